#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The sign-off page: what each block has shown, from the reports of test runs.

  signoff.py take RUN FILE...   RUN is normal, sanitize or nightly. FILEs are all JUnit reports (.xml)
                                and CTest logs (figures) of this run; they replace what was kept
                                of it in build/signoff.json. With --add they replace only what they
                                show: a long run may come in pieces. Then as `page`.
  signoff.py page               writes build/signoff.md from items.toml and build/signoff.json
  signoff.py check              items.toml can be read

Neither file is in the repository. tools/release.sh makes the page again and puts it into the release.

tools/test.sh leaves both files of a run, junit.xml and ctest.log, in build/, with --sanitize in
build-sanitize/. The normal and the nightly run write the same files: `take` comes between them. Only
whole runs show everything: a report of some tests alone leaves the others without one.

--table, --data and --page name other files, --root where links look for the repository. items.toml tells what is in it. An item is done if a
report, not older than items.toml demands, holds each of its tests and all of them passed, and if its
figure is there and good enough. Anything else is open, or not run if no test of it ran."""

import argparse
import datetime
import fnmatch
import json
import os
import re
import sys
import tomllib
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RUNS = ("normal", "sanitize", "nightly")
STAGES = {"D1": "interfaces and registers are fixed", "D2": "complete, lint and crossings clean",
          "D3": "synthesised, within its budget", "V1": "its own tests pass",
          "V2": "specification covered, proofs, sanitizers",
          "V3": "coverage, faults planted, gates, soak", "S1": "documented, packaged",
          "S2": "tried with other tools", "S3": "released, tried in the field"}
KEYS = {"stage", "block", "what", "run", "tests", "tests_of", "figure", "at_least", "at_most",
        "evidence", "open", "since"}


class Fault(Exception):
    """A file that cannot be used; its text begins with the file's name."""


# ---- reports -------------------------------------------------------------------------------------

def read_report(path):
    """(day, {test: "passed", "failed" or "skipped"}, {test: output}) of a JUnit file of CTest."""
    try:
        suite = ElementTree.fromstring(path.read_text(encoding="utf-8", errors="replace"))
        day = datetime.datetime.fromisoformat(suite.attrib["timestamp"]).date().isoformat()
        cases = [(case.attrib["name"], case) for case in suite.iter("testcase")]
    except OSError as error:
        raise Fault(f"{path}: {error.strerror}") from error
    except (ElementTree.ParseError, KeyError, ValueError) as error:
        raise Fault(f"{path}: no JUnit report of CTest: {error}") from error
    if not cases:
        raise Fault(f"{path}: a report without tests")
    states, texts = {}, {}
    for name, case in cases:
        if case.find("failure") is not None or case.find("error") is not None:
            states[name] = "failed"
        elif case.find("skipped") is not None or case.get("status", "run") != "run":
            states[name] = "failed" if case.get("status") == "fail" else "skipped"
        else:
            states[name] = "passed"
        texts[name] = case.findtext("system-out") or ""
    return day, states, texts


