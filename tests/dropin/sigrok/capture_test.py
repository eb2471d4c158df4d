#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Captures as a replay slave: what `mb4sim plot --vcd` wrote, and what sigrok made of it, gives the
words of the encoder again. A damaged capture gives one line of error and changes no file.

  capture_test.py MB4SIM

Exit status 77: sigrok-cli is not installed.
"""

import random
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

MB4SIM = sys.argv[1]
SAMPLE_PS = 5000
FRAMES = 6
RAMP = """[host]
ma_hz = 2_500_000
[[channel]]
number = 1
delay_ns = 330.0
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
source = "ramp"
start = 4711
step = 1001
busy_periods = 3
control = true
registers = { 0x67 = 0x5F }
"""
POSITIONS = [4711 + 1001 * i for i in range(FRAMES)]
REPLAY = """[host]
ma_hz = {ma_hz}
[[channel]]
number = 1
[[channel.slave]]
protocol = "replay"
data_bits = 28
ma = "MA1"
sl = "{sl}"
"""


def run(*command):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=120)


class Captures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = Path(cls.folder.name)
        (cls.work / "ramp.toml").write_text(RAMP)
        cls.plot(["--frame", str(FRAMES)], "line")
        cls.plot(["--read", "0x67"], "access")
        vcd = ["sigrok-cli", "-I", f"vcd:downsample={SAMPLE_PS}", "-i", cls.work / "line.vcd"]
        for output in (["-o", cls.work / "line.sr"],
                       ["-O", "csv", "-o", cls.work / "late.csv"]):
            made = run(*vcd, *output)
            assert made.returncode == 0, made.stderr
        for name, options in (("samples", ""), ("times", ":time=true"), ("changes", ":time=true:dedup=true")):
            made = run("sigrok-cli", "-i", cls.work / "line.sr", "-O", f"csv{options}", "-o",
                       cls.work / f"{name}.csv")
            assert made.returncode == 0, made.stderr
        with zipfile.ZipFile(cls.work / "line.sr") as packed, \
                zipfile.ZipFile(cls.work / "stored.sr", "w") as stored:
            for name in packed.namelist():
                stored.writestr(name, packed.read(name))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def plot(cls, options, name):
        made = run(MB4SIM, "plot", cls.work / "ramp.toml", *options, "--vcd", cls.work / f"{name}.vcd")
        assert made.returncode == 0, made.stderr

    def replay(self, capture, more="", ma_hz=2_500_000, frames=FRAMES, sl="SL1", options=()):
        scenario = self.work / "replay.toml"
        scenario.write_text(REPLAY.format(ma_hz=ma_hz, sl=sl) + f'capture = "{capture}"\n{more}')
        return run(MB4SIM, "run", scenario, "--frames", frames, *options)

    def positions(self, *arguments, **keys):
        done = self.replay(*arguments, **keys)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return [int(line.split()[4]) for line in done.stdout.splitlines()[1:-1]]

    def refused(self, expected, capture, more="", sl="SL1"):
        csv = self.work / "out.csv"
        csv.write_text("as before")
        done = self.replay(capture, more, sl=sl, options=("--csv", csv))
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(expected, done.stderr)
        self.assertEqual(csv.read_text(), "as before")

    def test_each_kind_gives_the_words_at_their_times(self):
        for name in ("line.vcd", "line.sr", "stored.sr", "samples.csv", "late.csv", "times.csv", "changes.csv"):
            self.assertEqual(self.positions(name), POSITIONS, name)

    def test_each_kind_gives_the_words_at_another_frequency(self):
        for name in ("line.vcd", "line.sr", "samples.csv"):
            # The timeout is longer than the delay in the recording.
            for ma_hz, timeout in ((10_000_000, "0.8"), (1_000_000, '"adaptive"')):
                more = f'play = "clock"\ntimeout = {timeout}\n'
                self.assertEqual(self.positions(name, more, ma_hz), POSITIONS, name)

    def test_frames_begin_again_after_the_last(self):
        self.assertEqual(self.positions("line.sr", frames=2 * FRAMES), POSITIONS * 2)

    def test_one_frame_alone(self):
        self.assertEqual(self.positions("line.vcd", "frame = 3\n"), [POSITIONS[2]] * FRAMES)
        self.refused("replay.toml:11:9: key 'frame': the capture has 6 frame(s)", "line.vcd", "frame = 7\n")

    def test_inverted_probes(self):
        text = (self.work / "samples.csv").read_text()
        flip = str.maketrans("01", "10")
        for which, columns in (("ma", {0}), ("sl", {2}), ("both", {0, 2})):
            lines = [",".join(cell.translate(flip) if i in columns else cell
                              for i, cell in enumerate(line.split(","))) if line[0] in "01" else line
                     for line in text.splitlines()]
            (self.work / "flipped.csv").write_text("\n".join(lines))
            self.assertEqual(self.positions("flipped.csv", f'invert = "{which}"\n'), POSITIONS)
        self.refused("expected 'SL1' to rest at 1 (key 'invert')", "line.vcd", 'invert = "sl"\n')

    def test_frames_of_an_access_have_both_levels_of_cdm(self):
        # Frames follow each other at once; MA rests at 0 after those with CDM = 1.
        frames = self.positions("access.vcd", 'play = "clock"\n', frames=40)
        self.assertEqual(frames, [4711 + 1001 * i for i in range(40)])

    def test_wrong_keys(self):
        self.refused("key 'edges': not together with 'capture'", "line.vcd", "edges = 'a'\n")
        self.refused("key 'rest_us'", "line.vcd", "rest_us = -1\n")
        self.refused("cannot read", "missing.vcd")
        scenario = self.work / "no_names.toml"
        scenario.write_text(REPLAY.replace('ma = "MA1"\n', "").format(ma_hz=2_500_000, sl="SL1")
                            + 'capture = "line.vcd"\n')
        self.assertIn("key 'ma': missing: the name of this signal in the capture",
                      run(MB4SIM, "run", scenario).stderr)
        self.refused("expected a capture with the ending .vcd, .sr or .csv", "replay.toml")
        self.refused("expected a signal 'SL9', the file has 'line.MA1', 'line.MO1', 'line.SL1'", "line.vcd",
                     sl="SL9")
        self.refused("expected a channel 'SL9', the file has 'MA1', 'MO1', 'SL1'", "line.sr", sl="SL9")

    def test_damaged_sr_is_one_line(self):
        good = (self.work / "line.sr").read_bytes()
        dice = random.Random(1)
        cases = [good[:dice.randrange(len(good))] for _ in range(15)]
        for _ in range(25):
            damaged = bytearray(good)
            damaged[dice.randrange(len(good))] ^= 1 << dice.randrange(8)
            cases.append(bytes(damaged))
        refused = 0
        for case in cases:
            (self.work / "bad.sr").write_bytes(case)
            done = self.replay("bad.sr")
            self.assertIn(done.returncode, (0, 2), done.stderr)
            if done.returncode == 2:
                refused += 1
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertRegex(done.stderr, r"bad\.sr: (byte|metadata)")
            else:  # a date or another number that does not count
                self.assertIn("good 6, bad 0", done.stdout)
        self.assertGreater(refused, 25)


if __name__ == "__main__":
    if shutil.which("sigrok-cli") is None:
        print("skipped: sigrok-cli is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
