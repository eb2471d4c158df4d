# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The commands with the iC-MB4 on a bus of words. Positions are those of the scenario.

  cli_words_test.py MB4SIM EXAMPLES
"""

import json
import sys
import tempfile
import unittest
from pathlib import Path

from cli import run

HOSTS = ('interface = "axi"\n', 'interface = "wb"\nbus_hz = 100_000_000\n',
         'interface = "wb"\nbus_hz = 7_000_000\n')
SLAVES = ('[[channel]]\nnumber = 1\ncable_m = 20.0\n'
          '[[channel.slave]]\nprotocol = "biss-c"\ndata_bits = 28\nsource = "ramp"\nstart = 100\nstep = 3\n'
          'control = true\nregisters = { 0x44 = [0x00, 0xD9] }\n'
          '[[channel]]\nnumber = 2\n'
          '[[channel.slave]]\nprotocol = "ssi"\ndata_bits = 13\nsource = "ramp"\nstart = 7\n')


class Words(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, host, rest=SLAVES, chip=""):
        path = self.folder / "words.toml"
        path.write_text(f"[chip]\n{chip}[host]\n{host}{rest}", encoding="utf-8")
        return str(path)

    def test_run_reads_what_the_encoders_send(self):
        for host in HOSTS:
            with self.subTest(host):
                result = run("run", self.path(host), "--json", "--frames", "4")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                rows = [(row["slave"], row["position"], row["state"])
                        for row in json.loads(result.stdout)["frames"]]
                self.assertEqual(rows, [row for n in range(4)
                                        for row in ((1, 100 + 3 * n, "ok"), (5, 7 + n, "ok"))])

    def test_bus_log_holds_the_accesses(self):
        log = self.folder / "bus.log"
        result = run("run", self.path(HOSTS[1]), "--frames", "1", "--bus-log", str(log))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        lines = log.read_text(encoding="utf-8").splitlines()
        for line in lines:
            self.assertRegex(line, "^(write|read) [0-9A-F]{2,3} [0-9A-F]{8}$")
        self.assertEqual(lines[0], "write F4 00000080")  # BREAK
        # 28 bits without a CRC of more than 8 bits: 0x5B is ENSCD1 and 27.
        self.assertTrue(any(line.startswith("write C0 ") and line.endswith("5B") for line in lines))

    def test_other_commands_work_as_over_spi(self):
        spi = self.path('interface = "spi"\n')

        def fields(scenario):
            got = json.loads(run("regs", scenario, "--frames", "2", "--json").stdout)
            # The levels of the lines depend on how soon they are read after the frame.
            return [field for field in got["fields"] if field["name"] not in ("SL1", "SL2")]
        expected = fields(spi)
        for host in HOSTS:
            scenario = self.path(host)
            self.assertEqual(fields(scenario), expected)
            result = run("sweep", scenario, "--delays", "0", "--jitters", "0,20", "--frames", "2")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("words 8, flagged 0, wrong but delivered 0", result.stdout)
            result = run("plot", scenario, "--read", "0x44:2")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("D9", result.stdout)
            result = run("regress", scenario, "--seeds", "2", "--frames", "3", "--jobs", "1")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("runs 2, failed 0", result.stdout)
            result = run("spi", scenario, text="03 EB 00\n02 80 5A A5\n03 80 00 00\n")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(result.stdout, "00 00 84\n00 00 00 00\n00 00 5A A5\n")

    def test_what_is_not_there_is_one_clear_error(self):
        scenario = self.path(HOSTS[0])
        fault = SLAVES + '[[fault]]\nkind = "abort"\nat_us = 5\nbits = 3\n'
        aborts = self.folder / "abort.toml"
        aborts.write_text(f"[host]\n{HOSTS[0]}{fault}", encoding="utf-8")
        clock = self.folder / "clock.toml"
        clock.write_text(f"[chip]\nf_clk_hz = 0\n[host]\n{HOSTS[0]}{SLAVES}", encoding="utf-8")
        slow = self.folder / "slow.toml"
        slow.write_text('[host]\ninterface = "wb"\nbus_hz = 0\n' + SLAVES, encoding="utf-8")
        cases = ((["run", scenario, "--trace", str(self.folder / "x.fst")],
                  "--trace: with the interface \"axi\" there is no waveform"),
                 (["regress", scenario, "--cover", str(self.folder / "x")],
                  "--cover: .*: there are no points for the interface \"axi\""),
                 (["spidev", "--scenario", scenario, "true"], "spidev needs a host on SPI"),
                 (["run", str(aborts)], "an AXI access is never aborted"),
                 (["run", str(clock)],
                  "key 'interface': a bus of words has no oscillator: f_clk_hz must not be 0"),
                 (["run", str(slow)], "key 'bus_hz': .*1000"))
        for command, message in cases:
            result = run(*command)
            self.assertEqual((result.returncode, result.stdout), (2, ""), command)
            self.assertRegex(result.stderr, f"^mb4sim: .*{message}.*\n$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
