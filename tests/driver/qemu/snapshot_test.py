#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A Snapshot between main() and an interrupt, in qemu-system-arm: no value has parts of two.

  snapshot_test.py MACHINE CPU ROOT    MACHINE: of QEMU; CPU: of the compiler

A copy without care must show such values, or the interrupts come at the wrong places. Exit status
77: a tool is missing.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
FLAGS = ("-mthumb --specs=nano.specs -std=c++17 -O2 -ffreestanding -fno-exceptions -fno-rtti "
         "-fno-threadsafe-statics -nostartfiles -Wall -Wextra -Wconversion -Wshadow -Werror").split()
LINE = re.compile(r"(\w+) reads: preempted 0x(\w+), torn 0x(\w+), read again 0x(\w+)")


def figures(machine, cpu, root, *more):
    """{who reads: (preempted, torn, read again)}"""
    with tempfile.TemporaryDirectory() as folder:
        elf = Path(folder) / "snapshot.elf"
        subprocess.run(
            ["arm-none-eabi-g++", f"-mcpu={cpu}", *FLAGS, *more, f"-I{root}",
             f"-I{root}/drivers/include", root / "tests/driver/qemu/snapshot.cpp",
             "-T", root / "examples/firmware/mps2.ld", "-o", elf], check=True)
        # One nanosecond an instruction: the same run each time.
        done = subprocess.run(
            ["qemu-system-arm", "-M", machine, "-icount", "shift=0", "-kernel", elf, "-display", "none",
             "-semihosting-config", "enable=on,target=native", "-serial", "none", "-monitor", "none"],
            capture_output=True, text=True, timeout=280)
    text = done.stdout + done.stderr
    print(" ".join(more), text, sep="\n")
    if done.returncode != 0:
        raise SystemExit(f"QEMU: exit {done.returncode}")
    return {who: tuple(int(value, 16) for value in values)
            for who, *values in LINE.findall(text)}


def main():
    machine, cpu, root = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    for tool in ("qemu-system-arm", "arm-none-eabi-g++"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            return SKIPPED
    found = []
    naive = figures(machine, cpu, root, "-DNAIVE")
    good = figures(machine, cpu, root)
    for who in ("main", "interrupt"):
        preempted, torn, again = good[who]
        print(f"{who} reads: {preempted} preemptions, {torn} torn, {again} read again")
        if naive[who][1] < 1000:
            found.append(f"{who} reads: a copy without care is torn {naive[who][1]} times only")
        if preempted < 100_000 or torn != 0:
            found.append(f"{who} reads: {preempted} preemptions, {torn} torn")
    if good["main"][2] == 0:
        found.append("no reader was overtaken")
    if good["interrupt"][2] != 0:
        found.append("a reader that has interrupted the writer had to read again")
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
