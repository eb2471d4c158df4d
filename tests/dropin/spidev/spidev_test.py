#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Programs that know nothing of a simulator, run by `mb4sim spidev`. They use no file of this project, so
registers and opcodes are numbers.

  spidev_test.py MB4SIM PROGRAM SCENARIO     PROGRAM: spidev_program
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MB4SIM, PROGRAM, SCENARIO = sys.argv[1:4]
# A Linux program in Python: frames for 20 ms by its own clock.
SLEEPER = """
import os, time
fd = os.open("/dev/spidev0.0", os.O_RDWR)
began = time.monotonic()
os.write(fd, bytes([0x02, 0xC0, 0x5B, 0x06, 0, 0]))
os.write(fd, bytes([0x02, 0xED, 0x01]))
os.write(fd, bytes([0x02, 0xE5, 0x40, 0xA0]))
os.write(fd, bytes([0x02, 0xE8, 0xFF]))  # a frame every 4 ms
os.write(fd, bytes([0x07, 0x01]))        # AGS
time.sleep(0.02)
os.write(fd, bytes([0x07, 0x00]))
print(time.monotonic() - began)
"""
# Positions before and after 50 ms of AGS with a frame each millisecond.
POSITIONS = """
import fcntl, os, time
fd = os.open("/dev/spidev0.0", os.O_RDWR)
for frame in ([0x02, 0xC0, 0x5B, 0x06, 0, 0], [0x02, 0xED, 0x01], [0x02, 0xE5, 0x40, 0xA0],
              [0x02, 0xE8, 0x9F], [0x07, 0x01]):
    os.write(fd, bytes(frame))
def position():
    os.write(fd, bytes([0x07, 0x41]))  # HOLDBANK: one frame's bytes
    import array, struct
    tx = array.array("B", [0x03, 0x00, 0, 0, 0, 0])
    rx = array.array("B", bytes(6))
    fcntl.ioctl(fd, 0x40206B00, struct.pack("<QQIIHBBBBBB", tx.buffer_info()[0],
                                            rx.buffer_info()[0], 6, 0, 0, 0, 0, 0, 0, 0, 0))
    os.write(fd, bytes([0x07, 0x01]))
    return int.from_bytes(bytes(rx[2:]), "little") >> 2
time.sleep(0.01)
first = position()
time.sleep(0.05)
print(first, position())
"""


def spidev(*command, options=(), data=b"", environment=None, timeout=60):
    return subprocess.run([MB4SIM, "spidev", *options, "--", *command], input=data,
                          capture_output=True, timeout=timeout, check=False,
                          env=dict(os.environ, **(environment or {})))


