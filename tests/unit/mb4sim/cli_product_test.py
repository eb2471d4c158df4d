# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""mb4sim as a product: waveform windows, progress, presets, scan, regressions, help pages.

Usage: cli_product_test.py MB4SIM EXAMPLES
"""
import json
import os
import pty
import re
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

from cli import EXAMPLES, MB4SIM, RESOLUTE, CliTest, run, slave

BUS = os.path.join(EXAMPLES, "control-bus.toml")
COMMANDS = ("run", "watch", "check", "spi", "regs", "scan", "sweep", "regress", "presets", "schema", "bench",
            "completion", "man", "spidev", "bridge", "plot", "help")
FLIP = "[[fault]]\nkind = \"bit-flip\"\nbits = [4]\nat_us = 1000\n"


def long_options(command):
    """Long options as --help lists them."""
    return set(re.findall(r"(?m)^ +(?:-h,)?(--[\w-]+)", run(command, "--help").stdout))


class Trace(CliTest):
    def times_us(self, name):
        """First and last time at which something changes in a waveform."""
        if shutil.which("fst2vcd") is None:
            self.skipTest("fst2vcd is not installed (package gtkwave)")
        text = subprocess.run(["fst2vcd", self.path(name)], capture_output=True, text=True,
                              timeout=60, check=True).stdout
        times = [int(line[1:]) / 1e6 for line in text.splitlines() if line.startswith("#")]
        return times[0], times[-1]

    def test_window_holds_nothing_else(self):
        result = run("run", RESOLUTE, "--frames", "20", "--trace", self.path("a.fst"),
                     "--trace-from", "200", "--trace-to", "260.5")
        self.assertEqual(result.returncode, 0, result.stderr)
        first, last = self.times_us("a.fst")
        # Half a period of CLK is 25 ns; what happens at one time is shown 1 ps apart.
        self.assertTrue(200 <= first <= 200.026, first)
        self.assertTrue(260.474 <= last <= 260.501, last)
        with open(self.path("a.gtkw"), encoding="utf-8") as file:
            view = file.read()
        self.assertIn(f"[timestart] {round(first * 1e6)}\n", view)
        # The window does not change what the command prints.
        self.assertEqual(result.stdout, run("run", RESOLUTE, "--frames", "20").stdout)

    def test_states_are_shown_by_name(self):
        run("run", RESOLUTE, "--frames", "1", "--trace", self.path("a.fst"))
        with open(self.path("a.gtkw"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        named = [lines[i + 1] for i, line in enumerate(lines) if line == "@100000028"]
        self.assertTrue(any(name.endswith(".state_q[2:0]") for name in named), named)
        self.assertFalse([name for name in named if "addr" in name or "data" in name])

    def test_pins_have_the_names_of_the_interface_in_use(self):
        top = "mb4.mb4sim_trace_top."
        # Page 3. Bits count from the left: (7) is bit 0.
        spi = {"NCS": "ncs_i", "SCLK": "ale_i", "MOSI": "(7)db_i[7:0]", "MISO": "(6)db_o[7:0]"}
        second = {"NCS of SPI2": "(3)db_i[7:0]", "SCLK of SPI2": "(2)db_i[7:0]",
                  "MOSI of SPI2": "(1)db_i[7:0]", "MISO of SPI2": "(0)db_o[7:0]"}
        bus = {"NCS": "ncs_i", "ALE": "ale_i", "DB in": "db_i[7:0]", "DB out": "db_o[7:0]"}
        intel = {**bus, "NWR": "nwr_e_i", "NRD": "nrd_rnw_i"}
        motorola = {**bus, "E": "nwr_e_i", "RNW": "nrd_rnw_i"}
        for interface, own, others in (("spi", spi, {**second, **intel, **motorola}),
                                       ("spi2", {**spi, **second}, {**intel, **motorola}),
                                       ("intel", intel, {**spi, **second, **motorola}),
                                       ("motorola", motorola, {**spi, **second, **intel})):
            with self.subTest(interface):
                scenario = self.path("x.toml", f"[host]\ninterface = \"{interface}\"\n" +
                                     slave("data_bits = 28"))
                trace = ["--trace", self.path("a.fst"), "--frames", "1"]
                self.assertEqual(run("run", scenario, *trace).returncode, 0)
                with open(self.path("a.gtkw"), encoding="utf-8") as file:
                    view = file.read()
                host = view.split("\n-host\n")[1]
                named = dict(re.findall(r"(?m)^\+\{([^}]*)\} (.*)$", host))
                for name, signal in {**own, "NRES": "nres_i", "EOT": "eot_o"}.items():
                    self.assertEqual(named.get(name), re.sub(r"^(\(\d\))?", r"\1" + top, signal, 1))
                self.assertEqual(set(named) & (set(others) - set(own)), set())
                inside = [line for line in host.splitlines() if ".u_host." in line]
                self.assertTrue(inside)
                self.assertEqual(any(".u_par_bus." in line for line in inside),
                                 interface in ("intel", "motorola"))
                self.assertEqual(any(".u_spi2." in line for line in inside), interface == "spi2")
                lines = view.split("\n-line\n")[1]
                for name, signal in (("MA1", "ma1_o"), ("SL1", "sl1_i")):
                    self.assertIn(f"+{{{name}}} {top}{signal}\n", lines)

    def test_window_around_the_first_error(self):
        scenario = self.path("x.toml", slave("data_bits = 28") + FLIP)
        plain = run("run", scenario, "--frames", "60", "--json")
        bad = [row for row in json.loads(plain.stdout)["frames"] if not row["good"]]
        result = run("run", scenario, "--frames", "60", "--json", "--trace", self.path("a.fst"),
                     "--trace-error", "20")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stdout, plain.stdout)
        self.assertRegex(result.stderr, rf"a\.fst shows frame {bad[0]['frame']}, the first bad")
        first, last = self.times_us("a.fst")
        self.assertTrue(900 < first < 1000, first)
        self.assertAlmostEqual(last, bad[0]["time_us"] + 20, delta=0.1)

    def test_no_error_no_waveform(self):
        result = run("run", RESOLUTE, "--trace", self.path("a.fst"), "--trace-error", "20")
        self.assert_one_line(result, 0, r"no bad frame, so .*a\.fst was not written")
        self.assertEqual(os.listdir(self.folder.name), [])

    def test_frame_with_waveform_costs_less_than_sixty_without(self):
        def used(frames, *arguments):
            begin = os.times()
            run("run", RESOLUTE, "--frames", str(frames), *arguments)
            end = os.times()
            return (end.children_user + end.children_system - begin.children_user -
                    begin.children_system) / frames

        # The test compares two times of one run, because the machine, its other work and sanitizers
        # change both. Each is many times the 10 ms in which some kernels count. Without a waveform
        # most parts of the model rest.
        plain = min(used(4000) for _ in range(2))
        traced = min(used(400, "--trace", self.path("a.fst")) for _ in range(2))
        self.assertLess(traced, 60 * plain)

    def test_wrong_windows(self):
        trace = ["--trace", self.path("a.fst")]
        for arguments, message in ((["--trace-from", "1"], "--trace-from: needs --trace"),
                                   (["--trace-to", "1"], "--trace-to: needs --trace"),
                                   (["--trace-error", "1"], "--trace-error: needs --trace"),
                                   ([*trace, "--trace-from", "2", "--trace-to", "1"],
                                    "--trace-to: is before"),
                                   ([*trace, "--trace-error", "2", "--trace-to", "1"],
                                    "not together"),
                                   ([*trace, "--trace-from", "-1"], "is no time of 0"),
                                   ([*trace, "--trace-from", "1e3"], "is no time of 0"),
                                   ([*trace, "--trace-from", "x"], "is no time of 0")):
            with self.subTest(arguments):
                self.assert_one_line(run("run", RESOLUTE, *arguments), 2, message)
                self.assertEqual(os.listdir(self.folder.name), [])


class Run(CliTest):
    def test_progress_is_for_terminals_only(self):
        arguments = ["run", RESOLUTE, "--frames", "60000"]
        master, terminal = pty.openpty()
        with subprocess.Popen([MB4SIM, *arguments], stdout=subprocess.DEVNULL, stderr=terminal,
                              stdin=subprocess.DEVNULL) as process:
            os.close(terminal)
            seen = b""
            while True:
                try:
                    part = os.read(master, 4096)
                except OSError:
                    break
                if not part:
                    break
                seen += part
            self.assertEqual(process.wait(timeout=60), 0)
        os.close(master)
        self.assertRegex(seen.decode(), r"\[#+ *\] +\d+ %  \d+ of 60000, \d+ s left")
        # The command leaves no file behind.
        self.assertTrue(seen.endswith(b"\r\x1b[K"), seen[-80:])

    def test_no_terminal_no_progress(self):
        with subprocess.Popen([MB4SIM, "run", RESOLUTE, "--frames", "1500"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            self.assertEqual(process.communicate(timeout=60)[1], b"")

    def test_two_runs_are_byte_identical(self):
        scenario = self.path("x.toml", slave("data_bits = 28\nsource = \"ramp\"").replace(
            "number = 1", "number = 1\njitter_ns = 24\nglitches_per_s = 900") +
            "[[fault]]\nkind = \"bit-flip\"\nper_s = 900\n")
        outputs = []
        for name in ("a", "b"):
            result = run("run", scenario, "--frames", "200", "--seed", "7", "--csv",
                         self.path(name), "--bus-log", self.path(name + ".bus"))
            with open(self.path(name), "rb") as csv, open(self.path(name + ".bus"), "rb") as log:
                outputs.append((result.stdout, csv.read(), log.read()))
        self.assertEqual(outputs[0], outputs[1])
        self.assertNotEqual(outputs[0][0], run("run", scenario, "--frames", "200").stdout)


class Presets(CliTest):
    def test_every_preset_makes_a_scenario_that_can_be_driven(self):
        listed = json.loads(run("presets", "--json").stdout)
        table = run("presets").stdout.splitlines()[1:]
        self.assertEqual([line.split()[0] for line in table], [one["preset"] for one in listed])
        self.assertGreater(len(listed), 15)
        for one in listed:
            with self.subTest(one["preset"]):
                scenario = self.path("x.toml", run("presets", one["preset"]).stdout)
                result = run("spi", scenario, text="03 EA 00 00\n")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertEqual(run("run", scenario, "--frames", "3").returncode, 0)

    def test_published_figures(self):
        listed = {one["preset"]: one for one in json.loads(run("presets", "--json").stdout)}
        # Renishaw L-9709-9005: 26 bits, two flags, CRC6 0x43, unidirectional.
        self.assertEqual(listed["resolute-26"], {
            "preset": "resolute-26", "protocol": "biss-c", "data_bits": 28, "flag_bits": 2,
            "crc": "0x43", "timeout": "adaptive", "registers": False,
            "encoder": "Renishaw RESOLUTE, 26 bits"})
        self.assertIsNone(listed["ic-mu"]["data_bits"])
        self.assertIsNone(listed["tr-ce-65"]["crc"])
        self.assertEqual(listed["posital-ssi-25"]["protocol"], "ssi")

    def test_unknown_preset(self):
        self.assert_one_line(run("presets", "x\ny"), 2, r"there is no preset 'x\\ny'")


class Scan(CliTest):
    def test_bus_of_three_is_found_with_ids_and_eds(self):
        result = run("scan", BUS, "--json", "--eds")
        self.assertEqual(result.returncode, 0, result.stderr)
        slaves = json.loads(result.stdout)["slaves"]
        # IDs count from the far end; names as the scenario's presets publish them.
        self.assertEqual([(one["channel"], one["id"]) for one in slaves], [(1, 0), (1, 1), (1, 2)])
        names = [bytes.fromhex(one["device_id"]) for one in slaves]
        self.assertEqual(names[:2], [b"MB4SIM", b"SMA1\0\0"])
        self.assertEqual(slaves[2]["manufacturer"], "57 41")
        self.assertEqual([one["eds_bank"] for one in slaves], [2, None, None])
        eds = bytes.fromhex(slaves[0]["eds"])
        # Common page: version, length, one data channel, its page in bank 3, 26 bits, CRC 0x25.
        self.assertEqual((eds[0], eds[1], eds[0x10], eds[0x14], eds[0x15], eds[0x17]),
                         (1, 1, 1, 3, 26, 0x25))
        text = run("scan", BUS, "--eds").stdout
        self.assertIn("data channel 1: page in bank 3, 26 bits, sensor, CRC 0x25", text)

    def test_who_does_not_answer_is_said(self):
        self.assertIn("channel 1: nobody answers", run("scan", RESOLUTE).stdout)
        ssi = self.path("x.toml", "[[channel]]\nnumber = 2\n[[channel.slave]]\n"
                        "protocol = \"ssi\"\ndata_bits = 13\n")
        self.assertIn("channel 2: not scanned, only BiSS C", run("scan", ssi).stdout)
        empty = self.path("e.toml", "[chip]\n")
        self.assert_one_line(run("scan", empty), 2, "key 'channel': missing")

    def test_slave_with_a_wrong_id_is_not_found(self):
        scenario = self.path("x.toml", slave("preset = \"eds-sensor\"") +
                             "[[fault]]\nkind = \"wrong-id\"\nslave = 1\nat_us = 0\n")
        self.assertEqual(json.loads(run("scan", scenario, "--json").stdout)["slaves"], [])


class Regress(CliTest):
    def setUp(self):
        super().setUp()
        self.noisy = self.path("noisy.toml", slave("data_bits = 28\nsource = \"ramp\"") + FLIP +
                               "[[fault]]\nkind = \"bit-flip\"\nbits = [9]\nper_s = 2000\n")

    def test_output_does_not_depend_on_the_number_of_processes(self):
        arguments = ["regress", self.noisy, RESOLUTE, BUS, "--seeds", "6", "--frames", "60"]
        one = run(*arguments, "--jobs", "1")
        two = run(*arguments, "--jobs", "2")
        many = run(*arguments, "--jobs", "7")
        self.assertEqual((one.returncode, one.stderr), (1, ""))
        self.assertEqual((one.stdout, one.returncode), (two.stdout, two.returncode))
        self.assertEqual(one.stdout, many.stdout)
        rows = one.stdout.splitlines()[1:-1]
        self.assertEqual([int(row.split()[1]) for row in rows], [1, 2, 3, 4, 5, 6] * 3)
        # Seeds make a difference where something is random.
        self.assertGreater(len({tuple(row.split()[2:]) for row in rows[:6]}), 1)

    def test_row_says_what_run_says(self):
        row = run("regress", self.noisy, "--first-seed", "5", "--frames", "80").stdout
        report = json.loads(run("run", self.noisy, "--seed", "5", "--frames", "80", "--json").stdout)
        summary = report["summary"]
        self.assertEqual([int(n) for n in row.splitlines()[1].split()[1:6]],
                         [5, summary["good"], summary["bad"], len(report["faults"]), 0])

    def test_good_scenarios_are_status_0(self):
        result = run("regress", RESOLUTE, BUS, "--seeds", "2", "--frames", "5", "--jobs", "2")
        self.assertEqual(result.returncode, 0)
        self.assertTrue(result.stdout.endswith("runs 4, failed 0\n"))

    def test_cover_counts_over_runs_and_processes(self):
        files = []
        for jobs in ("1", "2"):
            files.append(Path(self.path(f"cover{jobs}.txt", "")))
            result = run("regress", RESOLUTE, self.noisy, "--seeds", "2", "--frames", "5", "--jobs",
                         jobs, "--cover", str(files[-1]))
            self.assertRegex(result.stdout, r"\nfunctional coverage \d+ of \d+ points\n$")
        lines = files[0].read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines, files[1].read_text(encoding="utf-8").splitlines())
        self.assertIn("20\tBiSS C frame, one\tENSCD1=1", lines)
        self.assertIn("0\tSSI frame, one\tENSCD1=1", lines)
        self.assert_one_line(run("regress", RESOLUTE, "--cover", "/no/such/file"), 2, "/no/such/file")
        self.assert_one_line(run("regress", RESOLUTE, "--cover", RESOLUTE), 2, "--cover")

    def test_shards_merge_to_the_whole(self):
        batch = ["regress", self.noisy, RESOLUTE, "--seeds", "4", "--frames", "20"]
        whole = run(*batch, "--cover", self.path("whole.txt", ""))
        for count in (1, 3, 8):
            files = []
            for number in range(1, count + 1):
                cover = self.path(f"{number}.txt", "")
                shard = run(*batch, "--shard", f"{number}/{count}", "--cover", cover)
                files.append(self.path(f"{number}.shard", shard.stdout))
            files.reverse()
            merged = run("regress", "--merge", *files, "--cover", self.path("merged.txt", ""))
            self.assertEqual((merged.stdout, merged.stderr), (whole.stdout, ""))
            self.assertEqual(merged.returncode, whole.returncode)
            self.assertEqual(Path(self.path("merged.txt")).read_bytes(),
                             Path(self.path("whole.txt")).read_bytes())

    def test_format_of_a_shard(self):
        # As docs/simulator.md describes it. Programs of users read it.
        shard = run("regress", RESOLUTE, BUS, "--seeds", "2", "--first-seed", "7", "--frames", "5",
                    "--shard", "2/3")
        self.assertEqual(shard.stdout.splitlines(), [
            "mb4sim-regress-1\t2\t3\t2\t2\t7\t5\t0",
            f"1\t0\t{RESOLUTE}\t8\t5\t0\t0\t0\tok\t", "end"])
        self.assertEqual(shard.returncode, 0)
        last = run("regress", RESOLUTE, BUS, "--seeds", "2", "--first-seed", "7", "--frames", "5",
                   "--shard", "1/3").stdout.splitlines()
        self.assertEqual([line.split("\t")[:4] for line in last[1:-1]],
                         [["0", "0", RESOLUTE, "7"], ["3", "0", BUS, "8"]])

    def test_shards_that_do_not_fit(self):
        def shard(name, *arguments):
            return self.path(name, run("regress", RESOLUTE, "--frames", "2", *arguments).stdout)
        one = shard("one", "--seeds", "4", "--shard", "1/2")
        two = shard("two", "--seeds", "4", "--shard", "2/2")
        other = shard("other", "--seeds", "6", "--shard", "2/2")
        text = Path(two).read_text(encoding="utf-8")
        lines = text.splitlines(keepends=True)
        wrong = {
            "cut": ("".join(lines[:-1]), r"cut:4: the end of the shard is missing"),
            "row": ("".join(lines[:2] + lines[3:]), r"row:3: no row of run 3"),
            "swapped": ("".join(lines[k] for k in (0, 2, 1, 3)), "swapped:2: no row of run 1"),
            "seed": (text.replace(f"{RESOLUTE}\t2\t", f"{RESOLUTE}\t9\t"),
                     "seed:2: no row of run 1"),
            "scenario": (text.replace(RESOLUTE, "else"), "scenario:2: run 1 has scenario else"),
            "binary": ("\0\1\2", "binary:1: no output of mb4sim regress --shard"),
            "empty": ("", "empty:1: cannot read, or empty"),
            "huge": (text.replace("-1\t2\t2\t1\t4", "-1\t2\t2\t1\t99999999"), "huge:1: no output"),
        }
        for name, (content, pattern) in wrong.items():
            with self.subTest(name=name):
                self.assert_one_line(run("regress", "--merge", one, self.path(name, content)), 2,
                                     pattern)
        for files, pattern in (([one], "shard 2 of 2 is missing"), ([one, one], "comes twice"),
                               ([one, other], "of another batch than"),
                               (["/no/such"], "/no/such"), (["/dev/zero"], "/dev/zero"),
                               ([one, two, "--cover", self.path("c")], "made without --cover"),
                               ([one, two, "--seeds", "3"], "--seeds")):
            with self.subTest(files=files):
                self.assert_one_line(run("regress", "--merge", *files), 2, pattern)
        for text in ("0/2", "3/2", "1", "1/", "/", "1/2/3", "-1/2", "1/0", "a/b"):
            with self.subTest(shard=text):
                self.assert_one_line(run("regress", RESOLUTE, "--shard", text), 2, "no K/N")

    def test_shard_without_runs(self):
        files = [self.path(f"{k}", run("regress", RESOLUTE, "--shard", f"{k}/3", "--frames", "2")
                           .stdout) for k in (1, 2, 3)]
        self.assertEqual(len(Path(files[2]).read_text(encoding="utf-8").splitlines()), 2)
        self.assertTrue(run("regress", "--merge", *files).stdout.endswith("runs 1, failed 0\n"))

    def test_mistakes(self):
        self.assert_one_line(run("regress"), 2, "^mb4sim: ")
        self.assert_one_line(run("regress", RESOLUTE, "/no/such.toml"), 2, "cannot read")
        self.assert_one_line(run("regress", RESOLUTE, "--jobs", "0"), 2, "no whole number of 1")
        self.assert_one_line(run("regress", RESOLUTE, "--seeds", "2", "--first-seed",
                                 str(2**64 - 1)), 2, "does not fit into 64 bits")


class Help(CliTest):
    def test_every_command_has_help_with_an_example(self):
        listed = re.findall(r"(?m)^  (\w+) {2,}\S", run("--help").stdout.split("Subcommands:")[1])
        self.assertLessEqual(set(COMMANDS), set(listed))
        for command in listed:
            result = run(command, "--help")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertRegex(result.stdout, rf"(?m)^Examples?: .*mb4sim {command}\b")

    def test_manual_page_says_what_help_says(self):
        page = run("man").stdout.replace("\\-", "-")
        for command in COMMANDS:
            part = page.split(f".SS {command}\n")[1].split(".SS ")[0]
            self.assertEqual(set(re.findall(r"(?m)^\.BI? (?:-h,)?(--[\w-]+)", part)),
                             long_options(command), command)
        if shutil.which("groff") is None:
            self.skipTest("groff is not installed")
        done = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-z"], input=run("man").stdout,
                              capture_output=True, text=True, timeout=60, check=True)
        self.assertEqual(done.stderr, "")

    def complete(self, script, words):
        """What bash offers for the last of these words."""
        command = (f"source '{script}'; COMP_WORDS=({' '.join(words)}); "
                   f"COMP_CWORD={len(words) - 1}; _mb4sim; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=60,
                              check=True, cwd=self.folder.name)
        return set(done.stdout.split())

    def test_bash_completes_commands_options_and_files(self):
        script = self.path("mb4sim.bash", run("completion", "bash").stdout)
        self.path("my.toml", "")
        self.assertLessEqual(set(COMMANDS), self.complete(script, ["mb4sim", "''"]))
        self.assertEqual(self.complete(script, ["mb4sim", "pre"]), {"presets"})
        for command in COMMANDS:
            self.assertEqual(self.complete(script, ["mb4sim", command, "--"]),
                             long_options(command), command)
        self.assertEqual(self.complete(script, ["mb4sim", "run", "my"]), {"my.toml"})

    def test_names_that_a_command_takes_complete(self):
        bash = self.path("mb4sim.bash", run("completion", "bash").stdout)
        zsh = run("completion", "zsh").stdout
        self.path("resolute-x.toml", "")
        names = [one["preset"] for one in json.loads(run("presets", "--json").stdout)]
        for command, known, word, found in (
                ("presets", names, "resolute", {n for n in names if n.startswith("resolute")}),
                ("help", COMMANDS, "sp", {"spi", "spidev"}),
                ("completion", ("bash", "zsh"), "z", {"zsh"})):
            self.assertEqual(self.complete(bash, ["mb4sim", command, word]), found)
            part = zsh.split(f"  {command})\n")[1].split(";;")[0]
            offered = re.search(r"'1:word:\(([^)]*)\)'", part).group(1).split()
            self.assertEqual(set(offered), set(known))

    def test_zsh_script_names_every_option(self):
        script = run("completion", "zsh").stdout
        for command in COMMANDS:
            part = script.split(f"  {command})\n")[1].split(";;")[0]
            self.assertEqual(set(re.findall(r"'(--[\w-]+)\[", part)), long_options(command))
        if shutil.which("zsh") is None:
            self.skipTest("zsh is not installed: its syntax was not checked")
        subprocess.run(["zsh", "-n", self.path("_mb4sim", script)], timeout=60, check=True)

    def test_unknown_shell(self):
        self.assert_one_line(run("completion", "fish"), 2, "'fish' is neither bash nor zsh")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
