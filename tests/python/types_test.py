# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""mypy --strict passes on the package and on the examples that use it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
# Those of cocotb and LiteX run where these packages are.
EXAMPLES = sorted((ROOT / "examples" / "python").glob("*.py")) + sorted(
    (ROOT / "examples" / "axi").glob("*.py"))


def mypy(tmp_path, *arguments):
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports",
                           f"--cache-dir={tmp_path}", *map(str, arguments)], text=True,
                          capture_output=True, check=False,
                          env=dict(os.environ, MYPYPATH=str(ROOT / "tools" / "python")))
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_package_and_examples_are_typed(tmp_path):
    assert len(EXAMPLES) >= 2
    assert "Success" in mypy(tmp_path, "-p", "openmb4")
    for example in EXAMPLES:  # each is a program
        assert "Success" in mypy(tmp_path, example)


def test_a_wrong_type_is_found(tmp_path):
    program = tmp_path / "wrong.py"
    program.write_text("import openmb4\nopenmb4.Simulator('x.toml').driver.config().mahz\n",
                       encoding="utf-8")
    with pytest.raises(AssertionError, match="mahz"):
        mypy(tmp_path, program)
