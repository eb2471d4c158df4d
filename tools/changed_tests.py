#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Builds and runs the tests that a change can touch, the cheapest first, up to the first that fails.

  changed_tests.py BUILD [--since REVISION] [--all]

The change is what the working tree has against the revision (default: HEAD). What it touches comes
from the build's own dependencies: a program that the build would link again, a script's test whose
program, script or argument is in the change. --all goes on behind a failure. Left out: what nothing
of the change reaches, other hosts and netlists of the same tests (Intel, Motorola, Gate, DriverHost),
and scripts that only read the whole tree, but for those with the label lint.
"""

import argparse
import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# The programs that test the parts of a room alone come first for it.
NEAREST = {"rtl": "block_test", "sim": "sim_unit_test", "drivers": "mb4_driver_test"}
WHOLE = ("gate", "formal", "netlist", "nightly", "web")  # labels that run for minutes


def run(*command, **more):
    return subprocess.run(list(map(str, command)), check=False, text=True, **more)


def output(*command):
    done = run(*command, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"changed_tests.py: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def changed_files(since):
    names = output("git", "-C", ROOT, "diff", "--name-only", since).split()
    names += output("git", "-C", ROOT, "ls-files", "--others", "--exclude-standard").split()
    return {ROOT / name for name in names}


def steps(build, program):
    """How many steps the build needs to make the program again; 0: nothing."""
    told = output("ninja", "-C", build, "-n", program)
    return 0 if "no work to do" in told else len(re.findall(r"^\[\d+/\d+\]", told, re.M))


def tests_of(build):
    listed = json.loads(output("ctest", "--test-dir", build, "--show-only=json-v1"))["tests"]
    for test in listed:
        test["properties"] = {each["name"]: each["value"] for each in test["properties"]}
    return [test for test in listed if test.get("command")]


def costs(build):
    """{test: seconds of its last runs}"""
    path = build / "Testing" / "Temporary" / "CTestCostData.txt"
    rows = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    return {row.split()[0]: float(row.split()[2]) for row in rows if len(row.split()) == 3}


def is_own(test):
    """A test of a GoogleTest program with nothing but its name."""
    return any(word.startswith("--gtest_filter=" + test["name"]) for word in test["command"])


def main():
    parser = argparse.ArgumentParser(prog="changed_tests.py", add_help=True)
    parser.add_argument("build", type=Path)
    parser.add_argument("--since", default="HEAD")
    parser.add_argument("--all", action="store_true")
    wanted = parser.parse_args()
    build = wanted.build.resolve()
    if not (build / "build.ninja").is_file():
        sys.exit(f"changed_tests.py: {build}: no build tree; `cmake --preset default` makes one")
    changed = changed_files(wanted.since)
    if not changed:
        print("changed: nothing")
        return 0

    tests, last = tests_of(build), costs(build)
    programs = {}  # a program of the build: its tests
    scripts = []
    left_out = 0
    for test in tests:
        program = Path(test["command"][0])
        labels = test["properties"].get("LABELS", [])
        if set(labels) & set(WHOLE):
            left_out += 1
        elif program.is_relative_to(build) and (is_own(test) or len(test["command"]) == 1):
            programs.setdefault(program, []).append(test["name"])
        elif program.is_relative_to(build):
            left_out += 1
        else:
            scripts.append(test)

    # Each program with its price: steps to build it, then the time of its tests.
    prices = {program: steps(build, program.relative_to(build)) for program in programs}
    for test in scripts:
        for word in map(Path, test["command"]):
            if word.is_absolute() and word.is_relative_to(build / "bin") and word.is_file():
                prices.setdefault(word, steps(build, word.relative_to(build)))
    stale = {program for program, price in prices.items() if price > 0}

    own_scripts = set()
    jobs = []  # (price, seconds, what to build, name, command)
    for program, names in programs.items():
        if program in stale:
            seconds = sum(last.get(name, 0.05) for name in names)
            jobs.append((prices[program], seconds, [program], f"{program.name}: {len(names)} tests",
                         [program, "--gtest_brief=1"]))
        else:
            left_out += len(names)
    for test in scripts:
        words = [Path(word) for word in test["command"] if os.path.isabs(word)]
        needs = [word for word in words if word in stale]
        own = {path for word in words if word.is_file() and word.is_relative_to(ROOT) and
               not word.is_relative_to(build) for path in changed
               if path == word or path.parent == word.parent and word.suffix == path.suffix == ".py"}
        lint = "lint" in test["properties"].get("LABELS", [])
        if own or lint:
            own_scripts.add(test["name"])
        if needs or own or lint:
            price = sum(prices[need] for need in needs)
            jobs.append((price, last.get(test["name"], 1), needs, test["name"],
                         ["ctest", "--test-dir", build, "--output-on-failure", "-R",
                          f"^{re.escape(test['name'])}$"]))
        else:
            left_out += 1

    rooms = {path.relative_to(ROOT).parts[0] for path in changed}
    nearest = {NEAREST[room] for room in rooms if room in NEAREST}
    jobs.sort(key=lambda job: (not any(need.name in nearest for need in job[2]), *job[:2]))
    failed = []
    same = 0
    for price, _, needs, name, command in jobs:
        print(f"changed: {name}", flush=True)
        if needs:
            before = [need.stat().st_mtime_ns if need.is_file() else 0 for need in needs]
            done = run("cmake", "--build", build, "--", "--quiet",
                       *(need.relative_to(build) for need in needs))
            if done.returncode != 0:
                return 1
            if before == [need.stat().st_mtime_ns for need in needs] and name not in own_scripts:
                same += 1
                continue
        environment = dict(os.environ)
        done = run(*command, cwd=build, env=environment, capture_output=True)
        if done.returncode != 0:
            print(done.stdout[-6000:] + done.stderr[-6000:])
            failed.append(name)
            if not wanted.all:
                break
    ran = f"all {len(jobs)}" if wanted.all or not failed else f"up to this one of {len(jobs)}"
    print(f"changed: {len(changed)} files; {ran} programs and scripts, {same} of them came out of "
          f"the build as they were; left out {left_out} tests that the change does not reach or that run on other hosts "
          f"and netlists (tools/test.sh runs all)")
    for name in failed:
        print(f"changed: failed: {name}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
