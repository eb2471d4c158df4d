#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Compare the generated register map with the tables of the iC-MB4 datasheet.

The datasheet's text (with '|' tables, as a PDF to Markdown converter leaves it) is named by the environment
variable MB4_DATASHEET. Two things are read from it:
  * table 6, the layout: for each of the 256 addresses the names of all bits, constants and reserved bits
  * tables 7 to 67: for each field its address, bits, access, table, page and the codes listed for it
Both are compared with regmap/generated/mb4/mb4_regs.json in both directions.

--self-test spoils single entries of the map in memory and expects each to be reported.
"""

import argparse
import copy
import json
import os
import re
import sys
from pathlib import Path

MAP = Path(__file__).resolve().parents[2] / "regmap" / "generated" / "mb4" / "mb4_regs.json"
SKIPPED = 77

# Known slips: page, text as found, text as meant, how often, reason. Each has to occur, or it is reported.
PRINT = "the datasheet prints it so"
TEXT = "damage of the text extraction"
SLIPS = [
    # Slips of the datasheet
    (21, "ART1(16:8)", "ART1(15:8)", 1, f"{PRINT}: high byte of a 16-bit value"),
    (25, "(16:8) |", "(15:8) |", 8, f"{PRINT}: high byte of a 16-bit value"),
    (29, "| IDS(0:7) ", "| IDS(7:0) ", 1, f"{PRINT}: table 6 has IDS(7:0); ID 0 is bit 7 in both"),
    (29, "| IDS4 Addr. 0x80; Bit 2", "| IDS5 Addr. 0x80; Bit 2", 1, f"{PRINT}: the rows below speak of ID 5"),
    (31, "| 0x01 0x0F | Code*1/f", "| 0x01 0xFF | Code*1/f", 1, f"{PRINT}: the field has 8 bits"),
    (25, "with CF | GCHx = 1.", "with CFGCHx = 2.", 1, f"{PRINT}: note on GRAYSx; 1 is BiSS C, SSI is 2 (not compared)"),
    # Ranges and lists printed with dots
    (24, "| | Code + 1 |", "| 0x01 0x3E | Code + 1 |", 1, f"{TEXT}: dots between 0x00 and 0x3F"),
    (25, "| 0x01 | Code & '1'", "| 0x01 0x7F | Code & '1'", 1, f"{TEXT}: one row split in two"),
    (31, "| 0xFF |", "| |", 2, "dots down to 0xFF in tables 41 and 42 stand for codes of no device"),
    # Table 6, extraction
    (21, "RDAT | TA1(7:0)", "RDATA1(7:0)", 1, TEXT),
    (21, "IDS | S(7:0)", "IDS(7:0)", 1, TEXT),
    (21, "RDATA64(7:0 |)", "RDATA64(7:0)", 1, TEXT),
    (21, "SCDLE | N1(5:0)", "SCDLEN1(5:0)", 1, TEXT),
    (21, "SCRCLE | N1(6:0) / SCRCF | POLY1(7:1)", "SCRCLEN1(6:0) / SCRCPOLY1(7:1)", 1, TEXT),
    (21, "SCRCS | \u0393ART1(7:0)", "SCRCSTART1(7:0)", 1, f"{TEXT}: Greek letter"),
    (21, "SCRCST | ART1(15:8)", "SCRCSTART1(15:8)", 1, TEXT),
    (21, "REGNI | JM(5:0)", "REGNUM(5:0)", 1, TEXT),
    (21, "CHS | EL(1:0)", "CHSEL(1:0)", 1, TEXT),
    (21, "SLAVEID(2:0) | 1 | -*", "SLAVEID(2:0) | -*", 1, TEXT),
    (21, "CMI | D(1:0)", "CMD(1:0)", 1, TEXT),
    (21, "FREQ | AGS(7:0)", "FREQAGS(7:0)", 1, TEXT),
    (22, "CFGCI | H2(1:0) | CFGC | H1(1:0)", "CFGCH2(1:0) | CFGCH1(1:0)", 1, TEXT),
    (22, "ACTnSE | ENS(8:1)", "ACTnSENS(8:1)", 1, TEXT),
    (22, "CDMTIME- OUT", "CDMTIMEOUT", 1, "hyphenated"),
    (22, "REGBY | TES(5:0)", "REGBYTES(5:0)", 1, TEXT),
    (22, "| CFGI | |", "| CFGIF(1:0) |", 1, TEXT),
    (22, "| Reserve | d |", "| Reserved |", 1, TEXT),
    # Tables 7 to 67, extraction
    (24, "\n| Addr. 0x", "\n| SELCRCS# | Addr. 0x", 8, f"{TEXT}: the column of names is lost; # counts the rows"),
    (24, "| Apply CRC polynomial as p |", "| 0 | Apply", 1, f"{TEXT}: the column of codes is lost"),
    (24, "| Apply CRC polynomial as individually", "| 1 | Apply", 1, f"{TEXT}: the column of codes is lost"),
    (24, "Bit 6:0 R/V |", "Bit 6:0 | R/W |", 1, TEXT),
    (24, "| SCRCLEN8 | Addr. 0xDD; Bit 6:0 |", "| SCRCLEN8 | Addr. 0xDD; Bit 6:0 | R/W |", 1, TEXT),
    (25, "| SCRCPOLY | SCRCPOLY2 | | 0x", "| SCRCPOLY2 | Addr. 0x", 1, TEXT),
    (25, "| SCRCPOLY | SCRCPOLY7 | | 0x", "| SCRCPOLY7 | Addr. 0x", 1, TEXT),
    (25, "| SCRCPOLY | SCRCPOLY8 | | 0x", "| SCRCPOLY8 | Addr. 0x", 1, TEXT),
    (25, "SCRCSTART2(7:0) | | Bit", "SCRCSTART2(7:0) | Addr. 0xC6; Bit", 1, f"{TEXT}: address lost"),
    (25, "| SCRCSTAR | SCRCSTART2", "| SCRCSTART2", 1, TEXT),
    (29, "R/M Code Function 0x00 All slaves addressed (broadcast) IDS7 Addr. 0x80; Bit 0 R/M", "R/W", 1, TEXT),
    (31, "SINGLEBA | \u039dK", "SINGLEBANK", 1, f"{TEXT}: Greek letter"),
    (32, "| AGS | Ad | ddr.", "| AGS | Addr.", 1, TEXT),
    (32, "| INIT | \u0391 | .ddr.", "| INIT | Addr.", 1, f"{TEXT}: Greek letter"),
    (33, "| HOLDBANK | (| Addr.", "| HOLDBANK | Addr.", 1, TEXT),
    (35, "| SWBANKFA | AIL. |", "| SWBANKFAIL |", 1, TEXT),
    (35, "| REGBYTES | | Ac | dr.", "| REGBYTES | Addr.", 1, TEXT),
]
# The caption of table 32 stands below table 34, so its fields would seem to belong to table 33.
CAPTION_MOVED = {"IDS": 32}

FIELD_ROW = re.compile(
    r"^(?P<name>[A-Za-z_]\w*(\(\d(:\d)?\)|\(\d+:\d+\))?)\s*"
    r"Addr\.\s*0x(?P<first>[0-9A-F]{2})(\s*0x(?P<last>[0-9A-F]{2}))?;\s*"
    r"[Bb]it\s*(?P<msb>\d)(:(?P<lsb>\d))?\s*(?P<access>R(/W)?)\b"
)
CODE_CELL = re.compile(r"^(0x[0-9A-F]+|[01]{3}|[01])( (0x[0-9A-F]+))?( .*)?$")
LABEL = re.compile(r"(?P<name>[A-Za-z_]\w*?)(?P<number>\d*)\((?P<msb>\d+):(?P<lsb>\d+)\)")


class Datasheet:
    """What the text says: layout (table 6) and fields (tables 7 to 67)."""

    def __init__(self, text):
        self.problems = []
        self.layout = {}  # (address, second meaning?) -> {bit: label}
        self.fields = {}  # name -> dict
        self.codes = {}  # table -> set of code values
        self.rows = 0
        self.code_rows = 0
        pages = self.repaired_pages(text)
        self.read_layout(pages)
        self.read_fields(pages)

    def repaired_pages(self, text):
        parts = re.split(r"^Rev D2, Page (\d+)/41$", text, flags=re.M)
        pages = {int(n): body for n, body in zip(parts[1::2], parts[2::2])}
        for page, found, meant, times, reason in SLIPS:
            body = pages.get(page, "")
            count = body.count(found)
            if count != times:
                self.problems.append(f"slip '{found}' on page {page} ({reason}): found {count} times, not {times}")
            for number in range(1, count + 1):
                body = body.replace(found, meant.replace("#", str(number)), 1)
            pages[page] = body
        return pages

    # Table 6

    def read_layout(self, pages):
        for page in (21, 22):
            for line in pages.get(page, "").splitlines():
                row = re.match(r"^\| 0x(..)(?: 0x(..))?\s*(\[?[†‡]\]?)?\s*\|(.*)\|$", line)
                if row:
                    self.rows += 1
                    first = int(row[1], 16)
                    last = int(row[2], 16) if row[2] else first
                    self.layout_row(first, last, "‡" in (row[3] or ""), row[4])

    def layout_row(self, first, last, second, text):
        text = re.sub(r"[-_](\s*\|?\s*[-_])?\s*\|?\s*\*", "-", text)  # marks of reserved bits
        cells = re.findall(r"'[01]'|[A-Za-z]\w*(?:\(\d+:\d+\))?|/|-", text)
        if "Configuration" in cells:
            self.copy_slaves(first, last, cells)
        elif last > first and cells[0] != "-":
            self.spread(first, last, cells)
        else:
            for address in range(first, last + 1):
                self.place(address, second, cells)

    def place(self, address, second, cells):
        """Labels of one address from bit 7 down; a lone reserved mark fills the rest."""
        groups = []  # [labels, width]; width 0 is open
        fillers = cells.count("-")
        for i, cell in enumerate(cells):
            if cell == "/":
                continue
            label = LABEL.fullmatch(cell)
            if cell == "-":
                groups.append([[], 0 if fillers == 1 else 1])
            elif i and cells[i - 1] == "/":
                groups[-1][0].append(cell)
            else:
                groups.append([[cell], int(label["msb"]) - int(label["lsb"]) + 1 if label else 1])
        rest = 8 - sum(width for _, width in groups)
        msb = 7
        for labels, width in groups:
            width = width or rest
            for n, label in enumerate(labels):
                bits = self.layout.setdefault((address, second or n > 0), {})
                for bit in range(msb, msb - width, -1):
                    bits[bit] = label
            msb -= width
        self.layout.setdefault((address, second), {})
        if msb != -1:
            self.problems.append(f"table 6, 0x{address:02X}: {7 - msb} bits instead of 8")

    def spread(self, first, last, cells):
        """A row for several addresses: one long value, or numbered values from the first to the last."""
        labels = [LABEL.fullmatch(c) for c in cells]
        numbers = range(int(labels[0]["number"]), int(labels[-1]["number"]) + 1)
        lsb, msb = int(labels[0]["lsb"]), int(labels[0]["msb"])
        address = first
        for number in numbers:
            for low in range(lsb, msb, 8):
                self.place(address, False, [f"{labels[0]['name']}{number}({low + 7}:{low})"])
                address += 1
        if address != last + 1:
            self.problems.append(f"table 6, 0x{first:02X}: the row does not end at 0x{last:02X}")

    def copy_slaves(self, first, last, cells):
        """'Configuration Slave 2(31:0) ... Slave 8(31:0)': as slave 1."""
        if (last - first + 1) // 4 != 7:
            self.problems.append("table 6: configuration of slaves 2 to 8 has not 28 bytes")
        for address in range(first, last + 1):
            number = (address - 0xC0) // 4 + 1
            for second in (False, True):
                model = self.layout.get((0xC0 + address % 4, second))
                if model:
                    self.layout[address, second] = {b: re.sub(r"1(?=\(|$)", str(number), l) for b, l in model.items()}

    # Tables 7 to 67

    def read_fields(self, pages):
        entries, coded = [], True  # since the last caption
        for page in range(23, 37):
            for line in pages.get(page, "").splitlines():
                caption = re.match(r"^Table (\d+):", line)
                if caption:
                    for entry in entries:
                        moved = next((t for name, t in CAPTION_MOVED.items() if entry["name"].startswith(name)), None)
                        entry["table"] = moved or int(caption[1])
                        self.codes.setdefault(entry["table"], set()).update(entry.pop("codes"))
                        self.fields[entry.pop("name")] = entry
                    entries, coded = [], True
                elif line.startswith("|"):
                    cells = [c.strip() for c in line.strip().strip("|").split("|")]
                    row = FIELD_ROW.match("".join(cells))
                    if row:
                        entries.append(self.field(row, page))
                    elif cells[0] == "Addr.":
                        coded = False  # a list of addresses instead of codes
                    elif entries and coded and (code := CODE_CELL.match(cells[0])):
                        entries[-1]["codes"] |= self.code_values(code)
                        self.code_rows += 1

    def field(self, row, page):
        if row["name"] in self.fields:
            self.problems.append(f"page {page}: {row['name']} is described twice")
        msb = int(row["msb"])
        return {
            "name": row["name"], "first": int(row["first"], 16), "last": int(row["last"] or row["first"], 16),
            "msb": msb, "lsb": int(row["lsb"] or msb), "access": row["access"], "page": page, "codes": set(),
        }  # fmt: skip

    @staticmethod
    def code_values(code):
        first = int(code[1], 16) if code[1].startswith("0x") else int(code[1], 2)
        last = int(code[3], 16) if code[3] else first
        return set(range(first, last + 1))


def map_layout(regmap):
    """The map in the form of Datasheet.layout."""
    layout = {}
    groups = {(g["address"], g["alternate"]): g["label"] for g in regmap["groups"]}
    for key, second in (("fields", False), ("alternate_fields", True)):
        for f in regmap[key]:
            bits = layout.setdefault((f["address"], second), {})
            for bit in range(f["lsb"], f["lsb"] + f["width"]):
                constant = f"'{f['reset'] >> (bit - f['lsb']) & 1}'" if f["access"] == "rom" else None
                label = constant or groups.get((f["address"], second), f["label"])
                if bit in bits:
                    label = f"{bits[bit]} and {label}"
                bits[bit] = label
    return layout


def map_fields(regmap):
    """The map in the form of Datasheet.fields, with SCDATAx and RDATAx as single entries."""
    fields = {}
    for f in regmap["fields"] + regmap["alternate_fields"]:
        if f["access"] == "rom":
            continue
        memory = re.match(r"(SCDATA|RDATA)\d", f["name"])
        name = memory[1] + "x" if memory else f["name"]
        entry = {
            "first": f["address"], "last": f["address"], "msb": f["lsb"] + f["width"] - 1, "lsb": f["lsb"],
            "access": "R" if f["access"] == "ro" else "R/W", "page": f["page"], "table": f["table"],
        }  # fmt: skip
        if name in fields and memory:
            entry["first"] = min(entry["first"], fields[name]["first"])
            entry["last"] = max(entry["last"], fields[name]["last"])
        fields[name] = entry
    return fields


def compare(sheet, regmap):
    """All differences as lines of text."""
    problems = list(sheet.problems)

    # Table 6, address by address. The second meaning of 0xE5 repeats the bits that it shares with the first.
    ours = map_layout(regmap)
    for address in range(256):
        if (address, False) not in sheet.layout:
            problems.append(f"0x{address:02X} is not in table 6")
        for second in (False, True):
            theirs = sheet.layout.get((address, second), {})
            if second:
                first = sheet.layout.get((address, False), {})
                theirs = {b: l for b, l in theirs.items() if l != first.get(b)}
            mine = ours.get((address, second), {})
            for bit in range(7, -1, -1):
                if theirs.get(bit) != mine.get(bit):
                    problems.append(
                        f"0x{address:02X} bit {bit}{' (second meaning)' if second else ''}: "
                        f"table 6 {theirs.get(bit, 'reserved')}, map {mine.get(bit, 'reserved')}"
                    )

    # Tables 7 to 67, field by field. CMD is printed as CMD(1:0); IDS(7:0) describes IDS7 to IDS0 as a whole.
    ours = map_fields(regmap)
    theirs = {re.sub(r"^CMD\(1:0\)$", "CMD", n): e for n, e in sheet.fields.items()}
    whole = theirs.pop("IDS(7:0)", None)
    if not whole or (whole["first"], whole["msb"], whole["lsb"]) != (0x80, 7, 0):
        problems.append("IDS(7:0) is not described at 0x80 bits 7:0")
    found = {e["table"] for e in sheet.fields.values()}
    problems += [f"table {t} not found" for t in range(7, 68) if t not in found and t != 22]  # 22 is an example
    problems += [f"{n}: in the datasheet, not in the map" for n in theirs if n not in ours]
    problems += [f"{n}: in the map, not in the datasheet" for n in ours if n not in theirs]
    for name in theirs.keys() & ours.keys():
        for key, value in theirs[name].items():
            if ours[name][key] != value:
                problems.append(f"{name}: {key} is {value} in the datasheet, {ours[name][key]} in the map")

    # Codes: those of every field against those of its table.
    for f in regmap["fields"] + regmap["alternate_fields"]:
        mine = {c for first, last in f["codes"] for c in range(first, last + 1)}
        difference = mine ^ sheet.codes.get(f["table"], set())
        if difference:
            some = ", ".join(f"0x{c:02X}" for c in sorted(difference)[:4])
            problems.append(f"{f['name']}: codes differ from table {f['table']} ({some})")
    return problems


def find(regmap, name):
    return next(f for f in regmap["fields"] + regmap["alternate_fields"] if f["name"] == name)


def self_test(sheet, regmap):
    """Spoil one thing at a time; every one has to be noticed. Returns the number of misses."""

    def change(name, key, value):
        return f"{name}.{key} = {value}", lambda m: find(m, name).update({key: value})

    def drop(name):
        def run(m):
            for key in ("fields", "alternate_fields"):
                m[key] = [f for f in m[key] if f["name"] != name]

        return f"{name} removed", run

    def add(m):
        m["fields"].append(dict(find(m, "EOT"), name="EXTRA", label="EXTRA", address=0xFA))

    spoils = [
        change("REGNUM", "address", 0xE0), change("SCDATA3(15:8)", "address", 0x40), change("SVALID5", "lsb", 2),
        change("SCDLEN4", "width", 5), change("FREQR", "lsb", 4), change("EOT", "access", "rw"),
        change("AGS", "access", "ro"), change("nERR", "name", "NERR"), change("CMD", "lsb", 3),
        change("IDS5", "lsb", 3), change("LSTOP7", "address", 0xD4), change("MAFO", "table", 50),
        change("CFGCH1", "page", 24), change("CFGCH2", "codes", [[0, 2]]), change("INSTR", "codes", [[0, 7]]),
        drop("SWBANKFAIL"), drop("IDA_TEST"), drop("RDATA64(7:0)"), ("EXTRA added", add),
    ]  # fmt: skip
    for n, f in enumerate(regmap["fields"]):
        if f["access"] == "rom":
            title = f"constant at 0x{f['address']:02X}"
            spoils.append((title, lambda m, n=n, value=f["reset"] ^ 1: m["fields"][n].update(reset=value)))
    base = set(compare(sheet, regmap))
    misses = 0
    for title, spoil in spoils:
        spoiled = copy.deepcopy(regmap)
        spoil(spoiled)
        news = [p for p in compare(sheet, spoiled) if p not in base]
        if not news:
            misses += 1
            print(f"NOT NOTICED: {title}")
        else:
            print(f"noticed: {title} -> {news[0]}")
    print(f"{len(spoils) - misses} of {len(spoils)} spoiled entries noticed")
    return misses


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--self-test", action="store_true", help="spoil the map and expect reports")
    parser.add_argument("--map", type=Path, default=MAP, help="generated map")
    parser.add_argument("--slips", action="store_true", help="list the known slips and stop")
    args = parser.parse_args()
    if args.slips:
        for page, found, meant, times, reason in SLIPS:
            print(f"page {page}: {found!r} read as {meant!r} ({times}x): {reason}")
        return 0

    name = os.environ.get("MB4_DATASHEET", "")
    if not name:
        print("skipped: MB4_DATASHEET does not name the datasheet's text")
        return SKIPPED
    if not Path(name).is_file():
        print(f"skipped: no file {name}")
        return SKIPPED

    sheet = Datasheet(Path(name).read_text(encoding="utf-8"))
    regmap = json.loads(args.map.read_text(encoding="utf-8"))
    if args.self_test:
        return 1 if self_test(sheet, regmap) else 0
    problems = compare(sheet, regmap)
    for problem in problems:
        print(problem)
    bits = sum(len(b) for b in sheet.layout.values())
    tables = {e["table"] for e in sheet.fields.values()}
    print(
        f"table 6: {sheet.rows} rows, 256 addresses, {bits} named or constant bits; tables 7 to 67: "
        f"{len(tables)} tables, {len(sheet.fields)} fields, {sheet.code_rows} rows of codes; "
        f"{len(SLIPS) + len(CAPTION_MOVED)} known slips; {len(problems)} differences"
    )
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
