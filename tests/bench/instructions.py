#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""How many instructions the workloads of `mb4sim bench` take, against a budget.

  instructions.py BUDGET WORKLOAD_COUNT MB4SIM SCENARIO COMPILER [--write]

Callgrind counts the instructions of a shorter and of a longer run. Their difference, divided by
what the longer run has done more, is the cost of a clock, a frame or a byte of SPI. The machine and
its load do not matter. COMPILER names compiler and flags: other ones give other counts, so then the
program compares nothing. --write replaces the budget by what was counted.

Exit status 1: a count is more than 3 % away from its budget. After a gain the budget has to follow,
or a later loss would not be seen."""

import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

LIMIT = 0.03
UNITS = ("clock", "frame", "byte")
# Workload: simulated ms of the shorter and the longer run, the units that are counted.
WORKLOADS = {"A": (1, 3, ("clock",)), "B": (2, 6, ("clock",)), "C": (2, 22, ("frame",)),
             "D": (1, 3, ("byte",)), "E": (1, 3, ("frame", "byte")), "F": (5, 25, ("frame",)),
             "G": (1, 2, ("frame",)), "H": (1, 3, ("clock",)), "I": (1, 3, ("clock",)),
             "J": (1, 3, ("clock",)), "K": (1, 5, ("clock",))}
RUN_FRAMES = (10, 60)  # of `mb4sim run`


def instructions(command):
    """(instructions, standard output) of a program."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(["valgrind", "--tool=callgrind",
                               f"--callgrind-out-file={folder}/out", *map(str, command)],
                              check=True, capture_output=True, text=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1]), done.stdout


def of_a_frame(mb4sim, scenario):
    """Instructions of a frame of `mb4sim run`."""
    one, two = (instructions([mb4sim, "run", scenario, "--frames", frames])[0] for frames in RUN_FRAMES)
    return round((two - one) / (RUN_FRAMES[1] - RUN_FRAMES[0]))


def counted(workload_count, mb4sim, scenario):
    """{"A clock": instructions, ...}"""
    found = {}
    for letter, (short, long, units) in WORKLOADS.items():
        (one, first), (two, second) = (instructions([workload_count, letter, ms])
                                       for ms in (short, long))
        work = [int(b) - int(a) for a, b in zip(first.split(), second.split())]
        for unit in units:
            found[f"{letter} {unit}"] = round((two - one) / work[UNITS.index(unit)])
    found["run frame"] = of_a_frame(mb4sim, scenario)
    # The work of `run` that E does not have: the driver, the look at the frame, the table.
    found["driver and table frame"] = found["run frame"] - found["E frame"]
    # 12 bits at 5 MHz, each 100 us, 200 MHz; docs/pru.md: at most 1.5 million.
    found["run pru frame"] = of_a_frame(mb4sim, Path(scenario).parent / "pru" / "encoder.toml")
    return found


def main():
    words = [word for word in sys.argv[1:] if word != "--write"]
    if len(words) != 5:
        sys.exit("instructions.py: wrong arguments\n" + __doc__.split("\n\n")[1])
    path, *programs, compiler = words
    text = Path(path).read_text(encoding="utf-8")
    budget = tomllib.loads(text)
    if budget["compiler"] != compiler and "--write" not in sys.argv:
        print(f"skipped: the budget is that of {budget['compiler']}, this is {compiler}")
        return 0
    try:
        found = counted(*programs)
    except FileNotFoundError as error:
        print(f"skipped: {error.filename} is not installed")
        return 0
    bad = False
    for name, count in found.items():
        allowed = budget["instructions"].get(name, 0)
        change = count / allowed - 1 if allowed else float("inf")
        over = abs(change) > LIMIT
        bad |= over
        print(f"{name:24}{count:>12,}  budget{allowed:>12,}{change:>+8.1%}{'  <--' if over else ''}")
    if "--write" in sys.argv:
        head = text.split("compiler =")[0]
        rows = "".join(f'"{name}" = {count}\n' for name, count in found.items())
        Path(path).write_text(f'{head}compiler = "{compiler}"\n\n[instructions]\n{rows}',
                              encoding="utf-8")
        return 0
    return int(bad)


sys.exit(main())
