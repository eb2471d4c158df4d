#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Compare the generated map of the DSL master with the published tables of its registers, for both personalities.

The environment variable MB4_DSL_TABLES names the text with the tables: Markdown, a row "| Addr | Name | Acc | Reset |
Fields |" for a register or a run of registers, and a paragraph "Additional ... registers: ADDR NAME, ...". A name with
"n" behind it is none of the SDK's, a row whose fields begin with "TI" and a register of the paragraph are the SDK's.
Compared are address, name, access, bits and reset value, in both directions. MEANT has what is another one on purpose;
an entry of it that no difference needs is reported.

--self-test spoils single registers of the map in memory and expects each to be reported.
"""

import copy
import json
import os
import re
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
MAP = ROOT / "regmap" / "generated" / "dsl" / "dsl_regs.json"
SOURCE = ROOT / "regmap" / "dsl.rdl"
SKIPPED = 77

BOTH = "the register is there in both personalities"
NOT_MEASURED = "a deviation is not measured: reads 0, and nothing has to be written"
MEANT = {
    ("name", 0x0B): "VERSION is the version of the page",
    ("extra", 0x0C): "RELEASE is in one of the sources only",
    ("extra", 0x34): "the safe host of our personality has a start of its own",
    ("reset", 0x2D): "PEMP is 1 up to the first byte",
    ("access", 0x2F): "what the next short message writes is written there",
    ("absent", 0x3F): "a register without a meaning",
    ("bit", 0x04): "DTE: a deviation is not measured",
    ("personality", 0x09): "EDGES: the published calls read it",
    ("personality", 0x3A): NOT_MEASURED,
    ("personality", 0x3B): NOT_MEASURED,
    ("access", 0x3A): NOT_MEASURED,
    ("access", 0x3B): NOT_MEASURED,
    ("reset", 0x3A): NOT_MEASURED,
    ("reset", 0x3B): NOT_MEASURED,
    ("access", 0x42): "FFh is the only limit",
    ("access", 0x43): "FFh is the only limit",
    **{("personality", address): BOTH
       for address in (0x37, 0x3D, 0x3E, *range(0x44, 0x4F), *range(0x50, 0x56))},
}


class Row(NamedTuple):
    """A register of the tables."""
    name: str
    access: str      # "" if the text has none
    resets: tuple    # texts of eight characters, - where there is no bit
    personality: str  # "both", "ours", "sdk"


def addresses(text):
    ends = [int(part, 16) for part in re.split("[-/]", text)]
    return range(ends[0], ends[-1] + 1)


def names(text, count):
    run = re.fullmatch(r"(\w+?)(\d)\.\.(\d)", text)
    if run:
        first, last = int(run.group(2)), int(run.group(3))
        step = 1 if last > first else -1
        return [run.group(1) + str(i) for i in range(first, last + step, step)]
    if text.endswith("_H/L"):
        return [text[:-2], text[:-3] + "L"]
    return [text] * count


def resets(text, count):
    """Of each register: what its reset value may be."""
    if "/" in text.split(" ")[0]:
        return [(f"{int(part, 16):08b}",) for part in text.split("/")]
    found = []
    for part in re.findall(r"(?:^|, )([-0-9A-F]+)", text):
        if "-" in part or len(part) > 2:
            found.append(part.rjust(8, "-"))
        else:
            found.append(f"{int(part, 16):08b}")
    return [tuple(found)] * count


def read_tables(text):
    rows = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("| ") or len(cells) != 5 or not re.fullmatch(r"[0-9A-F]{2}([-/][0-9A-F]{2})?", cells[0]):
            continue
        places = addresses(cells[0])
        name = cells[1].removesuffix(" n")
        personality = "ours" if cells[1].endswith(" n") else "sdk" if re.match(r"TI($|, )", cells[4]) else "both"
        access = "" if cells[2] == "-" else cells[2]
        value = [()] * len(places) if cells[3] == "-" else resets(cells[3], len(places))
        for address, one, reset in zip(places, names(name, len(places)), value):
            rows[address] = Row(one, access, reset, personality)
    more = re.search(r"^Additional [^:]*registers: (.*?)\. ", text, re.MULTILINE | re.DOTALL)
    if more:
        listed = re.sub(r"\([^)]*\)", "", more.group(1).replace("\n", " "))
        for place, name in re.findall(r"([0-9A-F]{2}(?:[-/][0-9A-F]{2})?) ([A-Z][A-Z0-9_]*)", listed):
            for address in addresses(place):
                rows[address] = Row(name, "", (), "sdk")
    return rows


def read_map():
    fields = {}
    for field in json.loads(MAP.read_text(encoding="utf-8"))["fields"]:
        fields.setdefault(field["address"], []).append(field)
    registers = {}
    for block in SOURCE.read_text(encoding="utf-8").split("\n  reg {")[1:]:
        end = re.search(r"\n  \} (\w+) @0x([0-9A-F]+);", block)
        described = re.search(r'^    desc = "([^"]*)"', block, re.MULTILINE)
        text = described.group(1) if described else ""
        personality = "sdk" if text.startswith("SDK only") else "ours" if text.startswith("0 with the SDK") else "both"
        address = int(end.group(2), 16)
        registers[address] = {"name": end.group(1), "personality": personality, "fields": fields.get(address, [])}
    return registers


def bits_of(register):
    """The reset value as eight characters, - where there is no bit."""
    bits = ["-"] * 8
    for field in register["fields"]:
        for bit in range(field["width"]):
            bits[7 - field["lsb"] - bit] = str(field["reset"] >> bit & 1)
    return "".join(bits)


def access_differs(row, register):
    accesses = {field["access"] for field in register["fields"]}
    written = bool(accesses & {"rw", "w0c", "wo"})
    if row.access == "R/C":
        return not accesses <= {"w0c", "ro"} or "w0c" not in accesses
    return written != ("W" in row.access) or ("R" in row.access and accesses == {"wo"})


def differences(rows, registers):
    """(what, address): text."""
    found = {}
    for address in sorted(rows.keys() | registers.keys()):
        row, register = rows.get(address), registers.get(address)
        if row is None:
            found["extra", address] = f"{register['name']} is in no table"
            continue
        if register is None:
            found["absent", address] = f"{row.name} is not in the map"
            continue
        # A run of the paragraph has one name.
        alike = register["name"].startswith(row.name.split("_STATUS")[0])
        if register["name"] != row.name and not (row.personality == "sdk" and alike):
            found["name", address] = f"{register['name']}, the table has {row.name}"
        if register["personality"] != row.personality:
            found["personality", address] = f"{register['personality']}, the table has {row.personality}"
        if row.access and access_differs(row, register):
            found["access", address] = f"the table has {row.access}"
        has = bits_of(register)
        if row.resets and not any(all(want in ("-", bit) or bit == "-" and want == "0" for want, bit in zip(reset, has))
                                  for reset in row.resets):
            found["reset", address] = f"{has}, the table has {' or '.join(row.resets)}"
        # A table that shows which bits there are shows them by dashes.
        shown = [reset for reset in row.resets if "-" in reset]
        if shown and row.access == "R/C" and any((want == "-") != (bit == "-") for want, bit in zip(shown[0], has)):
            found["bit", address] = f"bits {has}, the table has {shown[0]}"
    return found


def findings(rows, registers):
    found = differences(rows, registers)
    texts = [f"{address:02X} {what}: {text}" for (what, address), text in found.items() if (what, address) not in MEANT]
    return texts + [f"{address:02X} {what}: meant, and not so" for what, address in MEANT if (what, address) not in found]


def self_test(rows, registers):
    faults = 0
    plants = {
        "a register is missing": lambda some: some.pop(0x18),
        "a name": lambda some: some[0x0A].update(name="DELAYS"),
        "a reset value": lambda some: some[0x28]["fields"][0].update(reset=0),
        "an access": lambda some: some[0x29]["fields"][0].update(access="ro"),
        "an event that a read clears": lambda some: some[0x05]["fields"][0].update(access="rw"),
        "a bit of an event": lambda some: some[0x05]["fields"].pop(),
        "a personality": lambda some: some[0x2D].update(personality="both"),
        "a register of the SDK": lambda some: some[0x36].update(personality="both"),
    }
    for what, plant in plants.items():
        spoilt = copy.deepcopy(registers)
        plant(spoilt)
        if not findings(rows, spoilt):
            print(f"not reported: {what}")
            faults += 1
    print(f"{len(plants) - faults} of {len(plants)} planted differences are reported")
    return faults


def main():
    text = os.environ.get("MB4_DSL_TABLES")
    if not text:
        print("MB4_DSL_TABLES names no text with the tables")
        sys.exit(SKIPPED)
    rows, registers = read_tables(Path(text).read_text(encoding="utf-8")), read_map()
    if len(rows) < 70:
        sys.exit(f"{text}: only {len(rows)} registers found")
    if "--self-test" in sys.argv[1:]:
        sys.exit(1 if self_test(rows, registers) else 0)
    texts = findings(rows, registers)
    for one in texts:
        print(one)
    print(f"{len(rows)} registers of the tables, {len(registers)} of the map, {len(MEANT)} differences that are meant, "
          f"{len(texts)} finding(s)")
    sys.exit(1 if texts else 0)


main()
