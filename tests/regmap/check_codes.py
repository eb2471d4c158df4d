#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Names of codes in what is generated: those of the RDL are in the JSON file, the C++ table and the manual; an SVD
file has the registers, fields, reset values and names of its JSON file.

  check_codes.py    of all maps and of the sample; planted faults are found
"""

import json
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

HERE = Path(__file__).resolve().parent
REGMAP = HERE.parents[1] / "regmap"
ACCESS = {"rw": "read-write", "ro": "read-only", "wo": "write-only", "sc": "read-write", "w0c": "read-write",
          "w1c": "read-write", "w1s": "read-write", "rc": "read-only", "rom": "read-only"}


def rdl_words(text):
    """{enum: {code: word}}: the name property where a code has one, else its identifier."""
    enums = {}
    for name, body in re.findall(r"^enum (\w+) \{\n(.*?)^\};", text, re.M | re.S):
        enums[name] = {int(value, 16 if base == "h" else 10): shown or ident
                       for ident, base, value, shown in re.findall(
                           r"^\s*(\w+)\s*=\s*\d+'([dh])(\w+)\s*\{ (?:name = \"([^\"]*)\"; )?", body, re.M)}
    return enums


def findings(rdl, folder):
    found = []
    text = rdl.read_text(encoding="utf-8")
    table = json.loads(next(folder.glob("*_regs.json")).read_text(encoding="utf-8"))
    fields = table["fields"] + table["alternate_fields"]
    cpp = next(folder.glob("*_regs_table.hpp")).read_text(encoding="utf-8")
    manual = (folder / "registers.md").read_text(encoding="utf-8")
    # Every list of names is one of the RDL's, and every one that a field uses is there.
    lists = [{code[0]: name for code, name in zip(f["codes"], f.get("names", [])) if name} for f in fields]
    for enum, words in rdl_words(text).items():
        if re.search(rf"encode = {enum};", text) and words not in lists:
            found.append(f"{folder.name}: {enum}: no field of the JSON file has its names")
        for code, word in words.items():
            if not re.search(rf'\{{{code}, \d+, "{re.escape(word)}", ', cpp):
                found.append(f"{folder.name}: {enum}: {word} is not in the C++ table")
            if not re.search(rf"\*\* {re.escape(word)} \(|\| {re.escape(word)} \|", manual):
                found.append(f"{folder.name}: {enum}: {word} is not in the manual")
    for f in fields:
        if len(f["codes"]) != len(f.get("names", [])) or len(f["codes"]) != len(f.get("meanings", [])):
            found.append(f"{folder.name}: {f['name']}: not as many names as codes")
    for svd in folder.glob("*.svd"):
        found += svd_findings(svd.name, svd.read_text(encoding="utf-8"), table)
    if table["register_width"] == 32 and not list(folder.glob("*.svd")):
        found.append(f"{folder.name}: there is no SVD file")
    return found


def svd_findings(name, text, table):
    registers = {}
    for register in ElementTree.fromstring(text).iter("register"):
        registers[int(register.findtext("addressOffset"), 0)] = register
    if len({register.findtext("name") for register in registers.values()}) != len(registers):
        return [f"{name}: two registers have one name"]
    made = set()
    for address, register in registers.items():
        reset = int(register.findtext("resetValue"), 0)
        for field in register.iter("field"):
            msb, lsb = map(int, field.findtext("bitRange").strip("[]").split(":"))
            names = tuple((int(each.findtext("value")), each.findtext("name").upper())
                          for each in field.iter("enumeratedValue"))
            made.add((address, lsb, msb - lsb + 1, reset >> lsb & (1 << msb - lsb + 1) - 1, field.findtext("access"),
                      names))
    expected = set()
    for f in table["fields"]:
        names = tuple((code[0], word.upper()) for code, word in zip(f["codes"], f.get("names", [])) if word)
        expected.add((f["address"], f["lsb"], f["width"], f["reset"], ACCESS[f["access"]], names))
    return [f"{name}: {what} {row}" for what, rows in (("lacks", expected - made), ("has", made - expected))
            for row in sorted(rows)]


def planted():
    """Each fault in an SVD file or a table is found."""
    folder = REGMAP / "generated" / "axi"
    table = json.loads((folder / "axi_regs.json").read_text(encoding="utf-8"))
    text = (folder / "axi.svd").read_text(encoding="utf-8")
    for before, after in (("<bitRange>[0:0]", "<bitRange>[1:1]"), ("<access>read-only", "<access>read-write"),
                          ("<enumeratedValue>", "<other>"), ("<resetValue>0x00000000", "<resetValue>0x00000001")):
        changed = text.replace(before, after, 1)
        if before == "<enumeratedValue>":
            changed = changed.replace("</enumeratedValue>", "</other>", 1)
        if changed == text or not svd_findings("planted", changed, table):
            yield f"planted: {after} was not found"


def main():
    maps = [(rdl, REGMAP / "generated" / rdl.stem) for rdl in sorted(REGMAP.glob("*.rdl"))]
    found = [row for rdl, folder in (*maps, (HERE / "sample.rdl", HERE / "generated" / "sample"))
             for row in findings(rdl, folder)]
    found += planted()
    for row in found:
        print(row)
    print(f"{len(maps)} maps, {len(found)} finding(s)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
