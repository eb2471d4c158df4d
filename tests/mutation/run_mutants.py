#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Wakes one fault after the other and runs tests until one fails.

  run_mutants.py MUTANTS_TXT GOAL [--jobs N] [--log FILE] [--tests FILTER] PROGRAM...
  run_mutants.py --design NAME|--master NAME [--build BUILD] [--jobs N] [--log FILE] [--only N,M...]
     GOAL  share in percent that must be caught, of the faults that are not in equivalent.txt
     NAME  a design of masters.toml, or a master: its first design. BUILD (default build) has its programs
           (target mutants_DESIGN); goal and tests are those of the entry
     N,M   numbers of faults: a sample
     FILE  takes what has been found; a run that was ended goes on from there. For one mutants.txt only

First all tests run without a fault: they must pass, and what takes long is known then. All
faults meet the quick tests of all programs first; what these do not catch meets longer ones.
A run that goes on does so with the tests that the programs have got since, by name: what is not
caught yet meets these first. A changed test of the same name is not run again.
A fault of equivalent.txt meets the first four batches and such new tests only: should they catch
it, its reason is wrong and the run fails. What does not end counts as caught: it may take three
times the processor time of the run without a fault, and ten seconds."""

import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import mutate  # noqa: E402
import project  # noqa: E402

LEFT_OUT = "-" + ":".join(
    line for line in (HERE.parent / "support" / "statistics.txt").read_text("utf-8").splitlines()
    if not line.startswith("#"))
SMALL = {"MB4_RANDOM_CONFIGS": "100", "MB4_FAULT_FRAMES": "2000", "MB4_LINE_FRAMES": "1210",
         "MB4_HOST_FRAMES": "300", "MB4_PRU_ACCESSES": "4000"}
FIRST_BATCH = 2.0  # seconds; each batch takes twice as long as the one before
EQUIVALENT_MEETS = 4  # batches
EXPECTED = HERE / "equivalent.txt"


def start(program, tests, number, seconds=0, options=()):
    """Exit status of a run with this fault (0: none)."""
    environment = {**os.environ, **SMALL, "MB4_MUTANT": str(number)}
    command = [program, f"--gtest_filter={tests}", "--gtest_fail_fast", "--gtest_brief=1",
               *options]
    if seconds:
        command = ["prlimit", f"--cpu={seconds}", *command]
    return subprocess.run(command, env=environment, check=False, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL).returncode


def report(program, tests, *options):
    """{test: what gtest says of it} of a run without a fault."""
    with tempfile.TemporaryDirectory() as folder:
        output = f"--gtest_output=json:{folder}/report.json"
        if start(program, tests, 0, options=(output, *options)) != 0:
            raise SystemExit(f"{program}: tests fail without a fault")
        suites = json.loads(Path(folder, "report.json").read_text(encoding="utf-8"))["testsuites"]
    return {f"{suite['name']}.{test['name']}": test for suite in suites for test in suite["testsuite"]}


def test_times(program, tests):
    """[(seconds, program, test)] without a fault."""
    times = [(float(test["time"].rstrip("s")), program, name)
             for name, test in report(program, tests).items()]
    print(f"{Path(program).name}: {len(times)} tests, {sum(row[0] for row in times):.1f} s", flush=True)
    return times


def in_batches(filters, jobs):
    """[[(program, filter, processor seconds that it may take)]] of {program: filter}, quick tests
    first."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with ThreadPoolExecutor(jobs) as pool:
        tests = [row for rows in pool.map(test_times, filters, filters.values())
                 for row in rows]
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    # Where other work runs beside, less of this time was processor time.
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    share = cpu / max(sum(seconds for seconds, _, _ in tests), 1e-3)
    tests = [(seconds * share, program, name) for seconds, program, name in tests]
    found, room = [{}], FIRST_BATCH
    for seconds, program, name in sorted(tests):
        if sum(s for s, _ in found[-1].values()) + seconds > room and found[-1]:
            found.append({})
            room *= 2
        taken, names = found[-1].get(program, (0.0, []))
        found[-1][program] = (taken + seconds, [*names, name])
    return [[(program, ":".join(names), int(3 * seconds) + 10)
             for program, (seconds, names) in batch.items()] for batch in found]


def caught(batch, number):
    return any(start(program, tests, number, seconds) for program, tests, seconds in batch)


