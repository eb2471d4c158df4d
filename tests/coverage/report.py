#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Coverage of the RTL from Verilator's counters: shares, one HTML page, goals.

  report.py DESIGN PAGE DATA...   DESIGN is one of masters.toml, `measured`: its goals, and the files that count

A line is covered if a block that it belongs to has run; a branch if it was taken; a toggle point if
a bit has changed, in any instance of the module. exclusions.txt lists what cannot be
reached, each with its reason; an entry that is reached after all is an error."""

import html
import re
import sys
from collections import defaultdict
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import project  # noqa: E402


def points(design, paths):
    """{(file, line, column, kind, comment): (count, lines)} over all instances and runs."""
    counts = defaultdict(int)
    lines = {}
    for path in paths:
        for text in path.read_text(encoding="utf-8", errors="replace").splitlines():
            match = re.fullmatch(r"C '(.*)' (\d+)", text)
            if not match:
                continue
            keys = dict(part.split("\x02", 1) for part in match.group(1).split("\x01")
                        if "\x02" in part)
            kind = re.match(r"v_(\w+)", keys.get("page", "")).group(1)
            file = Path(keys["f"]).resolve()
            if not design.counts(file):
                continue
            key = (file, int(keys["l"]), int(keys["n"]), kind, keys.get("o", ""))
            counts[key] += int(match.group(2))
            lines[key] = keys.get("S", keys["l"])
    return counts, lines


def span(text):
    for part in text.split(","):
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)


def exclusions():
    """[(file name, pattern of the source line, reason)]."""
    rows = []
    for text in (HERE / "exclusions.txt").read_text(encoding="utf-8").splitlines():
        if text and not text.startswith("#"):
            rows.append(tuple(part.strip() for part in text.split(" | ")))
    return rows


def main():
    design, page, data = project.design(sys.argv[1]), Path(sys.argv[2]), [Path(name) for name in sys.argv[3:]]
    counts, spans = points(design, data)
    sources = {file: file.read_text(encoding="utf-8").splitlines()
               for file in {key[0] for key in counts}}
    # Another design may not have the module of a row.
    rows = [row for row in exclusions() if row[0] in {file.name for file in sources} or "chip" == design.name]
    used = set()

    def excluded(file, line):
        for number, (name, pattern, _) in enumerate(rows):
            if file.name == name and re.search(pattern, sources[file][line - 1]):
                used.add(number)
                return True
        return False

    per_line = defaultdict(int)
    for key, count in counts.items():
        if key[3] in ("line", "branch"):
            for line in span(spans[key]):
                per_line[key[0], line] = max(per_line[key[0], line], count)
    totals = {}
    missed = defaultdict(list)
    shares = {kind: [0, 0] for kind in ("line", "branch", "toggle")}
    rooms = defaultdict(lambda: [0, 0])

    def add(kind, file, reached):
        room = str(file.parent.relative_to(ROOT / "rtl"))
        for share in (shares[kind], rooms[kind, room], rooms[kind, "all"]):
            share[0] += reached
            share[1] += 1

    for (file, line), count in per_line.items():
        if count == 0 and excluded(file, line):
            continue
        add("line", file, count > 0)
        if count == 0:
            missed[file].append((line, "line"))
    for (file, line, _, kind, comment), count in counts.items():
        if kind not in ("branch", "toggle") or (count == 0 and excluded(file, line)):
            continue
        add(kind, file, count > 0)
        if count == 0:
            missed[file].append((line, f"{kind} {comment}"))
    for kind, (hit, total) in shares.items():
        totals[kind] = 100 * hit / max(total, 1)

    body = ["<!doctype html><meta charset=utf-8><title>RTL coverage</title><style>"
            "pre{margin:0}.m{background:#fbb}.c{color:#888;width:5em;text-align:right}"
            "td{padding:0 .5em}</style><h1>RTL coverage</h1><table>"]
    for kind, (hit, total) in shares.items():
        body.append(f"<tr><td>{kind}<td>{hit} of {total}<td>{totals[kind]:.2f} %")
    body.append("</table><h2>Excluded</h2><ul>")
    body += [f"<li>{html.escape(f'{n}: {p}: {r}')}" for n, p, r in rows]
    body.append("</ul>")
    for file in sorted(sources):
        notes = defaultdict(list)
        for line, note in missed[file]:
            notes[line].append(note)
        body.append(f"<h2>{file.name}</h2><table>")
        for number, text in enumerate(sources[file], 1):
            count = per_line.get((file, number))
            mark = " class=m" if number in notes else ""
            ran = "" if count is None else count
            body.append(f"<tr{mark}><td class=c>{number}<td class=c>{ran}"
                        f"<td><pre>{html.escape(text)}</pre><td>"
                        f"{html.escape('; '.join(notes[number])[:120])}")
        body.append("</table>")
    page.write_text("\n".join(body), encoding="utf-8")

    for file in sorted(missed):
        for line, note in sorted(missed[file]):
            if not note.startswith("toggle"):
                print(f"{file.name}:{line}: {note}: {sources[file][line - 1].strip()}")
    for (kind, room), (hit, total) in sorted(rooms.items()):
        print(f"{kind} in {room}: {hit} of {total}, {100 * hit / total:.2f} %")
    failed = [f"exclusions.txt: reached or unknown: {rows[n]}" for n in range(len(rows))
              if n not in used]
    for kind, total in totals.items():
        print(f"{kind}: {shares[kind][0]} of {shares[kind][1]}, {total:.2f} %")
        if total < design.goals.get(kind, 0):
            failed.append(f"{kind} coverage is below {design.goals[kind]} %")
    print(page)
    print("\n".join(failed))
    sys.exit(1 if failed else 0)


main()
