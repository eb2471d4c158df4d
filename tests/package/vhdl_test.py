#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The VHDL of rtl/mb4/vhdl around the plain Verilog of the release: GHDL turns each example into Verilog,
Icarus and Yosys elaborate it with the module itself in place of GHDL's empty one.

  vhdl_test.py FOLDER    FOLDER is for what the tools leave

Exit status 77: a tool is missing.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import plain_verilog  # noqa: E402
import project  # noqa: E402
import vhdl  # noqa: E402

PACKAGE = {"ghdl": "ghdl", "iverilog": "iverilog", "yosys": "yosys"}


def run(command, folder):
    status, text = project.run(command, cwd=folder)
    # The warnings about ports.
    return text if status != 0 or re.search(r"warning:.* port|Resizing", text, re.I) else ""


def instance(top, folder):
    """The example of a top as Verilog, without the empty module that GHDL puts before it."""
    sources = [vhdl.FOLDER / f"{vhdl.PACKAGE}.vhd", vhdl.FOLDER / f"{top}_example.vhd"]
    for command in ([project.tool("ghdl"), "-a", "--std=08", *sources],
                    [project.tool("ghdl"), "--synth", "--std=08", "--out=verilog",
                     f"{top}_example"]):
        status, text = project.run(command, cwd=folder)
        if status != 0:
            raise SystemExit(f"{top}: {text}")
    text = text[text.index(f"module {top}\n"):]
    stub, rest = text.split("endmodule\n", 1)
    if f"module {top}_example" not in rest or "assign" in stub:
        raise SystemExit(f"{top}: GHDL's Verilog has another form than this test knows")
    path = folder / f"{top}_example.v"
    path.write_text(rest.split("endmodule\n", 1)[0] + "endmodule\n", encoding="utf-8")
    return path


def elaborate(top, files, folder):
    """What each tool says against it; empty if nothing."""
    files = [str(file) for file in files]
    script = f"read_verilog {' '.join(files)}; hierarchy -check -top {top}_example"
    return {"Icarus": run([project.tool("iverilog"), "-g2005", "-Wall", "-t", "null", "-s",
                           f"{top}_example", *files], folder),
            "Yosys": run([project.tool("yosys"), "-p", script], folder)}


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    missing = [name for name in PACKAGE if project.shutil.which(name) is None]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (tools/setup.sh test installs it)")
        sys.exit(project.SKIPPED)
    findings = vhdl.stale()
    for top in plain_verilog.TOPS:
        example = instance(top, folder)
        module = plain_verilog.write(top, folder)
        for tool, text in elaborate(top, [example, module], folder).items():
            if text:
                findings.append(f"{top}, {tool}: {text}")
        # A port with another name must be found, and one of another width.
        for what, new in (("name", "quirk_i"), ("width", "[6:0]")):
            wrong = folder / f"{top}_{what}.v"
            text = module.read_text(encoding="utf-8")
            changed = [re.sub(r"\bquirks_i\b", new, line) if what == "name" else
                       re.sub(r"^(  (?:input|wire) )\[5:0\] (quirks_i;)$", rf"\1{new} \2", line)
                       for line in text.splitlines()]
            if changed == text.splitlines():
                findings.append(f"{top}: no port quirks_i to change")
            wrong.write_text("\n".join(changed) + "\n", encoding="utf-8")
            for tool, said in elaborate(top, [example, wrong], folder).items():
                if not said:
                    findings.append(f"{top}: {tool} does not notice the other {what} of a port")
    project.finish(findings, f"{len(plain_verilog.TOPS)} tops fit, wrong ports are noticed")


if __name__ == "__main__":
    main()
