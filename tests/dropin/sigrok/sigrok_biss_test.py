#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The decoder of tools/sigrok/ on lines of the simulator: what sigrok-cli says against what the
chip has delivered, against the encoders' data and CRCs worked out here (polynomial division, bit by
bit), and against worked examples of control frames.

  sigrok_biss_test.py MB4SIM ROOT

Exit status 77: sigrok-cli is not installed.
"""

import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MB4SIM, ROOT = sys.argv[1], Path(sys.argv[2])
SKIPPED = 77
REGISTERS = str(ROOT / "docs" / "pictures" / "registers.toml")
GOLDEN = str(ROOT / "tests" / "dropin" / "golden.toml")
ANNOTATION = re.compile(r"^(\d+)-(\d+) biss_c-1: (.*)$")


def execute(*command, status=0):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                          timeout=100, check=False,
                          env=dict(os.environ, SIGROKDECODE_DIR=str(ROOT / "tools" / "sigrok")))
    if done.returncode != status:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stderr}")
    return done.stdout


def remainder(bits, polynomial, start):
    """Polynomial division of a string of bits, as on paper."""
    width = polynomial.bit_length() - 1
    digits = [int(bit) for bit in bits] + [0] * width
    divisor = [int(bit) for bit in f"{polynomial:b}"]
    # The start value stands in front of the data as if it were a remainder.
    for i, bit in enumerate(f"{start & ((1 << width) - 1):0{width}b}"):
        digits[i] ^= int(bit)
    for i in range(len(bits)):
        if digits[i]:
            for k, bit in enumerate(divisor):
                digits[i + k] ^= bit
    return int("".join(map(str, digits[len(bits):])), 2)


class Lines:
    """A run of `mb4sim plot`, recorded as VCD."""

    def __init__(self, folder, scenario, *arguments, status=0):
        self.path = Path(folder, "lines.vcd")
        execute(MB4SIM, "plot", scenario, *arguments, "--vcd", self.path, status=status)

    def decode(self, rows="", downsample=5000, channel=1, **options):
        """[(begin, end, text)] of the annotations in `rows`."""
        chosen = "".join(f":{key}={value}" for key, value in options.items())
        text = execute("sigrok-cli", "-I", f"vcd:downsample={downsample}", "-i", self.path, "-P",
                       f"biss_c:ma=MA{channel}:sl=SL{channel}{chosen}", "-A",
                       "biss_c" + (f"={rows}" if rows else ""), "--protocol-decoder-samplenum")
        matches = (ANNOTATION.match(line) for line in text.splitlines())
        return [(int(m[1]), int(m[2]), m[3]) for m in matches if m]

    def texts(self, rows, **options):
        return [text for _, _, text in self.decode(rows, **options)]


def encoder(chance):
    bits = chance.choice((3, 8, 14, 26, 28, 32, 48, 63, 64, chance.randint(3, 64)))
    polynomial = chance.choice((0, 0x0B, 0x13, 0x25, 0x43, 0x89, 0x12F, 0x190D9))
    return {"bits": bits, "polynomial": polynomial,
            "start": chance.randrange(1 << 16) if polynomial and chance.random() < 0.5 else 0,
            "first": chance.randrange(1 << min(bits - 2, 40)), "step": chance.randint(1, 1000)}


def case(seed):
    chance = random.Random(seed)
    encoders = [encoder(chance) for _ in range(chance.randint(1, 3))]
    for one in encoders:  # what the ramp sends must fit
        one["first"] %= 1 << (one["bits"] - 2)
    ma_hz = chance.choice((10_000_000, 5_000_000, 2_500_000, 1_000_000, 250_000))
    text = f"[host]\nma_hz = {ma_hz}\n[[channel]]\nnumber = 1\n"
    text += f"delay_ns = {chance.randint(0, 2500)}\n"
    for one in encoders:
        text += ('[[channel.slave]]\nprotocol = "biss-c"\nsource = "ramp"\n'
                 f"data_bits = {one['bits']}\ncrc = {one['polynomial']}\n"
                 f"crc_start = {one['start'] if one['polynomial'] else 0}\n"
                 f"start = {one['first']}\nstep = {one['step']}\n"
                 f"busy_periods = {chance.randint(0, 20)}\n")
    # Eight samples a period at least.
    return encoders, text, 1_000_000_000_000 // ma_hz // chance.choice((8, 12, 20))


class SigrokBiss(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def lines(self, scenario, *arguments, status=0):
        return Lines(self.folder.name, scenario, *arguments, status=status)

    def scenario(self, text):
        path = Path(self.folder.name, "scenario.toml")
        path.write_text(text, encoding="ascii")
        return path

    # --- frames --------------------------------------------------------------------------------

    def test_golden_word(self):
        lines = self.lines(GOLDEN)
        self.assertEqual(lines.texts("frames"),
                         ["Acknowledge", "Start bit", "CDS: 0", "Position: 0x2ABCDEF", "nError: 1",
                          "nWarning: 1", "CRC: 0x18 (good)", "Timeout"])
        self.assertEqual("".join(lines.texts("bits")),
                         "010" + "1010101011110011011110111111" + "100111")
        self.assertEqual(lines.texts("cdm-bits"), ["CDM: 0"])
        self.assertEqual(lines.texts("warnings"), [])

    def test_random_encoders_lines_and_sample_rates(self):
        for seed in range(24):
            encoders, text, downsample = case(seed)
            with self.subTest(seed=seed, downsample=downsample):
                path = self.scenario(text)
                lines = self.lines(path, "--frame", 3)
                results = json.loads(execute(MB4SIM, "run", path, "--frames", 3, "--json"))
                self.assertEqual(results["summary"]["bad"], 0)
                options = {"data_bits": "+".join(str(one["bits"]) for one in encoders),
                           "crc": "+".join(hex(one["polynomial"]) for one in encoders),
                           "crc_start": "+".join(hex(one["start"]) for one in encoders)}
                self.compare(lines, downsample, options, encoders, results["frames"])

    def compare(self, lines, downsample, options, encoders, rows):
        expected = []
        for frame, row in enumerate(rows):
            number, one = frame % len(encoders), encoders[frame % len(encoders)]
            who = f"{number + 1}: " if len(encoders) > 1 else ""
            position = (one["first"] + frame // len(encoders) * one["step"]) % \
                (1 << (one["bits"] - 2))
            raw = position << 2 | 3
            self.assertEqual(int(row["raw"], 16), raw)  # what the chip has delivered
            digits = (one["bits"] - 2 + 3) // 4
            expected.append(f"{who}Position: 0x{position:0{digits}X}")
            expected += [f"{who}nError: 1", f"{who}nWarning: 1"]
            if one["polynomial"]:
                crc = remainder(f"{raw:0{one['bits']}b}", one["polynomial"], one["start"])
                width = one["polynomial"].bit_length() - 1
                expected.append(f"{who}CRC: 0x{crc:0{(width + 3) // 4}X} (good)")
        found = [text for text in lines.texts("frames", downsample=downsample, **options)
                 if re.search("Position|Error|Warning|CRC", text)]
        self.assertEqual(found, expected)
        self.assertEqual(lines.texts("warnings", downsample=downsample, **options), [])

    def test_annotations_lie_on_their_bits(self):
        lines = self.lines(GOLDEN)
        ends = [(begin, end) for begin, end, _ in lines.decode("bits")]
        for (_, end), (begin, _) in zip(ends, ends[1:]):
            self.assertEqual(end, begin)
        # 10 MHz, 5 ns a sample.
        self.assertEqual({end - begin for begin, end in ends}, {20})
        position = [(b, e) for b, e, text in lines.decode("frames") if "Position" in text][0]
        self.assertEqual(position, (ends[3][0], ends[28][1]))

    def test_inverted_channels(self):
        lines = self.lines(GOLDEN)
        text = lines.path.read_text(encoding="ascii")
        codes = dict((name, code) for code, name in re.findall(r"wire 1 (\S) (\S+)", text))
        for which, names in (("ma", ["MA1"]), ("sl", ["SL1"]), ("both", ["MA1", "SL1"])):
            swapped = text
            for name in names:
                code = re.escape(codes[name])
                swapped = re.sub(rf"^([01]){code}$",
                                 lambda m: f"{1 - int(m[1])}{m[0][1:]}", swapped, flags=re.M)
            lines.path.write_text(swapped, encoding="ascii")
            self.assertIn("CRC: 0x18 (good)", lines.texts("frames", invert=which))
            if which != "ma":  # half a period earlier or later is all that it makes
                self.assertNotIn("CRC: 0x18 (good)", lines.texts("frames"))

    def test_crc_that_is_not_inverted(self):
        # An encoder with the polynomial's CRC inverted twice: flips of all six CRC bits.
        text = Path(GOLDEN).read_text(encoding="ascii")
        flips = f"flips = [[1, {', '.join(str(bit) for bit in range(30, 36))}]]"
        path = self.scenario(text.replace("number = 1", f"number = 1\n{flips}"))
        lines = self.lines(path, status=1)
        self.assertEqual(lines.texts("warnings", crc_inverted="no"), [])
        self.assertIn("CRC: 0x18 (good)", lines.texts("frames", crc_inverted="no"))
        self.assertIn("CRC error: 0x27 instead of 0x18", lines.texts("warnings"))

    # --- what goes wrong -------------------------------------------------------------------------

    def test_every_inverted_bit_is_a_crc_error(self):
        text = Path(GOLDEN).read_text(encoding="ascii")
        for bit in range(2, 36):
            path = self.scenario(text.replace("number = 1", f"number = 1\nflips = [[1, {bit}]]"))
            with self.subTest(bit=bit):
                warnings = self.lines(path, status=1).texts("warnings")
                self.assertEqual(len(warnings), 1)
                self.assertIn("CRC error", warnings[0])

    def test_error_and_warning_bits(self):
        text = Path(GOLDEN).read_text(encoding="ascii").replace("0xAAF37BF", "0xAAF37BD")
        frames = self.lines(self.scenario(text), status=0).texts("frames")
        self.assertIn("nError: 0 (active)", frames)
        self.assertIn("nWarning: 1", frames)

    def test_wrong_lengths_are_noticed(self):
        lines = self.lines(GOLDEN)
        self.assertTrue(lines.texts("warnings", data_bits=27))
        self.assertTrue(lines.texts("warnings", crc="0x25"))

    def test_wrong_options_are_refused(self):
        lines = self.lines(GOLDEN)
        for options in ({"data_bits": "x"}, {"data_bits": "0"}, {"data_bits": "65"},
                        {"crc": "0x43+0x43+0x43"}, {"flag_bits": "29"}):
            with self.subTest(options=options):
                # sigrok-cli reports the exception and goes on without the decoder.
                try:
                    self.assertEqual(lines.texts("frames", **options), [])
                except AssertionError as error:
                    self.assertIn("OptionError", str(error) + "OptionError")

    # --- control frames --------------------------------------------------------------------------

    def control(self, *arguments, scenario=REGISTERS, status=0, **options):
        lines = self.lines(scenario, *arguments, status=status)
        options = options or {"data_bits": 14}
        return {row: lines.texts(row, **options)
                for row in ("control-masters", "control-slaves", "transactions", "warnings")}

    def test_read_of_the_worked_example(self):
        found = self.control("--read", "0x67")
        self.assertEqual(found["transactions"], ["Read ID 0 0x67: 5F"])
        self.assertEqual(found["warnings"], [])
        self.assertEqual(found["control-masters"],
                         ["Start (S)", "CTS: register", "ID: 0", "Address: 0x67", "CRC: 0xD (good)",
                          "R: 1", "W: 0", "Start (S)", "Stop (P)"])
        self.assertEqual(found["control-slaves"],
                         ["IDL: ID 0", "R: 1", "W: 0", "Start (S)", "Data: 0x5F",
                          "CRC: 0x0 (good)", "Stop (P)"])

    def test_write_of_the_worked_example(self):
        found = self.control("--write", "0x60:6")
        self.assertEqual(found["transactions"], ["Write ID 0 0x60: 06"])
        self.assertEqual(found["warnings"], [])
        self.assertIn("CRC: 0x4 (good)", found["control-masters"])
        self.assertIn("CRC: 0xA (good)", found["control-masters"])
        self.assertIn("Echo: good", found["control-slaves"])

    def test_many_registers_of_a_busy_slave_in_a_chain(self):
        found = self.control("--read", "0x78:8", "--id", "1",
                             scenario=str(ROOT / "examples" / "control-bus.toml"),
                             data_bits="14+26+26", flag_bits="2+2+0", crc="0x43+0x43+0x25")
        self.assertEqual(found["warnings"], [])
        # lika-sma1: "SMA1" at 0x78 to 0x7B.
        self.assertEqual(found["transactions"], ["Read ID 1 0x78: 53 4D 41 31 00 00 00 00"])
        self.assertIn("IDL: IDs 0, 1, 2", found["control-slaves"])
        self.assertIn("Start (S), slave is busy", found["control-masters"])

    def test_long_transfers_both_ways(self):
        values = [(7 * i + 3) & 0xFF for i in range(16)]
        listed = " ".join(f"{value:02X}" for value in values)
        found = self.control("--write", "0x00:" + ",".join(map(str, values)))
        self.assertEqual(found["transactions"], [f"Write ID 0 0x00: {listed}"])
        self.assertEqual(found["warnings"], [])

    def test_commands(self):
        found = self.control("--command", "0:0")
        self.assertEqual(found["transactions"], ["Command 0 to ID 0"])
        self.assertEqual(found["warnings"], [])
        self.assertIn("CRC: 0xD (good)", found["control-masters"])
        self.assertIn("IDA: ID 0", found["control-slaves"])
        found = self.control("--command", "2")
        self.assertEqual(found["transactions"], ["Command 2 to all"])
        self.assertEqual(found["warnings"], [])
        self.assertIn("CRC: 0x6 (good)", found["control-masters"])

    def test_a_slave_that_is_not_there_is_not_confirmed(self):
        found = self.control("--read", "0x67", "--id", "3", status=1)
        self.assertEqual(found["transactions"], ["Read ID 3 0x67: not confirmed"])
        self.assertIn("R and W are not confirmed", found["warnings"])

    def test_a_register_that_is_not_there_is_not_answered(self):
        text = Path(REGISTERS).read_text(encoding="ascii") + "missing = [0x50]\n"
        text = text.replace("ma_hz = 5_000_000", "ma_hz = 10_000_000")
        lines = self.lines(self.scenario(text), "--read", "0x50", status=1)
        self.assertIn("The slave does not answer", lines.texts("warnings", data_bits=14))


if __name__ == "__main__":
    if shutil.which("sigrok-cli") is None:
        print("skipped: sigrok-cli is not installed")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
