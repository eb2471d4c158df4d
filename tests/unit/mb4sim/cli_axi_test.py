# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The commands with a master on AXI. Positions are those of the scenario, MA and delays those of its keys.

  cli_axi_test.py MB4SIM EXAMPLES
"""

import json
import re
import sys
import unittest
from pathlib import Path

from cli import MasterTest, run

HEAD = '[master]\ntype = "axi"\n[chip]\nf_clk_hz = 100_000_000\n'


def channel(number, *, keys="", slave="", bits=28):
    return (f'[[channel]]\nnumber = {number}\n{keys}[[channel.slave]]\nprotocol = "biss-c"\n'
            f"crc = 0x43\ndata_bits = {bits}\n{slave}")


def ramp(start, step=1):
    return f'source = "ramp"\nstart = {start}\nstep = {step}\n'


class Axi(MasterTest):
    HEAD = HEAD
    NAME = "axi.toml"

    def test_run_reads_all_channels_with_their_cables(self):
        scenario = self.path("".join(
            channel(c, keys=f"delay_ns = {100 * c}\n", slave=ramp(1000 * c, c)) for c in range(1, 7)))
        status, got = self.frames(scenario, "--frames", "4")
        self.assertEqual(status, 0)
        rows = [(row["slave"], row["position"], row["state"]) for row in got["frames"]]
        self.assertEqual(rows, [(c, 1000 * c + c * n, "ok") for n in range(4) for c in range(1, 7)])
        self.assertEqual(got["summary"]["good"], 24)

    def test_run_shows_position_flags_and_crc_of_one_encoder(self):
        for flags in range(4):
            word = 0x1234564 | flags
            rest = 0  # of the CRC x^6 + x + 1 over 28 bits, not inverted
            for bit in range(27, -1, -1):
                top = (rest >> 5 ^ word >> bit) & 1
                rest = rest << 1 & 0x3F ^ (3 if top else 0)
            status, got = self.frames(self.path(channel(1, slave=f"data = {word}\n")), "--frames", "1")
            row = got["frames"][0]
            self.assertEqual((status, row["position"], row["nE"], row["nW"], row["crc"]),
                             (0, word >> 2, flags >> 1, flags & 1, f"0x{rest:02X}"))

    def test_flags_of_several_encoders_are_told_only_where_they_are_known(self):
        good = channel(1, slave="data = 7\n")
        bad = channel(2, slave="data = 4\n")
        _, got = self.frames(self.path(good + channel(2, slave="data = 7\n")), "--frames", "1")
        self.assertEqual([(row["nE"], row["nW"]) for row in got["frames"]], [(1, 1), (1, 1)])
        _, got = self.frames(self.path(good + bad), "--frames", "1")
        self.assertEqual([(row["nE"], row["nW"]) for row in got["frames"]], [(None, None)] * 2)

    def test_fault_without_its_channel_tells_how_many_there_are(self):
        for count, told in ((2, "two"), (3, "3"), (16, "16")):
            scenario = self.path("".join(channel(c) for c in range(1, count + 1)) +
                                 '[[fault]]\nkind = "glitch"\nwidth_ns = 5\nat_us = 1\n')
            result = run("run", scenario)
            self.assertEqual(result.returncode, 2)
            self.assertTrue(result.stderr.endswith(f"key 'channel': missing: there are {told} (in [[fault]])\n"), result.stderr)

    def test_bad_frames_say_what_was_wrong(self):
        cases = (('kind = "bit-flip"\nchannel = 1\nbits = [5]\n', "CRC error"),
                 ('kind = "silent"\nslave = 1\nfor_us = 100\n', "no acknowledge, or SLO was 0 at the start"),
                 ('kind = "busy"\nslave = 1\nfor_us = 200\n', "no start bit"),
                 ('kind = "stuck"\nchannel = 1\nlevel = 0\nfor_us = 200\n',
                  "no acknowledge, or SLO was 0 at the start"))
        for keys, state in cases:
            scenario = self.path(channel(1, slave=ramp(5)) + channel(2, slave=ramp(9)) +
                                 f"[[fault]]\nat_us = 30\n{keys}")
            with self.subTest(keys):
                result = run("run", scenario, "--frames", "1")
                self.assertEqual((result.returncode, result.stderr), (1, ""))
                self.assertRegex(result.stdout, rf"1 +[\d.]+ +1 +- +- +- +- +- +{state}\n")
                self.assertRegex(result.stdout, r"1 +[\d.]+ +2 +0x0000009 +9 +1 +1 +0x.. +ok\n")

    def test_bus_log_holds_the_accesses(self):
        log = self.folder / "bus.log"
        result = run("run", self.path(channel(1)), "--frames", "1", "--bus-log", str(log))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        lines = log.read_text(encoding="utf-8").splitlines()
        for line in lines:
            self.assertRegex(line, "^(write|read) [0-9A-F]{2} [0-9A-F]{8}$")
        self.assertIn("write 14 00000005", lines)  # MA_DIVIDER: 100 MHz / 10
        self.assertIn("write 18 0000001A", lines)  # POSITION_BITS

    def test_regs_names_registers_and_channels(self):
        scenario = self.path(channel(1, keys="delay_ns = 35\n", slave="data = 0x37\n") +
                             channel(3, keys="delay_ns = 435\n", slave="data = 0x87\n"))
        got = json.loads(run("regs", scenario, "--frames", "1", "--json").stdout)
        values = {field["name"]: field["value"] for field in got["fields"]}
        expected = {"MA_DIVIDER": 5, "POSITION_BITS": 26, "CHANNEL_ENABLE": 0b101,
                    "SINGLE_POINT_VALID": 0b101, "SINGLE_POINT_DATA[0]": 0xD,
                    "SINGLE_POINT_DATA[2]": 0x21}
        self.assertEqual({name: values[name] for name in expected}, expected)
        self.assertAlmostEqual(values["LINE_DELAY[0]"], 3, delta=1)  # clocks of 10 ns
        self.assertAlmostEqual(values["LINE_DELAY[2]"], 43, delta=1)
        self.assertEqual(len(got["registers"]), 16)
        result = run("regs", scenario)
        self.assertRegex(result.stdout, r"(?m)^0x14  0x00000005  7:0    MA_DIVIDER = 0x05 +MA is ")
        got = json.loads(run("regs", scenario, "--reset", "--json").stdout)
        self.assertFalse(any(got["registers"]))

    def test_sweep_takes_codes_of_ma_divider(self):
        scenario = self.path(channel(1) + channel(2))
        result = run("sweep", scenario, "--delays", "0,400", "--jitters", "0,20", "--freqs", "5,50",
                     "--frames", "3", "--csv", str(self.folder / "s.csv"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("MA_DIVIDER 0x05: MA 10000 kHz, T_MA 100 ns", result.stdout)
        self.assertIn("words 48, flagged 0, wrong but delivered 0; jitter up to 25 %: all good",
                      result.stdout)
        lines = (self.folder / "s.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[0], "ma_divider,ma_hz,delay_ns,jitter_percent,words,flagged,wrong")
        self.assertEqual(lines[1], "5,10000000,0,0,6,0,0")
        self.assertEqual(len(lines), 9)
        for code in ("0", "7"):  # 0 Hz, no whole number
            result = run("sweep", scenario, "--freqs", code)
            self.assertEqual(result.returncode, 2, code)
            self.assertRegex(result.stderr, f"--freqs: .*MA_DIVIDER.* {code}$")

    def test_sweep_over_duty_distortion(self):
        scenario = self.path(channel(1))
        result = run("sweep", scenario, "--delays", "0,403", "--jitters", "0", "--skews=-65,0,20", "--frames", "4",
                     "--csv", str(self.folder / "s.csv"))
        self.assertEqual(result.returncode, 1)  # 65 % of a bit are too much
        self.assertIn("T_MA 100 ns, rising edges 65 % later; bad words", result.stdout)
        self.assertIn("T_MA 100 ns, no skew; bad words", result.stdout)
        self.assertIn("T_MA 100 ns, falling edges 20 % later; bad words", result.stdout)
        rows = [row.split(",") for row in (self.folder / "s.csv").read_text(encoding="utf-8").splitlines()]
        self.assertEqual(rows[0][:3], ["ma_divider", "ma_hz", "skew_percent"])
        self.assertEqual([row[2] for row in rows[1:]], ["-65", "-65", "0", "0", "20", "20"])
        self.assertTrue(all(int(row[6]) + int(row[7]) == 4 for row in rows[1:3]), rows)
        self.assertTrue(all(int(row[6]) + int(row[7]) == 0 for row in rows[3:]), rows)
        planes = json.loads(run("sweep", scenario, "--delays", "0", "--jitters", "0", "--skews", "20", "--json").stdout)
        self.assertEqual(planes["planes"][0]["skew_percent"], 20)
        # The scenario's own skew, and a picture of each plane.
        plain = json.loads(run("sweep", scenario, "--delays", "0", "--jitters", "0", "--json").stdout)
        self.assertNotIn("skew_percent", plain["planes"][0])
        picture = self.folder / "s.svg"
        run("sweep", scenario, "--delays", "0,100", "--jitters", "0,10", "--skews", "0,20", "--frames", "1", "--svg",
            str(picture))
        self.assertIn("falling edges 20 % later", picture.read_text(encoding="utf-8"))

    def test_run_and_regs_show_the_eye(self):
        text = "[master]\ntype = \"axi\"\n[chip]\nf_clk_hz = 100_000_000\nfeatures = \"frames\"\n"
        line = "[[channel]]\nnumber = {}\njitter_ns = {}\n[[channel.slave]]\npreset = \"resolute-26\"\nprotocol = \"biss-c\"\n"
        scenario = self.folder / "eye.toml"
        scenario.write_text(text + line.format(1, 0) + line.format(2, 50), encoding="utf-8")
        frames = json.loads(run("run", scenario, "--frames", "40", "--json").stdout)["frames"]
        eyes = {slave: [row["eye_percent"] for row in frames if row["slave"] == slave] for slave in (1, 2)}
        self.assertEqual(set(eyes[1]), {100})  # all edges at one clock
        self.assertLess(max(eyes[2]), 90)
        self.assertIn(min(eyes[2]), (40, 50, 60))
        self.assertRegex(run("run", scenario, "--frames", "1").stdout, r"eye/%  state\n")
        registers = run("regs", scenario, "--frames", "1").stdout
        self.assertIn("EYE_WIDTH[0] = 0x0A", registers)
        self.assertIn("EYE_VALID[1] = 1", registers)
        # A line that is gone has no number, and not the one of before.
        with scenario.open("a", encoding="utf-8") as file:
            file.write('[[fault]]\nkind = "unplug"\nslave = 1\nat_us = 100\n')
        frames = json.loads(run("run", scenario, "--frames", "10", "--json").stdout)["frames"]
        last = [row for row in frames if row["slave"] == 1][-1]
        self.assertIsNone(last["eye_percent"])
        # Other dividers leave the word to the acknowledge.
        slow = self.folder / "slow.toml"
        slow.write_text(text + "[host]\nma_hz = 1_000_000\n" + line.format(1, 0), encoding="utf-8")
        row = json.loads(run("run", slow, "--frames", "1", "--json").stdout)["frames"][0]
        self.assertEqual((row["state"], row["eye_percent"]), ("ok", None))

    def test_plot_draws_a_frame_of_any_channel(self):
        scenario = self.path(channel(1) + channel(6, slave="data = 0x1234567\n"))
        result = run("plot", scenario, "--channel", "6")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("Frame 1 of channel 6", result.stdout)
        result = run("plot", scenario, "--channel", "2")
        self.assertEqual(result.returncode, 2)
        self.assertIn("no slave on channel 2", result.stderr)

    def test_regress_counts_the_frames(self):
        scenario = self.path(channel(1, slave=ramp(0)))
        result = run("regress", scenario, "--seeds", "2", "--frames", "5", "--jobs", "1")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("runs 2, failed 0", result.stdout)

    def test_trace_writes_a_waveform_and_its_view_of_every_model(self):
        for channels in (1, 3, 16):
            for chip in ("", 'features = "full"\n', "[chip.quirks]\nALIGN_LATCH = true\n"):
                scenario = self.path(chip + "".join(
                    channel(c, keys=f"delay_ns = {20 * c}\n", slave=ramp(c))
                    for c in range(1, channels + 1)))
                wave = self.folder / "a.fst"
                result = run("run", scenario, "--frames", "2", "--trace", str(wave))
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertEqual(result.stdout, run("run", scenario, "--frames", "2").stdout)
                self.assertGreater(wave.stat().st_size, 1000)
                view = (self.folder / "a.gtkw").read_text(encoding="utf-8")
                for c in range(channels):
                    for name in (f"ma{c}", f"slo{c}", f"encoder{c}_ma", f"encoder{c}_slo",
                                 f"gen_channel[{c}].u_channel.u_word.result_q.delay[9:0]"):
                        self.assertIn(f"\nmb4sim.biss_axi.{name}\n", view)
                    # The names of its states.
                    self.assertIn("\n@100000028\nmb4sim.biss_axi."
                                  f"gen_channel[{c}].u_channel.state_q[3:0]\n", view)
                built = next(size for size in (1, 4, 16) if size >= channels)
                self.assertEqual(view.count("\n-channel "), 2 * built)  # begin and end
                self.assertEqual("\n-extras\n" in view, "full" in chip or
                                 ("ALIGN" in chip and channels > 1))

    def test_run_tells_the_driver_the_switches_of_the_master(self):
        wrong = ('[[fault]]\nkind = "bit-flip"\nchannel = 2\nat_us = 60.0\nbits = [9]\n')
        for switches in ("", "ENABLE_ACTIVE_LOW = true\n", "CRC_BIT_IGNORES = true\n",
                         "ENABLE_ACTIVE_LOW = true\nCRC_BIT_IGNORES = true\nALIGN_LATCH = true\n"
                         "VALID_UNTIL_REQUEST = false\n"):
            scenario = self.path(f"[chip.quirks]\n{switches}" + "".join(
                channel(c, slave=f"data = {4000 * c + 3}\n") for c in range(1, 4)) + wrong)
            status, got = self.frames(scenario, "--frames", "3")
            rows = [(row["slave"], row["position"]) for row in got["frames"] if row["state"] == "ok"]
            self.assertEqual(status, 1)
            self.assertEqual(sorted(rows), [(c, 1000 * c) for c in (1, 1, 1, 2, 2, 3, 3, 3)], switches)
            self.assertEqual([(row["slave"], row["state"]) for row in got["frames"]
                              if row["state"] != "ok"], [(2, "CRC error")], switches)

    def test_what_the_master_does_not_have_is_one_clear_error(self):
        scenario = self.path(channel(1))
        chip = "key 'type': this needs the iC-MB4, not \"axi\""
        cases = ((["spi", scenario], chip), (["scan", scenario], chip),
                 (["bridge", "--tcp", "0", scenario], chip),
                 (["plot", scenario, "--read", "0x44"], "\"axi\" makes no control frames"),
                 (["regress", scenario, "--cover", str(self.folder / "x")],
                  "--cover: .*: there are no points for the master \"axi\""))
        for command, message in cases:
            result = run(*command)
            self.assertEqual((result.returncode, result.stdout), (2, ""), command)
            self.assertRegex(result.stderr, f"^mb4sim: .*{message}\n$")
        self.assertEqual(list(self.folder.iterdir()), [Path(scenario)])  # nothing was written

    def test_scenarios_that_the_driver_does_not_take_name_the_key(self):
        def slave(keys, bits=28):
            return ('[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = "biss-c"\n'
                    f"data_bits = {bits}\n{keys}")
        cases = (("", "channel", "there is no slave"),
                 ("[[channel]]\nnumber = 1\n", "slave", "there is no slave"),
                 (slave("", 40), "data_bits", "3 to 34"),
                 (slave("crc = 0x25\n"), "crc", "CRC 0x43"),
                 (slave("crc_start = 1\n"), "crc_start", "start value 0"),
                 (slave("flag_bits = 0\n"), "flag_bits", "2 flags"),
                 (channel(1) + channel(2, bits=20), "data_bits", "one length"),
                 (slave("").replace("biss-c", "ssi"), "protocol", "BiSS C only"))
        for text, key, message in cases:
            scenario = self.path(text)
            for command in ("run", "plot", "sweep", "regress", "regs"):
                result = run(command, scenario)
                with self.subTest(command=command, text=text):
                    self.assertEqual((result.returncode, result.stdout), (2, ""))
                    self.assertRegex(result.stderr,
                                     rf"^mb4sim: {re.escape(scenario)}(:\d+:\d+)?: key '{key}': .*{message}.*\n$")
        clock = self.folder / "clock.toml"
        clock.write_text(HEAD.replace("100_000_000", "0") + channel(1), encoding="utf-8")
        self.assertRegex(run("run", str(clock)).stderr, "key 'f_clk_hz'")
        # Without an answer there is no map.
        result = run("regs", str(clock), "--reset")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, "^mb4sim: the master does not answer at 0x")

    def test_sweep_takes_the_frequency_of_the_scenario_above_10_mhz(self):
        scenario = self.path(channel(1) + "[host]\nma_hz = 25_000_000\n")
        result = run("sweep", scenario, "--delays", "0", "--jitters", "0", "--frames", "2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("MA_DIVIDER 0x02: MA 25000 kHz", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
