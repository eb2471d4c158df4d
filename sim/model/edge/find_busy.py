#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Writes busy.txt: find_busy.py PROGRAM BUSY_TXT. PROGRAM is mb4sim_count (target mb4sim_busy).

A variable is fast if it changes at 45 % of the clocks or more. A part holds groups that have work
about equally often, because all of them run when the busiest one has work."""

import subprocess
import sys
from pathlib import Path

FAST = 0.45
RATES = (("often", 0.05), ("seldom", 0.012), ("rarely", 0.0005))  # the rest: hardly ever
HEAD = """# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Workload B: the variables of the model that change at 45 % of the clocks or more (==N: whether
# they are N), and how often groups of statements, each by a variable that it writes, have something
# to do. Made by the target mb4sim_busy.
"""


def main():
    told = subprocess.run([sys.argv[1]], capture_output=True, text=True, check=True).stderr
    counts = {"runs": {}, "moves": {}}
    for kind, count, name in map(str.split, told.splitlines()):
        if kind == "moves":
            name = name.rsplit(".", 1)[-1]  # a local variable has its function's name before it
        counts[kind][name] = max(int(count), counts[kind].get(name, 0))
    # All groups run after an edge of a host pin, so those runs are subtracted.
    runs = counts["runs"].values()
    least, clocks = min(runs), max(runs) - min(runs)
    rows = [f"fast {name}\n" for name, count in sorted(counts["moves"].items())
            if count / clocks >= FAST]
    for name, count in sorted(counts["runs"].items()):
        share = (count - least) / clocks
        rows += [f"{rate} {name}\n" for rate, limit in RATES if share >= limit][:1]
    Path(sys.argv[2]).write_text(HEAD + "".join(rows), encoding="utf-8")


main()
