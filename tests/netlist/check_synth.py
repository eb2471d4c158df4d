#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Yosys reads, elaborates and synthesises the RTL.

  check_synth.py every FOLDER          each module as its own top, then all with synth; leaves
                                       all.json (ports, cells) and yosys.log in FOLDER
  check_synth.py warnings FOLDER       the log of the first holds only warnings that are listed
  check_synth.py ice40 FOLDER MODULE   synth_ice40; prints LUT, flop and RAM counts
  check_synth.py self-test FOLDER      planted latch, loop, two drivers, no driver, new warning
"""

import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import yosys  # noqa: E402

ALLOW_LIST = HERE / "yosys_warnings.txt"

PLANTED = {
    "latch": ("always @* if (a_i[0]) y_o = a_i[1];", r"selection is not empty"),
    "loop": ("logic p, q; assign p = !(q && a_i[0]); assign q = p || a_i[1]; assign y_o = q;",
             r"[Ll]oop|SCC"),
    "two_drivers": ("assign y_o = a_i[0]; assign y_o = a_i[1];", r"multiple conflicting drivers"),
    "no_driver": ("logic p; assign y_o = p & a_i[0];", r"has no driver"),
    "unknown_module": ("nowhere u_x (.a(a_i), .y(y_o));", r"not part of the design"),
}


def unlisted(text, patterns):
    """Warnings that no pattern covers, and patterns that cover no warning."""
    found = yosys.warnings(text)
    bad = [f"{top}: {line}" for top, line in found
           if not any(re.fullmatch(p, line) for p in patterns)]
    idle = [f"{ALLOW_LIST.name}: matches nothing any more: {p}" for p in patterns
            if not any(re.fullmatch(p, line) for _, line in found)]
    return bad + idle


def every(folder):
    modules = list(project.rtl_modules())
    commands = yosys.read(project.all_rtl_files()) + ["design -save rtl"]
    for module in modules:
        commands += yosys.check_as_top(module)
    commands += yosys.synthesise() + ["write_json all.json"]
    status, text = yosys.execute(commands, folder, "every")
    (folder / "yosys.log").write_text(text, encoding="utf-8")
    if status != 0:
        project.finish([text], "")
    netlist = json.loads((folder / "all.json").read_text(encoding="utf-8"))
    missing = [f"{m}: not in the netlist" for m in modules if m not in netlist["modules"]]
    checked = [line for line in text.splitlines() if line.startswith("top ")]
    if len(checked) != len(modules) + 1:
        missing.append(f"{len(checked) - 1} of {len(modules)} modules were checked as top")
    # One file, one module: what the list names is all there is.
    known = {re.sub(r"^\\", "", m["attributes"].get("hdlname", name))
             for name, m in netlist["modules"].items()}
    missing += [f"{m}: module outside the lists of masters.toml" for m in sorted(known - set(modules))]
    project.finish(missing, f"{len(modules)} modules, each as its own top and synthesised; "
                            f"no latch, no loop, no double driver")


def ice40(folder, module):
    commands = yosys.read(project.files_of(module)) + [
        f"synth_ice40 -top {module}",
        "select -assert-none t:$dlatch t:$sr t:$_DLATCH_* t:$_SR_*",
        "check -assert",
        "tee -o stat.json stat -json",
    ]
    status, text = yosys.execute(commands, folder, "ice40")
    findings = [] if status == 0 else [text]
    findings += unlisted(text, yosys.allowed(ALLOW_LIST))
    if findings:
        project.finish(findings, "")
    cells = json.loads((folder / "stat.json").read_text(encoding="utf-8"))
    cells = cells["design"]["num_cells_by_type"]
    flops = sum(count for cell, count in cells.items() if cell.startswith("SB_DFF"))
    ram = sum(count for cell, count in cells.items() if cell.startswith("SB_RAM"))
    foreign = [f"cell that is not iCE40's: {cell}" for cell in cells if not cell.startswith("SB_")]
    project.finish(foreign, f"{module}: {cells.get('SB_LUT4', 0)} LUT4, {cells.get('SB_CARRY', 0)} "
                            f"carry, {flops} flops, {ram} block RAMs")


def self_test(folder):
    findings = []
    for name, (body, expected) in PLANTED.items():
        source = folder / f"{name}.sv"
        folder.mkdir(parents=True, exist_ok=True)
        source.write_text(f"module {name} (input logic [1:0] a_i, output logic y_o);\n"
                          f"  {body}\nendmodule\n", encoding="utf-8")
        commands = yosys.read([source]) + ["design -save rtl"] + yosys.check_as_top(name)
        status, text = yosys.execute(commands, folder, name)
        if status == 0 or not re.search(expected, text):
            findings.append(f"planted {name} was not reported (exit status {status}):\n{text}")
    patterns = [r"Warning: expected in \w+\.sv:\d+"]
    listed = "top mb4_x\nWarning: expected in /some/where/mb4_x.sv:46\n"
    if unlisted(listed, patterns):
        findings.append("a listed warning was reported")
    if len(unlisted(listed + "Warning: something new\n", patterns)) != 1:
        findings.append("a new warning was not reported")
    if len(unlisted("", patterns)) != 1:
        findings.append("a warning that has gone was not reported")
    project.finish(findings, f"{len(PLANTED) + 2} planted faults, all reported")


def main():
    mode, folder = sys.argv[1], Path(sys.argv[2])
    project.tool("yosys")
    if mode == "every":
        every(folder)
    elif mode == "warnings":
        text = (folder / "yosys.log").read_text(encoding="utf-8")
        findings = unlisted(text, yosys.allowed(ALLOW_LIST))
        project.finish(findings, f"{len(yosys.warnings(text))} warnings, all listed with a reason")
    elif mode == "ice40":
        ice40(folder, sys.argv[3])
    else:
        self_test(folder)


main()
