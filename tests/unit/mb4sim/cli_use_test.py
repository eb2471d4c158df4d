# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""mb4sim used wrongly, asked for help, interrupted, fed with files without end.

Usage: cli_use_test.py MB4SIM EXAMPLES
"""
import contextlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest

from cli import EXAMPLES, MB4SIM, RESOLUTE, CliTest, run, slave

BISS_C = "[[channel.slave]]\nprotocol = \"biss-c\"\n"


class Words(CliTest):
    def test_help_and_version_in_every_usual_way(self):
        self.assertEqual(run("-V").stdout, run("--version").stdout)
        self.assertEqual(run("help").stdout, run("--help").stdout)
        for command in ("run", "sweep", "help"):
            result = run("help", command)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(result.stdout, run(command, "--help").stdout)
        self.assert_one_line(run("help", "rum"), 2,
                             r"^mb4sim: there is no command 'rum', did you mean 'run'\?$")

    def test_unknown_words_are_named_as_typed_with_a_suggestion(self):
        for arguments, message in (
                (["fly"], r"unknown: 'fly' \(see mb4sim --help\)"),
                (["rum", RESOLUTE], r"unknown: 'rum', did you mean 'run'\? \(see mb4sim --help\)"),
                (["rgress", "--jobs", "2"],
                 r"unknown: 'rgress', did you mean 'regress'\? \(see mb4sim --help\)"),
                (["--versoin"], r"unknown: '--versoin', did you mean '--version'\? "),
                (["run", RESOLUTE, "y", "--frams", "3", "--jsn"],
                 r"unknown: 'y', '--frams', did you mean '--frames'\?, '3', '--jsn', did you mean "
                 r"'--json'\? \(see mb4sim run --help\)"),
                (["run", "--frams=3", RESOLUTE],
                 r"unknown: '--frams=3', did you mean '--frames'\? \(see mb4sim run --help\)"),
                (["run", RESOLUTE, "--trace-f", "1"],
                 r"unknown: '--trace-f', did you mean '--trace-from'\?, '1' "),
                # An unknown key is reported before a missing one or a bad value.
                (["run", "--quick"], r"unknown: '--quick' \(see mb4sim run --help\)"),
                (["run", RESOLUTE, "--frames", "x", "--quick"], r"unknown: '--quick' "),
                (["--eds", "scan", RESOLUTE],
                 r"unknown: '--eds', which goes behind the command \(see mb4sim scan --help\)"),
                (["presets", "resolut-26"],
                 r"there is no preset 'resolut-26', did you mean 'resolute-26'\?")):
            with self.subTest(arguments):
                self.assert_one_line(run(*arguments), 2, "^mb4sim: " + message)
        self.assertNotIn("did you mean", run("presets", "xyz").stderr)

    def test_examples_of_the_readme_write_into_the_build_folder(self):
        with open(os.path.join(EXAMPLES, "..", "README.md"), encoding="utf-8") as file:
            written = re.findall(r" --(?:trace|svg|csv|vcd|bus-log)[ =](\S+)", file.read())
        self.assertGreater(len(written), 2)
        self.assertEqual([name for name in written if not name.startswith("build/")], [])

    def test_waveforms_are_not_written_under_the_name_of_a_vcd(self):
        for command, more in (("run", []), ("bridge", ["--tcp", "0", "--once"]),
                              ("spidev", ["--", "true"])):
            for name in ("x.vcd", "x.VCD"):
                trace = self.path(name)
                scenario = ["--scenario"] if command == "spidev" else []
                result = run(command, *scenario, RESOLUTE, "--trace", trace, *more)
                self.assert_one_line(result, 2, r"^mb4sim: --trace: .*x\.(vcd|VCD): .*FST")
                self.assertEqual(os.listdir(self.folder.name), [])


class Keys(CliTest):
    """An unknown key is named before a missing one: it is what was meant, misspelt."""

    def test_unknown_key_before_missing_one(self):
        # The line of each unknown key.
        for text, key, line, *column in (
                ("[[channel]]\nnumber = 1\n" + BISS_C + "data_bit = 28\n", "data_bit", 5),
                ("[[channel]]\nnumber = 1\ncabel_m = 10\n" + BISS_C, "cabel_m", 3),
                ("[[channel]]\nnummer = 1\n" + BISS_C + "data_bits = 8\n", "nummer", 2),
                ("[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocoll = \"ssi\"\ngray = true\n",
                 "protocoll", 4),
                ("[[channel]]\nnumber = 1\n" + BISS_C + "data_bits = 28\nsource = \"sine\"\n"
                 "amplitud = 5\nperiod = 1\n", "amplitud", 7),
                ("[[channel]]\nnumber = 1\n" + BISS_C + "data_bits = 28\nsource = \"file\"\n"
                 "files = \"x\"\n", "files", 7),
                ("[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"replay\"\n"
                 "edge = \"x\"\ndata_bits = 8\n", "edge", 5),
                # Known to another protocol, unknown to this one.
                ("[[channel]]\nnumber = 1\n" + BISS_C + "gray = true\n", "gray", 5),
                ("[[channel]]\nnumber = 1\n[[channel.event]]\nat = 1\n" + BISS_C, "at", 4),
                ("[[chanel]]\nnumber = 1\n" + "[[fault]]\nkind = \"silent\"\n", "chanel", 1, 3),
                (slave("data_bits = 8") + "[[fault]]\nkin = \"stuck\"\nlevel = 1\n", "kin", 7),
                (slave("data_bits = 8") + "[[fault]]\nkind = \"stuck\"\nat_us = 1\nlevl = 1\n",
                 "levl", 9),
                (slave("data_bits = 8") + "[[fault]]\nkind = \"silent\"\nat_us = 1\nslav = 1\n",
                 "slav", 9),
                (slave("data_bits = 8") + "[[fault]]\nkind = \"abort\"\nat = 1\n", "at", 8),
                (slave("data_bits = 8") + "[[fault]]\nkind = \"busy\"\nslave = 1\nper_s = 1\n"
                 "for = 1\n", "for", 10),
                # In a table further down than what is missing.
                ("[[channel]]\nnumber = 1\n[[channel.slave]]\ndata_bits = 8\n[[fault]]\nx = 1\n",
                 "x", 6)):
            with self.subTest(text):
                result = run("run", self.path("x.toml", text))
                self.assert_one_line(result, 2, rf"x\.toml:{line}:{(column or [1])[0]}: "
                                     rf"key '{key}': unknown key[,;] ")

    def test_without_unknown_keys_the_missing_one_is_named(self):
        for text, place in (
                ("[[channel]]\nnumber = 1\n[[channel.slave]]\ngray = true\nbusy_periods = 1\n"
                 "edges = \"x\"\n", r":3:1: key 'protocol': missing"),
                ("[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"ssi\"\n"
                 "[[channel.slave]]\nprotocol = \"biss-c\"\n", r":3:1: key 'data_bits': missing"),
                (slave("data_bits = 8") + "[[fault]]\nlevel = 1\nslave = 1\nhz = 1\n",
                 r":6:1: key 'kind': missing"),
                (slave("data_bits = 8") + "[[fault]]\nkind = \"silent\"\nfor_us = 1\n",
                 r":6:1: key 'at_us': one of"),
                ("[[channel]]\n" + BISS_C + "data = 1\n[[channel]]\nnumber = 2\n",
                 r":2:1: key 'data_bits': missing")):
            with self.subTest(text):
                self.assert_one_line(run("run", self.path("x.toml", text)), 2, "x.toml" + place)


class Json(CliTest):
    def only(self, result, status):
        """The one JSON object on standard error."""
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        return json.loads(result.stderr)

    def test_errors_are_json_on_standard_error(self):
        bad = self.path("bad.toml", "[chip]\n\"f\\u0001\\\"k\" = 1\n")
        for command in ("run", "regs", "scan"):
            told = self.only(run(command, bad, "--json"), 2)
            plain = run(command, bad).stderr
            self.assertEqual(f"mb4sim: {told['error']}\n", plain)
            self.assertEqual(told["status"], 2)
        for arguments in (["run", "--json"], ["run", RESOLUTE, "--json", "--frames", "x"],
                          ["presets", "--json", "nobody"], ["bench", "--json", "--workload", "X"],
                          ["rum", "--json"], ["run", RESOLUTE, "--json", "--csv", "/no/such/x"]):
            with self.subTest(arguments):
                told = self.only(run(*arguments), 2)
                self.assertEqual(f"mb4sim: {told['error']}\n", self.plain(arguments))
        told = self.only(run("regs", b"/no/\xff\x01.toml", "--json"), 2)
        self.assertIn("/no/\ufffd\\x01.toml: cannot read", told["error"])
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([MB4SIM, "run", RESOLUTE, "--json"], stdout=full, text=True,
                                    stderr=subprocess.PIPE, timeout=60, check=False)
        self.assertEqual(self.only(result, 2)["error"], "cannot write to standard output")

    def plain(self, arguments):
        """What the same mistake says without --json."""
        return run(*[word for word in arguments if word != "--json"]).stderr

    def test_a_chip_that_cannot_be_configured_is_told_in_both(self):
        dead = self.path("x.toml", slave("data_bits = 28") +
                         "[[fault]]\nkind = \"abort\"\nper_s = 100_000\n")
        result = run("run", dead, "--json")
        told = self.only(result, 1)
        self.assertRegex(told["error"], "^cannot configure the chip: ")
        report = json.loads(result.stdout)
        self.assertEqual((report["frames"], report["error"]), ([], told["error"]))

    def test_notes_are_json_as_well(self):
        result = run("run", RESOLUTE, "--json", "--trace", self.path("a.fst"), "--trace-error", "1")
        self.assertRegex(self.only(result, 0)["note"], r"no bad frame, so .*a\.fst was not written")
        fault = slave("preset = \"lika-sma1\"") + \
            "[[fault]]\nkind = \"wrong-id\"\nslave = 1\nat_us = 5\n"
        for command in ("regs", "scan"):
            told = self.only(run(command, self.path("x.toml", fault), "--json"), 0)
            self.assertEqual(told["note"], "fault 1 at 5.000 us: slave 1 answers to a wrong ID")


class Interrupted(CliTest):
    def start(self, *arguments, **options):
        return subprocess.Popen([MB4SIM, *arguments], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, **options)

    def rest(self, process):
        """What it still prints until it ends."""
        timer = threading.Timer(60, process.kill)
        timer.start()
        texts = process.stdout.read(), process.stderr.read()
        process.wait()
        timer.cancel()
        return texts

    def test_an_interrupted_run_ends_what_it_prints(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number), self.start(
                    "run", RESOLUTE, "--frames", "1000000000", "--json", "--csv", self.path("a.csv"),
                    "--trace", self.path("a.fst")) as process:
                head = [process.stdout.readline() for _ in range(3)]
                process.send_signal(number)
                rest, errors = self.rest(process)
                # The command completes its output and then ends by the signal, as callers expect.
                self.assertEqual(process.returncode, -number)
                report = json.loads("".join(head) + rest)
                name = number.name
                self.assertEqual(report["error"], f"interrupted by {name}")
                self.assertEqual(json.loads(errors), {"error": f"interrupted by {name}",
                                                      "status": 128 + number})
                self.assertGreater(len(report["frames"]), 1)
                self.assertEqual(report["summary"]["good"], len(report["frames"]))
            # The waveform can be looked at; tables appear complete or not at all.
            self.assertEqual(sorted(os.listdir(self.folder.name)), ["a.fst", "a.gtkw"])

    def test_text_ends_with_its_summary(self):
        with self.start("run", RESOLUTE, "--frames", "1000000000") as process:
            process.stdout.readline()
            process.send_signal(signal.SIGINT)
            rest, errors = self.rest(process)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertRegex(rest.splitlines()[-1], r"^frames good \d+, bad 0; ")
        self.assertEqual(errors, "mb4sim: interrupted by SIGINT\n")

    def test_an_ignored_signal_stays_ignored(self):
        with self.start("run", RESOLUTE, "--frames", "3000",
                        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)) as process:
            process.stdout.readline()
            process.send_signal(signal.SIGHUP)
            rest = self.rest(process)[0]
        self.assertEqual(process.returncode, 0)
        self.assertIn("frames good 3000, bad 0", rest)


class Workers(CliTest):
    """regress leaves no process behind."""

    def workers_of(self, process):
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
            return [int(word) for word in file.read().split()]

    def alive(self, worker):
        """A zombie counts as alive, because no process has waited for it."""
        return os.path.exists(f"/proc/{worker}")

    def started(self, **options):
        process = subprocess.Popen([MB4SIM, "regress", RESOLUTE, "--seeds", "8", "--frames",
                                    "100000000", "--jobs", "3"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        limit = time.monotonic() + 30
        while len(self.workers_of(process)) < 3:
            self.assertLess(time.monotonic(), limit)
            self.assertIsNone(process.poll())
        workers = self.workers_of(process)
        for worker in workers:
            self.addCleanup(self.kill, worker)
        return process, workers

    def kill(self, worker):
        with contextlib.suppress(ProcessLookupError):
            os.kill(worker, signal.SIGKILL)

    def test_signals_end_the_workers_before_the_command_is_gone(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(number.name):
                process, workers = self.started()
                process.send_signal(number)
                _, errors = process.communicate(timeout=30)
                self.assertEqual([worker for worker in workers if self.alive(worker)], [])
                self.assertEqual(process.returncode, -number)
                self.assertEqual(errors, f"mb4sim: interrupted by {number.name}\n")

    def test_a_killed_command_takes_its_workers_along(self):
        process, workers = self.started()
        process.kill()
        process.communicate(timeout=30)  # its pipes are closed when the last worker has gone
        limit = time.monotonic() + 30
        while any(self.running(worker) for worker in workers):
            self.assertLess(time.monotonic(), limit)

    def running(self, worker):
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):
            with open(f"/proc/{worker}/stat", encoding="ascii") as file:
                return file.read().rsplit(")", 1)[1].split()[0] not in "ZX"
        return False

    def test_an_ignored_hangup_stays_ignored(self):
        process, _ = self.started(
            preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        with self.assertRaises(subprocess.TimeoutExpired):
            process.wait(timeout=0.5)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, -signal.SIGTERM)


class Files(CliTest):
    """Files without end, and files too large to be written by hand."""

    def limited(self, *arguments, stdin=subprocess.DEVNULL):
        """With 20 s and, unless it is built with AddressSanitizer, 1 GiB of memory."""
        def less_memory():
            resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))
        works = subprocess.run([MB4SIM, "--version"], preexec_fn=less_memory, timeout=20,
                               capture_output=True, check=False).returncode == 0
        return subprocess.run([MB4SIM, *arguments], stdin=stdin, capture_output=True, text=True,
                              timeout=20, check=False, preexec_fn=less_memory if works else None)

    def test_scenarios_without_end(self):
        for name in ("/dev/zero", "/dev/full"):
            for command in (["regress", RESOLUTE], ["run"], ["spi"], ["plot"], ["sweep"]):
                with self.subTest(name=name, command=command):
                    self.assert_one_line(self.limited(*command, name), 2,
                                         rf"^mb4sim: {name}: cannot read: more than 16 MiB$")

    def test_files_of_a_scenario_without_end(self):
        words = slave("data_bits = 8\nsource = \"file\"\nfile = \"/dev/zero\"")
        edges = "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"replay\"\n" \
                "data_bits = 8\nedges = \"/dev/zero\"\n"
        for text, key in ((words, "file"), (edges, "edges")):
            self.assert_one_line(self.limited("regress", self.path("x.toml", text)), 2,
                                 rf"key '{key}': /dev/zero: cannot read: more than 16 MiB")

    def test_a_size_of_16_mib_is_read_and_one_more_is_not(self):
        good = slave("data_bits = 28") + "#"
        exact = self.path("exact.toml", good + "x" * (2**24 - len(good) - 1) + "\n")
        self.assertEqual(self.limited("regress", exact, "--frames", "1").returncode, 0)
        over = self.path("over.toml", good + "x" * (2**24 - len(good)) + "\n")
        self.assert_one_line(self.limited("regress", over), 2, "more than 16 MiB")

    def test_a_line_of_spi_without_end(self):
        with open("/dev/zero", "rb") as zero:
            result = self.limited("spi", RESOLUTE, stdin=zero)
        self.assert_one_line(result, 2, "^mb4sim: standard input:1: the line is longer than 1 MiB$")


class Pairs(CliTest):
    TWO = slave("data_bits = 28") + "[[channel]]\nnumber = 2\n" + BISS_C + "data_bits = 28\n"
    WARNING = (r"^mb4sim: CFGIF makes the pins of line 2 the inverse ones of line 1: channel 2 of "
               r"the scenario is not connected$")

    def test_the_channel_that_cfgif_takes_away_is_named(self):
        two = self.path("two.toml", self.TWO)
        for value in ("08", "0C"):
            # Once, however often it is written.
            result = run("spi", two, text=f"02 F5 {value}\n02 F5 00\n02 F5 {value}\n")
            self.assert_one_line(result, 0, self.WARNING)
        for value in ("00", "04"):
            self.assertEqual(run("spi", two, text=f"02 F5 {value}\n").stderr, "")
        # A scenario without the channel gives no warning.
        one = self.path("one.toml", slave("data_bits = 28"))
        self.assertEqual(run("spi", one, text="02 F5 08\n").stderr, "")

    def test_drop_ins_name_it_as_well(self):
        two = self.path("two.toml", self.TWO)
        program = ["sh", "-c", "printf '\\002\\365\\010' | spi-pipe -d /dev/spidev0.0 -b 3 -n 1"]
        if shutil.which("spi-pipe") is None:
            self.skipTest("spi-pipe is not installed (package spi-tools)")
        result = run("spidev", "--scenario", two, "--", *program)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, "(?m)" + self.WARNING)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
