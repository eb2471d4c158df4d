#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Constants of the packages that name a width or a place of a struct, against the struct.

  check_structs.py               each package of rtl/: NAME_W is the width of name_t, NAME_FIELD the place of its field
  check_structs.py --self-test   wrong constants are found

Where Yosys 0.23 builds wrong hardware for a struct variable (in a generate loop) or a port is a flat vector of several
structs, the RTL takes such a constant. It stands in the package of its struct.
"""

import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import structs  # noqa: E402

SELF_TEST = """package x_pkg;
  typedef struct packed {
    logic       good;
    logic [3:0] delay;
  } word_t;
  typedef struct packed {
    word_t      word;   // a comment; with a semicolon
    logic [1:0] slave;
  } offer_t;
  localparam int unsigned WORD_W     = %d;
  localparam int unsigned WORD_GOOD  = %d;
  localparam int unsigned OFFER_W    = 7;
  localparam int unsigned OFFER_WORD = %d;
  localparam int unsigned WORD_LIMIT = 99;  // no field: another meaning
endpackage
"""


def check(path):
    """(findings, number of constants compared)."""
    package = structs.Package(path)
    findings, compared = [], 0
    for name, value in package.constants.items():
        for struct, fields in package.structs.items():
            prefix = struct[:-2].upper() + "_"
            if not name.startswith(prefix):
                continue
            what = name[len(prefix):].lower()
            if what == "w":
                expected = sum(field.width for field in fields)
            else:
                expected = next((field.lsb for field in fields if field.name == what), None)
            if expected is None:
                continue
            compared += 1
            if value != expected:
                findings.append(f"{path.name}: {name} is {value}, {struct} says {expected}")
    return findings, compared


def self_test():
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "x_pkg.sv"
        for values, wrong in (((5, 4, 2), []), ((6, 4, 2), ["WORD_W"]), ((5, 0, 2), ["WORD_GOOD"]), ((5, 4, 0), ["OFFER_WORD"])):
            path.write_text(SELF_TEST % values, encoding="utf-8")
            findings, compared = check(path)
            if compared != 4 or [text.split()[1] for text in findings] != wrong:
                problems.append(f"{values}: {findings}, {compared} compared")
    project.finish(problems, "a right package and three wrong constants")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    findings, total = [], 0
    for path in sorted(project.RTL.rglob("*_pkg.sv")):
        found, compared = check(path)
        findings += found
        total += compared
    if total == 0:
        findings.append("no constant was compared")
    project.finish(findings, f"{total} constants are those of their structs")


main()
