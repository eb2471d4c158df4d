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
