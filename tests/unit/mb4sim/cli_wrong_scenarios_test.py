# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Mistakes of users in scenario files, tests/wrong_scenarios: each error names the place and what to write, as the
index of that folder says; what is no mistake runs.

Usage: cli_wrong_scenarios_test.py MB4SIM EXAMPLES
"""
import json
import os
import re
import subprocess
import unittest
from pathlib import Path

from cli import EXAMPLES, MB4SIM, CliTest

FOLDER = Path(EXAMPLES).parent / "tests" / "wrong_scenarios"
ROW = re.compile(r"\| \[([\w.-]+)\]\([\w.-]+\) \| (.*?) \| (.*?) \| (.*?) \|$")


def index():
    """(file, place, advice) of each row."""
    text = (FOLDER / "README.md").read_text(encoding="utf-8")
    return [(row[1], row[3], row[4]) for line in text.splitlines() if (row := ROW.match(line))]


def bare(text):
    """The index quotes values as TOML does, a message as it likes."""
    return text.replace('"', "").replace("'", "")


def wanted(place, advice):
    """What must stand in the message. Brackets in a place hold another name for the same."""
    place = re.sub(r"\([^)]*\)", "", place)
    first, *others = re.findall(r"line (\d+)", place)
    yield f":{first}:"
    for line in others:
        yield f"line {line}"
    yield from re.findall(r"`([^`]+)`", place)
    yield from re.findall(r"value (\w+)", place)
    for alternative in re.findall(r"`([^`]+)`", advice):
        yield alternative
    # Ranges and limits outside of code.
    yield from re.findall(r"\b(?:0x[0-9A-F]+|\d+)\b", re.sub(r"`[^`]+`|channel \d", "", advice))


class WrongScenarios(CliTest):
    def mb4sim(self, *arguments):
        return subprocess.run([MB4SIM, *arguments], cwd=FOLDER, capture_output=True, text=True, timeout=120,
                              check=False)

    def test_index_names_every_file(self):
        rows = index()
        self.assertEqual([name for name, _, _ in rows], sorted(path.name for path in FOLDER.glob("*.toml")))
        self.assertEqual(len(rows), 40)

    def test_each_error_names_the_place_and_what_to_write(self):
        before = sorted(os.listdir(FOLDER))
        for name, place, advice in index():
            if advice.startswith("runs"):
                continue
            with self.subTest(name):
                made = self.path("made.csv")
                result = self.mb4sim("run", name, "--csv", made)
                self.assert_one_line(result, 2, rf"^mb4sim: {name}:\d+:\d+: ")
                self.assertEqual(result.stdout, "")
                self.assertFalse(os.path.exists(made))
                message = bare(result.stderr)
                self.assertEqual([word for word in map(bare, wanted(place, advice)) if word not in message], [],
                                 result.stderr)
                self.assertEqual(self.mb4sim("check", name).stderr, result.stderr)
        self.assertEqual(sorted(os.listdir(FOLDER)), before)

    def test_what_only_leaves_out_a_default_runs(self):
        names = [name for name, _, advice in index() if advice.startswith("runs")]
        self.assertEqual(len(names), 6)
        for name in names:
            with self.subTest(name):
                result = self.mb4sim("run", name, "--frames", "3", "--json")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertEqual(self.mb4sim("check", name).stdout, f"{name}: ok\n")

    def test_the_order_of_channels_is_that_of_the_file(self):
        # Slave 1 counts from 0 in steps of 3, slave 5 from 500 on; of biss_axi 1 from 1000 on, 2 from 2000 on.
        for name, starts in (("03-two-channels-without-number.toml", {1: 0, 5: 500}),
                             ("06-axi-without-numbers.toml", {1: 1000, 2: 2000})):
            frames = json.loads(self.mb4sim("run", name, "--frames", "1", "--json").stdout)["frames"]
            self.assertEqual({row["slave"]: row["position"] for row in frames}, starts)


if __name__ == "__main__":
    unittest.main(argv=["cli_wrong_scenarios_test.py"])
