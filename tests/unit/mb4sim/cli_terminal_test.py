# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What mb4sim does on a terminal only, and what programs read: colour, watch, pictures, JSON, JUnit.

Usage: cli_terminal_test.py MB4SIM EXAMPLES
"""
import contextlib
import json
import os
import pty
import re
import select
import shutil
import subprocess
import termios
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

from cli import EXAMPLES, MB4SIM, RESOLUTE, CliTest, run, slave

FAULTS = os.path.join(EXAMPLES, "faults.toml")
GREEN, RED = "\033[32m", "\033[31m"
COLOURS = re.compile(r"\033\[\d*m")


def on_terminal(*arguments, keys=b"", wait_for=None, **variables):
    """(exit status, text) of mb4sim with a terminal as its input, output and errors. `keys` are pressed when
    `wait_for` has been printed."""
    main, end = pty.openpty()
    before = termios.tcgetattr(end)
    environment = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
    process = subprocess.Popen([MB4SIM, *arguments], stdin=end, stdout=end, stderr=end,
                               env={**environment, "TERM": "xterm", **variables})
    text = b""
    limit = time.monotonic() + 60
    while time.monotonic() < limit:
        if select.select([main], [], [], 0.05)[0]:
            with contextlib.suppress(OSError):
                text += os.read(main, 65536)
        elif process.poll() is not None:
            break
        if keys and wait_for in text.decode(errors="replace"):
            os.write(main, keys)
            keys = b""
    status = process.wait(timeout=60)
    after = termios.tcgetattr(end)
    os.close(main)
    os.close(end)
    assert before[3] == after[3], "the terminal is not as it was"
    return status, text.decode().replace("\r\n", "\n")


class Colour(CliTest):
    def test_good_and_bad_rows_have_a_colour_on_a_terminal(self):
        plain = run("run", FAULTS, "--frames", "70")
        status, text = on_terminal("run", FAULTS, "--frames", "70")
        self.assertEqual(status, plain.returncode)
        self.assertEqual(COLOURS.sub("", text), plain.stdout)
        rows = [line for line in text.splitlines() if re.match(r"\033\[\d+m +\d+ ", line)]
        self.assertEqual(len(rows), 70)
        for row in rows:
            self.assertEqual(row.startswith(GREEN), row.endswith("  ok\033[0m"), row)
            self.assertTrue(row.startswith((GREEN, RED)))
        self.assertTrue(any(row.startswith(RED) for row in rows))

    def test_no_color_and_a_dumb_terminal_have_none(self):
        for variables in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            self.assertNotIn("\033[3", on_terminal("run", RESOLUTE, "--frames", "2", **variables)[1])
        self.assertIn(GREEN, on_terminal("run", RESOLUTE, "--frames", "2", NO_COLOR="")[1])  # as no-color.org says

    def test_other_tables(self):
        wide = ["--delays", "0", "--jitters", "0,70", "--frames", "50"]
        text = on_terminal("sweep", RESOLUTE, *wide)[1]
        self.assertIn(GREEN + "    .", text)
        self.assertIn(RED, text)
        self.assertEqual(COLOURS.sub("", text), run("sweep", RESOLUTE, *wide).stdout)
        self.assertIn(GREEN, on_terminal("regress", RESOLUTE)[1])


class Watch(CliTest):
    def test_positions_live_until_a_key(self):
        ramp = self.path("ramp.toml", slave("data_bits = 28\nsource = \"ramp\"\nstep = 7"))
        status, text = on_terminal("watch", ramp, "--every", "5", keys=b"q", wait_for="good 5,")
        self.assertEqual(status, 0)
        positions = [int(found) for found in re.findall(r"0x[0-9A-F]{7} +(\d+) ", text)]
        self.assertGreaterEqual(len(positions), 5)
        self.assertEqual(positions, list(range(0, 7 * len(positions), 7)))
        self.assertIn("\033[2A", text)  # each frame over the last one

    def test_bad_frames_are_status_1(self):
        dead = self.path("dead.toml", slave("data_bits = 28") + "[[fault]]\nkind = \"silent\"\nat_us = 0\n")
        status, text = on_terminal("watch", dead, "--every", "1", keys=b"q", wait_for="bad 2;")
        self.assertEqual(status, 1)
        self.assertIn(RED, text)

    def test_without_a_terminal_it_is_refused(self):
        self.assert_one_line(run("watch", RESOLUTE), 2, "^mb4sim: watch needs a terminal; 'mb4sim run' ")


class Pictures(CliTest):
    def test_no_svg_on_a_terminal(self):
        status, text = on_terminal("plot", RESOLUTE)
        self.assertEqual(status, 2)
        self.assertRegex(text, r"\Amb4sim: plot prints SVG, which no terminal shows: give --svg FILE\.svg[^\n]*\n\Z")
        self.assertIn("<svg", run("plot", RESOLUTE).stdout)

    def test_a_png_file_is_one(self):
        sweep = ["sweep", RESOLUTE, "--delays", "0", "--jitters", "0", "--frames", "1"]
        for command in (["plot", RESOLUTE], sweep):
            path = self.path("x.PNG" if command[0] == "plot" else "x.png")
            result = run(*command, "--svg", path)
            if shutil.which("rsvg-convert") is None:
                self.assert_one_line(result, 2, "x.png: a PNG file needs rsvg-convert")
                self.skipTest("rsvg-convert is not installed")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(Path(path).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_other_formats_are_refused_and_nothing_is_written(self):
        for name in ("x.pdf", "x.JPG"):
            result = run("plot", RESOLUTE, "--svg", self.path(name))
            self.assert_one_line(result, 2, rf"^mb4sim: --svg: .*{name}: a picture is an \.svg or a \.png file")
        without = subprocess.run([MB4SIM, "plot", RESOLUTE, "--svg", self.path("x.png")], env={"PATH": "/nowhere"},
                                 capture_output=True, text=True, timeout=60, check=False)
        self.assert_one_line(without, 2, r"x\.png: a PNG file needs rsvg-convert \(package librsvg2-bin\); give the name")
        self.assertEqual(os.listdir(self.folder.name), [])


class ForPrograms(CliTest):
    POINTS = ["--delays", "0:200:100", "--jitters", "0,70", "--frames", "10"]

    def test_a_sweep_does_not_depend_on_its_jobs(self):
        one = run("sweep", RESOLUTE, *self.POINTS, "--jobs", "1")
        self.assertEqual(one.stdout, run("sweep", RESOLUTE, *self.POINTS, "--jobs", "3").stdout)
        self.assertEqual(one.stderr, "")

    def test_json_of_sweep_has_the_points_of_its_csv(self):
        csv = self.path("x.csv")
        result = run("sweep", RESOLUTE, *self.POINTS, "--json", "--csv", csv, "--freqs", "0,1")
        document = json.loads(result.stdout)
        self.assertEqual(document["good"], result.returncode == 0)
        self.assertEqual([plane["code"] for plane in document["planes"]], [0, 1])
        rows = [[plane["code"], plane["ma_hz"], *point.values()]
                for plane in document["planes"] for point in plane["points"]]
        with open(csv, encoding="utf-8") as file:
            self.assertEqual([[int(cell) for cell in line.split(",")] for line in file.readlines()[1:]], rows)

    def test_json_and_junit_of_regress(self):
        bad = self.path("bad & <worse>.toml", slave("data_bits = 28") +
                        "[[fault]]\nkind = \"silent\"\nat_us = 500\n")
        junit = self.path("x.xml")
        result = run("regress", RESOLUTE, bad, "--seeds", "2", "--frames", "50", "--json", "--junit", junit)
        self.assertEqual(result.returncode, 1, result.stderr)
        document = json.loads(result.stdout)
        self.assertEqual(document["failed"], 2)
        self.assertEqual([(each["scenario"], each["seed"], each["status"]) for each in document["runs"]],
                         [(RESOLUTE, 1, 0), (RESOLUTE, 2, 0), (bad, 1, 1), (bad, 2, 1)])
        suite = xml.etree.ElementTree.parse(junit).getroot()
        self.assertEqual((suite.get("tests"), suite.get("failures")), ("4", "2"))
        cases = [(case.get("classname"), case.get("name"), case.find("failure") is not None) for case in suite]
        self.assertEqual(cases, [(each["scenario"], f"seed {each['seed']}", each["status"] != 0)
                                 for each in document["runs"]])
        self.assertEqual(suite[2].find("failure").get("message"), document["runs"][2]["state"])

    def test_junit_of_merged_shards_is_that_of_the_whole(self):
        shards = []
        for part in ("1/2", "2/2"):
            shards.append(self.path(part[0] + ".shard", run("regress", RESOLUTE, "--seeds", "3", "--frames", "2",
                                                            "--shard", part).stdout))
        run("regress", RESOLUTE, "--seeds", "3", "--frames", "2", "--junit", self.path("whole.xml"))
        run("regress", "--merge", *shards, "--junit", self.path("merged.xml"))
        self.assertEqual(Path(self.path("whole.xml")).read_text(encoding="utf-8"),
                         Path(self.path("merged.xml")).read_text(encoding="utf-8"))


class Names(CliTest):
    """A name of `mb4sim presets` in place of a file."""

    def mb4sim(self, *arguments):
        return subprocess.run([MB4SIM, *arguments], cwd=self.folder.name, capture_output=True, text=True, timeout=60,
                              check=False)

    def test_every_preset_runs_by_its_name(self):
        for preset in json.loads(run("presets", "--json").stdout):
            with self.subTest(preset["preset"]):
                self.path("same.toml", run("presets", preset["preset"]).stdout)
                by_name = self.mb4sim("run", preset["preset"], "--frames", "2")
                self.assertEqual((by_name.returncode, by_name.stderr), (0, ""))
                self.assertEqual(by_name.stdout, self.mb4sim("run", "same.toml", "--frames", "2").stdout)

    def test_a_file_of_the_name_wins(self):
        self.path("resolute-26", slave("data_bits = 12\ndata = 0x7F"))
        self.assertIn("0x07F", self.mb4sim("run", "resolute-26", "--frames", "1").stdout)

    def test_a_name_that_is_nearly_one(self):
        self.assert_one_line(self.mb4sim("run", "resolut-26"), 2,
                             "^mb4sim: resolut-26: there is no such file, .* did you mean 'resolute-26'")
        self.assert_one_line(self.mb4sim("run", "resolute-26.toml"), 2, "resolute-26.toml: cannot read: No such file")

    def test_check_tells_of_every_file(self):
        good, bad = self.path("good.toml", slave("data_bits = 8")), self.path("bad.toml", "x = 1\n")
        result = run("check", good, bad, good)
        self.assert_one_line(result, 2, r"bad\.toml:1:1: key 'x': unknown key")
        self.assertEqual(result.stdout, f"{good}: ok\n" * 2)


if __name__ == "__main__":
    unittest.main(argv=["cli_terminal_test.py"])
