#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Compares the quirks in the three places that name them: the package of the RTL (the source), the simulator's
master, which reads them from a scenario, and the table of docs/choices.md. The package may shorten a name. For
biss_axi: the parameters of one bit (the source), its master, and the row of docs/axi.md.

  check_quirks.py               the places agree
  check_quirks.py --self-test   planted differences are reported
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools" / "synth"))

import project  # noqa: E402

PACKAGE = "rtl/mb4/mb4_pkg.sv"
MASTER = "sim/masters/mb4/mb4_master.cpp"
TABLE = "docs/choices.md"
AXI_PLACES = ("rtl/axi/biss_axi.sv", "sim/masters/axi/axi_master.cpp", "docs/axi.md")


def package_quirks(text):
    bits = {name: int(bit) for name, bit in
            re.findall(r"int unsigned QUIRK_(\w+?)(?:_LSB)?\s*=\s*(\d+);", text)}
    width = re.search(r"QUIRKS_W\s*=\s*(\d+);", text)
    return bits, int(width[1]) if width else None


def master_quirks(text):
    table = re.search(r"kQuirkBits\[\] = \{(.*?)\};", text, re.S)
    bits = {name: int(bit) for name, bit in re.findall(r'\{"(\w+)", (\d+)\}', table[1] if table else "")}
    revision = re.search(r"kQuirkRevisionBit = (\d+);", text)
    return bits | ({"REVISION": int(revision[1])} if revision else {})


def table_quirks(text):
    table = re.search(r"(?m)^\| no\. \| quirk .*\n(?:\|.*\n)+", text)
    return set(re.findall(r"(?m)^\| \d+ \| `(\w+)`", table[0] if table else ""))


def findings(package, master, table):
    source, width = package_quirks(package)
    bits = master_quirks(master)
    found = []
    if not source:
        found.append(f"{PACKAGE}: no QUIRK_ constants")
    for name, bit in source.items():
        full = [other for other in bits if other.startswith(name)]
        if len(full) != 1 or bits[full[0]] != bit:
            found.append(f"{MASTER}: no quirk {name} with bit {bit}, as in {PACKAGE}")
    if len(bits) != len(source):
        found.append(f"{MASTER}: {len(bits)} quirks, {PACKAGE} has {len(source)}")
    for name in sorted(table_quirks(table) ^ bits.keys()):
        found.append(f"{TABLE} and {MASTER}: only one of them has quirk {name}")
    # REVISION has two bits, each other quirk one; together they fill the vector.
    if width != len(source) + 1:
        found.append(f"{PACKAGE}: QUIRKS_W is {width}, not {len(source) + 1}")
    return found


def axi_findings(top, master, page):
    parameters = set(re.findall(r"(?m)^ +parameter bit +(\w+)", top))
    table = re.search(r"kSwitches\[\] = \{(.*?)\};", master, re.S)
    switches = set(re.findall(r'\{"(\w+)", ', table[1] if table else ""))
    row = re.search(r"(?m)^\| `\[chip\.quirks\]` ([^|]*)\|", page)
    shown = set(re.findall(r"`(\w+)`", row[1] if row else ""))
    found = [] if parameters else [f"{AXI_PLACES[0]}: no parameters of one bit"]
    for place, names in zip(AXI_PLACES[1:], (switches, shown)):
        found += [f"{place} and {AXI_PLACES[0]}: only one of them has {name}" for name in sorted(names ^ parameters)]
    return found


def self_test():
    package = ("localparam int unsigned QUIRKS_W = 3;\nlocalparam int unsigned QUIRK_AB_WR = 0;\n"
               "localparam int unsigned QUIRK_REVISION_LSB = 1;\n")
    master = 'x kQuirkBits[] = {{"AB_WRITE", 0}};\nunsigned kQuirkRevisionBit = 1;\n'
    table = "| no. | quirk | x |\n|---|---|---|\n| 5 | `AB_WRITE` | 0 |\n| 6 | `REVISION` | 0 |\n\n"
    wrong = []
    if found := findings(package, master, table):
        wrong.append(f"the good places: {found}")
    for what, places in {
            "a bit of the package": (package.replace("WR = 0", "WR = 2"), master, table),
            "the bit of REVISION": (package, master.replace("Bit = 1", "Bit = 2"), table),
            "a name of the master": (package, master.replace("AB", "AC"), table),
            "one quirk more": (package, master.replace('"AB_WRITE", 0}', '"AB_WRITE", 0}, {"NEW", 3}'),
                               table),
            "a row missing": (package, master, table.replace("| 6 | `REVISION` | 0 |\n", "")),
            "the width": (package.replace("W = 3", "W = 4"), master, table),
            "nothing found": ("", "", "")}.items():
        if not findings(*places):
            wrong.append(f"{what}: not reported")
    axi = ("  parameter bit          ONE = 1'b0,\n  parameter bit TWO = 1'b1\n",
           'kSwitches[] = {\n {"ONE", kOne},\n {"TWO", kTwo}};', "| `[chip.quirks]` `ONE`, `TWO` | boolean |\n")
    if found := axi_findings(*axi):
        wrong.append(f"the good places of biss_axi: {found}")
    for place in range(3):
        planted = [text.replace("TWO", "TOO") if k == place else text for k, text in enumerate(axi)]
        if not axi_findings(*planted):
            wrong.append(f"a name in {AXI_PLACES[place]}: not reported")
    return wrong


def read(names):
    return [(project.ROOT / name).read_text(encoding="utf-8") for name in names]


def main():
    if sys.argv[1:] == ["--self-test"]:
        project.finish(self_test(), "planted differences, all reported")
    project.finish(findings(*read((PACKAGE, MASTER, TABLE))) + axi_findings(*read(AXI_PLACES)),
                   "the places agree, for the iC-MB4 and for biss_axi")


main()
