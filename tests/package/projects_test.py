# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The project scripts for Vivado and Quartus read a release archive: run in the Tcl of Yosys with stand-ins for the
vendors' commands, for each top with constraints, with each preset or with parameters. Every file they name exists, in the
order of the list of its room, and wrong arguments are refused.

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


def designs():
    """(top, third argument, {parameter: value}) of each run."""
    for top, one in constraints.CLOCKED.items():
        if one.master.presets:
            for preset, features in project.presets().items():
                yield top, preset, {"Features": features}
        else:
            yield top, "default", {}
    yield "biss_axi", "BISS_CHANNEL_WIDTH=4,ALIGN_LATCH=1'b1", {"BISS_CHANNEL_WIDTH": 4, "ALIGN_LATCH": "1'b1"}


def findings(tool, top, chosen, parameters, calls, release):
    room = constraints.CLOCKED[top].master.list.parent
    rtl = [str(release / path.relative_to(ROOT)) for path in project.listed(constraints.CLOCKED[top].master.list)]
    ending = {"vivado": "Vivado", "quartus": "Quartus"}[tool]
    preset = chosen if "Features" in parameters and chosen != "full" else ""
    file = str(release / room.relative_to(ROOT) / "constraints" / preset / constraints.FILES[ending].format(top))
    if tool == "vivado":
        found = {"rtl": next(call[2] for call in calls if call[0] == "add_files" and call[1] == "-norecurse").split(),
                 "constraints": [call[4] for call in calls if call[:2] == ["add_files", "-fileset"]],
                 "parameters": [call[2] for call in calls if call[:2] == ["set_property", "generic"]],
                 "top": [call[2] for call in calls if call[:2] == ["set_property", "top"]]}
        values = [" ".join(f"{name}={value}".replace("Features=", "Features=32'd") for name, value in parameters.items())]
    else:
        named = [call[2:] for call in calls if call[0] == "set_global_assignment"]
        found = {"rtl": [value for name, value in named if name == "SYSTEMVERILOG_FILE"],
                 "constraints": [value for name, value in named if name == "SDC_FILE"],
                 "parameters": [tuple(call[2:]) for call in calls if call[:2] == ["set_parameter", "-name"]],
                 "top": [value for name, value in named if name == "TOP_LEVEL_ENTITY"]}
        values = [(name, str(value)) for name, value in parameters.items()]
    expected = {"rtl": rtl, "constraints": [file], "parameters": values, "top": [top]}
    wrong = [f"{tool}, {top}, {chosen}: {what}: {found[what]}" for what, value in expected.items() if found[what] != value]
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
        # Of presets, as tools/release.sh adds them.
        for preset in list(project.presets())[1:]:
            made = folder / "constraints" / preset
            status, text = project.run([sys.executable, "-B", ROOT / "tools/synth/constraints.py", made, "--features", preset])
            if status != 0:
                raise SystemExit(text)
            tar.add(made, f"openmb4-9.9.9/rtl/mb4/constraints/{preset}")
        for name in project.tracked():
            if re.match(r"rtl/|regmap/", name) and (ROOT / name).is_file():
                tar.add(ROOT / name, f"openmb4-9.9.9/{name}")
    found = []
    for tool, device in DEVICE.items():
        for number, (top, chosen, parameters) in enumerate(designs()):
            place = folder / tool / str(number)
            place.mkdir(parents=True, exist_ok=True)
            status, calls, text = run(tool, [archive, top, chosen, *device, place], place)
            if status != 0:
                found.append(f"{tool}, {top}, {chosen}: {text[-1000:]}")
            else:
                found += findings(tool, top, chosen, parameters, calls, place / "openmb4-9.9.9")
        for what, arguments in {"a preset": [archive, "mb4_core", "small", *device, folder],
                                "a preset of a top without": [archive, "biss_spi", "single", *device, folder],
                                "parameters": [archive, "biss_axi", "EXTRAS 1", *device, folder],
                                "a top": [archive, "mb4_chip", "full", *device, folder],
                                "an archive": [folder / "none.tar.gz", "mb4_core", "full", *device, folder],
                                "a number of arguments": [archive, "mb4_core"]}.items():
            if run(tool, arguments, folder)[0] == 0:
                found.append(f"{tool}: wrong {what} is not refused")
    project.finish(found, f"{len(DEVICE)} scripts, {len(list(designs()))} designs: each file exists, wrong arguments are refused")


if __name__ == "__main__":
    main()
