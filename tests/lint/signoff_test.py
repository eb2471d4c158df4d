#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""tools/signoff/signoff.py with planted tables, reports and logs; tests/coverage/functional.py."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "signoff" / "signoff.py"
TABLE = """since = 2026-05-01
[[block]]
name = "x"
title = "Block X"
room = "x"
about = "X."
[[item]]
stage = "D1"
what = "Lint"
block = ["x"]
run = "normal"
tests = ["Lint.*", "Spi.*"]
[[item]]
stage = "D2"
what = "Coverage"
block = ["x"]
run = "nightly"
tests = ["Nightly.Coverage"]
figure = '^line in {room}: (\\d+ of \\d+, [\\d.]+) %'
at_least = 98.0
[[item]]
stage = "D3"
what = "Board"
block = ["x"]
open = "not tried"
"""
LOG = """test 7
      Start  7: Nightly.Coverage

7: line in x: 98 of 100, {} %
7/7 Test #7: Nightly.Coverage ...   Passed    1.00 sec
"""


def report(cases, day="2026-05-02"):
    inside = {"passed": "", "failed": "<failure message=''/>", "skipped": "<skipped message=''/>"}
    status = {"passed": "run", "failed": "fail", "skipped": "notrun"}
    return (f'<testsuite name="a" timestamp="{day}T10:00:00">' +
            "".join(f'<testcase name="{name}" status="{status[state]}">{inside[state]}</testcase>'
                    for name, state in cases.items()) + "</testsuite>")


GOOD = {"Lint.A": "passed", "Lint.B": "passed", "Spi.A": "passed", "Other.A": "failed"}


