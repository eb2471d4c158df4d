# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The encoder in Python. Expected CRCs: golden vectors that two independent programs have worked out
for 28 bits 0xAAF37BF; expected levels: the slave of the simulator, which shares no code with it."""

import openmb4
import pytest
from openmb4.biss import BissCEncoder, crc

WORD = 0b1010101011110011011110111111  # 26 bits of position 0x2ABCDEF, nE = nW = 1
POLYNOMIALS = {3: 0xB, 4: 0x13, 5: 0x25, 6: 0x43, 7: 0x89, 8: 0x12F, 16: 0x190D9}
GOLDEN = {3: (0x5, 0x4, 0x2), 4: (0x9, 0x4, 0xE), 5: (0x10, 0x06, 0x1E), 6: (0x18, 0x04, 0x31),
          7: (0x21, 0x12, 0x20), 8: (0x0C, 0xEC, 0x7E), 16: (0x13F8, 0x2264, 0x07A8)}


@pytest.mark.parametrize("width", GOLDEN)
def test_crc_of_the_golden_vectors(width):
    assert tuple(crc(WORD, 28, POLYNOMIALS[width], start)
                 for start in (0, 1, 0xFFFF)) == GOLDEN[width]


def test_wrong_values_are_refused():
    with pytest.raises(openmb4.Error, match="0x1 is no polynomial"):
        crc(1, 1, 1)
    with pytest.raises(openmb4.Error, match="data_bits 0"):
        BissCEncoder(0, data_bits=0)


@pytest.mark.parametrize("busy, bits, polynomial", [(0, 28, 0x43), (3, 17, 0x43), (1, 64, 0x190D9)])
def test_levels_are_those_of_the_simulated_slave(busy, bits, polynomial):
    word = 0xA5F0_1234_5678_9ABF & (1 << bits) - 1  # nE = nW = 1
    scenario = {"chip": {"f_clk_hz": 20_000_000}, "channel": [{"number": 1, "slave": [
        {"protocol": "biss-c", "data_bits": bits, "data": word, "crc": polynomial,
         "busy_periods": busy}]}]}
    with openmb4.Simulator(scenario) as chip:
        chip.driver.configure()
        chip.driver.read_frame(1)
        chip.spi(bytes((7, 4)))
        record = chip.record(("MA1", "SL1"), 30_000)
    times, levels = record.pins["MA1"]
    encoder = BissCEncoder(lambda: word, bits, polynomial, busy=busy)
    edges = [encoder.ma(level) for level in levels[1:]]
    assert encoder.timeout() == 1 and encoder.frames == 1 and encoder.latched == word
    assert encoder.cdm == 1 - levels[-1]
    # The level of SL 20 ns after each edge of MA; the cable has no delay.
    expected = [record.pins["SL1"][1][record.pins["SL1"][0].searchsorted(at + 20_000, "right") - 1]
                for at in times[1:]]
    assert edges == expected
    assert len(edges) > 2 * bits


def test_second_frame_begins_after_the_timeout_only():
    encoder = BissCEncoder(iter(range(100)).__next__, 4)
    for level in (0, 1) * 30:
        encoder.ma(level)
    assert encoder.frames == 1 and encoder.slo == 0
    assert encoder.timeout() == 1 and encoder.cdm == 0
    encoder.ma(1)
    assert encoder.frames == 1
    encoder.ma(0)
    encoder.ma(1)
    assert encoder.frames == 2 and encoder.latched == 1
    encoder.ma(0)
    encoder.timeout()
    assert encoder.cdm == 1
