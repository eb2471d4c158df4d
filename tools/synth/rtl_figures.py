#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""How much of the RTL is wiring, and how full the folders are.

  rtl_figures.py    prints the share of code lines that are wiring: in all rooms, below the tops, and
                    in each room; the modules with most ports, and the folders with most files

Tops are modules that no module of the RTL uses. Their ports are fixed: pins of the chip, and buses
as their standards spell them.

A code line is one with more than comments. Wiring is a code line that declares a port, is a
.name connection, or only copies a signal into or out of a struct (assign a.b = c; or assign c = a.b;),
also several at once (assign {a, b} = c; or assign c = {a, b};).
"""

import re
from collections import Counter

import project
import sv_widths

COPY = re.compile(r"assign\s+(\w+(\[\w+\])?\.[\w.]+\s*=\s*[\w\[\]]+|[\w\[\]]+\s*=\s*\w+(\[\w+\])?\.[\w.]+)\s*;$")
NAMES = r"\{[\w\s,.\[\]]*\}"
COPIES = re.compile(rf"assign\s+({NAMES}\s*=\s*[\w.\[\]]+|[\w.\[\]]+\s*=\s*{NAMES})\s*;")
PORT = re.compile(r"(input|output|inout)\s")


def wiring(text):
    """(code lines, lines of wiring, {module: ports}) of one file."""
    lines = [line.strip() for line in sv_widths.without_comments(text).splitlines() if line.strip()]
    found = sum(1 for line in lines
                if PORT.match(line) or re.match(r"\.\w+|\.\*", line) or COPY.match(line))
    found += sum(copies.group().count("\n") + 1 for copies in COPIES.finditer("\n".join(lines)))
    ports = Counter()
    module = ""
    for line in lines:
        begin = re.match(r"module\s+(\w+)", line)
        module = begin.group(1) if begin else module
        if PORT.match(line):
            # input logic a, b: the names after the type and its ranges.
            names = re.sub(r"\[[^\]]*\]", "", line).rstrip(",);").split(",")
            ports[module] += len([name for name in names if name.strip()])
    return len(lines), found, ports


def folders():
    """Tracked files a folder, without what is generated and without pictures."""
    return Counter(name.rpartition("/")[0] for name in project.tracked()
                   if "generated/" not in name and not name.endswith((".svg", ".png")))


def share(found, lines):
    return f"{found} of {lines}, {100 * found / lines:.1f} %"


def main():
    project.Arguments(__doc__).parse_args()
    lines, found, ports = Counter(), Counter(), Counter()
    texts = {path: path.read_text(encoding="utf-8") for path in project.all_rtl_files()
             if project.RTL in path.parents}  # without the generated ones
    used = project.instances("\n".join(texts.values()), {path.stem for path in texts})
    below, below_found = 0, 0
    for path, text in texts.items():
        own, wires, own_ports = wiring(text)
        if path.stem in used or path.stem.endswith("_pkg"):
            below, below_found = below + own, below_found + wires
        room = path.parent.relative_to(project.ROOT).as_posix()
        lines[room] += own
        found[room] += wires
        ports.update(own_ports)
    print(f"wiring: {share(found.total(), lines.total())} of the RTL's code lines")
    print(f"        below the tops {share(below_found, below)}")
    for room in sorted(lines):
        print(f"        {room} {share(found[room], lines[room])}")
    print("ports:  " + ", ".join(f"{name} {number}" for name, number in ports.most_common(5)))
    print("files:  " + ", ".join(f"{name} {number}" for name, number in folders().most_common(6)))


if __name__ == "__main__":
    main()
