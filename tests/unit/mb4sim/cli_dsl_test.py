# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The commands with the model of a DSL master. Positions are those of the scenario's source.

  cli_dsl_test.py MB4SIM EXAMPLES
"""

import json
import sys
import tempfile
import unittest
from pathlib import Path

from cli import EXAMPLES, run

HEAD = '[master]\ntype = "dsl-model"\n'
FRAME_US = 11.52


def motor(keys="", slave=""):
    return f'[[channel]]\nnumber = 1\n{keys}[[channel.slave]]\nprotocol = "dsl"\n{slave}'


class Dsl(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, text):
        path = self.folder / "motor.toml"
        path.write_text(HEAD + text, encoding="utf-8")
        return str(path)

    def rows(self, scenario, frames):
        result = run("run", scenario, "--json", "--frames", str(frames))
        self.assertEqual(result.stderr, "")
        return result.returncode, json.loads(result.stdout)["frames"]

    def test_every_example_has_50_good_frames(self):
        examples = sorted((Path(EXAMPLES) / "dsl").glob("*.toml"))
        self.assertGreaterEqual(len(examples), 3)
        for example in examples:
            status, rows = self.rows(str(example), 50)
            self.assertEqual((status, [row["state"] for row in rows]), (0, ["ok"] * 50), example)

    def test_ramp_goes_on_by_one_step_a_frame(self):
        scenario = self.path(motor("cable_m = 60\n", 'source = "ramp"\nstart = 7\nstep = -3\n'
                                                     "position_bits = 40\n"))
        status, rows = self.rows(scenario, 30)
        self.assertEqual(status, 0)
        steps = {b["position"] - a["position"] for a, b in zip(rows, rows[1:])}
        self.assertEqual(steps, {-3})
        self.assertAlmostEqual(rows[20]["time_us"] - rows[0]["time_us"], 20 * FRAME_US, delta=0.1)

    def test_named_frame_loses_its_word(self):
        fault = '[[fault]]\nkind = "bit-flip"\nchannel = 1\nframe = 73\nanswer_bit = 33\n'
        status, rows = self.rows(self.path(motor(slave="data = 5\n") + fault), 80)
        self.assertEqual(status, 1)
        # The first row is running frame 32. Frame 73 is RX0, so POS is set for 15 frames.
        bad = [number for number, row in enumerate(rows, 32) if row["state"] != "ok"]
        self.assertEqual(bad, list(range(73, 73 + 15)))

    def test_faults_are_told_and_the_link_comes_back(self):
        result = run("run", str(Path(EXAMPLES) / "dsl" / "faults.toml"), "--frames", "600")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(sum("restart: " in line for line in result.stdout.splitlines()
                             if not line.startswith("errors")), 1)
        self.assertIn("  600 ", result.stdout)
        self.assertTrue([line for line in result.stdout.splitlines()
                         if line.split()[:1] == ["600"]][0].endswith("ok"))

    def test_no_link_is_one_message(self):
        for keys in ("cable_m = 130\n", '[[channel.event]]\nat_us = 0\naction = "unplug"\n'):
            event = keys.startswith("[[")
            text = (motor("" if event else keys)).replace("[[channel.slave]]", (keys if event else "") +
                                                          "[[channel.slave]]")
            result = run("run", self.path("[host]\nlink_ms = 5\n" + text))
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, r"\Amb4sim: .*no link within 5 ms: state [A-Z ]+, "
                                            r"\d\d restarts, the last one: no answer was found\n\Z")

    def test_what_the_master_has_not_is_refused_in_one_line(self):
        scenario = self.path(motor())
        for arguments in (("regs", scenario), ("sweep", scenario), ("plot", scenario),
                          ("run", scenario, "--trace", str(self.folder / "x.fst")),
                          ("run", scenario, "--bus-log", str(self.folder / "x.log"))):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertRegex(result.stderr, r"\Amb4sim: .*\n\Z", arguments)
            self.assertIn("no picture" if "plot" in arguments else "dsl-model", result.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["motor.toml"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
