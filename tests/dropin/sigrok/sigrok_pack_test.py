#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""tools/sigrok_pack.py: the packed decoders alone decode the packed captures, with the channels and options of
test.conf; what breaks a rule of the project is refused.

  sigrok_pack_test.py MB4SIM ROOT

Exit status 77: sigrok-cli is not installed.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

MB4SIM, ROOT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path.insert(0, str(ROOT / "tools"))

import sigrok_pack  # noqa: E402

# From the scenarios: 0x2ABCDEF is position 0xAAF37B, nE = nW = 1. The worked examples of the register read and of
# the command stand in the protocol's documents. Bit 9 of the frame is inverted.
SHOWN = {"frame": "Position: 0x0AAF37B", "register_read": "Read ID 0 0x67: 5F", "command": "Command 0 to ID 0",
         "wrong_crc": "CRC error", "motor": "Safe position 1"}


class Pack(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.pack = Path(cls.folder.name) / "pack"
        done = cls.run_pack(cls.pack)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @staticmethod
    def run_pack(folder):
        return subprocess.run([sys.executable, "-B", ROOT / "tools/sigrok_pack.py", folder, "--mb4sim", MB4SIM],
                              capture_output=True, text=True, timeout=120, check=False)

    def test_packed_decoders_decode_the_packed_captures(self):
        shown = {}
        for conf in self.pack.glob("sigrok-test/decoder/test/*/test.conf"):
            for block in conf.read_text().strip().split("\n\n"):
                name = re.search(r"^test (\w+)$", block, re.M)[1]
                decoder, chosen = re.search(r"protocol-decoder (\w+)(.*)", block).groups()
                capture = self.pack / "sigrok-dumps" / re.search(r"input (\S+)", block)[1]
                self.assertIn(f"output {decoder} annotation match {name}.output", block)
                with zipfile.ZipFile(capture) as session:
                    probes = dict(re.findall(r"probe(\d+)=(\w+)", session.read("metadata").decode()))
                options = "".join(f":{channel}={probes[str(int(bit) + 1)]}"
                                  for channel, bit in re.findall(r"channel (\w+)=(\d+)", chosen))
                options += "".join(f":{one}" for one in re.findall(r"option (\S+)", chosen))
                done = subprocess.run(
                    ["sigrok-cli", "-i", capture, "-P", decoder + options, "-A", decoder], capture_output=True,
                    text=True, timeout=120, check=True,
                    env={**os.environ, "SIGROKDECODE_DIR": str(self.pack / "libsigrokdecode/decoders")})
                self.assertIn(SHOWN[name], done.stdout, name)
                self.assertEqual("rror:" in done.stdout.replace("nError:", ""), name == "wrong_crc", done.stdout)
                shown[name] = capture
                self.assertIn(capture.name, (capture.parent / "README").read_text())
        self.assertEqual(set(shown), set(SHOWN))

    def test_a_folder_that_is_there_stays_as_it_is(self):
        before = sorted(self.pack.rglob("*"))
        done = self.run_pack(self.pack)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("is there already", done.stderr)
        self.assertEqual(sorted(self.pack.rglob("*")), before)

    def test_broken_rules_are_refused(self):
        for file, old, new, message in (
                ("pd.py", "id = 'biss_c'", "id = 'biss'", "expected api_version = 3 and id = 'biss_c'"),
                ("pd.py", "    license =", "    licence =", "expected 'license'"),
                ("pd.py", "import sigrokdecode as srd", "import sigrokdecode as srd, numpy", "found numpy"),
                ("__init__.py", "'''", "#", "expected a text about the decoder"),
                ("notes.txt", "", "x", "other .py files only")):
            with tempfile.TemporaryDirectory() as work:
                copy = Path(work, "biss_c")
                shutil.copytree(ROOT / "tools/sigrok/biss_c", copy, ignore=shutil.ignore_patterns("__pycache__"))
                text = (copy / file).read_text() if (copy / file).exists() else ""
                if file == "__init__.py":
                    text = "from .pd import Decoder\n"
                (copy / file).write_text(text.replace(old, new, 1) if old else new)
                with self.assertRaises(sigrok_pack.Fault) as raised:
                    sigrok_pack.check(copy)
                self.assertIn(message, str(raised.exception))


if __name__ == "__main__":
    if shutil.which("sigrok-cli") is None:
        print("skipped: sigrok-cli is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