def read_log(path):
    """{test: output} of a log of `ctest --verbose`."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise Fault(f"{path}: {error.strerror}") from error
    names, texts = {}, {}
    for line in lines:
        if start := re.fullmatch(r"\s*Start\s+(\d+): (\S+)\s*", line):
            names[start[1]] = start[2]
        elif (said := re.match(r"(\d+): (.*)", line)) and said[1] in names:
            texts.setdefault(names[said[1]], []).append(said[2])
    if not names:
        raise Fault(f"{path}: no log of CTest")
    return {name: "\n".join(text) for name, text in texts.items()}


def digest(items, run, files):
    """What build/signoff.json keeps of a run: {"tests": {pattern: result}, "figures": {regex: text}}."""
    states, days, texts = {}, {}, {}
    for path in files:
        if path.suffix == ".xml":
            day, found, output = read_report(path)
            for name, state in found.items():
                # If a test is in two reports, the worse result counts, with the older day.
                if name not in states or (states[name] == "passed" and state != "passed"):
                    states[name] = state
                days[name] = min(day, days.get(name, day))
        else:
            output = read_log(path)
        for name, text in output.items():
            texts[name] = texts.get(name, "") + text + "\n"
    if not states:
        raise Fault(f"{', '.join(map(str, files))}: no JUnit report (.xml) among them")
    kept = {"tests": {}, "figures": {}}
    for item in items:
        if item.get("run") != run:
            continue
        matching = {pattern: fnmatch.filter(states, pattern) for pattern in item["tests"]}
        for pattern, names in matching.items():
            if names:
                kept["tests"][pattern] = {
                    "day": min(days[name] for name in names), "passed": 0,
                    **{state: len(those) for state in ("passed", "failed", "skipped")
                       if (those := [n for n in names if states[n] == state])},
                    **({"which": bad} if (bad := sorted(
                        n for n in names if states[n] != "passed")[:3]) else {})}
        text = "\n".join(texts.get(name, "") for names in matching.values() for name in names)
        if "figure" in item and (found := re.search(item["figure"], text, re.M)):
            kept["figures"][item["figure"]] = found[1]
    return {kind: dict(sorted(rows.items())) for kind, rows in kept.items()}


def added(kept, found):
    """What a piece of a run has found, beside what is kept of the other pieces."""
    def total(row):
        return sum(row.get(state, 0) for state in ("passed", "failed", "skipped"))

    for pattern, row in found["tests"].items():
        # A piece that shows some of the tests would hide how the others have ended.
        if total(row) < total(kept.get("tests", {}).get(pattern, {})):
            raise Fault(f"{pattern}: the report shows fewer tests than are kept")
    return {kind: {**kept.get(kind, {}), **rows} for kind, rows in found.items()}


# ---- table ---------------------------------------------------------------------------------------

def read_table(path):
    """(blocks {name: {...}}, items, one for each block that an [[item]] names)."""
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise Fault(f"{path}: {error.strerror}") from error
    except tomllib.TOMLDecodeError as error:
        raise Fault(f"{path}: {error}") from error
    if not isinstance(table.get("since"), datetime.date) or any(
            {"name", "title", "about"} - block.keys()
            or not isinstance(block.get("since", table["since"]), datetime.date)
            for block in table.get("block", [{}])):
        raise Fault(f"{path}: no day `since`, or a block without name, title or about")
    blocks = {block["name"]: block for block in table["block"]}
    items = []
    for number, row in enumerate(table.get("item", []), 1):
        def fault(text, number=number, row=row):
            return Fault(f"{path}: item {number} ({row.get('what', '')}): {text}")

        for key in row.keys() - KEYS:
            raise fault(f"unknown key '{key}'")
        if row.get("stage") not in STAGES or not row.get("what") or not row.get("block"):
            raise fault("stage, what or block is missing or unknown")
        if ("run" in row) == ("open" in row) or row.get("run", RUNS[0]) not in RUNS:
            raise fault("either run or open, and a run is one of " + ", ".join(RUNS))
        for place in row.get("evidence", []):
            if not (ROOT / place).exists():
                raise fault(f"there is no evidence {place}")
        for name in row["block"]:
            if name not in blocks:
                raise fault(f"unknown block '{name}'")
            item = {"since": blocks[name].get("since", table["since"]), **row, "block": name}
            item["tests"] = row.get("tests", []) + row.get("tests_of", {}).get(name, [])
            if "run" in row and not item["tests"]:
                raise fault(f"no tests of block '{name}'")
            if "figure" in row:
                item["figure"] = row["figure"].replace("{room}", blocks[name].get("room", ""))
            items.append(item)
    return blocks, items


def judge(item, data):
    """(state, what is missing, figure, day) of an item."""
    if "open" in item:
        return "open", item["open"], "", ""
    kept = data.get(item["run"], {"tests": {}, "figures": {}})
    rows = {pattern: kept["tests"].get(pattern) for pattern in item["tests"]}
    absent = [pattern for pattern, row in rows.items() if row is None]
    if len(absent) == len(rows):
        return "not run", f"no report of the {item['run']} run has it", "", ""
    there = [row for row in rows.values() if row]
    day = min(row["day"] for row in there)

    def total(state):
        return sum(row.get(state, 0) for row in there)

    passed = total("passed")
    figure = kept["figures"].get(item.get("figure"), "")
    counted = f"{passed} tests" if passed != 1 else "1 test"
    shown = ", ".join(text for text in (counted if passed else "", figure) if text)
    which = ", ".join(name for row in there for name in row.get("which", []))
    if day < item["since"].isoformat():
        return "open", f"the report is older than {item['since']}", shown, day
    for state in ("failed", "skipped"):
        if total(state):
            ran = "not run" if passed + total("failed") == 0 else "open"
            return ran, f"{total(state)} {state}: {which}", shown, day
    if absent:
        return "open", "not in the report: " + ", ".join(absent), shown, day
    if "figure" in item:
        if not figure:
            return "open", "the figure is not in the log", shown, day
        value = float(re.findall(r"\d+(?:\.\d+)?", figure)[-1])
        if value < item.get("at_least", value):
            return "open", f"the goal is {item['at_least']}", shown, day
        if value > item.get("at_most", value):
            return "open", f"the goal is {item['at_most']}", shown, day
    return "done", "", shown, day


# ---- page ----------------------------------------------------------------------------------------

def stage_reached(letter, results):
    """The highest stage of D, V or S whose items are all done, as are those of the stages before."""
    reached = f"{letter}0"
    for stage in STAGES:
        if stage.startswith(letter):
            states = [state for at, state in results if at == stage]
            if any(state != "done" for state in states):
                break
            if states:
                reached = stage
    return reached


def page(blocks, items, data, root):
    judged = [(item, *judge(item, data)) for item in items]

    def reported(run, there):
        return sum(item.get("run") == run and (state != "not run") == there
                   for item, state, *_ in judged)

    out = ["<!--", "SPDX-FileCopyrightText: 2026 The openmb4 authors",
           "SPDX-License-Identifier: Apache-2.0", "-->", "", "# Sign-off", "",
           "For those who decide whether a block is good enough for their use. After this page you "
           "know what each", "block has shown, on which day, and what is still open.", "",
           "`tools/signoff/signoff.py` makes this page from reports of test runs; do not edit it. "
           "The items stand in", "`tools/signoff/items.toml`. An item is done if all its tests have "
           f"passed in a report from {items[0]['since']} or later,", "and if its figure reaches the "
           "goal. \"not run\" means that no test of the item is in a report.",
           "\"open\" has its reason in the row: the report is older than that day (its result stands beside it; of several reports the oldest counts), a test was",
           "skipped, a goal is not met, or nothing can show it yet. \"N tests\" are those that passed.", "",
           "The stages follow those of OpenTitan: D for design, V for verification, S for release. "
           "A block has reached", "a stage if all items of this stage and of the earlier ones of the "
           "same letter are done.",
           "D0, V0, S0: not even the first; one skipped test is enough. Empty: the block has no item of this letter.", "",
           "The report of a run replaces the one before; a part of a long run can be added to it (`take "
           "... --add`).", "A report of a part of the tests leaves the other items without one:", "",
           "| run | items with a report, of any day | items without a report |", "|---|---|---|",
           *[f"| {run} | {reported(run, True)} | {reported(run, False)} |" for run in RUNS], "",
           "| stage | what it asks for |", "|---|---|",
           *[f"| {stage} | {text} |" for stage, text in STAGES.items()], "",
           "| block | design | verification | release | done | open | not run |",
           "|---|---|---|---|---|---|---|"]

    def link(place):
        return f"[{place}]({root}/{place})"

    def counts(rows):
        return " | ".join(str(sum(state == wanted for _, state, *_ in rows))
                          for wanted in ("done", "open", "not run"))

    def anchor(name):
        return re.sub(r"[^a-z0-9 -]", "", name.lower()).replace(" ", "-")

    for name, block in blocks.items():
        rows = [row for row in judged if row[0]["block"] == name]
        results = [(item["stage"], state) for item, state, *_ in rows]
        letters = [stage_reached(letter, results)
                   if any(stage.startswith(letter) for stage, _ in results) else ""
                   for letter in "DVS"]
        out.append(f"| [{block['title']}](#{anchor(block['title'])}) | {' | '.join(letters)} "
                   f"| {counts(rows)} |")
    out.append(f"| all | | | | {counts(judged)} |")
    for name, block in blocks.items():
        out += ["", f"## {block['title']}", "", block["about"], "",
                "| stage | item | state | shown, or missing | run | day | evidence |",
                "|---|---|---|---|---|---|---|"]
        rows = [row for row in judged if row[0]["block"] == name]
        for item, state, missing, shown, day in sorted(
                rows, key=lambda row: list(STAGES).index(row[0]["stage"])):
            said = "; ".join(text for text in (missing, shown) if text).replace("|", "\\|")
            evidence = ", ".join(map(link, item.get("evidence", [])))
            mark = {"done": "done", "open": "**open**", "not run": "*not run*"}[state]
            # A * in a pattern is no emphasis.
            said = said.replace("*", "\\*")
            out.append(f"| {item['stage']} | {item['what']} | {mark} | {said} "
                       f"| {item.get('run', '')} | {day} | {evidence} |")
    return "\n".join(out) + "\n"


def read_data(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise Fault(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise Fault(f"{path}: {error}") from error


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", type=Path, default=ROOT / "tools" / "signoff" / "items.toml")
    parser.add_argument("--data", type=Path, default=ROOT / "build" / "signoff.json")
    parser.add_argument("--page", type=Path, default=ROOT / "build" / "signoff.md")
    parser.add_argument("--root", help="the repository as the page's links see it")
    commands = parser.add_subparsers(dest="command", required=True)
    take = commands.add_parser("take")
    take.add_argument("run", choices=RUNS)
    take.add_argument("--add", action="store_true")
    take.add_argument("files", nargs="+", type=Path)
    commands.add_parser("page")
    commands.add_parser("check")
    options = parser.parse_args()
    try:
        blocks, items = read_table(options.table)
        if options.command == "check":
            return 0
        data = read_data(options.data) if options.data.exists() or options.command != "take" else {}
        if options.command == "take":
            found = digest(items, options.run, options.files)
            data[options.run] = added(data.get(options.run, {}), found) if options.add else found
            options.data.write_text(json.dumps(data, indent=1, sort_keys=True) + "\n",
                                    encoding="utf-8")
        text = page(blocks, items, data, options.root or os.path.relpath(ROOT, options.page.resolve().parent))
    except Fault as fault:
        print(f"signoff.py: {fault}", file=sys.stderr)
        return 2
    options.page.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
