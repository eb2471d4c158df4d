# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Programs that a test of a package runs."""

import os
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def call(*command, **options):
    """What a program prints. The test ends with all of its output if it fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, check=False, text=True, capture_output=True,
                          **{"timeout": 2500} | options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(words)}: exit status {done.returncode}\n"
                             f"{done.stdout}{done.stderr}")
    return done.stdout


def clean_root():
    """The folder of MB4_CLEAN_ROOT, a Debian made by `debootstrap --variant=minbase`; None: not named."""
    named = os.environ.get("MB4_CLEAN_ROOT")
    return Path(named).resolve() if named else None


def inside(root):
    """The words before a command that runs in this Debian."""
    return ("chroot", str(root), "/usr/bin/env", "DEBIAN_FRONTEND=noninteractive",
            "PATH=/usr/sbin:/usr/bin:/sbin:/bin")


def version():
    """The project's version, from its one place."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(openmb4 VERSION ([\d.]+)", text)[1]