def of_design(options):
    """([mutants.txt, goal, programs...], tests) of a design, or of the first one of a master."""
    name = options.get("--design")
    if name is None:
        master = project.MASTERS.get(options["--master"])
        if master is None or not master.measured:
            names = [one.name for one in project.MASTERS.values() if one.measured]
            raise SystemExit(f"run_mutants.py: no master '{options['--master']}' with measured designs; there are {', '.join(names)}")
        name = next(iter(master.measured))
    design, build = project.design(name), Path(options.get("--build", "build")).resolve()
    programs = [str(build / "bin" / f"mutant_{name}_{program}") for program in design.programs + design.blocks]
    missing = [path for path in programs if not Path(path).exists()]
    if missing:
        raise SystemExit(f"run_mutants.py: {missing[0]} is missing; build the target mutants_{name}")
    return [str(build / "tests/mutation" / name / "rtl/mutants.txt"), design.goals.get("mutants", 0), *programs], \
        design.tests or LEFT_OUT


def main():
    arguments = sys.argv[1:]
    options = {}
    for name in ("--jobs", "--log", "--tests", "--design", "--master", "--build", "--only"):
        if name in arguments:
            at = arguments.index(name)
            options[name] = arguments[at + 1]
            del arguments[at:at + 2]
    if "--design" in options or "--master" in options:
        arguments, tests = of_design(options)
        options.setdefault("--tests", tests)
    head, *listing = Path(arguments[0]).read_text(encoding="utf-8").splitlines()
    print(head, flush=True)
    goal, programs = float(arguments[1]), arguments[2:]
    chosen = options.get("--tests", LEFT_OUT)
    if "--only" in options:
        listing = [line for line in listing if line.split(" ", 1)[0] in options["--only"].split(",")]
    jobs = int(options.get("--jobs", 1))
    log = Path(options.get("--log", os.devnull))
    kept = [line.split(": ", 1) for line in
            (log.read_text(encoding="utf-8") if log.is_file() else "").splitlines()]
    seen = {(int(place), number) for place, number in
            (key.split()[1:] for key, _ in kept if key.startswith("batch "))}
    done = {number for _, number in seen for key, said in kept
            if key.endswith(f" {number}") and said.startswith("caught")}

    def note(text):
        with log.open("a", encoding="utf-8") as file:
            file.write(text + "\n")

    batches = next((json.loads(said) for key, said in reversed(kept) if key == "batches"), [])
    if batches:
        known = {(program, name) for batch in batches for program, tests, _ in batch
                 for name in tests.split(":")}
        added = {program: [name for name in report(program, chosen, "--gtest_list_tests")
                           if (program, name) not in known]
                 for program in programs}
        filters = {program: ":".join(names) for program, names in added.items() if names}
    else:
        filters = dict.fromkeys(programs, chosen)
    old = len(batches)
    if filters:
        batches += in_batches(filters, jobs)
        note(f"batches: {json.dumps(batches)}")
    first_run = old or len(batches)
    order = [*range(old, len(batches)), *range(old)]
    faults = dict(line.split(" ", 1) for line in listing)
    reason_of = mutate.reasons(EXPECTED)
    argued = {number: reason_of[text] for number, text in
              ((number, re.sub(r"^(\w+):\d+", r"\1", text)) for number, text in faults.items())
              if text in reason_of}
    with ThreadPoolExecutor(jobs) as pool:
        for place, batch in ((index + 1, batches[index]) for index in order):
            def run(number, place=place, batch=batch):
                if number in done or (place, number) in seen:
                    return
                if number in argued and EQUIVALENT_MEETS < place <= first_run:
                    return
                said = "passed"
                if caught(batch, number):
                    done.add(number)
                    said = f"caught: {faults[number]}"
                    print(f"{number}: caught in batch {place}: {faults[number]}", flush=True)
                note(f"batch {place} {number}: {said}")

            list(pool.map(run, faults))
            print(f"  batch {place} of {len(batches)}: {len(done)} of {len(faults)} caught",
                  flush=True)
    places = {module: str(path.parent.relative_to(project.RTL))
              for module, path in project.rtl_modules().items() if project.RTL in path.parents}
    rooms = {room: [0, 0] for room in sorted({*places.values(), "all"})}
    for number, text in faults.items():
        for room in ("all", places[text.split(":")[0]]):
            rooms[room][0] += number in done
            rooms[room][1] += number in done or number not in argued
        if number not in done:
            reason = argued.get(number)
            print(f"not caught: {text}" + (f"\n  because {reason}" if reason else ""))
    wrong = sorted(done & argued.keys(), key=int)
    for number in wrong:
        print(f"{EXPECTED.name} says that no test sees it: {faults[number]}")
    for room, (found, of) in rooms.items():
        if of:
            print(f"in {room}: {found} of {of} faults caught, {100 * found / of:.1f} %")
    share = 100 * len(done) / max(len(faults) - len(argued), 1)
    print(f"{len(done)} of {len(faults)} faults caught, {len(argued)} change nothing: "
          f"{share:.1f} %")
    sys.exit(0 if share >= goal and not wrong else 1)


main()
