#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Functional coverage: adds up what runs have counted (FunctionalCoverage::text()).

  functional.py FOLDER GOAL   reads FOLDER/*.txt, prints shares by kind of frame, writes the points that
                              no run has reached to FOLDER/missed.txt; fails below GOAL percent"""

import sys
from collections import defaultdict
from pathlib import Path


def read(paths):
    """{kind of frame: {class of a field's values: count}} over all files."""
    counts = defaultdict(lambda: defaultdict(int))
    for path in paths:
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            parts = line.split("\t")
            if len(parts) != 3 or not parts[0].isdigit():
                raise SystemExit(f"{path}:{number}: no line 'count, kind, class'")
            counts[parts[1]][parts[2]] += int(parts[0])
    return counts


def main():
    folder, goal = Path(sys.argv[1]), float(sys.argv[2])
    paths = sorted(path for path in folder.glob("*.txt") if path.name != "missed.txt")
    counts = read(paths)
    if not counts:
        raise SystemExit(f"{folder}: no points")
    rows = [(kind, sum(count > 0 for count in values.values()), len(values))
            for kind, values in counts.items()]
    rows.append(("all", sum(row[1] for row in rows), sum(row[2] for row in rows)))
    for kind, reached, points in rows:
        print(f"functional in {kind}: {reached} of {points} points, {100 * reached / points:.2f} %")
    (folder / "missed.txt").write_text(
        "".join(f"{kind}: {value}\n" for kind, values in counts.items()
                for value, count in values.items() if count == 0), encoding="utf-8")
    if 100 * rows[-1][1] / rows[-1][2] < goal:
        print(f"functional coverage is below {goal} %; {folder / 'missed.txt'} lists the points")
        sys.exit(1)


main()
