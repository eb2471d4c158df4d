# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of the mb4sim command line have in common. Arguments of every one of them:
MB4SIM EXAMPLES"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MB4SIM, EXAMPLES = sys.argv[1:3]
RESOLUTE = os.path.join(EXAMPLES, "resolute-26.toml")


def run(*arguments, text=""):
    return subprocess.run([MB4SIM, *arguments], input=text, capture_output=True, text=True,
                          timeout=120, check=False)


def slave(keys):
    """A scenario with one BiSS C slave on channel 1; its keys begin on line 5."""
    return "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n" + keys + "\n"


class CliTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name, content=None):
        path = os.path.join(self.folder.name, name)
        if content is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(content)
        return path

    def assert_one_line(self, result, status, pattern):
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertRegex(result.stderr, pattern)


class MasterTest(unittest.TestCase):
    """Of one master. HEAD: what its scenarios begin with; NAME: their file."""
    HEAD = ""
    NAME = "scenario.toml"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, text):
        path = self.folder / self.NAME
        path.write_text(self.HEAD + text, encoding="utf-8")
        return str(path)

    def frames(self, scenario, *options):
        """The exit status and the JSON of a run."""
        result = run("run", scenario, "--json", *options)
        self.assertEqual(result.stderr, "")
        return result.returncode, json.loads(result.stdout)
