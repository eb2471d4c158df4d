#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Verilator's lint of the RTL and the waivers.

  check_verilator.py lint        every module as top with the project's flags, smaller instances of
                                 some (SMALLER), each parameter of the features alone, and each
                                 preset: no message
  check_verilator.py list        the names of these modules
  check_verilator.py waivers     each waiver of rtl/waivers.vlt stands under its reason, none is idle,
                                 none names UNOPTFLAT; no lint_off inside the RTL
  check_verilator.py self-test   planted faults are reported
"""

import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402

# The generated packages are lists of constants, of which a design uses a part: one pair for each.
INLINE_ALLOWED = {(path.name, "UNUSEDPARAM"): 1 for path in project.rtl_packages() if "generated" in path.parts}


# Parameters that are smaller than in the chip, or other choices: each alone, and all together.
SMALLER = {"biss_line": ["BissB=0", "Ssi=0", "Mo=0", "FreeCrc=0", "Gray=0", "Slaves=1", "DataBits=32", "DelayW=6"],
           **{name: top.smaller for name, top in project.tops("smaller").items()}}

# Features of the tops (decision 44), each alone. Wrong numbers end the elaboration.
FEATURES = ["Lines=1", "Slaves=1", "Slaves=2", "Slaves=3", "Slaves=4", "BissB=0", "Ssi=0", "Mo=0",
            "Control=0", "Gray=0", "Force=0", "FreeCrc=0", "Banks=1"]
TOPS = list(project.MASTERS["mb4"].tops)
WRONG = ["Lines=0", "Lines=3", "Slaves=0", "Slaves=5", "Slaves=7", "Slaves=9", "Banks=0", "Banks=3"]


def lint(top, files, waivers, parameters=()):
    """What Verilator says about one top module; verilator_flags() holds -fno-const-bit-op-tree."""
    status, text = project.run([project.tool("verilator"), "--lint-only",
                                *project.verilator_flags(), f"-I{project.INCLUDE}",
                                "--top-module", top, *(f"-G{value}" for value in parameters),
                                *waivers, *files])
    text = text.replace(f"{project.ROOT}/", "")
    return [f"{' '.join([top, *parameters])}: {text.strip()}"] if status != 0 or text.strip() else []


def inline(path, text):
    """lint_off comments, beyond those that are allowed."""
    findings, seen = [], {}
    for number, line in enumerate(text.splitlines(), 1):
        for rule in re.findall(r"\blint_off\b\s*(\w*)", line):
            key = (path.name, rule)
            seen[key] = seen.get(key, 0) + 1
            if seen[key] > INLINE_ALLOWED.get(key, 0):
                findings.append(f"{path.name}:{number}: lint_off {rule}: waivers live in waivers.vlt")
    return findings


def unreasoned(name, text):
    """Waivers without a sentence above them, and those of UNOPTFLAT. A reason holds up to the next
    empty line."""
    findings, reason = [], False
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if line.startswith("//"):
            words = re.search(r"\w+\W+\w+\W+\w+", line) is not None
            reason = reason or ("SPDX" not in line and words)
        elif line == "" or line.startswith("`"):
            reason = False
        else:
            if not reason:
                findings.append(f"{name}:{number}: waiver without a reason above it")
            if "UNOPTFLAT" in line:
                findings.append(f"{name}:{number}: UNOPTFLAT is never waived")
            if not re.match(r"lint_off\s+-rule\s+\w+", line):
                findings.append(f"{name}:{number}: a waiver names its rule: lint_off -rule")
    return findings


def waiver_lines(text):
    return [n for n, line in enumerate(text.splitlines()) if line.strip().startswith("lint_off")]


def idle(stems, files_of, tops, text):
    """Waivers whose removal brings no message, with any of `tops` or the module of `stems` that they name as
    top: left over from code that has gone, they would hide the next fault. files_of(top): what it is read with."""
    findings = []
    lines = text.splitlines()
    for number in waiver_lines(text):
        with tempfile.TemporaryDirectory() as folder:
            rest = Path(folder) / "rest.vlt"
            rest.write_text("\n".join(lines[:number] + lines[number + 1:]) + "\n", encoding="utf-8")
            named = set(re.findall(r"\w+(?=\.sv\b)", lines[number])) & stems
            named = {name for name in named if not name.endswith("_pkg")}
            if not any(lint(top, files_of(top), [rest])
                       for top in [*sorted(named), *(top for top in tops if top not in named)]):
                findings.append(f"waivers.vlt:{number + 1}: nothing needs this waiver any more: "
                                f"{lines[number]}")
    return findings


def left_out(files):
    """RTL that no master has."""
    left = {path for pattern in ("*.sv", "*.f") for path in project.RTL.rglob(pattern)} - {*files, *project.rtl_lists()}
    return [f"{path.relative_to(project.ROOT)}: no master of masters.toml has it" for path in sorted(left)]


def check_lint():
    files = project.all_rtl_files()
    modules = [path.stem for path in files if not path.stem.endswith("_pkg")]
    findings = left_out(files)
    findings += [line for top in modules for line in lint(top, project.files_of(top), [project.WAIVERS])]
    smaller = [(top, values) for top, all_values in SMALLER.items()
               for values in [*([value] for value in all_values), all_values]]
    # mb4_axil has the engine with all its ports. The tops pass the features on as one number.
    presets = [f"Features={value}" for value in project.presets().values()]
    smaller += [("mb4_axil", [value]) for value in [*FEATURES, *presets]]
    smaller += [("mb4_axil", ["Lines=1", f"Slaves={n}"]) for n in (1, 5, 7)]
    smaller += [(top, ["Lines=1", "Mo=0"]) for top in TOPS]
    for top, values in smaller:
        findings += lint(top, project.files_of(top), [project.WAIVERS], values)
    for value in WRONG:
        if not any("Lines is 1 or 2" in text for text in lint("mb4_core", project.files_of("mb4_core"), [project.WAIVERS], [value])):
            findings.append(f"mb4_core {value}: no error")
    project.finish(findings, f"{len(modules)} modules as top and {len(smaller)} smaller instances: no message; "
                             f"{len(WRONG)} wrong numbers: an error each")


def list_modules():
    """The modules that lint reads, or RTL that no master has."""
    findings = left_out(project.all_rtl_files())
    project.finish(findings, "\n".join(project.rtl_modules()))


def check_waivers():
    waivers = (project.WAIVERS).read_text(encoding="utf-8")
    findings = unreasoned("waivers.vlt", waivers)
    texts = {*project.RTL.rglob("*.sv"), *project.RTL.rglob("*.svh"), *project.all_rtl_files()}
    for path in sorted(texts):
        findings += inline(path, path.read_text(encoding="utf-8"))
    # The registers of biss_axi alone use a part of its package.
    tops = [*(name for master in project.MASTERS.values() for name in master.tops), "axi_regs"]
    findings += idle(set(project.rtl_modules()), project.files_of, tops, waivers)
    project.finish(findings, f"{len(waiver_lines(waivers))} waivers, each with a reason and needed")


def self_test():
    findings = []
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "mb4_x.sv"
        source.write_text("module mb4_x (input logic [1:0] a_i, output logic [1:0] y_o);\n"
                          "  assign y_o = a_i + 3'd1;\nendmodule\n", encoding="utf-8")
        if not any("WIDTH" in text for text in lint("mb4_x", [source], [])):
            findings.append("a width that does not fit was not reported")
        waiver = Path(folder) / "x.vlt"
        waiver.write_text("`verilator_config\nlint_off -rule WIDTH -file \"*mb4_x.sv\"\n"
                          "lint_off -rule LATCH\n", encoding="utf-8")
        if lint("mb4_x", [source], [waiver]):
            findings.append("a waived message was reported")
        if len(idle({"mb4_x"}, lambda top: [source], ["mb4_x"], waiver.read_text(encoding="utf-8"))) != 1:
            findings.append("one of two waivers is idle, this was not reported")
    head = "// SPDX-License-Identifier: Apache-2.0\n`verilator_config\n"
    if len(unreasoned("x.vlt", head + "lint_off -rule WIDTH\n")) != 1:
        findings.append("a waiver without a reason was not reported")
    if unreasoned("x.vlt", head + "// Because it is so.\nlint_off -rule WIDTH\n"):
        findings.append("a waiver with a reason was reported")
    if len(unreasoned("x.vlt", head + "// It is so here.\nlint_off -rule UNOPTFLAT\n")) != 1:
        findings.append("a waiver of UNOPTFLAT was not reported")
    if len(unreasoned("x.vlt", head + "// It is so here.\nlint_off\n")) != 1:
        findings.append("a waiver of everything was not reported")
    off = "// verilator " "lint_off UNUSEDPARAM\n"
    if inline(Path("mb4_regs_pkg.sv"), off) or len(inline(Path("mb4_regs_pkg.sv"), off * 2)) != 1 \
            or len(inline(Path("mb4_x.sv"), off)) != 1:
        findings.append("lint_off comments are not counted right")
    project.finish(findings, "planted faults, all reported")


project.tool("verilator")
{"lint": check_lint, "list": list_modules, "waivers": check_waivers, "self-test": self_test}[sys.argv[1]]()
