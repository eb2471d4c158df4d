# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The commands with the master biss_clb. Positions are those of the scenario, MA and delays those of its keys.

  cli_clb_test.py MB4SIM EXAMPLES
"""

import json
import re
import sys
import unittest
from pathlib import Path

from cli import MasterTest, run

HEAD = '[master]\ntype = "clb"\n'
EXAMPLES = Path(sys.argv[2]) / "clb"


def encoder(slave="", *, keys="", bits=20, crc="0x43"):
    return (f'[[channel]]\nnumber = 1\n{keys}[[channel.slave]]\nprotocol = "biss-c"\ncrc = {crc}\n'
            f"data_bits = {bits}\n{slave}")


def ramp(start, step=1):
    return f'source = "ramp"\nstart = {start}\nstep = {step}\n'


def remainder(word, bits, polynomial, start=0):
    """Of the CRC over the bits, highest first; not inverted."""
    width = polynomial.bit_length() - 1
    rest = start
    for place in range(bits - 1, -1, -1):
        top = (rest >> (width - 1) ^ word >> place) & 1
        rest = (rest << 1) & ((1 << width) - 1) ^ (polynomial & ((1 << width) - 1) if top else 0)
    return rest


class Clb(MasterTest):
    HEAD = HEAD
    NAME = "clb.toml"

    def test_run_reads_any_length_and_crc(self):
        for bits, polynomial, start in ((3, 0x43, 0), (14, 0x43, 5), (34, 0x25, 3), (64, 0x190D9, 0x1234)):
            word = 0x65C3_9687_1E2D_4B59 >> (64 - bits)
            keys = f"data = {word}\ncrc_start = {start}\n"
            status, got = self.frames(
                self.path(encoder(keys, bits=bits, crc=hex(polynomial), keys="cable_m = 20.0\n")), "--frames", "2")
            for row in got["frames"]:
                self.assertEqual(
                    (status, row["position"], row["nE"], row["nW"], row["crc"]),
                    (0, word >> 2, word >> 1 & 1, word & 1, f"0x{remainder(word, bits, polynomial, start):02X}"))

    def test_frames_begin_as_the_scenario_asks(self):
        cable = "cable_m = 10.0\n"
        for master in ("clb", "axi"):
            text = encoder(ramp(7), keys=cable) + "[host]\nma_hz = 5_000_000\nframe_us = {}\n"
            path = self.folder / "frames.toml"
            times = {}
            for period in (100, 1000):
                path.write_text(f'[master]\ntype = "{master}"\n[chip]\nf_clk_hz = 200_000_000\n' + text.format(period),
                                encoding="utf-8")
                status, got = self.frames(str(path), "--frames", "4")
                self.assertEqual((status, [row["position"] for row in got["frames"]]), (0, [7, 8, 9, 10]))
                times[period] = [row["time_us"] for row in got["frames"]]
            for period, seen in times.items():
                for before, after in zip(seen, seen[1:]):
                    self.assertAlmostEqual(after - before, period, delta=0.3)
        result = run("run", self.path(encoder() + "[host]\nframe_us = 0\n"))
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, "key 'frame_us'")

    def test_frequency_of_ma_is_the_nearest_or_at_most_10_mhz(self):
        # Half a period in clocks: the clock by twice the frequency, rounded.
        for clk, hz, half in ((200_000_000, 5_000_000, 20), (200_000_000, 8_000_000, 13), (200_000_000, None, 10),
                              (150_000_000, None, 8), (40_000_000, None, 4), (100_000_000, 1_000_000, 50)):
            scenario = self.path(f"[chip]\nf_clk_hz = {clk}\n" + (f"[host]\nma_hz = {hz}\n" if hz else "") + encoder())
            got = json.loads(run("regs", scenario, "--json").stdout)
            values = {field["name"]: field["value"] for field in got["fields"]}
            self.assertEqual([values[name] for name in ("MA_MATCH1", "MA_MATCH2", "RECEIVE_MATCH1", "RECEIVE_MATCH2")],
                             [half - 1, 2 * half - 1] * 2, clk)
        for hz in (20_000, 60_000_000):
            result = run("run", self.path(f"[host]\nma_hz = {hz}\n" + encoder()))
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertRegex(result.stderr, rf"key 'ma_hz': the master cannot make {hz} Hz .* 4 to 2048 clocks \(in \[host\]\)\n$")

    def test_bad_frames_say_what_was_wrong(self):
        cases = (('kind = "bit-flip"\nchannel = 1\nbits = [5]\n', "CRC error"),
                 ('kind = "silent"\nslave = 1\nfor_us = 500\n', "no start bit"))
        for keys, state in cases:
            scenario = self.path(encoder(ramp(5)) + f"[[fault]]\nat_us = 0\n{keys}")
            with self.subTest(keys):
                result = run("run", scenario, "--frames", "1")
                self.assertEqual((result.returncode, result.stderr), (1, ""))
                self.assertRegex(result.stdout, rf"1 +[\d.]+ +1 +- +- +- +- +- +{state}\n")

    def test_bus_log_holds_the_accesses_of_the_calls(self):
        log = self.folder / "bus.log"
        result = run("run", self.path(encoder()), "--frames", "1", "--bus-log", str(log))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        lines = log.read_text(encoding="utf-8").splitlines()
        # R0 = X + 10, SPI clocks = 12 x words, MA started last.
        self.assertIn("write B0 0000001C", lines)
        self.assertIn("write 98 00000024", lines)
        start = lines.index("write C0 00000081")
        self.assertEqual(lines[start - 1:start + 2], ["write 00 00000009", "write C0 00000081", "write 40 00000001"])

    def test_regs_names_the_fields(self):
        got = json.loads(run("regs", self.path(encoder("data = 0x37\n")), "--frames", "1", "--json").stdout)
        values = {field["name"]: field["value"] for field in got["fields"]}
        self.assertEqual({name: values[name] for name in ("R0", "SPI_COUNT_MATCH1", "FRAME_STATE", "WATCHDOG")},
                         {"R0": 28, "SPI_COUNT_MATCH1": 36, "FRAME_STATE": 3, "WATCHDOG": 4096})
        self.assertEqual(got["registers"][0x200 // 4], 0x454E4304)

    def test_sweep_takes_codes_of_ma_match1(self):
        result = run("sweep", self.path(encoder()), "--delays", "0,400", "--jitters", "0,20", "--freqs", "9,99",
                     "--frames", "3", "--csv", str(self.folder / "s.csv"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("MA_MATCH1 0x09: MA 10000 kHz, T_MA 100 ns", result.stdout)
        self.assertIn("words 24, flagged 0, wrong but delivered 0", result.stdout)
        lines = (self.folder / "s.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[1], "9,10000000,0,0,3,0,0")
        self.assertRegex(run("sweep", self.path(encoder()), "--freqs", "2").stderr, "--freqs: .*MA_MATCH1 2$")

    def test_plot_and_regress(self):
        scenario = self.path(encoder(ramp(0)))
        result = run("plot", scenario)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("Frame 1 of channel 1", result.stdout)
        result = run("regress", scenario, "--seeds", "2", "--frames", "5", "--jobs", "1")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("runs 2, failed 0", result.stdout)

    def test_trace_writes_a_waveform_and_its_view(self):
        scenario = self.path(encoder(ramp(3)) + "[host]\nframe_us = 50\n")
        wave = self.folder / "a.fst"
        result = run("run", scenario, "--frames", "3", "--trace", str(wave))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout, run("run", scenario, "--frames", "3").stdout)
        self.assertGreater(wave.stat().st_size, 1000)
        view = (self.folder / "a.gtkw").read_text(encoding="utf-8")
        for name in ("ma_o", "sl_i", "encoder_ma", "encoder_slo", "irq_o", "u_frame.count_q[15:0]",
                     "u_regs.cfg_q.ma.match1[11:0]"):
            self.assertIn(f"\nmb4sim.biss_clb.{name}\n", view)
        self.assertIn("\n@100000028\nmb4sim.biss_clb.u_frame.u_state.state_q[1:0]\n", view)

    def test_what_the_master_does_not_take_names_the_key(self):
        cases = (("", "channel", "there is no slave"),
                 (encoder("flag_bits = 0\n"), "flag_bits", "2 flags"),
                 (encoder(crc="0"), "crc", "with a CRC only"),
                 (encoder().replace("biss-c", "ssi").replace("crc = 0x43\n", ""), "protocol", "BiSS C only"),
                 (encoder() + encoder().replace("number = 1", "number = 2"), "number", ""),
                 ("[chip.quirks]\nEXTRA = 1\n" + encoder(), "EXTRA", ""))
        for text, key, message in cases:
            scenario = self.path(text)
            for command in ("run", "plot", "sweep", "regress", "regs"):
                result = run(command, scenario)
                with self.subTest(command=command, text=text):
                    self.assertEqual((result.returncode, result.stdout), (2, ""))
                    self.assertRegex(result.stderr,
                                     rf"^mb4sim: {re.escape(scenario)}(:\d+:\d+)?: key '{key}': .*{message}.*\n$")
        stands = self.path("[chip]\nf_clk_hz = 0\n" + encoder())
        self.assertRegex(run("regs", stands, "--reset").stderr, "^mb4sim: the master does not answer at 0x000")

    def test_examples_are_read(self):
        for name, positions in (("reference-frame", [0x0E08] * 10),
                                ("lika-hs58s18", [100_000 + 25 * n for n in range(10)]),
                                ("lika-eh036-20-12", [0x7FF_FFF00 + 0x40 * n & 0xFFFF_FFFF for n in range(10)]),
                                ("ic-mhm", [0x123_4F00 + 0x20 * n for n in range(10)])):
            status, got = self.frames(str(EXAMPLES / f"{name}.toml"), "--frames", "10")
            self.assertEqual((status, [row["position"] for row in got["frames"]]), (0, positions), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
