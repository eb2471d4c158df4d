# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The project scripts for Vivado and Quartus read a release archive: run in the Tcl of Yosys with stand-ins for the
vendors' commands, for each top and preset. Every file they name exists, in the order of rtl/mb4/mb4.f, and wrong
arguments are refused.

  projects_test.py FOLDER    FOLDER is for what the tools leave

Exit status 77: Yosys is missing, or this is no git checkout.
"""

import re
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import constraints  # noqa: E402
import project  # noqa: E402

SCRIPTS = ROOT / "tools" / "synth" / "projects"
COMMANDS = {"vivado": "create_project add_files set_property get_files get_runs current_fileset launch_runs "
                      "wait_on_run open_run report_timing_summary report_clock_interaction report_utilization",
            "quartus": "load_package project_new set_global_assignment set_parameter execute_flow project_close"}
# Without project and folder.
DEVICE = {"vivado": ["xc7a35ticsg324-1L"], "quartus": ["Cyclone V", "5CEBA4F23C7"]}


def run(tool, arguments, folder):
    """(exit status, calls of the vendor's commands as lists of words)"""
    stubs = "\n".join(f'proc {name} args {{puts "CALL {name} [join $args \\x01]"; return {name}}}'
                      for name in COMMANDS[tool].split())
    words = " ".join("{" + str(word) + "}" for word in arguments)
    script = folder / f"{tool}_test.tcl"
    script.write_text(f"{stubs}\nset argv [list {words}]\nsource {{{SCRIPTS / f'{tool}.tcl'}}}\n", encoding="utf-8")
    status, text = project.run([project.tool("yosys"), "-q", "-c", script], cwd=folder)
    calls = [line.removeprefix("CALL ").split(" ", 1) for line in text.splitlines() if line.startswith("CALL ")]
    return status, [[call[0], *(call[1].split("\x01") if len(call) > 1 else [])] for call in calls], text


def findings(tool, top, preset, calls, release):
    rtl = [str(release / path.relative_to(ROOT)) for path in project.rtl_files()]
    ending = {"vivado": "Vivado", "quartus": "Quartus"}[tool]
    place = release / "rtl/mb4/constraints" / ("" if preset == "full" else preset)
    file = str(place / constraints.FILES[ending].format(top))
    features = project.presets()[preset]
    if tool == "vivado":
        found = {"rtl": next(call[2] for call in calls if call[0] == "add_files" and call[1] == "-norecurse").split(),
                 "constraints": [call[4] for call in calls if call[:2] == ["add_files", "-fileset"]],
                 "features": [call[2] for call in calls if call[:2] == ["set_property", "generic"]],
                 "top": [call[2] for call in calls if call[:2] == ["set_property", "top"]]}
        features = f"Features=32'd{features}"
    else:
        named = [call[2:] for call in calls if call[0] == "set_global_assignment"]
        found = {"rtl": [value for name, value in named if name == "SYSTEMVERILOG_FILE"],
                 "constraints": [value for name, value in named if name == "SDC_FILE"],
                 "features": [call[3] for call in calls if call[:3] == ["set_parameter", "-name", "Features"]],
                 "top": [value for name, value in named if name == "TOP_LEVEL_ENTITY"]}
    expected = {"rtl": rtl, "constraints": [file], "features": [str(features)], "top": [top]}
    wrong = [f"{tool}, {top}, {preset}: {what}: {found[what]}" for what, value in expected.items() if found[what] != value]
    return wrong + [f"{tool}: {name} is no file" for name in found["rtl"] + found["constraints"]
                    if not Path(name).is_file()]


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    project.tool("yosys")
    folder.mkdir(parents=True, exist_ok=True)
    archive = folder / "openmb4-9.9.9.tar.gz"
    with tarfile.open(archive, "w:gz") as tar:
        for name in project.tracked():
            if re.match(r"rtl/|regmap/", name) and (ROOT / name).is_file():
                tar.add(ROOT / name, f"openmb4-9.9.9/{name}")
    found = []
    for tool, device in DEVICE.items():
        for preset in project.presets():
            for top in constraints.TOPS:
                place = folder / tool / preset / top
                place.mkdir(parents=True, exist_ok=True)
                status, calls, text = run(tool, [archive, top, preset, *device, place], place)
                if status != 0:
                    found.append(f"{tool}, {top}, {preset}: {text[-1000:]}")
                else:
                    found += findings(tool, top, preset, calls, place / "openmb4-9.9.9")
        for what, arguments in {"a preset": [archive, "mb4_core", "small", *device, folder],
                                "a top": [archive, "mb4_chip", "full", *device, folder],
                                "an archive": [folder / "none.tar.gz", "mb4_core", "full", *device, folder],
                                "a number of arguments": [archive, "mb4_core"]}.items():
            if run(tool, arguments, folder)[0] == 0:
                found.append(f"{tool}: wrong {what} is not refused")
    project.finish(found, f"{len(DEVICE)} scripts, {len(project.presets())} presets, {len(constraints.TOPS)} tops: each "
                          "file exists, wrong arguments are refused")


if __name__ == "__main__":
    main()
