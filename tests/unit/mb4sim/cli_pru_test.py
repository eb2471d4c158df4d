# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The commands with the master biss_pru. Positions are those of the scenario, delays those of its keys.

  cli_pru_test.py MB4SIM EXAMPLES
"""

import json
import re
import sys
import unittest
from pathlib import Path

from cli import MasterTest, run

HEAD = '[master]\ntype = "pru"\n'
EXAMPLES = Path(sys.argv[2]) / "pru"
# TIDEP0022, Table 10: line delays; row 9 prints none.
TABLE_10 = [1, 1, 1, 1, 2, 1, 1, 2, None, 3, 1, 3, 3, 4]


def encoder(slave="", *, keys="", bits=14, crc="0x43"):
    return (f'[[channel]]\nnumber = 1\n{keys}[[channel.slave]]\nprotocol = "biss-c"\ncrc = {crc}\n'
            f"data_bits = {bits}\n{slave}")


def ramp(start, step=1):
    return f'source = "ramp"\nstart = {start}\nstep = {step}\n'


def remainder(word, bits):
    """Of x^6 + x + 1 over the bits, highest first; not inverted."""
    rest = 0
    for place in range(bits - 1, -1, -1):
        top = (rest >> 5 ^ word >> place) & 1
        rest = (rest << 1 & 0x3F) ^ (3 if top else 0)
    return rest


class Pru(MasterTest):
    HEAD = HEAD
    NAME = "pru.toml"

    def test_run_reads_any_length_with_and_without_crc(self):
        for clk in (80_000_000, 200_000_000):
            for bits, flags, crc in ((3, 2, True), (14, 2, True), (57, 2, True), (20, 2, False), (12, 0, True),
                                     (13, 1, True), (63, 2, False)):
                word = 0x65C3_9687_1E2D_4B59 >> (64 - bits)
                text = encoder(f"data = {word}\nflag_bits = {flags}\n", bits=bits, crc="0x43" if crc else "0",
                               keys="cable_m = 20.0\n")
                status, got = self.frames(self.path(f"[chip]\nf_clk_hz = {clk}\n" + text), "--frames", "2")
                for row in got["frames"]:
                    with self.subTest(clk=clk, bits=bits, flags=flags, crc=crc):
                        self.assertEqual((status, row["position"]), (0, word >> flags))
                        self.assertEqual(row["crc"], f"0x{remainder(word, bits):02X}" if crc else None)
                        self.assertEqual(row["nE"], word >> flags - 1 & 1 if flags else None)
                        self.assertEqual(row["nW"], word & 1 if flags == 2 else None)

    def test_columns_tell_line_delay_and_processing_time(self):
        keys = "delay_ns = 1_150\n"
        for mhz, line in ((1, 2), (2, 3), (5, 6), (10, 12 + 2)):
            text = f"[host]\nma_hz = {mhz}_000_000\n" + encoder("busy_periods = 7\n", keys=keys)
            status, got = self.frames(self.path(text), "--frames", "6")
            self.assertEqual(status, 0)
            for row in got["frames"]:
                self.assertEqual((row["line_delay"], row["processing"]), (line, 7), mhz)
        quirk = "[chip.quirks]\nEXTRA_10 = false\n"
        _, got = self.frames(self.path(quirk + encoder(keys=keys)), "--frames", "1")
        self.assertEqual(got["frames"][0]["line_delay"], 12)

    def test_frames_come_with_the_timer(self):
        for period in (100, 250, 83_886):
            text = f"[host]\nma_hz = 5_000_000\nframe_us = {period}\n" + encoder(ramp(7))
            status, got = self.frames(self.path(text), "--frames", "4")
            # The first frame of the encoder is that of RUN.
            self.assertEqual((status, [row["position"] for row in got["frames"]]), (0, [8, 9, 10, 11]))
            times = [row["time_us"] for row in got["frames"]]
            for before, after in zip(times, times[1:]):
                self.assertAlmostEqual(after - before, period, delta=0.05)
        for clk, most in ((200_000_000, 83886), (80_000_000, 209715)):
            result = run("run", self.path(f"[chip]\nf_clk_hz = {clk}\n[host]\nframe_us = {most + 1}\n" + encoder()))
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertRegex(result.stderr, f"key 'frame_us': the longest period of frames is {most} us")

    def test_bad_frames_say_what_was_wrong(self):
        # What the frame of RUN meets is none of the session's frames.
        cases = (('kind = "bit-flip"\nchannel = 1\nbits = [5]\nat_us = 150\n', "CRC error"),
                 ('kind = "silent"\nslave = 1\nat_us = 120\nfor_us = 100\n', "no acknowledge, or SLO was 0 at the start"))
        for keys, state in cases:
            result = run("run", self.path("[host]\nma_hz = 5_000_000\n" + encoder(ramp(5)) + f"[[fault]]\n{keys}"),
                         "--frames", "3")
            with self.subTest(keys):
                self.assertEqual((result.returncode, result.stderr), (1, ""))
                self.assertRegex(result.stdout, rf" 1 +- +- +- +- +- +\d+ +\d+ +{state}\n")
        late = self.path("[host]\nma_hz = 1_000_000\n" + encoder("busy_periods = 41\n"))
        self.assertRegex(run("run", late, "--frames", "1").stdout, r" 1 +41 +no start bit\n")

    def test_regs_names_the_fields(self):
        got = json.loads(run("regs", self.path("[host]\nma_hz = 2_000_000\n" + encoder("data = 0x37\n")), "--frames",
                             "1", "--json").stdout)
        values = {field["name"]: field["value"] for field in got["fields"]}
        self.assertEqual({name: values[name] for name in ("DATA_LENGTH", "CRC_ERR_WAR", "FREQUENCY", "POS_LO", "NE",
                                                          "NW", "RUN", "FRAME_COUNT", "CLOCK_80")},
                         {"DATA_LENGTH": 12, "CRC_ERR_WAR": 8, "FREQUENCY": 2, "POS_LO": 0x37 >> 2, "NE": 1, "NW": 1,
                          "RUN": 1, "FRAME_COUNT": 2, "CLOCK_80": 0})
        self.assertEqual(got["registers"][0x200 // 4], 0x454E4303)

    def test_sweep_takes_codes_of_frequency(self):
        result = run("sweep", self.path(encoder()), "--delays", "0,400", "--jitters", "0,10", "--freqs", "1,10",
                     "--frames", "3", "--csv", str(self.folder / "s.csv"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("FREQUENCY 0x0A: MA 10000 kHz, T_MA 100 ns", result.stdout)
        self.assertIn("words 24, flagged 0, wrong but delivered 0", result.stdout)
        lines = (self.folder / "s.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[1], "1,1000000,0,0,3,0,0")
        self.assertRegex(run("sweep", self.path(encoder()), "--freqs", "3").stderr, "--freqs: FREQUENCY .* not 3$")

    def test_plot_and_regress(self):
        scenario = self.path(encoder(ramp(0)))
        result = run("plot", scenario)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("Frame 1 of channel 1", result.stdout)
        result = run("regress", scenario, "--seeds", "2", "--frames", "5", "--jobs", "1")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("runs 2, failed 0", result.stdout)

    def test_regress_finds_the_faults_of_a_line(self):
        faults = "".join(f'[[fault]]\nkind = "bit-flip"\nchannel = 1\nframe = {frame}\nbits = [{bit}]\n'
                         for frame, bit in ((1, 4), (3, 9), (4, 2)))
        result = run("regress", self.path("[host]\nma_hz = 5_000_000\n" + encoder(ramp(0)) + faults), "--seeds", "1",
                     "--frames", "8", "--jobs", "1")
        # The first one meets the frame of RUN, which is no row.
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        self.assertRegex(result.stdout, r" 1 +6 +2 +3 +0 +CRC error\n")

    def test_trace_writes_a_waveform_and_its_view(self):
        scenario = self.path(encoder(ramp(3)))
        wave = self.folder / "a.fst"
        result = run("run", scenario, "--frames", "3", "--trace", str(wave))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout, run("run", scenario, "--frames", "3").stdout)
        self.assertGreater(wave.stat().st_size, 1000)
        view = (self.folder / "a.gtkw").read_text(encoding="utf-8")
        for name in ("trigger_i", "ma_o", "sl_i", "encoder_ma", "encoder_slo", "irq_o", "u_pace.count_q[15:0]",
                     "u_regs.cfg_q.data_length[7:0]"):
            self.assertIn(f"\nmb4sim.pru_core.{name}\n", view)

    def test_what_the_master_does_not_take_names_the_key(self):
        cases = (("", "channel", "there is no slave"),
                 (encoder("flag_bits = 3\n"), "flag_bits", "2 flags at most"),
                 (encoder("flag_bits = 2\n", bits=2), "data_bits", "at least one bit"),
                 (encoder(bits=58), "data_bits", "63 bits at most"),
                 (encoder(crc="0x25"), "crc", "0x43 only"),
                 (encoder("crc_start = 1\n"), "crc_start", "starts with 0"),
                 (encoder().replace("biss-c", "ssi").replace("crc = 0x43\n", ""), "protocol", "BiSS C only"),
                 (encoder() + encoder().replace("number = 1", "number = 2"), "number", ""),
                 ("[chip]\nf_clk_hz = 100_000_000\n" + encoder(), "f_clk_hz", "80000000 and 200000000"),
                 ("[chip]\nf_clk_hz = 0\n" + encoder(), "f_clk_hz", ""),
                 ("[host]\nma_hz = 8_000_000\n" + encoder(), "ma_hz", "1, 2, 5 and 10 MHz"),
                 ("[host]\ninterface = \"spi\"\n" + encoder(), "interface", ""),
                 ("[chip.quirks]\nEXTRA = true\n" + encoder(), "EXTRA", ""))
        for text, key, message in cases:
            scenario = self.path(text)
            for command in ("run", "plot", "sweep", "regress", "regs"):
                result = run(command, scenario)
                with self.subTest(command=command, text=text):
                    self.assertEqual((result.returncode, result.stdout), (2, ""))
                    self.assertRegex(result.stderr,
                                     rf"^mb4sim: {re.escape(scenario)}(:\d+:\d+)?: key '{key}': .*{message}.*\n$")

    def test_examples_are_read(self):
        for number, delay in enumerate(TABLE_10, 1):
            status, got = self.frames(str(EXAMPLES / f"table10-{number:02}.toml"), "--frames", "10")
            self.assertEqual((status, [row["position"] for row in got["frames"]]), (0, [7 * n for n in range(1, 11)]))
            self.assertEqual({row["line_delay"] for row in got["frames"]}, {2 if delay is None else delay}, number)
        status, got = self.frames(str(EXAMPLES / "metres-100.toml"), "--frames", "10")
        self.assertEqual((status, [row["position"] for row in got["frames"]]), (0, [1000 + 11 * n for n in range(1, 11)]))
        # 2 x (100 m x 5.3 ns + 20 ns) and up to 10 ns are 11 periods begun, and two more are shown.
        self.assertEqual({(row["line_delay"], row["processing"]) for row in got["frames"]} <= {(13, 3), (14, 3)}, True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
