#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Builds, and runs the tests of which something has changed since they last passed here.

  changed_tests.py BUILD [--all]

A test is left alone only if everything is as it was before this script saw it pass: its program after the build with
the libraries that it loads, its script with the files beside it, the files and folders that its command names, and
what programs read (examples, data of the tests). BUILD/Testing/passed.json keeps that. The program that tests the
parts of a changed room comes first, then the tests of scripts, before the rest is built. The first failure ends the
run; --all goes on. Suites that run for minutes are left out, and named.
"""

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# The first row that a file begins with.
NEAREST = {"rtl/axi/": "axi_block_test", "rtl/": "block_test", "sim/": "sim_unit_test", "drivers/": "mb4_driver_test"}
LEFT_OUT = re.compile(r"(Intel|Motorola|Package|DriverHost|DriverSweep|Docs|EdgeParts|Icarus|Canary)[.]|"
                      r"Parts/ChipFuzz|Python[.]Cocotb")
# Rooms of tests/ whose data is read by the scripts beside it alone.
ROOMS_OF_SCRIPTS = {"bench", "canary", "changed", "coverage", "docs", "formal", "gate", "icarus", "lint", "mutation",
                    "netlist", "package", "regmap", "site", "web"}
LONG_LABELS = {"gate", "formal", "netlist", "nightly", "web", "bench"}


def output(*command):
    done = subprocess.run(list(map(str, command)), check=False, text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"changed_tests.py: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def git(*arguments):
    return output("git", "-c", f"safe.directory={ROOT}", "-C", ROOT, *arguments)


def build_targets(build, *targets):
    return subprocess.run(["cmake", "--build", build, "--", "--quiet", *targets], check=False).returncode == 0


class Digests:
    """Of files and folders below ROOT as they are now, each computed once."""

    def __init__(self):
        names = git("ls-files", "--cached", "--others", "--exclude-standard", "-z")
        self.sources = sorted(ROOT / name for name in names.split("\0") if name)
        self.known = {}

    def of(self, path):
        if path not in self.known:
            inside = [path] if path.is_file() else [each for each in self.sources
                                                    if each.is_relative_to(path) and each.is_file()]
            digest = hashlib.sha256()
            for each in inside:
                digest.update(str(each).encode() + b"\0" + each.read_bytes())
            self.known[path] = digest.hexdigest()
        return self.known[path]


def data_of_programs(digests):
    """What programs read, which no dependency of the build names."""
    code = {".cpp", ".hpp", ".c", ".h", ".sv", ".py", ".sh"}

    def may_be_read(path):
        first, room = (*path.relative_to(ROOT).parts, "")[:2]
        return (first == "examples" or first == "tests" and room not in ROOMS_OF_SCRIPTS) and path.is_file() and \
            path.suffix not in code and path.name != "CMakeLists.txt"

    text = "".join(digests.of(path) for path in digests.sources if may_be_read(path))
    return digests.of(ROOT / "docs" / "driver.md") + hashlib.sha256(text.encode()).hexdigest()


def digest_of_built(path, build):
    """Of a file of the build with the libraries there that it names, or of a folder's files."""
    if path.is_dir():
        inside = [] if path == build else sorted(each for each in path.rglob("*.*") if each.is_file())
        return hashlib.sha256(b"".join(each.read_bytes() for each in inside if each.suffix != ".pyc")).hexdigest()
    text = path.read_bytes()
    loaded = [library.read_bytes() for library in sorted((build / "lib").glob("*.so"))
              if library.stem.encode() in text]
    return hashlib.sha256(b"".join([text, *loaded])).hexdigest()


def digest_of(job, build, digests, data):
    parts = [" ".join(job["command"]), data]
    for word in job["command"]:
        path = Path(word.removeprefix("-I"))
        if not path.is_absolute() or not path.exists():
            continue
        if path.is_relative_to(build):
            parts.append(digest_of_built(path, build))
        elif path.is_relative_to(ROOT):
            parts.append(digests.of(path.parent if path.suffix in (".py", ".sh") else path))
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def program_job(program):
    """All tests of a GoogleTest program."""
    return {"command": [str(program), "--gtest_brief=1"]}


