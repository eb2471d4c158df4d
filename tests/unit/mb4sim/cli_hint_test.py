# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Hints of `mb4sim run` and `mb4sim spi`: one for each set-up of tests/wrong_setups, none for right
ones. MB4_HINT_SEED is the first seed of the random right ones.

  cli_hint_test.py MB4SIM EXAMPLES
"""

import json
import os
import re
import sys
from pathlib import Path

from cli import CliTest, run

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "wrong_setups"))
import hint_cases  # noqa: E402

RIGHT = 200
SEED = int(os.environ.get("MB4_HINT_SEED", "1"))
LINE = re.compile(r"mb4sim: hint \((?P<kind>[a-z]+)\): (?P<text>.*)")


def of_json(stderr):
    """The hints of `run --json`; other lines are notes."""
    objects = [json.loads(line) for line in stderr.splitlines()]
    return [{"kind": one["hint"], "place": one["place"], "text": one["text"]}
            for one in objects if "hint" in one]


class Hints(CliTest):
    def run_setup(self, setup, *options, frames=hint_cases.FRAMES):
        scenario = self.path("scenario.toml", setup.scenario)
        lines = self.path("lines.txt", "".join(f"{line}\n" for line in setup.lines))
        return run("run", scenario, "--frames", str(frames), "--spi", lines, *options)

    def test_each_wrong_setup_gives_its_hint_in_run(self):
        for setup in hint_cases.listed():
            with self.subTest(setup.name):
                result = self.run_setup(setup, "--json")
                self.assertEqual(hint_cases.wrong_with(setup, of_json(result.stderr)), "")
                self.assertNotIn("hint", json.loads(result.stdout))
                if setup.hint is None:
                    self.assertEqual((result.returncode, result.stderr), (0, ""))
                elif setup.hint["place"] != "host":  # the words of the others are as they should be
                    self.assertEqual(result.returncode, 1)

    def test_run_says_the_same_in_words(self):
        for setup in hint_cases.listed():
            with self.subTest(setup.name):
                plain, told = self.run_setup(setup), self.run_setup(setup, "--json")
                self.assertEqual([f"mb4sim: hint ({one['kind']}): {one['text']}" for one in of_json(told.stderr)],
                                 plain.stderr.splitlines())
                self.assertNotIn("hint", plain.stdout)

    def in_spi(self, setup):
        """What the driver sends in `run`, with time for the first frame behind it, in `spi`."""
        log = self.path("log.txt", "")
        self.run_setup(setup, "--bus-log", log, frames=1)
        sent = [line.split(">")[0].strip() for line in Path(log).read_text().splitlines()]
        self.assertIn("07 04", sent)
        by_hand = [line for line in setup.lines if not re.match("[0-9A-F]", line)]
        scenario = self.path("scenario.toml", setup.scenario)
        result = run("spi", scenario, text="".join(f"{line}\n" for line in [*sent, "+1000000", *by_hand]))
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_each_wrong_setup_gives_its_hint_in_spi(self):
        for setup in hint_cases.listed():
            with self.subTest(setup.name):
                result = self.in_spi(setup)
                hints = [{"place": setup.hint and setup.hint["place"], **LINE.fullmatch(line).groupdict()}
                         for line in result.stderr.splitlines() if "host timing" not in line]
                self.assertEqual(hint_cases.wrong_with(setup, hints), "")

    def test_no_right_setup_gives_a_hint(self):
        print(f"right set-ups from seed {SEED} on (MB4_HINT_SEED)", file=sys.stderr)
        good = bad = 0
        for setup in hint_cases.rights(RIGHT, SEED):
            with self.subTest(setup.name):
                result = self.run_setup(setup)
                self.assertIn(result.returncode, (0, 1), result.stderr + setup.scenario)
                self.assertEqual(result.stderr, "", setup.scenario)
                if "with faults" not in setup.name:
                    self.assertEqual(result.returncode, 0, result.stdout + setup.scenario)
                good += result.returncode == 0
                bad += result.returncode
        print(f"{good} without a bad word, {bad} with bad words", file=sys.stderr)
        self.assertGreater(bad, RIGHT // 8)  # faults have done something

    def test_what_fits_in_another_way_gives_none(self):
        for name, scenario, line in (
                ("software checks the CRC", "resolute-26", "02 C0 61 00"),
                ("software checks the CRC of each word", "chain", "02 C0 61 00 00 00 5F 00"),
                ("the last word leaves its CRC on the line", "chain", "02 C5 00"),
                ("fewer words than slaves", "chain", "02 C4 19"),
                ("a line is left out", "two-channels", "02 ED 0D"),
                ("no word of one line", "two-channels", "02 D0 19"),
                ("Gray code for software", "ssi-gray", "02 C0 4C"),
                ("SSI: the repeated word too", "ssi-25", "02 C0 72")):
            with self.subTest(name):
                setup = hint_cases.Setup(name, hint_cases.scenario_text(scenario), [line])
                self.assertEqual(self.in_spi(setup).stderr, "")

    def test_run_misses_what_the_host_leaves_out(self):
        for scenario, line, kind, text in (
                ("chain", "02 C4 19", "enable", "no word of slave 2: ENSCD2 = 0"),
                ("two-channels", "02 ED 0D", "channel", "channel 2, where 1 slave is: CFGCH2 = 3"),
                ("two-channels", "02 D0 19", "enable", "no word of channel 2: ENSCD5 = 0"),
                ("ssi-gray", "02 C0 4C", "gray", "slave 1 sends Gray code")):
            with self.subTest(line):
                setup = hint_cases.Setup(line, hint_cases.scenario_text(scenario), [line])
                self.assert_one_line(self.run_setup(setup), 1, rf"hint \({kind}\): .*{text}")

    def test_a_smaller_chip_names_what_it_lacks(self):
        text = hint_cases.scenario_text("ssi-25")
        for features, expected in (("single", "channel 1 needs SSI"), ("full", "")):
            setup = hint_cases.Setup(features, f'[chip]\nfeatures = "{features}"\n' + text, [])
            stderr = self.run_setup(setup).stderr
            self.assertRegex(stderr, f"^mb4sim: hint .features.: {expected}.*\n$" if expected else "^$")

    def test_a_smaller_chip_ignores_what_it_has_no_registers_for(self):
        setup = hint_cases.Setup("ENSCD2 of one data channel", '[chip]\nfeatures = "single"\n' +
                                 hint_cases.scenario_text("resolute-26"), ["02 C4 5B 06"])
        result = self.run_setup(setup)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_a_clock_by_hand_is_a_clock(self):
        scenario = self.path("scenario.toml", hint_cases.scenario_text("no-clk"))
        ask = "02 C0 5B 06\n02 E5 C0 A0 00 7C\n02 EC 00 0D\n07 04\n"
        by_hand = "pin CLK 1\n+50\npin CLK 0\n+50\n"
        self.assertIn("hint (clock)", run("spi", scenario, text=ask).stderr)
        self.assertEqual(run("spi", scenario, text=by_hand + ask + 20 * by_hand).stderr, "")

    def test_spi_tells_a_hint_once_and_in_time(self):
        setup = next(hint_cases.listed())
        scenario = self.path("scenario.toml", setup.scenario)
        configure = ("02 C0 59 06\n02 E5 C0 A0 00 7C\n02 EC 00 0D\n")
        self.assertEqual(run("spi", scenario, text=configure).stderr, "")  # nothing was asked for
        once = run("spi", scenario, text=configure + "07 04\n+100000\n07 04\n+100000\n").stderr
        self.assertEqual(len(once.splitlines()), 1, once)
        self.assertIn("hint (length)", once)

    def test_a_register_access_before_the_lengths_are_known_is_no_mistake(self):
        setup = next(hint_cases.listed())
        scenario = self.path("scenario.toml", setup.scenario)
        access = "02 C0 40\n02 E2 78 00 01 C0 A0 00 7C\n02 EC 00 0D\n07 08\n+3000000\n"
        self.assertEqual(run("spi", scenario, text=access).stderr, "")

    def test_spi_lines_of_run_have_their_line_number(self):
        scenario = self.path("scenario.toml", next(hint_cases.listed()).scenario)
        lines = self.path("lines.txt", "# a comment\n\n02 C0 ZZ\n")
        self.assert_one_line(run("run", scenario, "--spi", lines), 2, r"lines\.txt:3: expected bytes")


if __name__ == "__main__":
    import unittest
    unittest.main(argv=sys.argv[:1])
