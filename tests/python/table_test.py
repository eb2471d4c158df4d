# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Frames as a table of pandas: values are those of the ramp and of the faults."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import openmb4
import pandas
import pytest

TWO = ('[[channel]]\nnumber = 1\n' + ''.join(
    f'[[channel.slave]]\nprotocol = "biss-c"\ndata_bits = 28\nsource = "ramp"\nstart = {start}\nstep = 3\n'
    for start in (1000, 5000)))


@pytest.fixture
def chip():
    with openmb4.Simulator(TWO) as opened:
        opened.driver.configure()
        yield opened


def test_table_has_a_line_for_each_word(chip):
    first = [chip.driver.read_frame(slave).position for slave in (1, 2)]
    table = chip.driver.read_table(100)
    assert list(table.columns) == ["frame", "time_ns", "slave", "code", "position", "raw", "crc",
                                   "slave_error", "slave_warning"]
    assert len(table) == 200 and (table.code == "OK").all() and table.frame.iloc[-1] == 99
    for slave in (1, 2):
        own = table[table.slave == slave]
        step = own.position.to_numpy().astype(np.int64)
        assert (np.diff(step) == 3).all() and step[0] > first[slave - 1]
    assert table.time_ns.iloc[-1] == chip.time_ns
    assert table.position.dtype == np.uint64


def test_bad_words_have_the_name_of_their_code(chip):
    chip.inject({"fault": [{"kind": "wrong-crc", "slave": 2, "at_us": 0, "for_us": 100}]})
    rows = chip.driver.read_all(20)
    table = openmb4.to_pandas(rows, slaves=[2])
    assert len(table) == 20 and (table.slave == 2).all()
    assert list(table.code) == [openmb4.Code(code).name for code in rows["frame"]["code"][:, 1]]
    assert table.code.iloc[0] != "OK" and table.code.iloc[-1] == "OK"
    assert isinstance(table.groupby("code", observed=True).size(), pandas.Series)
    with pytest.raises(openmb4.Error, match="slave is 1 to 8, not 9"):
        openmb4.to_pandas(rows, slaves=[9])


def test_without_pandas_the_message_says_what_to_install(tmp_path):
    (tmp_path / "pandas.py").write_text("raise ImportError('none')\n", encoding="utf-8")
    package = str(Path(openmb4.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, "-B", "-c", "import openmb4; openmb4.Simulator('').driver.read_table(0)"],
        env=dict(os.environ, PYTHONPATH=f"{tmp_path}:{package}"), text=True, capture_output=True)
    assert done.returncode == 1
    assert done.stderr.strip().endswith(
        "openmb4._library.Error: to_pandas: pandas is not installed: pip install openmb4[pandas]")
