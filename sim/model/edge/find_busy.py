#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Writes busy.txt: find_busy.py PROGRAM BUSY_TXT, PROGRAM being mb4sim_count (target mb4sim_busy).

A group that runs at most clocks is better run without asking; of the others those that run at one
clock in twenty or more are kept apart from the rare ones, module by module."""

import subprocess
import sys
from pathlib import Path

ALWAYS, OFTEN = 0.7, 0.05
HEAD = """# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# How often groups of statements of the model run in workload B, by a variable that they write;
# what is not listed runs at less than one clock in twenty. Made by the target mb4sim_busy.
"""


def main():
    told = subprocess.run([sys.argv[1]], capture_output=True, text=True, check=True).stderr
    runs = {}
    for count, name in map(str.split, told.splitlines()):
        runs[name] = max(int(count), runs.get(name, 0))
    # All groups run after an edge of a host pin: that says nothing about them.
    least, most = min(runs.values()), max(runs.values())
    share = {name: (count - least) / (most - least) for name, count in sorted(runs.items())}
    rows = [f"{'always' if value >= ALWAYS else 'often'} {name}\n"
            for name, value in share.items() if value >= OFTEN]
    Path(sys.argv[2]).write_text(HEAD + "".join(rows), encoding="utf-8")


main()
