# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The command `mb4sim` of the wheel: replaces this process by the program in the package, which needs
no Python. It stands outside of openmb4 so that numpy is not loaded."""

import os
import sys
from pathlib import Path


def main() -> None:
    """Runs the program with the arguments of this one."""
    program = Path(__file__).resolve().parents[1] / "openmb4" / "bin" / "mb4sim"
    os.execv(program, ["mb4sim", *sys.argv[1:]])
