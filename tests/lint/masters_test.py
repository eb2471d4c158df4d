#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""masters.toml: what tools/masters.py reads, what it refuses, and a master that is added by one entry.

  masters_test.py faults   wrong entries, each refused in one line with file, master and key
  masters_test.py toy      a copy of the tree with one more entry: each check lists the master
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import masters  # noqa: E402
import project  # noqa: E402

# (text of the file, what is said after the file's name)
WRONG = (
    ('[toy]\n', "toy: the key 'what' is missing"),
    ('[toy]\nwhat = 1\n', "toy: what: is not a text"),
    ('[toy]\nwhat = "a"\ntopps = 1\n', "toy: topps: no such key; there are what, line, list"),
    ('[toy]\nwhat = "a"\nline = "bus"\n', "toy: line: 'bus' is none of clocked, duplex"),
    ('[toy]\nwhat = "a"\nlist = "toy.x"\n', "toy: list: 'toy.x' does not exist"),
    ('[toy]\nwhat = "a"\nmaps = ["none"]\n', "toy: maps: 'regmap/generated/none' does not exist"),
    ('[toy]\nwhat = "a"\nmaps = [1]\n', "toy: maps: is not a list of texts"),
    ('[toy]\nwhat = "a"\ndriver = "toy.f"\n', "toy: driver: 'toy.f' is no folder with / at its end"),
    ('[toy]\nwhat = "a"\ncore = "none.core"\n', "toy: core: 'none.core' does not exist"),
    ('[toy]\nwhat = "a"\nuses = ["rtl/common/"]\n', "toy: uses: the master has no list"),
    ('[toy]\nwhat = "a"\nswitch = {A = "a", B = "b"}\n', "toy: switch: has more than one option"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.none = {}\n', "toy: tops.none: the list has no such module"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {plain = 1}\n', "toy: tops.toy: plain: is not true or false"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {clocks = {core = ["clk_i"]}}\n',
     "toy: tops.toy: clocks.core: is not [port, number]"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {parameters = {A = "1"}}\n', "toy: tops.toy: parameters.A: is not a number"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {buses = [{name = "a", kind = "can"}]}\n',
     "toy: tops.toy.buses[0]: kind: 'can' is none of axi4-lite"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {buses = [{name = "a", kind = "wishbone"}]}\n',
     "toy: tops.toy.buses[0]: the key 'prefix' is missing"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {plain = true, generics = {}}\n',
     "toy: tops.toy: generics: a top with plain = true has none"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ngates.one = {top = "none"}\n', "toy: gates.one.top: the list has no module none"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmeasured.one = {maker = "toy.f", programs = []}\n',
     "toy: measured.one: programs: names no program"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmeasured.one = {maker = "toy.f", programs = ["a"], models.a = {top = "none"}}\n',
     "toy: measured.one.models.a.top: the list has no module none"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\nmeasured.one = {maker = "toy.f", programs = ["a"], goals = {toggle = 1}}\n',
     "toy: measured.one: goals.toggle: is none of line, branch, mutants"),
    ('[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {}\n[other]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {}\n',
     "other: tops.toy: toy has one of this name"),
    ('[Toy]\nwhat = "a"\n', "Toy: a name has small letters, digits and '-'"),
    ('toy = 1\n', "toy: is no table"),
    ('[toy]\nwhat = \n', "Invalid value (at line 2, column 8)"),
)
# A model without RTL, as small as an entry can be, and a master with all that a check reads.
RIGHT = ('[dsl-model]\nwhat = "a"\nline = "duplex"\n',
         '[toy]\nwhat = "a"\nlist = "toy.f"\ntops.toy = {}\n')

TOY = """
[toy]
what = "a toy"
line = "duplex"
list = "rtl/toy/toy.f"
uses = ["rtl/common/"]
maps = ["toy"]
driver = "drivers/include/toy/"
core = "openmb4-toy.core"
switch = {MB4_TOY = "The simulator has the toy"}

[toy.tops.toy_bus]
ice40 = true
plain = true
clocks = {host = ["clk_i", 10]}
buses = [{name = "bus", kind = "wishbone", prefix = "wb_"}]

[toy.gates.toy_gates]
top = "toy_bus"

[toy.measured.toy_run]
maker = "rtl/toy/toy.f"
programs = ["toy_test"]
models = {toy = {top = "toy_bus"}}
"""
FILES = {
    "rtl/toy/toy.f": "-F ../common/common.f\n../../regmap/generated/toy/toy_regs_pkg.sv\ntoy_bus.sv\n",
    "rtl/toy/toy_bus.sv": "module toy_bus (\n  input  logic clk_i,\n  output logic y_o\n);\n  assign y_o = clk_i;\nendmodule\n",
    "regmap/generated/toy/toy_regs_pkg.sv": "package toy_regs_pkg;\nendpackage\n",
    "drivers/include/toy/toy.hpp": "",
    "openmb4-toy.core": "CAPI=2:\nname: openmb4:ip:toy:VERSION\n",
}


def faults():
    findings = []
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "masters.toml"
        (Path(folder) / "toy.f").write_text("toy.sv\n", encoding="utf-8")
        for text, wanted in WRONG:
            file.write_text(text, encoding="utf-8")
            done = subprocess.run([sys.executable, "-B", ROOT / "tools/masters.py", "--file", file],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 1 or not done.stderr.startswith(f"masters.toml: {wanted}") or done.stderr.count("\n") != 1:
                findings.append(f"expected '{wanted}', got {done.returncode}: {done.stderr or done.stdout}\n{text}")
        for text in RIGHT:
            file.write_text(text, encoding="utf-8")
            try:
                masters.read(file)
            except masters.Fault as fault:
                findings.append(f"refused: {fault}\n{text}")
    project.finish(findings, f"{len(WRONG)} wrong files, each refused with its key, and {len(RIGHT)} right ones")


if __name__ == "__main__":
    {"faults": faults}[sys.argv[1]]()
