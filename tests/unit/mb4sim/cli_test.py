# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The contract of the mb4sim command line: exit statuses, messages, output, files.

Usage: cli_test.py MB4SIM EXAMPLES
"""
import contextlib
import csv
import itertools
import json
import os
import re
import shutil
import stat
import subprocess
import sys
import unittest
import xml.etree.ElementTree

from cli import EXAMPLES, MB4SIM, RESOLUTE, CliTest, run, slave


def crc(polynomial, width, start, data, bits):
    """CRC bit by bit, most significant bit first."""
    register = start
    for index in reversed(range(bits)):
        feedback = ((data >> index) & 1) ^ (register >> (width - 1))
        register = (register << 1) & ((1 << width) - 1)
        register ^= polynomial & ((1 << width) - 1) if feedback else 0
    return register


def crc6(data, bits):
    """CRC6 0x43, start 0."""
    return crc(0x43, 6, 0, data, bits)


class Cli(CliTest):
    # --- wrong use ---------------------------------------------------------------------------

    def test_wrong_use_is_status_2(self):
        for arguments in ([], ["fly"], ["run"], ["run", RESOLUTE, "--frames", "x"],
                          ["run", RESOLUTE, "--frames", "0"], ["run", RESOLUTE, "--fast"],
                          ["spi"], ["regs", RESOLUTE, "again"], ["run", ""],
                          ["run", RESOLUTE, "--frames", "-1"],
                          ["run", RESOLUTE, "--frames", "1000000001"],
                          ["run", RESOLUTE, "--frames", "99999999999999999999"],
                          ["regs", RESOLUTE, "--frames", "-1"],
                          ["run", RESOLUTE, "--seed", "-1"],
                          ["run", RESOLUTE, "--seed", "18446744073709551616"],
                          ["run", RESOLUTE, "--seed", "0x10000000000000000"],
                          ["run", RESOLUTE, "--seed", "1.5"], ["run", RESOLUTE, "--seed", ""],
                          ["run", RESOLUTE, "--csv", ""], ["run", RESOLUTE, "--trace", ""],
                          ["run", RESOLUTE, "--csv="], ["run", RESOLUTE, "--trace="]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assert_one_line(result, 2, r"^mb4sim: ")
                self.assertEqual(result.stdout, "")

    def test_help_and_version_are_status_0(self):
        for arguments in (["--help"], ["run", "--help"], ["spi", "--help"], ["regs", "--help"],
                          ["sweep", "--help"], ["bench", "--help"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 0)
            self.assertIn("Example", result.stdout)
            self.assertEqual(result.stderr, "")
        result = run("--version")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stdout, r"^mb4sim \d+\.\d+\.\d+\n$")

    # --- bad input ---------------------------------------------------------------------------

    def test_bad_scenario_is_one_line_with_file_line_and_key(self):
        bad = self.path("bad.toml", "[chip]\nf_clk_hz = 20_000_000\nf_osk_hz = 1\n")
        for command in ("run", "spi", "regs"):
            result = run(command, bad)
            self.assert_one_line(result, 2, re.escape(bad) + r":3:1: key 'f_osk_hz': unknown key")
            self.assertEqual(result.stdout, "")

    def test_missing_scenario(self):
        for command in ("run", "spi", "regs"):
            self.assert_one_line(run(command, "/no/such.toml"), 2,
                                 r"/no/such\.toml: cannot read: No such file")
        self.assert_one_line(run("run", self.folder.name), 2, "is a directory")

    def test_a_dash_is_no_pipe(self):
        before = os.listdir(".")
        for words in (("run", "-"), ("run", RESOLUTE, "--csv", "-"), ("plot", RESOLUTE, "--svg", "-")):
            self.assert_one_line(run(*words), 2, "'-' is taken for no pipe: give a file name")
        self.assertEqual(os.listdir("."), before)

    def test_run_shows_positions_of_every_protocol(self):
        keys = {"ssi": "gray = true\n", "biss-b": "crc = 0x25\n", "biss-c": "crc = 0x43\n"}
        for first, second in itertools.product(keys, keys):
            text = "".join(f"[[channel]]\nnumber = {number}\n[[channel.slave]]\nprotocol = "
                           f"\"{protocol}\"\ndata_bits = 20\nflag_bits = 0\nsource = \"ramp\"\n"
                           f"start = {1000 * number}\nstep = {number}\n{keys[protocol]}"
                           for number, protocol in ((1, first), (2, second)))
            with self.subTest(text):
                result = run("run", self.path("x.toml", text), "--frames", "4", "--json")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                rows = [(row["slave"], row["position"]) for row in json.loads(result.stdout)["frames"]]
                self.assertEqual(rows, [(slave, number * 1000 + number * frame)
                                        for frame in range(4) for slave, number in ((1, 1), (5, 2))])

    def test_run_shows_flags_behind_gray_code(self):
        for flags in range(4):
            text = ("[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"ssi\"\ndata_bits = 27\n"
                    f"flag_bits = 2\nflags = {flags}\ngray = true\nsource = \"ramp\"\nstart = 99\n")
            result = run("run", self.path("x.toml", text), "--frames", "1", "--json")
            self.assertEqual(result.returncode, 0)
            row = json.loads(result.stdout)["frames"][0]
            self.assertEqual((row["position"], row["nE"], row["nW"]), (99, flags >> 1, flags & 1))
        # The chip converts one flag too, and the position is still right.
        text = text.replace("flag_bits = 2\nflags = 3", "flag_bits = 1\nflags = 1")
        result = run("run", self.path("x.toml", text), "--frames", "1", "--json")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(json.loads(result.stdout)["frames"][0]["position"], 99)

    def test_run_writes_actuators_and_shows_what_they_have_taken(self):
        slave = "[[channel.slave]]\nprotocol = \"biss-c\"\n"
        text = ("[[channel]]\nnumber = 1\nmo = true\n" +
                slave + "data_bits = 8\nactuator = true\ndata = 254\n" +
                slave + "data_bits = 12\nflag_bits = 0\ndata = 0xABC\nbusy_periods = 7\n" +
                slave + "data_bits = 64\nactuator = true\ndata = 5\n")
        result = run("run", self.path("x.toml", text), "--frames", "3", "--json")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        words = [row["position"] for row in json.loads(result.stdout)["frames"]]
        self.assertEqual(words, [255, 0xABC, 6, 0, 0xABC, 7, 1, 0xABC, 8])
        # MO is shorted: no word arrives, and that is no good frame.
        broken = text.replace("mo = true\n", "mo = true\ndelay_ns = 40_000\nmo_delay_ns = 900_000\n")
        self.assertEqual(run("run", self.path("x.toml", broken), "--frames", "3").returncode, 1)

    def test_regs_shows_each_protocol(self):
        for protocol, code in (("biss-b", "0xC"), ("ssi", "0xE")):
            text = ("[[channel]]\nnumber = 1\n[[channel.slave]]\n"
                    f"protocol = \"{protocol}\"\ndata_bits = 13\n")
            result = run("regs", self.path("x.toml", text))
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn(code[2], result.stdout)

    def test_nothing_is_written_before_everything_is_valid(self):
        bad = self.path("bad.toml", "x = 1\n")
        run("run", bad, "--csv", self.path("a.csv"), "--trace", self.path("a.fst"))
        self.assertEqual(os.listdir(self.folder.name), ["bad.toml"])
        result = run("run", RESOLUTE, "--csv", self.path("a.csv"), "--trace", "/no/such/dir/a.fst")
        self.assert_one_line(result, 2, "/no/such/dir/a.fst: cannot write: No such file")
        result = run("run", RESOLUTE, "--csv", "/no/such/dir/a.csv", "--trace", self.path("a.fst"))
        self.assert_one_line(result, 2, "/no/such/dir/a.csv: cannot write: No such file")
        self.assertEqual(os.listdir(self.folder.name), ["bad.toml"])

    def test_what_the_driver_cannot_do_is_named_with_place_and_key(self):
        good = "data_bits = 28"
        second = "[[channel.slave]]\nprotocol = \"biss-c\"\n" + good + "\n"
        channel2 = "[[channel]]\nnumber = 2\n"
        for text, message in (
                ("[chip]\nf_clk_hz = 25_000_001\n" + slave(good), r":2:12: key 'f_clk_hz': "),
                ("[chip]\nf_clk_hz = 999_999\n" + slave(good), r":2:12: key 'f_clk_hz': "),
                (slave(good + "\ncrc = 0x101"), r":6:7: key 'crc': .*0x101"),
                (slave(good + "\ncrc = 0\ncrc_start = 1"), r":7:13: key 'crc_start': "),
                (slave(good) + second + "crc = 0x11D", r":9:7: key 'crc': .*0x11D"),
                (slave(good) + channel2 + second + "crc = 0\ncrc_start = 2",
                 r":12:13: key 'crc_start': "),
                (slave(good) + channel2, r":6:1: key 'slave': missing"),
                (channel2, r":1:1: key 'slave': missing"),
                ("[[channel]]\nnumber = 1\n", r":1:1: key 'slave': "),
                ("[chip]\n", r":1:1: key 'channel': ")):
            with self.subTest(text):
                scenario = self.path("x.toml", text)
                for command in ("run", "regs"):
                    result = run(command, scenario)
                    self.assert_one_line(result, 2, "^mb4sim: " + re.escape(scenario) + message)
                    self.assertNotIn("polynomial of", result.stderr)
                # Only the chip takes these bytes, so limits of the driver do not matter here.
                self.assertEqual(run("spi", scenario, text="03 EB 00\n").returncode, 0)

    def test_messages_stay_one_line_without_control_characters(self):
        for text, message in (
                ('"a\\nb" = 1\n', r"key 'a\\nb': unknown key"),
                ('[host]\ninterface = "a\\u0000\\u001b[1m\\r\\t\\u007f"\n',
                 r"'a\\x00\\x1b\[1m\\r\\t\\x7f'"),
                (slave('preset = "a\\u009b\\nb"'), r"'a\\x9b\\nb'"),
                (slave('data_bits = 8\nsource = "file"\nfile = "no\\nsuch"'), r"no\\nsuch: cannot"),
                (slave('data_bits = 8\nsource = "file"\nfile = "x.toml\\u0000y"'),
                 r":7:8: key 'file': a file name cannot hold a NUL character")):
            with self.subTest(text):
                self.assert_one_line(run("run", self.path("x.toml", text)), 2, message)
        self.assert_one_line(run("run", self.path("no\nsuch.toml")), 2, r"no\\nsuch\.toml: cannot")
        result = run("spi", RESOLUTE, text="\x1b[2J\n")
        self.assert_one_line(result, 2, r"found '\\x1b\[2J'")

    def test_output_never_replaces_input_or_other_output(self):
        words = self.path("words.txt", "1\n2\n")
        scenario = self.path("s.toml", slave('data_bits = 8\nsource = "file"\nfile = "words.txt"'))
        edges = self.path("ti.edges")
        shutil.copy(os.path.join(EXAMPLES, "ti-tidm-1010.edges"), edges)
        replay = self.path("replay.toml", "[host]\nma_hz = 1_000_000\n[[channel]]\nnumber = 1\n"
                           "[[channel.slave]]\nprotocol = \"replay\"\nedges = \"ti.edges\"\n"
                           "data_bits = 15\n")
        gtkw = self.path("view.gtkw", slave("data_bits = 8"))
        partial = self.path("p.csv.partial", slave("data_bits = 8"))
        hier = self.path("h.fst.hier", slave("data_bits = 8"))
        link = self.path("link")
        os.symlink("s.toml", link)
        hard = self.path("hard")
        os.link(scenario, hard)
        dangling = self.path("dangling")
        os.symlink("new.fst", dangling)
        new = self.path("new")
        before = self.contents()
        for arguments in ([scenario, "--csv", scenario], [scenario, "--trace", scenario],
                          [scenario, "--csv", os.path.join(self.folder.name, ".", "s.toml")],
                          [scenario, "--csv", link], [link, "--trace", scenario],
                          [scenario, "--trace", hard], [scenario, "--csv", words],
                          [scenario, "--trace", words], [replay, "--csv", edges],
                          [replay, "--trace", edges], [gtkw, "--trace", self.path("view.fst")],
                          [partial, "--csv", self.path("p.csv")],
                          [hier, "--trace", self.path("h.fst")],
                          [scenario, "--csv", new, "--trace", new],
                          [scenario, "--csv", new + ".gtkw", "--trace", new + ".fst"],
                          [scenario, "--csv", new + ".fst", "--trace", dangling]):
            with self.subTest(arguments):
                result = run("run", *arguments, "--frames", "1")
                self.assert_one_line(result, 2, r"^mb4sim: --(csv|trace): .*(same file|would)")
                self.assertEqual(result.stdout, "")
                self.assertEqual(self.contents(), before)

    def contents(self):
        found = {}
        for name in sorted(os.listdir(self.folder.name)):
            path = os.path.join(self.folder.name, name)
            with contextlib.suppress(FileNotFoundError), open(path, "rb") as file:
                found[name] = file.read()
        return found

    def test_trace_takes_only_regular_files(self):
        fifo = self.path("fifo")
        os.mkfifo(fifo)
        os.symlink("fifo", self.path("link"))
        os.mkfifo(self.path("x.gtkw"))
        os.mkfifo(self.path("y.fst.hier"))
        os.mkdir(self.path("dir"))
        names = sorted(os.listdir(self.folder.name))
        for name in ("fifo", "link", "x.fst", "y.fst", "dir"):
            with self.subTest(name):
                result = run("run", RESOLUTE, "--frames", "1", "--trace", self.path(name),
                             "--csv", self.path("out.csv"))
                self.assert_one_line(result, 2, r"^mb4sim: .*(not a regular|is a directory)")
                self.assertEqual(sorted(os.listdir(self.folder.name)), names)
        self.assertTrue(stat.S_ISFIFO(os.stat(fifo).st_mode))

    def test_trace_through_a_link_keeps_the_link(self):
        target = self.path("target", "old")
        link = self.path("wave.fst")
        os.symlink("target", link)
        result = run("run", RESOLUTE, "--frames", "1", "--trace", link)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(os.path.islink(link))
        self.assertGreater(os.path.getsize(target), 1000)
        with open(self.path("wave.gtkw"), encoding="utf-8") as file:
            self.assertIn('[dumpfile] "wave.fst"', file.read())

    def test_csv_may_go_to_a_pipe(self):
        fifo = self.path("fifo")
        os.mkfifo(fifo)
        with subprocess.Popen([MB4SIM, "run", RESOLUTE, "--frames", "1", "--csv", fifo],
                              stdout=subprocess.DEVNULL) as process:
            with open(fifo, encoding="utf-8") as file:
                self.assertEqual(len(file.read().splitlines()), 2)
            self.assertEqual(process.wait(timeout=10), 0)
        self.assertEqual(os.listdir(self.folder.name), ["fifo"])

    def test_output_that_cannot_be_written_is_status_2(self):
        for command, text in (("spi", "05 00\n"), ("spi", "05 00\n" * 3000), ("run", ""),
                              ("regs", "")):
            with self.subTest(command), open("/dev/full", "w", encoding="utf-8") as full:
                result = subprocess.run([MB4SIM, command, RESOLUTE], input=text, stdout=full,
                                        stderr=subprocess.PIPE, text=True, timeout=120,
                                        check=False)
                self.assert_one_line(result, 2, r"^mb4sim: cannot write to ")

    # --- bench -------------------------------------------------------------------------------

    def test_bench_measures_work_that_was_done(self):
        result = run("bench", "--json", "--repeats", "2", "--ms", "5")
        self.assertEqual(result.returncode, 0, result.stderr)
        report = json.loads(result.stdout)
        rates = {rate["workload"]: rate for rate in report["rates"]}
        self.assertEqual(list(rates), list("ABCDEFGHIJK"))
        for rate in rates.values():
            self.assertGreater(rate["clk_per_s"], 10_000)
            self.assertLessEqual(rate["slowest"], rate["clk_per_s"])
            self.assertLessEqual(rate["clk_per_s"], rate["fastest"])
        time_us = {letter: rates[letter]["clocks"] / 20 for letter in rates}
        # A: 40 periods of MA at 10 MHz and the slave's timeout. B: 141 periods, 8 slaves a frame.
        # C: a frame a millisecond.
        self.assertAlmostEqual(rates["A"]["frames"] * 4.3 / time_us["A"], 1, delta=0.15)
        self.assertAlmostEqual(rates["B"]["frames"] / 8 * 14.4 / time_us["B"], 1, delta=0.15)
        self.assertAlmostEqual(rates["C"]["frames"], time_us["C"] / 1000, delta=1.5)
        # K: 40 periods of 1 us.
        self.assertAlmostEqual(rates["K"]["frames"] * 40 / time_us["K"], 1, delta=0.15)
        # H, I: 39 periods of MA at 10 MHz (two edges, start, CDS, 28 bits, CRC, timeout), 0.05 us a cable
        # of 5 m, and up to 1 us until the next sample clock; four encoders in I.
        for letter, encoders in (("H", 1), ("I", 4)):
            clocks = rates[letter]["clocks"] / rates[letter]["frames"] * encoders
            self.assertAlmostEqual(clocks, 450, delta=60)
        # J: 108 bits of eight clocks.
        self.assertAlmostEqual(rates["J"]["clocks"] / rates["J"]["frames"], 864, delta=20)
        self.assertEqual(rates["D"]["frames"], 0)
        self.assertGreater(rates["D"]["spi_bytes"] * 0.8, 0.9 * (time_us["D"] - 200))
        self.assertGreater(len(report["compiler"]), 3)

    def test_bench_text_has_a_line_for_each_workload_asked_for(self):
        result = run("bench", "--workload", "dA", "--repeats", "1", "--ms", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([line[0] for line in result.stdout.splitlines()[-2:]], ["D", "A"])
        for word in ("machine", "compiler", "model"):
            self.assertRegex(result.stdout, rf"(?m)^{word} +\S")
        self.assert_one_line(run("bench", "--workload", "AX"), 2, "no workload 'X'")
        self.assert_one_line(run("bench", "--workload", ","), 2, "names no workload")

    # --- run ---------------------------------------------------------------------------------

    def test_run_numbers_are_decimal_or_hexadecimal(self):
        count = len(run("run", RESOLUTE, "--frames", "010").stdout.splitlines())
        self.assertEqual(count, 1 + 10 + 1)
        for seed, value in (("0x1F", 31), ("010", 10), ("18446744073709551615", 2**64 - 1)):
            result = run("run", RESOLUTE, "--frames", "0x1", "--seed", seed)
            self.assertIn(f"seed {value}\n", result.stdout)

    def test_run_prints_table_and_summary(self):
        result = run("run", RESOLUTE, "--frames", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        self.assertEqual(len(lines), 1 + 3 + 1)
        for line in lines[1:4]:
            words = line.split()
            # 28 bits 0x2ABCDEF: position without nE, nW; CRC by an independent computation.
            self.assertEqual(words[2:], ["1", "0x2ABCDEF", str(0x2ABCDEF >> 2), "1", "1",
                                         f"0x{crc6(0x2ABCDEF, 28):02X}", "ok"])
        self.assertRegex(lines[4], r"^frames good 3, bad 0; simulated time .* us, simulated clocks")

    def test_run_default_is_ten_frames_and_repeatable(self):
        first = run("run", RESOLUTE)
        self.assertEqual(len(first.stdout.splitlines()), 12)
        self.assertEqual(first.stdout, run("run", RESOLUTE).stdout)

    def test_run_reads_the_recorded_frame_of_ti(self):
        result = run("run", os.path.join(EXAMPLES, "ti-tidm-1010.toml"), "--frames", "2", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        for frame in json.loads(result.stdout)["frames"]:
            self.assertEqual(frame["position"], 0x0E08)
            self.assertEqual((frame["nE"], frame["nW"]), (1, 1))
            self.assertEqual(int(frame["crc"], 16), 0b101110 ^ 0b111111)

    def test_run_json_and_csv_agree(self):
        table = self.path("out.csv")
        result = run("run", os.path.join(EXAMPLES, "ramp-sensor.toml"), "--frames", "4", "--json",
                     "--csv", table)
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(result.stdout)
        with open(table, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([f["position"] for f in document["frames"]], [0, 1000, 2000, 3000])
        self.assertEqual([int(r["position"]) for r in rows], [0, 1000, 2000, 3000])
        self.assertEqual(document["summary"]["good"], 4)
        self.assertEqual(os.listdir(self.folder.name), ["out.csv"])

    def test_run_reads_all_slaves_of_both_channels(self):
        table = self.path("out.csv")
        arguments = ("run", os.path.join(EXAMPLES, "two-channels.toml"), "--frames", "3")
        result = run(*arguments, "--csv", table)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        # One row per slave and frame, then one line per slave and the sum.
        self.assertEqual(len(lines), 1 + 3 * 3 + 3 + 1)
        self.assertEqual([line.split()[::2][:2] for line in lines[1:10]],
                         [[str(frame), str(number)] for frame in (1, 2, 3) for number in (1, 2, 5)])
        crc16 = crc(0x190D9, 16, 0x1234, 0xABCDEF, 24)
        self.assertEqual(lines[3].split()[2:],
                         ["5", "0xABCDEF", str(0xABCDEF), "-", "-", f"0x{crc16:04X}", "ok"])
        self.assertEqual(lines[10:13], [f"slave {n}: good 3, bad 0" for n in (1, 2, 5)])
        self.assertRegex(lines[13], r"^frames good 9, bad 0; ")
        with open(table, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        document = json.loads(run(*arguments, "--json").stdout)
        self.assertEqual([(int(r["slave"]), int(r["position"])) for r in rows],
                         [(f["slave"], f["position"]) for f in document["frames"]])
        self.assertEqual([int(r["position"]) for r in rows if r["slave"] == "1"], [0, 1000, 2000])
        self.assertEqual(document["summary"]["slaves"],
                         [{"slave": n, "good": 3, "bad": 0} for n in (1, 2, 5)])

    def test_run_counts_the_bad_frames_of_each_slave(self):
        # Frame 2: one bit of slave 2, after start bit, CDS and the 28 + 6 bits of slave 1.
        two = ("[[channel]]\nnumber = 1\nflips = [[2, 37]]\n" + 2 *
               "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n")
        result = run("run", self.path("x.toml", two), "--frames", "3")
        self.assertEqual(result.returncode, 1, result.stderr)
        states = [line.split()[-1] for line in result.stdout.splitlines()[1:7]]
        self.assertEqual(states, ["ok", "ok", "ok", "error", "ok", "ok"])
        self.assertIn("slave 1: good 3, bad 0\nslave 2: good 2, bad 1\nframes good 5, bad 1;",
                      result.stdout)

    def test_run_with_bad_frames_is_status_1(self):
        # A recording whose CRC is wrong in one bit.
        with open(os.path.join(EXAMPLES, "ti-tidm-1010.edges"), encoding="utf-8") as file:
            edges = file.read()
        bad = edges.replace("24500  0", "23500  0")
        self.assertNotEqual(bad, edges)
        self.path("bad.edges", bad)
        scenario = self.path("bad.toml", "[host]\nma_hz = 1_000_000\n[[channel]]\nnumber = 1\n"
                             "[[channel.slave]]\nprotocol = \"replay\"\nedges = \"bad.edges\"\n"
                             "data_bits = 15\n")
        result = run("run", scenario, "--frames", "2")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("CRC error", result.stdout)
        self.assertIn("frames good 0, bad 2", result.stdout)

    def test_run_trace_writes_waveform_and_view(self):
        wave = self.path("wave.fst")
        result = run("run", RESOLUTE, "--frames", "1", "--trace", wave)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, run("run", RESOLUTE, "--frames", "1").stdout)
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["wave.fst", "wave.gtkw"])
        self.assertGreater(os.path.getsize(wave), 1000)
        with open(self.path("wave.gtkw"), encoding="utf-8") as file:
            view = file.read()
        self.assertIn('[dumpfile] "wave.fst"', view)
        for group in ("host", "line", "slaves", "control", "inside the lines", "registers",
                      "straps"):
            self.assertEqual(view.count(f"\n-{group}\n"), 2)
            self.assertNotRegex(view, f"-{group}\n@1[04]0")  # no empty group
        for pin in ("ncs_i", "ale_i", "ma1_o", "sl1_i", "slaves_slo_i[7:0]"):
            self.assertRegex(view, r"\." + re.escape(pin) + "\n")

    # --- spi ---------------------------------------------------------------------------------

    def test_spi_answers_each_frame_line(self):
        result = run("spi", RESOLUTE, text="# comment\n\n03 ea 00 00\n+1000\npin GETSENS 1\n"
                     "  05 00   # status\n")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "00 00 20 84\n00 FB\n")

    def test_spi_answers_before_the_next_line_is_written(self):
        with subprocess.Popen([MB4SIM, "spi", RESOLUTE], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE, text=True) as process:
            for _ in range(3):
                process.stdin.write("03 EB 00\n")
                process.stdin.flush()
                self.assertEqual(process.stdout.readline(), "00 00 84\n")
            process.stdin.close()
            self.assertEqual(process.wait(timeout=10), 0)

    def test_spi_refuses_anything_else_with_its_line(self):
        for line in ("03 E", "03 EBC", "hello", "+", "+1.5", "+-3", "+1 2", "pin", "pin EOT 1",
                     "pin GETSENS", "pin GETSENS 2", "pin NOPE 1", "pin GETSENS 1 1", "0x03"):
            with self.subTest(line):
                result = run("spi", RESOLUTE, text=f"03 EB 00\n\n{line}\n03 EB 00\n")
                self.assert_one_line(result, 2, r"^mb4sim: standard input:3: ")
                self.assertEqual(result.stdout, "00 00 84\n")

    # --- regs --------------------------------------------------------------------------------

    def test_regs_shows_the_configured_chip(self):
        result = run("regs", RESOLUTE, "--frames", "1", "--all")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"0x00 +SCDATA1 +EF CD AB 02")
        for row in (r"0xEA +0x20 +7:0 +REVISION = Y ", r"0xEB +0x84 +7:0 +VERSION = IC_MB4 ",
                    r"0xC0 +0x5B +5:0 +SCDLEN1 = 0x1B \(28 bits\) ", r"0xED +0x0D +1:0 +CFGCH1 = BiSS_C ",
                    r"0xF0 +\S+ +4 +nSCDERR = GOOD ", r"0xE8 +0x7C +7:0 +FREQAGS = 0x7C \(AGSMIN\) "):
            self.assertRegex(result.stdout, row)

    def test_regs_leaves_out_what_is_as_after_reset(self):
        fields = json.loads(run("regs", RESOLUTE, "--json").stdout)["fields"]
        changed = {field["name"] for field in fields
                   if field["value"] != field["reset"] and field["address"] >= 0xC0}
        lines = run("regs", RESOLUTE).stdout.splitlines()
        shown = {match[1] for line in lines if (match := re.search(r"^0x.*? (\w+)(?:/\S+)? = ", line))}
        self.assertEqual(shown, changed)
        self.assertIn("CFGCH1", shown)
        self.assertFalse(any("SCDATA2" in line for line in lines))
        self.assertIn("SCDATA2", run("regs", RESOLUTE, "--all").stdout)

    def test_regs_of_a_name(self):
        def rows(*arguments):
            return re.findall(r"(?m)^0x.*? (\w+)(?:/\S+)? = (.*?)  ", run("regs", *arguments).stdout)

        # Frequencies follow from CLK: Table 35, 36 and 37 with 20 MHz, then with 16 MHz.
        self.assertEqual(rows(RESOLUTE, "freq"), [("FREQR", "0x05 (156.25 kHz)"), ("FREQS", "0x00 (10 MHz)"),
                                                  ("FREQAGS", "0x7C (AGSMIN)")])
        slow = self.path("slow.toml", "[chip]\nf_clk_hz = 16_000_000\n[host]\nma_hz = 100_000\n" +
                         slave("data_bits = 28"))
        # FREQS 0x17: f_CLK / 20 / (23 - 15) = 100 kHz; FREQR 5: f_MA / 64.
        self.assertEqual(rows(slow, "FREQS", "FREQR"), [("FREQR", "0x05 (1.5625 kHz)"), ("FREQS", "0x17 (100 kHz)")])
        self.assert_one_line(run("regs", RESOLUTE, "CFGHC1"), 2,
                             r"^mb4sim: no field has 'CFGHC1' in its name, did you mean 'CFGCH1'\?$")

    def test_regs_after_reset(self):
        result = run("regs", RESOLUTE, "--reset", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(result.stdout)
        self.assertEqual(document["registers"][0xC0:0xE8], [0] * 0x28)
        self.assertEqual(document["registers"][0xEB], 0x84)

    # --- sweep -------------------------------------------------------------------------------

    def test_sweep_wrong_use_is_status_2_and_one_line(self):
        for arguments, pattern in (
                ([], "scenario"), (["--delays", ""], "--delays: '': expected a number"),
                (["--delays", "1:2"], "three parts"), (["--delays", "2:1:1"], "ends before"),
                (["--delays", "0:1:0"], "step must be above 0"),
                (["--delays", "-1"], "expected a number of 0 to 1"),
                (["--delays", "0:1000000:1"], "more than 2000 values"),
                (["--delays", "0.0001"], "expected a number"),
                (["--jitters", "10%"], "--jitters: '10%'"), (["--jitters", "1,,2"], "expected"),
                (["--jitters", "nan"], "expected a number"),
                (["--skews", "101"], "--skews: '101': expected a number of -100 to 100"),
                (["--skews", "x"], "--skews: 'x'"),
                (["--freqs", "32"], "whole number of 0 to 31"), (["--freqs", "1.5"], "whole"),
                (["--freqs", "16"], "does not permit code 16"), (["--frames", "0"], "--frames"),
                (["--delays", "0:1999:1", "--jitters", "0:999:1"], "points are more than"),
                (["--svg", ""], "file name"), (["--svg", "/no/such/a.svg"], "cannot write"),
                (["--svg", RESOLUTE], "would replace the input"), (["--fast"], "--fast"),
                (["--csv", self.path("x"), "--svg", self.path("x")], "is the same file")):
            with self.subTest(arguments):
                result = run("sweep", *([RESOLUTE] if arguments else []), *arguments)
                self.assert_one_line(result, 2, pattern)
                self.assertEqual(result.stdout, "")
        self.assertEqual(os.listdir(self.folder.name), [])
        bad = self.path("bad.toml", slave("data_bits = 28") + "x = 1\n")
        self.assert_one_line(run("sweep", bad), 2, r":6:1: key 'x': unknown key")
        slow = self.path("slow.toml", "[chip]\nf_clk_hz = 25_000_001\n" + slave("data_bits = 28"))
        self.assert_one_line(run("sweep", slow), 2, r":2:12: key 'f_clk_hz': ")

    def test_sweep_shows_the_margin_as_text_csv_and_picture(self):
        def sweep(*arguments):
            return run("sweep", RESOLUTE, "--delays", "0:90:30", "--jitters", "0,25,100",
                       "--freqs", "0,1", "--frames", "12", "--csv", self.path("a.csv"), "--svg",
                       self.path("a.svg"), *arguments)
        result = sweep()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("jitter up to 25 % (I305): all good; seed 1\n", result.stdout)
        with open(self.path("a.csv"), encoding="utf-8") as file:
            content = file.read()
        rows = list(csv.DictReader(content.splitlines()))
        self.assertEqual([(row["freqs"], row["ma_hz"], row["delay_ns"], row["jitter_percent"])
                          for row in rows],
                         [(freqs, ma, delay, jitter)
                          for freqs, ma in (("0", "10000000"), ("1", "5000000"))
                          for delay in ("0", "30", "60", "90") for jitter in ("0", "25", "100")])
        for row in rows:
            self.assertEqual(row["words"], "12")
            bad = int(row["flagged"]) + int(row["wrong"])
            self.assertEqual(bad != 0, row["jitter_percent"] == "100", row)
        total = sum(int(row["flagged"]) for row in rows)
        self.assertIn(f"words 288, flagged {total}, ", result.stdout)
        picture = xml.etree.ElementTree.parse(self.path("a.svg")).getroot()
        self.assertEqual(picture.tag, "{http://www.w3.org/2000/svg}svg")
        colours = [node.get("fill") for node in picture.iter("{http://www.w3.org/2000/svg}rect")]
        # Two thirds of 24 cells are green, and one field of the legend.
        self.assertEqual(colours.count("#4caf50"), 16 + 1)
        self.assertEqual(colours.count("none"), 2)
        # The same seed repeats all of it, another does not.
        self.assertEqual(sweep().stdout, result.stdout)
        with open(self.path("a.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read(), content)
        self.assertNotEqual(sweep("--seed", "2").stdout, result.stdout)
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["a.csv", "a.svg"])

    def test_sweep_picture_has_room_for_its_labels(self):
        name = "x" * 50 + "\u00e9" * 39 + ".toml"  # cut inside of a character
        scenario = self.path(name, slave("data_bits = 28"))
        svg = "{http://www.w3.org/2000/svg}"
        for delays, expected in (("0,10,500", ["0", "100", "200", "300", "400", "500"]),
                                 ("0:1200:10", ["0", "200", "400", "600", "800", "1000", "1200"]),
                                 ("17", ["17"])):
            result = run("sweep", scenario, "--delays", delays, "--jitters", "0", "--frames", "1",
                         "--svg", self.path("a.svg"))
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn(": 1 frame at each point", result.stdout)
            self.assertIn("\nFREQS 0x00: MA 10000 kHz, T_MA 100 ns; bad words", result.stdout)
            texts = list(xml.etree.ElementTree.parse(self.path("a.svg")).getroot().iter(svg + "text"))
            labels = [t for t in texts if t.get("class") == "mid" and t.text.isdigit()]
            self.assertEqual([t.text for t in labels], expected)
            places = [float(t.get("x")) for t in labels]
            for left, right in zip(places, places[1:]):
                self.assertGreater(right - left, 40)
            title = next(t.text for t in texts if t.get("class") == "title")
            self.assertLess(len(title), 90)
            self.assertIn("\u00e9.toml, 1 frame at each point, seed 1", title)
        # The turned title of the other axis has room beside long numbers.
        result = run("sweep", scenario, "--delays", "0", "--jitters", "12.345,12.349", "--frames",
                     "1", "--svg", self.path("a.svg"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        texts = list(xml.etree.ElementTree.parse(self.path("a.svg")).getroot().iter(svg + "text"))
        turned = next(t.get("transform") for t in texts if t.get("transform"))
        title = float(re.match(r"translate\(([\d.]+)", turned).group(1))
        ends = [t for t in texts if t.get("class") == "end"]
        self.assertIn("12.346", [t.text for t in ends])
        for label in ends:
            self.assertGreater(float(label.get("x")) - 7.7 * len(label.text), title + 3)

    def test_sweep_is_status_1_when_a_frame_within_i305_is_bad(self):
        # Rising edges 40 % of T_MA late at every jitter.
        skewed = self.path("skew.toml", "[[channel]]\nnumber = 1\nskew_ns = -40\n"
                           "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n")
        result = run("sweep", skewed, "--delays", "20", "--jitters", "0", "--frames", "3")
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn("jitter up to 25 % (I305): BAD", result.stdout)
        result = run("sweep", RESOLUTE, "--delays", "0", "--jitters", "80", "--frames", "5")
        self.assertEqual(result.returncode, 0)
        self.assertIn("not tried", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
