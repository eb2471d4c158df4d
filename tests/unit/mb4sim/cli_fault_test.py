# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""[[fault]] tables: what is injected, how it is detected, what is said about it.

Usage: cli_fault_test.py MB4SIM EXAMPLES
"""
import json
import re
import sys
import unittest

from cli import CliTest, run, slave

ENCODER = slave("data_bits = 28\nsource = \"ramp\"\nstep = 1000")
TIMEOUT = "frame did not end in time"


class Faults(CliTest):
    def report(self, fault, frames=60, scenario=ENCODER, seed="1"):
        """The JSON report of a run with one [[fault]] table and its exit status."""
        path = self.path("x.toml", scenario + "[[fault]]\n" + fault + "\n")
        result = run("run", path, "--json", "--frames", str(frames), "--seed", seed)
        self.assertEqual(result.stderr, "")
        return json.loads(result.stdout), result.returncode

    def only(self, report):
        self.assertEqual(len(report["faults"]), 1, report["faults"])
        return report["faults"][0]

    def assert_detected(self, fault, error, frames=60, scenario=ENCODER):
        report, status = self.report(fault, frames, scenario)
        one = self.only(report)
        self.assertEqual((one["fate"], status), ("detected", 1), one)
        self.assertTrue(one["by"].endswith(": " + error), one)
        self.assertEqual(set(report["summary"]["errors"]), {error})
        # The fault ends: the last frames are good and right.
        self.assertTrue(report["frames"][-1]["good"])
        self.assertTrue(report["frames"][0]["good"])
        return report

    def bad_frames(self, report):
        return [row["frame"] for row in report["frames"] if not row["good"]]

    # --- each kind ---------------------------------------------------------------------------

    def test_line_faults(self):
        # Bit 2 is the first data bit: one frame, found by the CRC.
        report = self.assert_detected("kind = \"bit-flip\"\nbits = [2]\nat_us = 700", "CRC error")
        self.assertEqual(len(self.bad_frames(report)), 1)
        self.assertEqual(self.only(report)["time_us"], 700)
        # SL stays 1: no acknowledge, no start bit.
        self.assert_detected("kind = \"stuck\"\nlevel = 1\nat_us = 700\nfor_us = 300", TIMEOUT)
        # MA stays 1 at the slaves, so they get no frame.
        self.assert_detected("kind = \"stuck\"\non = \"ma\"\nlevel = 1\nat_us = 700\nfor_us = 300",
                             TIMEOUT)
        # Nearly a period of MA.
        self.assert_detected("kind = \"jitter\"\njitter_ns = 95\nat_us = 700\nfor_us = 200",
                             "CRC error")
        # Within I305: 25 % of 100 ns.
        report, status = self.report("kind = \"jitter\"\njitter_ns = 24\nat_us = 700")
        self.assertEqual((self.only(report)["fate"], status), ("no effect", 0))

    def test_slave_faults(self):
        when = "slave = 1\nat_us = 700\nfor_us = 300"
        self.assert_detected("kind = \"silent\"\n" + when, TIMEOUT)
        self.assert_detected("kind = \"busy\"\n" + when, TIMEOUT)
        self.assert_detected("kind = \"unplug\"\n" + when, TIMEOUT)
        report = self.assert_detected("kind = \"wrong-crc\"\n" + when, "CRC error")
        # All frames of that time and no other.
        end = {row["frame"]: row["time_us"] for row in report["frames"]}
        for frame in self.bad_frames(report):
            self.assertTrue(700 < end[frame] and end[frame - 1] < 950, frame)
        # A bad frame takes about 130 us, with the time that the driver gives the slaves after it.
        self.assertGreaterEqual(len(self.bad_frames(report)), 2)

    def test_unplugged_slave_takes_those_behind_it_along(self):
        chain = ENCODER + "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\ndata = 7\n"
        report, status = self.report("kind = \"unplug\"\nslave = 2\nat_us = 700\nfor_us = 900",
                                     60, chain)
        self.assertEqual(self.only(report)["fate"], "detected")
        self.assertEqual(status, 1)
        self.assertTrue(report["frames"][-1]["good"])
        for number, slave_of in ((1, 1), (2, 2)):
            bad = [row for row in report["frames"] if row["slave"] == slave_of and not row["good"]]
            self.assertGreater(len(bad), 0, number)

    def test_wrong_id_is_found_by_a_register_access(self):
        report, status = self.report("kind = \"wrong-id\"\nslave = 1\nat_us = 200", 10)
        one = self.only(report)
        self.assertEqual((one["fate"], status), ("detected", 1))
        self.assertEqual(one["by"], "register access to slave 1: register access failed")
        self.assertEqual(report["summary"]["bad"], 0)

    def test_aborted_spi_frames_never_give_wrong_data(self):
        report, _ = self.report("kind = \"abort\"\nper_s = 5000\nfrom_us = 300", 300)
        self.assertGreater(len(report["faults"]), 50)
        fates = {fault["fate"] for fault in report["faults"]}
        self.assertIn("detected", fates)
        # The driver promises nothing where two transfers of one read are disturbed: it takes 45 us.
        times = [fault["time_us"] for fault in report["faults"]]
        for fault in report["faults"]:
            alone = not any(0 < abs(time - fault["time_us"]) < 45 for time in times)
            self.assertFalse(alone and fault["fate"] == "missed", fault)
        report, _ = self.report("kind = \"abort\"\nafter_clocks = 9\nat_us = [300, 600]", 60)
        self.assertEqual([fault["what"] for fault in report["faults"]],
                         ["next SPI frame ends behind 9 clocks or before its last"] * 2)

    def test_clock_faults(self):
        self.assert_detected("kind = \"clock-stop\"\nat_us = 700\nfor_us = 800", TIMEOUT)
        # MA is slower, but everything fits.
        fault = "kind = \"clock-frequency\"\nhz = 10_000_000\nat_us = 700\nfor_us = 300"
        report, status = self.report(fault)
        self.assertEqual((self.only(report)["fate"], status), ("no effect", 0))
        plain, _ = self.report("kind = \"clock-stop\"\nat_us = 1e9")
        slower = plain["summary"]["clocks"] / plain["summary"]["time_us"] - \
            report["summary"]["clocks"] / report["summary"]["time_us"]
        # 300 us at half the speed.
        self.assertAlmostEqual(slower * report["summary"]["time_us"], 300 * 10, delta=60)

    # --- BiSS Safety ---------------------------------------------------------------------------

    def words(self, kind, number, status):
        """The raw words of both slaves with a fault of `number` for frames 5 to 9."""
        pair = "".join(f"[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"{name}\"\n"
                       "source = \"ramp\"\n" for name in ("bp3-cpw", "bp3-spw"))
        scenario = "[[channel]]\nnumber = 1\n" + pair
        plain, _ = self.report("kind = \"silent\"\nslave = 1\nat_us = 1e9", 12, scenario)
        ends = [row["time_us"] for row in plain["frames"] if row["slave"] == 1]
        report, was = self.report(f"kind = \"{kind}\"\nslave = {number}\nat_us = {ends[3] + 1}\n"
                                  f"for_us = {ends[8] - ends[3]}", 12, scenario)
        self.assertEqual(was, status)
        return [[row["raw"] and int(row["raw"], 16) for row in report["frames"]
                 if row["slave"] == slave_of] for slave_of in (1, 2)], report

    def test_faults_of_words_with_a_life_counter(self):
        good = [[n << 2 | 3 for n in range(12)], [n << 8 | 0xC0 | n for n in range(12)]]
        # Nothing but the counter shows them, so `run` calls them good.
        words, _ = self.words("stuck-counter", 2, 0)
        counts = [0, 1, 2, 3, 3, 3, 3, 3, 3, 4, 5, 6]
        self.assertEqual(words, [good[0], [n << 8 | 0xC0 | counts[n] for n in range(12)]])
        words, _ = self.words("skipped-word", 2, 0)
        counts = [0, 1, 2, 3, 5, 7, 9, 11, 13, 14, 15, 16]
        self.assertEqual(words, [good[0], [n << 8 | 0xC0 | counts[n] for n in range(12)]])
        words, _ = self.words("stuck-word", 2, 0)
        self.assertEqual(words, [good[0], good[1][:4] + [good[1][3]] * 5 + good[1][9:]])
        # Words of different length: no border is where it should be. A failed read takes longer, so
        # these are fewer frames: those that begin while the words are swapped.
        words, report = self.words("swapped-words", 1, 1)
        fault = self.only(report)
        bad = words[0].count(None)
        ends = [row["time_us"] for row in report["frames"] if row["slave"] == 1]
        length = ends[1] - ends[0]
        swapped = sum(fault["time_us"] <= end - length < fault["end_us"] for end in ends)
        self.assertEqual(bad, swapped)
        self.assertGreater(bad, 0)
        self.assertEqual(words, [side[:4] + [None] * bad + side[4 + bad:] for side in good])
        self.assertEqual(fault["fate"], "detected")

    # --- what is said ------------------------------------------------------------------------

    def test_wrong_data_without_crc_is_missed_and_bad(self):
        report, status = self.report("kind = \"bit-flip\"\nbits = [10]\nat_us = 500", 40,
                                     slave("data_bits = 28\ncrc = 0\ndata = 0x123"))
        self.assertEqual((self.only(report)["fate"], status), ("missed", 1))
        self.assertEqual(report["summary"]["errors"], {"wrong data, not what the slave sent": 1})
        bad = self.bad_frames(report)
        self.assertEqual(len(bad), 1)
        # Bit 10 of the frame is data bit 28 - 1 - 8.
        self.assertEqual(int(report["frames"][bad[0] - 1]["raw"], 16), 0x123 ^ 1 << 19)

    def test_between_frames_a_fault_has_no_effect(self):
        # The first frame is asked for after the configuration, about 100 us.
        report, status = self.report("kind = \"glitch\"\nwidth_ns = 50\nat_us = 20")
        self.assertEqual((self.only(report)["fate"], status), ("no effect", 0))

    def test_later_errors_are_not_laid_at_an_old_fault(self):
        report, _ = self.report("kind = \"glitch\"\nwidth_ns = 50\nat_us = 20\n"
                                "[[fault]]\nkind = \"bit-flip\"\nbits = [2]\nat_us = 900")
        self.assertEqual([fault["fate"] for fault in report["faults"]],
                         ["no effect", "detected"])

    def test_text_logs_every_fault_and_sums_up(self):
        path = self.path("x.toml", ENCODER + "[[fault]]\nkind = \"bit-flip\"\nbits = [7]\nper_s = 2000\n"
                         "[[fault]]\nkind = \"silent\"\nslave = 1\nat_us = 900\nfor_us = 100\n")
        result = run("run", path, "--frames", "100")
        self.assertEqual(result.returncode, 1)
        logged = re.findall(r"(?m)^  fault (\d+) at ([\d.]+) us: ", result.stdout)
        self.assertEqual([int(number) for number, _ in logged], list(range(1, len(logged) + 1)))
        times = [float(time) for _, time in logged]
        self.assertEqual(times, sorted(times))
        self.assertIn(900.0, times)
        counts = re.search(r"(?m)^faults: injected (\d+), detected (\d+), no effect (\d+), "
                           r"missed (\d+)$", result.stdout)
        injected, detected, no_effect, missed = map(int, counts.groups())
        self.assertEqual(injected, len(logged))
        self.assertEqual(detected + no_effect + missed, injected)
        # 2000 a second in the time of the run, spread evenly over 0 to twice the distance.
        time_us = float(re.search(r"simulated time ([\d.]+)", result.stdout).group(1))
        self.assertAlmostEqual((injected - 1) / (time_us * 0.002), 1, delta=0.5)
        self.assertRegex(result.stdout, r"(?m)^  bit-flip +injected \d+, detected \d+")

    def test_other_commands_log_on_standard_error(self):
        scenario = self.path("x.toml", slave("preset = \"lika-sma1\"") +
                             "[[fault]]\nkind = \"wrong-id\"\nslave = 1\nat_us = 5\n")
        line = "  fault 1 at 5.000 us: slave 1 answers to a wrong ID\n"
        result = run("spi", scenario, text="03 EB 00\n+9000\n")
        self.assertEqual((result.stdout, result.stderr), ("00 00 84\n", line))
        for command in ("regs", "scan"):
            self.assertEqual(run(command, scenario).stderr, line)

    def test_same_seed_same_faults(self):
        fault = "kind = \"bit-flip\"\nper_s = 3000"
        first, _ = self.report(fault, 100)
        again, _ = self.report(fault, 100)
        other, _ = self.report(fault, 100, seed="2")
        self.assertEqual(first, again)
        self.assertNotEqual(first["faults"], other["faults"])

    def test_random_faults_keep_to_their_window(self):
        report, _ = self.report(
            "kind = \"silent\"\nslave = 1\nper_s = 3000\nfrom_us = 500\nto_us = 1500\nfor_us = 5",
            100)
        times = [fault["time_us"] for fault in report["faults"]]
        self.assertGreater(len(times), 1)
        self.assertTrue(all(500 < time <= 1500 for time in times), times)
        self.assertTrue(all(abs(fault["end_us"] - fault["time_us"] - 5) < 1e-6
                            for fault in report["faults"]))

    # --- mistakes ----------------------------------------------------------------------------

    def test_mistakes_are_named_with_place_and_key(self):
        # The table [[fault]] is line 9 of the file, its keys begin on line 10.
        for fault, message in (
                ("at_us = 1", r":9:1: key 'kind': missing"),
                ("kind = \"fire\"", r":10:8: key 'kind': unknown value 'fire', expected one of: "),
                ("kind = \"glitch\"\nwidth_ns = 5", r":9:1: key 'at_us': one of at_us"),
                ("kind = \"glitch\"\nwidth_ns = 5\nat_us = 1\nper_s = 1",
                 r":12:9: key 'at_us': one of"),
                ("kind = \"glitch\"\nat_us = 1", r":9:1: key 'width_ns': missing"),
                ("kind = \"glitch\"\nwidth_ns = 5\nat_us = -1", r":12:9: key 'at_us': expected"),
                ("kind = \"glitch\"\nwidth_ns = 5\nat_us = [1, \"x\"]", r":12:13: key 'at_us'"),
                ("kind = \"glitch\"\nwidth_ns = 5\nat_us = 1\nfor_us = 3",
                 r":13:10: key 'for_us': a fault of kind 'glitch' has no such key"),
                ("kind = \"glitch\"\nwidth_ns = 5\nat_us = 1\nslave = 1",
                 r":13:1: key 'slave': unknown key"),
                ("kind = \"glitch\"\nwidth_ns = 5\nat_us = 1\nchannel = 2",
                 r":13:11: key 'channel': the scenario has no channel 2"),
                ("kind = \"silent\"", r":9:1: key 'at_us': one of"),
                ("kind = \"silent\"\nslave = 2\nat_us = 1",
                 r":11:9: key 'slave': the scenario has no slave 2"),
                ("kind = \"silent\"\nslave = 1\nper_s = 1", r":9:1: key 'for_us': missing"),
                ("kind = \"silent\"\nslave = 1\nat_us = 1\nfrom_us = 1",
                 r":13:11: key 'from_us': only together with per_s"),
                ("kind = \"silent\"\nslave = 1\nper_s = 1\nfrom_us = 2\nto_us = 1\nfor_us = 1",
                 r":14:9: key 'to_us': is before from_us"),
                ("kind = \"stuck\"\nat_us = 1", r":9:1: key 'level': missing"),
                ("kind = \"stuck\"\non = \"mo\"\nlevel = 1\nat_us = 1",
                 r":11:6: key 'on': unknown value 'mo'"),
                ("kind = \"bit-flip\"\nbits = [4096]\nat_us = 1", r":11:9: key 'bits': expected"),
                ("kind = \"bit-flip\"\nbits = []\nat_us = 1", r":11:8: key 'bits': expected"),
                ("kind = \"clock-frequency\"\nat_us = 1", r":9:1: key 'hz': missing"),
                ("kind = \"abort\"\nafter_clocks = 0\nat_us = 1",
                 r":11:16: key 'after_clocks': 0 is outside")):
            with self.subTest(fault):
                path = self.path("x.toml", ENCODER + "\n[[fault]]\n" + fault + "\n")
                result = run("run", path)
                self.assert_one_line(result, 2, re.escape(path) + message)
                self.assertEqual(result.stdout, "")

    def test_faults_that_do_not_fit_the_scenario(self):
        for scenario, fault, message in (
                ("[host]\ninterface = \"intel\"\n" + ENCODER, "kind = \"abort\"\nat_us = 1",
                 "key 'kind': only an SPI host"),
                ("[chip]\nf_clk_hz = 0\n" + ENCODER, "kind = \"clock-stop\"\nat_us = 1",
                 "key 'kind': there is no clock at pin CLK"),
                (slave("data_bits = 8\ncrc = 0"), "kind = \"wrong-crc\"\nslave = 1\nat_us = 1",
                 "key 'slave': this slave sends no CRC"),
                (slave("preset = \"resolute-26\""), "kind = \"wrong-id\"\nslave = 1\nat_us = 1",
                 "key 'slave': only a BiSS C slave with control"),
                (slave("data_bits = 8").replace("biss-c", "ssi"),
                 "kind = \"wrong-id\"\nslave = 1\nat_us = 1", "key 'slave': this slave has no ID"),
                (ENCODER, "kind = \"swapped-words\"\nslave = 1\nat_us = 1",
                 "key 'slave': there is no slave behind it"),
                (ENCODER, "kind = \"stuck-counter\"\nslave = 1\nat_us = 1",
                 "key 'slave': this slave has no life counter"),
                (slave("data_bits = 8").replace("biss-c", "biss-b"),
                 "kind = \"stuck-word\"\nslave = 1\nat_us = 1",
                 "key 'slave': only a BiSS C sensor can have it"),
                (slave("data_bits = 8").replace("biss-c", "ssi"),
                 "kind = \"busy\"\nslave = 1\nat_us = 1", "key 'slave': this slave has no busy time")):
            with self.subTest(message):
                path = self.path("x.toml", scenario + "[[fault]]\n" + fault + "\n")
                self.assert_one_line(run("run", path), 2, message)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
