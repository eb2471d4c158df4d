# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Hints: one for each set-up of tests/wrong_setups, none for right ones. MB4_HINT_SEED is the first
seed of the random right ones."""

import os
import sys
from pathlib import Path

import openmb4
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "wrong_setups"))
import hint_cases  # noqa: E402

RIGHT = 200
SEED = int(os.environ.get("MB4_HINT_SEED", "1"))


def hints_of(setup):
    """After the driver has configured the chip, the host has sent its lines, and frames were read."""
    with openmb4.Simulator(setup.scenario) as chip:
        chip.driver.configure()
        for line in setup.lines:
            hint_cases.apply(line, chip.spi, chip.advance_ns, chip.set_pin)
        rows = chip.driver.read_all(hint_cases.FRAMES)
        return chip.hints(), rows


@pytest.mark.parametrize("setup", hint_cases.listed(), ids=lambda setup: setup.name)
def test_each_wrong_setup_gives_its_hint(setup):
    hints, _ = hints_of(setup)
    assert hint_cases.wrong_with(setup, [hint._asdict() for hint in hints]) == ""


def test_no_right_setup_gives_a_hint(capsys):
    with capsys.disabled():
        print(f"right set-ups from seed {SEED} on (MB4_HINT_SEED)")
    for setup in hint_cases.rights(RIGHT, SEED):
        hints, _ = hints_of(setup)
        assert hints == [], setup.scenario


def test_hints_are_those_of_the_report_and_their_text_is_a_sentence():
    setup = next(hint_cases.listed())
    with openmb4.Simulator(setup.scenario) as chip:
        assert chip.hints() == [] == chip.report()["hints"]
        chip.driver.configure()
        chip.regs.SCDLEN1.modify(25)
        assert chip.hints() == []  # no word has been asked for
        chip.driver.read_all(1)
        hint, = chip.hints()
        assert hint._asdict() == chip.report()["hints"][0]
        assert str(hint) == hint.text == "slave 1 sends 28 bits, the chip takes 26 (SCDLEN1 = 0x19)"
        assert "length" in repr(hint) and "slave 1" in repr(hint)
        chip.regs.SCDLEN1.modify(27)
        chip.driver.read_all(1)
        assert chip.hints() == []


AXI = """[master]
type = "axi"
[chip]
f_clk_hz = 100_000_000
[[channel]]
number = 1
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
crc = CRC
[[channel]]
number = 2
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
crc = CRC
"""


@pytest.mark.parametrize("crc, position_bits, enable, expected", [
    ("0x43", 26, 3, []),
    ("0x43", 26, 1, []),  # the second one is left out
    ("0x43", 28, 3, [("length", "slave 1", "28 bits, the master takes 30"),
                     ("length", "slave 2", "28 bits, the master takes 30")]),
    ("0x43", 26, 4, [("enable", "chip", "CHANNEL_ENABLE")]),
    ("0x25", 26, 1, [("crc", "slave 1", "0x25, that of the master 0x43")])])
def test_hints_of_biss_axi(crc, position_bits, enable, expected):
    with openmb4.Simulator(AXI.replace("CRC", crc)) as chip:
        for address, value in ((0x08, 1), (0x14, 5), (0x18, position_bits), (0x1C, 1), (0x20, enable)):
            chip.axi_write(address, value)
        assert chip.hints() == []  # no word has been asked for
        chip.axi_write(0x0C, 1)
        chip.advance_ns(50_000)
        hints = chip.hints()
        assert [(hint.kind, hint.place) for hint in hints] == [one[:2] for one in expected]
        assert all(one[2] in hint.text for one, hint in zip(expected, hints))
        if not expected:  # a fault is no mistake
            chip.inject({"fault": [{"kind": "silent", "slave": 1, "at_us": 0}]})
            chip.axi_write(0x0C, 0)
            chip.axi_write(0x0C, 1)
            chip.advance_ns(50_000)
            assert chip.hints() == []