class SignOff(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)
        self.put("items.toml", TABLE)

    def put(self, name, text):
        (self.path / name).write_text(text, encoding="utf-8")
        return self.path / name

    def call(self, *arguments):
        done = subprocess.run(
            [sys.executable, "-B", SCRIPT, "--table", self.path / "items.toml", "--data",
             self.path / "data.json", "--page", self.path / "page.md", *arguments],
            capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def row(self, what):
        """Cells of an item's line behind its name."""
        for line in (self.path / "page.md").read_text(encoding="utf-8").splitlines():
            if line.startswith("| D") and f"| {what} |" in line:
                return [cell.strip() for cell in line.split("|")][3:-1]
        self.fail(f"no line {what}")

    def taken(self, run, *files):
        self.assertEqual(self.call("take", run, *files), (0, ""))

    def refused(self, text, *arguments):
        status, said = self.call(*arguments)
        self.assertEqual(status, 2, said)
        self.assertIn(text, said)
        self.assertEqual(said.count("\n"), 1, said)

    def test_every_test_passed_is_done(self):
        self.taken("normal", self.put("a.xml", report(GOOD)))
        self.assertEqual(self.row("Lint")[:4], ["done", "3 tests", "normal", "2026-05-02"])
        self.assertIn("| D1 |", (self.path / "page.md").read_text(encoding="utf-8"))

    def test_no_report_is_not_run(self):
        self.put("data.json", "{}")
        self.assertEqual(self.call("page"), (0, ""))
        self.assertEqual(self.row("Lint")[0], "*not run*")
        self.assertEqual(self.row("Board")[:2], ["**open**", "not tried"])

    def test_failed_skipped_absent_old_are_open(self):
        for cases, day, text in (({**GOOD, "Lint.B": "failed"}, "2026-05-02", "1 failed: Lint.B"),
                                 ({**GOOD, "Lint.B": "skipped"}, "2026-05-02", "1 skipped: Lint.B"),
                                 ({"Lint.A": "passed"}, "2026-05-02", "not in the report: Spi."),
                                 (GOOD, "2026-04-30", "older than 2026-05-01")):
            self.taken("normal", self.put("a.xml", report(cases, day)))
            self.assertEqual(self.row("Lint")[0], "**open**")
            self.assertIn(text, self.row("Lint")[1])

    def test_new_block_needs_a_newer_report(self):
        self.put("items.toml", TABLE.replace('about = "X."', 'about = "X."\nsince = 2026-05-03'))
        self.taken("normal", self.put("a.xml", report(GOOD)))
        self.assertIn("older than 2026-05-03", self.row("Lint")[1])
        self.taken("normal", self.put("a.xml", report(GOOD, "2026-05-03")))
        self.assertEqual(self.row("Lint")[0], "done")

    def test_page_tells_how_much_of_a_run_was_reported(self):
        self.taken("normal", self.put("a.xml", report({**GOOD, "Lint.B": "failed"})))
        page = (self.path / "page.md").read_text(encoding="utf-8")
        for line in ("| normal | 1 | 0 |", "| sanitize | 0 | 0 |", "| nightly | 0 | 1 |"):
            self.assertIn(line + "\n", page)

    def test_all_skipped_is_not_run(self):
        self.taken("normal", self.put("a.xml", report({name: "skipped" for name in GOOD})))
        self.assertEqual(self.row("Lint")[0], "*not run*")

    def test_new_report_replaces_old_results(self):
        self.taken("normal", self.put("a.xml", report(GOOD)))
        self.taken("normal", self.put("a.xml", report({"Other.A": "passed"})))
        self.assertEqual(self.row("Lint")[0], "*not run*")

    def test_added_report_keeps_the_other_pieces(self):
        self.taken("nightly", self.put("a.xml", report({"Nightly.Coverage": "passed"})),
                   self.put("a.log", LOG.format("99.0")))
        self.put("items.toml", TABLE.replace('run = "normal"', 'run = "nightly"'))
        self.taken("nightly", "--add", self.put("b.xml", report(GOOD)))
        self.assertEqual([self.row("Lint")[0], self.row("Coverage")[0]], ["done", "done"])
        self.refused("Lint.*: the report shows fewer tests than are kept", "take", "nightly",
                     "--add", self.put("c.xml", report({"Lint.A": "passed"})))

    def test_two_reports_worse_result_and_older_day_count(self):
        self.taken("normal", self.put("a.xml", report({**GOOD, "Lint.A": "failed"})),
                   self.put("b.xml", report({"Lint.A": "passed"}, "2026-05-09")))
        self.assertEqual(self.row("Lint")[0], "**open**")
        self.assertEqual(self.row("Lint")[3], "2026-05-02")

    def test_figure_is_held_against_its_goal(self):
        xml = self.put("a.xml", report({"Nightly.Coverage": "passed"}))
        self.taken("nightly", xml)
        self.assertIn("figure is not in the log", self.row("Coverage")[1])
        self.taken("nightly", xml, self.put("a.log", LOG.format("97.9")))
        self.assertEqual(self.row("Coverage")[0], "**open**")
        self.taken("nightly", xml, self.put("a.log", LOG.format("98.1")))
        self.assertEqual(self.row("Coverage")[:2], ["done", "1 test, 98 of 100, 98.1"])

    def test_useless_report_is_named(self):
        for text in ("<testsuite", "", '<testsuite timestamp="2026-05-02T1:00"/>', "<a/>",
                     '<testsuite timestamp="2026-05-02T10:00:00"/>',
                     '<testsuite timestamp="2026-05-02T10:00:00"><testcase/></testsuite>'):
            path = self.put("a.xml", text)
            self.refused(str(path), "take", "normal", path)
        self.refused("none.xml: No such file", "take", "normal", self.path / "none.xml")
        xml = self.put("a.xml", report(GOOD))
        self.refused("none.log: No such file", "take", "normal", xml, self.path / "none.log")
        self.refused("a.txt: no log of CTest", "take", "normal", xml, self.put("a.txt", "x\n"))
        self.refused("no JUnit report", "take", "normal", self.put("a.log", LOG))
        self.assertFalse((self.path / "data.json").exists())

    def test_useless_table_or_data_is_named(self):
        self.refused("data.json: No such file", "page")
        self.put("data.json", "{")
        self.refused("data.json: ", "page")
        self.put("data.json", "{}")
        for old, new in (('stage = "D1"', 'stage = "D9"'), ('block = ["x"]', 'block = ["y"]'),
                         ("tests = [", "test = ["), ('run = "normal"', ""),
                         ('open = "not tried"', 'open = "a"\nevidence = ["none"]'),
                         ("since = ", "since = ="), ("since = ", "day = "),
                         ('about = "X."', 'about = "X."\nsince = "x"'), ('title = "Block X"', "")):
            self.put("items.toml", TABLE.replace(old, new, 1))
            self.refused("items.toml: ", "page")

    def test_check_reads_the_table_alone(self):
        self.assertEqual(self.call("check"), (0, ""))
        self.put("items.toml", TABLE.replace('stage = "D3"', 'stage = "D9"'))
        self.assertEqual(self.call("check")[0], 2)


class Functional(unittest.TestCase):
    """tests/coverage/functional.py."""

    def call(self, goal, **files):
        script = SCRIPT.parents[2] / "tests" / "coverage" / "functional.py"
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                (Path(folder) / f"{name}.txt").write_text(text, encoding="utf-8")
            done = subprocess.run([sys.executable, "-B", script, folder, goal],
                                  capture_output=True, text=True, check=False)
            missed = Path(folder) / "missed.txt"
            missed = missed.read_text(encoding="utf-8") if missed.exists() else ""
        return done.returncode, done.stdout + done.stderr, missed

    def test_files_are_added_up(self):
        one, two = "0\tA\tx=0\n0\tA\tx=1\n", "3\tA\tx=0\n0\tA\tx=1\n"
        status, said, missed = self.call("50", a=one, b=two, missed="old")
        self.assertEqual((status, missed), (0, "A: x=1\n"))
        self.assertIn("functional in all: 1 of 2 points, 50.00 %", said)
        self.assertEqual(self.call("51", a=one, b=two)[0], 1)
        self.assertEqual(self.call("1", a=one)[0], 1)

    def test_useless_files_are_named(self):
        self.assertIn("a.txt:1: no line", self.call("1", a="x\n")[1])
        self.assertIn("no points", self.call("1")[1])


if __name__ == "__main__":
    unittest.main()
