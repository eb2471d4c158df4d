#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Checks tests/testplan.toml against the tests that CTest knows.

Usage: check_testplan.py TESTPLAN BUILD_DIR
Exit status: 0 every row is whole and names existing tests, and rows name each test of the presets;
1 otherwise (one line per finding).
"""

import fnmatch
import json
import re
import subprocess
import sys
import tomllib


# Tables of single-cycle data, frame control, instructions and status: rows that name each by its
# number. All others, but 68 (errata of a revision that is not the default), may stand in a range.
OWN_ROW = {*range(11, 23), 35, 37, 38, 44, 45, 47, 48, 49, *range(54, 68)}
TABLES = {*range(1, 70)} - {68}


# Tests of cores with fewer features (decision 44): each is in a row.
TRACED = ("Cores/", "Single.")


def tables_without_row(rows):
    """Numbers in TABLES that no row names ("Table 35", "Tables 65, 66", "Tables 27 to 31")."""
    alone = set()
    in_range = set()
    for row in rows:
        for text in re.findall(r"Tables? (\d+(?:(?:, | to |\.\.)\d+)*)", row.get("where", "")):
            for part in text.split(", "):
                first, *last = (int(number) for number in re.findall(r"\d+", part))
                (in_range if last else alone).update(range(first, (last or [first])[0] + 1))
    return sorted((TABLES - alone - in_range) | (OWN_ROW - alone))


def known_tests(build_dir):
    listing = subprocess.run(
        ["ctest", "--test-dir", build_dir, "--show-only=json-v1"],
        check=True, capture_output=True, text=True).stdout
    return {test["name"] for test in json.loads(listing)["tests"]}


def findings(plan, tests):
    rows = plan.get("row", [])
    if not rows:
        yield "the plan has no rows"
    for number in tables_without_row(rows):
        yield f"there is no row for Table {number}"
    for number, row in enumerate(rows, start=1):
        place = f"row {number} ({row.get('where', 'no place')})"
        for key in ("where", "says", "tests"):
            if not row.get(key):
                yield f"{place}: key '{key}' is missing or empty"
        for key in row.keys() - {"where", "says", "tests"}:
            yield f"{place}: unknown key '{key}'"
        for pattern in row.get("tests", []):
            if not any(fnmatch.fnmatchcase(test, pattern) for test in tests):
                yield f"{place}: there is no test '{pattern}'"
    patterns = [pattern for row in rows for pattern in row.get("tests", [])
                if pattern.startswith(TRACED)]
    for test in sorted(tests):
        if test.startswith(TRACED) and not any(
                fnmatch.fnmatchcase(test, pattern) for pattern in patterns):
            yield f"no row names the test '{test}'"


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    with open(sys.argv[1], "rb") as file:
        plan = tomllib.load(file)
    tests = known_tests(sys.argv[2])
    unbuilt = [test for test in tests if test.endswith("_NOT_BUILT")]
    if unbuilt:
        print(f"build first: {len(unbuilt)} test programs are not built")
        return 1
    # The check must be able to fail.
    every = ", ".join(str(number) for number in sorted(TABLES - {63}))
    broken = {"row": [{"where": f"Tables {every}", "says": "y", "tests": ["No.SuchTest"]}]}
    others = {test for test in tests if not test.startswith(TRACED)}
    if len(list(findings(broken, others))) != 2 or not list(findings({}, others)) or (
            len(list(findings(broken, others | {"Single.Some.Test"}))) != 3):
        print("the check does not notice a missing test or table, or a test without a row")
        return 1
    found = list(findings(plan, tests))
    for line in found:
        print(f"{sys.argv[1]}: {line}")
    if not found:
        print(f"{len(plan['row'])} rows, {len(tests)} tests known")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
