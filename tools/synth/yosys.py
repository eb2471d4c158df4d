# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of Yosys on the RTL: reading, checks, synthesis."""

import re

from project import INCLUDE, rtl_files, run, tool

# After proc a latch is one of these; after techmap one of the second line.
LATCHES = "t:$dlatch t:$adlatch t:$dlatchsr t:$sr"
GATE_LATCHES = "t:$_DLATCH_* t:$_DLATCHSR_* t:$_SR_*"


def read(files=None):
    """Yosys commands that read the RTL as a user's tool would: no define, SystemVerilog subset."""
    names = " ".join(str(path) for path in (rtl_files() if files is None else files))
    return [f"read_verilog -sv -I{INCLUDE} {names}"]


def choose(top, parameters):
    """Gives parameters of a top, {name: integer}, their values, all at once: any part of them may be an error. The
    top has another name then: rename -top."""
    sets = " ".join(f"-set {name} {value}" for name, value in parameters.items())
    return [f"chparam {sets} {top}"] if parameters else []


def check_as_top(module):
    """Elaborates one module as top and demands a clean structure of everything below it."""
    return [
        "design -load rtl",
        f"log -stderr top {module}",
        f"hierarchy -check -top {module}",
        "proc",
        f"select -assert-none {LATCHES}",
        "flatten",
        "opt_expr",
        "opt_clean",
        "check -assert",
        "scc -expect 0",
        "memory -nomap",
        "check -assert",
    ]


def synthesise():
    """Every module with its default parameters and those it has in the chip; hierarchy is kept."""
    return [
        "design -load rtl",
        "log -stderr top all",
        "synth",
        f"select -assert-none {LATCHES} {GATE_LATCHES}",
        "check -assert",
    ]


def execute(commands, folder, name):
    """Runs the commands; returns exit status and all that Yosys says with -q (warnings, errors)."""
    folder.mkdir(parents=True, exist_ok=True)
    script = folder / f"{name}.ys"
    script.write_text("\n".join(commands) + "\n", encoding="utf-8")
    return run([tool("yosys"), "-q", "-s", script], cwd=folder)


def warnings(text):
    """(top, message) of each warning, paths reduced to the file's name."""
    found = []
    top = ""
    for line in text.splitlines():
        started = re.fullmatch(r"top (\w+)", line.strip())
        if started:
            top = started.group(1)
        elif re.search(r"\bwarning\b", line, re.IGNORECASE):
            found.append((top, re.sub(r"/\S*/", "", line.strip())))
    return found


def allowed(path):
    """Regular expressions of an allow list; each must stand under a comment with the reason."""
    patterns = []
    reason = False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        line = line.strip()
        if line.startswith("#"):
            reason = "SPDX" not in line and len(line) > 10
        elif line == "":
            reason = False
        else:
            if not reason:
                raise SystemExit(f"{path.name}:{number}: no reason above this entry")
            patterns.append(line)
    return patterns