def jobs_of(build, must_be_built=True):
    """Jobs: a GoogleTest program with all its tests, or a single test. And the suites left out."""
    listed = json.loads(output("ctest", "--test-dir", build, "--show-only=json-v1"))["tests"]
    jobs, left = {}, Counter()
    for test in listed:
        name, command = test["name"], test.get("command")
        labels = {label for each in test["properties"] if each["name"] == "LABELS" for label in each["value"]}
        if LEFT_OUT.match(name) or labels & LONG_LABELS:
            left[name.split(".")[0]] += 1
        elif command is None and not must_be_built:
            continue
        elif command is None:
            sys.exit(f"changed_tests.py: {name}: its program is not built")
        elif f"--gtest_filter={name}" in command:
            jobs.setdefault(Path(command[0]).name, program_job(command[0]))
        else:
            jobs[name] = {"command": command, "ctest": True}
    return jobs, left


def jobs_without_build(build):
    """The tests of scripts that need nothing of the build, but for lint, which reads all."""
    return {name: job for name, job in jobs_of(build, must_be_built=False)[0].items() if not name.startswith("Lint.")
            and not any(Path(word).is_relative_to(build) for word in job["command"])}


def run(name, job, build):
    command = job["command"]
    if job.get("ctest"):
        command = ["ctest", "--test-dir", build, "--output-on-failure", "-R", f"^{re.escape(name)}$"]
    done = subprocess.run(command, cwd=build, check=False, text=True, capture_output=True, timeout=3600)
    if done.returncode != 0:
        print(done.stdout[-6000:] + done.stderr[-6000:])
    return done.returncode == 0


def main():
    parser = argparse.ArgumentParser(prog="changed_tests.py")
    parser.add_argument("build", type=Path)
    parser.add_argument("--all", action="store_true")
    wanted = parser.parse_args()
    build = wanted.build.resolve()
    if not (build / "build.ninja").is_file():
        sys.exit(f"changed_tests.py: {build}: no build tree; `cmake --preset default` makes one")
    record = build / "Testing" / "passed.json"
    passed = json.loads(record.read_text(encoding="utf-8")) if record.is_file() else {}
    digests = Digests()
    data = data_of_programs(digests)

    failed, ran = [], 0

    def attempt(name, job):
        """Runs a job unless it has failed in this run or passed as it is."""
        nonlocal ran
        digest = digest_of(job, build, digests, data)  # before it runs: a change meanwhile counts
        if name in failed or passed.get(name) == digest or failed and not wanted.all:
            return
        print(f"changed: {name}", flush=True)
        ran += 1
        if not run(name, job, build):
            failed.append(name)
            return
        passed[name] = digest
        record.parent.mkdir(exist_ok=True)
        record.write_text(json.dumps(passed, indent=1, sort_keys=True), encoding="utf-8")

    files = [line[3:] for line in git("status", "--porcelain").splitlines()]
    nearest = {next((program for room, program in NEAREST.items() if file.startswith(room)), None) for file in files}
    for program in sorted(nearest - {None}):
        if not build_targets(build, program):
            return 1
        attempt(program, program_job(build / "bin" / program))
    for name, job in jobs_without_build(build).items():
        attempt(name, job)
    if not failed or wanted.all:
        if not build_targets(build):
            return 1
        jobs, left = jobs_of(build)
        for name, job in jobs.items():
            attempt(name, job)
        print("changed: left out: " + ", ".join(f"{suite} {count}" for suite, count in sorted(left.items())))
    print(f"changed: {ran} programs and single tests run, {len(failed)} failed")
    for name in failed:
        print(f"changed: failed: {name}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
