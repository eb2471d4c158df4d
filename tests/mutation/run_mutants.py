#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Wakes one fault after the other and runs tests until one fails.

  run_mutants.py MUTANTS_TXT GOAL PROGRAM...   GOAL: share in percent that must be caught

Each fault meets the quick tests of the first program first, then all of every program. What does
not end counts as caught: it may take so much processor time, whatever else the machine does."""

import os
import resource
import subprocess
import sys
from pathlib import Path

QUICK = ("ChipRegisters.*:ChipSpi.*:ChipStatus.*:ChipFrame.*:ChipInstr.*:ChipReset.*:ChipAgs.*:"
         "ChipControl.*:ChipBanks.*:ChipInit.*:Reference*")
STAGES = [(0, QUICK, 300), (0, "-Lockstep.*", 1500), (1, "*", 1500),
          (2, "-HostFuzz.*:*HostHammer*", 1500)]
SMALL = {"MB4_RANDOM_CONFIGS": "100", "MB4_FAULT_FRAMES": "2000", "MB4_LINE_FRAMES": "1210",
         "MB4_HOST_FRAMES": "300"}


def fails(program, tests, seconds, number):
    """True if a test fails with this fault (0: none)."""
    environment = {**os.environ, **SMALL, "MB4_MUTANT": str(number)}
    command = [program, f"--gtest_filter={tests}", "--gtest_fail_fast", "--gtest_brief=1"]

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))

    return subprocess.run(command, env=environment, check=False, preexec_fn=limit,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0


def main():
    listing = Path(sys.argv[1]).read_text(encoding="utf-8").splitlines()
    goal, programs = float(sys.argv[2]), sys.argv[3:]
    stages = [(programs[place], tests, seconds) for place, tests, seconds in STAGES
              if place < len(programs)]
    os.nice(15)
    if fails(*stages[0][:2], 600, 0):
        raise SystemExit("the tests fail without a fault")
    alive = []
    for count, line in enumerate(listing, 1):
        number, text = line.split(" ", 1)
        stage = next((i for i, s in enumerate(stages, 1) if fails(*s, number)), None)
        if stage is None:
            alive.append(text)
        print(f"{number}: {f'caught in stage {stage}' if stage else 'NOT CAUGHT'}: {text}",
              flush=True)
        if count % 10 == 0:
            print(f"  {count - len(alive)} of {count} caught", flush=True)
    share = 100 * (len(listing) - len(alive)) / len(listing)
    print("\n".join(f"not caught: {text}" for text in alive))
    print(f"{share:.1f} % of {len(listing)} faults caught")
    sys.exit(0 if share >= goal else 1)


main()