class Spidev(unittest.TestCase):
    def assert_good(self, result):
        self.assertEqual(result.returncode, 0, result.stderr.decode())

    def test_a_program_finds_all_that_spidev_offers(self):
        # Simulated time: how busy the machine is makes no difference.
        result = spidev(PROGRAM, options=["--scenario", SCENARIO, "--simulated-time"])
        self.assert_good(result)
        self.assertEqual(result.stdout, b"all good\n")

    def test_any_node_can_be_taken_and_no_other_is(self):
        options = ["--scenario", SCENARIO, "--device", "/dev/spidev7.3", "--simulated-time"]
        self.assert_good(spidev(PROGRAM, "/dev/spidev7.3", options=options))
        result = spidev(PROGRAM, "/dev/spidev7.4", options=options)
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"No such file", result.stderr)

    def test_the_status_is_the_program_s(self):
        for command, status in ((["true"], 0), (["sh", "-c", "exit 7"], 7),
                                (["sh", "-c", "kill -9 $$"], 128 + 9), (["no-such-program"], 127),
                                (["/dev/null"], 126)):
            with self.subTest(command=command):
                self.assertEqual(spidev(*command).returncode, status)

    def test_wrong_use(self):
        for options, message in ((["--scenario", "no-such-file"], "no-such-file"),
                                 (["--library", "no-such-library"], "no-such-library"),
                                 (["--trace", "/"], "/")):
            result = spidev("true", options=options)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(len(result.stderr.splitlines()), 1)
            self.assertIn(message, result.stderr.decode())
        without = subprocess.run([MB4SIM, "spidev"], capture_output=True, timeout=20, check=False)
        self.assertEqual(without.returncode, 2)

    def test_a_parallel_host_is_refused_by_its_key(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "intel.toml")
            path.write_text('[host]\ninterface = "intel"\n', encoding="ascii")
            result = spidev("true", options=["--scenario", str(path)])
        self.assertEqual(result.returncode, 2)
        self.assertIn(":2:", result.stderr.decode())
        self.assertIn("interface", result.stderr.decode())

    def test_nothing_is_left_behind(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assert_good(spidev("true", environment={"TMPDIR": folder}))
            self.assertEqual(os.listdir(folder), [])

    def test_other_preloaded_libraries_stay(self):
        # A build with AddressSanitizer refuses to start behind any other library unless told to.
        environment = {"LD_PRELOAD": "libm.so.6",
                       "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"}
        result = spidev("sh", "-c", "echo $LD_PRELOAD", environment=environment)
        self.assertTrue(result.stdout.endswith(b"libmb4sim_spidev.so:libm.so.6\n"), result.stdout)

    def test_a_library_in_a_folder_with_blanks(self):
        listed = spidev("sh", "-c", "echo $LD_PRELOAD").stdout.decode().strip()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "with blanks: and colons")
            path.mkdir()
            library = shutil.copy(listed, path)
            result = spidev("test", "-c", "/dev/spidev0.0", options=["--library", library])
        self.assert_good(result)

    def test_the_node_looks_like_one(self):
        self.assert_good(spidev("test", "-c", "/dev/spidev0.0"))
        self.assert_good(spidev("sh", "-c", "test -r /dev/spidev0.0 -a -w /dev/spidev0.0"))
        self.assertEqual(spidev("test", "-e", "/dev/spidev0.1").returncode, 1)

    def test_a_descriptor_survives_exec(self):
        code = "import os; os.write(3, b'x')"
        result = spidev("sh", "-c", f'exec 3<>/dev/spidev0.0; exec "{sys.executable}" -c "{code}"')
        self.assert_good(result)
        self.assertNotIn(b"does not see", result.stderr)

    def test_simulated_time_sleeps_at_once_and_repeats(self):
        if shutil.which("fst2vcd") is None:
            self.skipTest("fst2vcd (GTKWave) is not installed")
        with tempfile.TemporaryDirectory() as folder:
            traces = [os.path.join(folder, f"{i}.fst") for i in (1, 2)]
            for trace in traces:
                result = spidev(sys.executable, "-c", SLEEPER,
                                options=["--simulated-time", "--trace", trace])
                self.assert_good(result)
                self.assertGreaterEqual(float(result.stdout), 0.02)
            values = [subprocess.run(["fst2vcd", trace], capture_output=True, timeout=60,
                                     check=True).stdout.split(b"$enddefinitions", 1)[1]
                      for trace in traces]
        self.assertGreater(len(values[0]), 10000)
        self.assertEqual(values[0], values[1])

    def test_real_time_passes_in_the_simulation(self):
        # Frames go on while the program sleeps: a ramp has moved by one a millisecond.
        text = Path(SCENARIO).read_text(encoding="ascii")
        text = text.replace("data = 0xAAF37BF", 'source = "ramp"\nstart = 0\nstep = 1\n#')
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "ramp.toml")
            path.write_text(text, encoding="ascii")
            result = spidev(sys.executable, "-c", POSITIONS, options=["--scenario", str(path)])
        self.assert_good(result)
        first, second = (int(word) for word in result.stdout.split())
        self.assertGreaterEqual(second - first, 50)

    def test_sclk_too_fast_for_the_address_is_reported(self):
        # I204: 100 ns after the address of 0x03. Linux hosts cannot stretch: 5 MHz is the limit.
        for hz, seen in ((5_000_000, False), (10_000_000, True)):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder, "fast.toml")
                path.write_text(f"[host]\nsclk_hz = {hz}\n", encoding="ascii")
                code = ("import os; fd = os.open('/dev/spidev0.0', os.O_RDWR); "
                        "os.write(fd, bytes([3, 0xEA, 0]))")
                result = spidev(sys.executable, "-c", code, options=["--scenario", str(path)])
            self.assert_good(result)
            self.assertEqual(b"I204" in result.stderr, seen, result.stderr)

    def test_writes_past_the_library_are_reported(self):
        # The C library's own streams write without a call that could be taken.
        code = "exec 3>/dev/spidev0.0; printf x >&3"
        result = spidev("bash", "-c", code)
        self.assertIn(b"does not see", result.stderr)

    def test_sigterm_ends_the_program_and_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.Popen([MB4SIM, "spidev", "--", "sh", "-c", "echo ready; exec sleep 60"],
                                   stdout=subprocess.PIPE, env=dict(os.environ, TMPDIR=folder))
            self.assertEqual(run.stdout.readline(), b"ready\n")
            run.send_signal(signal.SIGTERM)
            self.assertEqual(run.stdout.read(), b"")  # no process has it open any more
            run.stdout.close()
            self.assertEqual(run.wait(20), 128 + signal.SIGTERM)
            self.assertEqual(os.listdir(folder), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
