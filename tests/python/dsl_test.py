# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The DSL master from Python: words of the window, bytes of the map, and what a write may touch."""

import openmb4

SCENARIO = """
[master]
type = "dsl"
[[channel]]
number = 1
cable_m = 20
[[channel.slave]]
protocol = "dsl"
position_bits = 24
data = 0x123456
"""


def test_window_and_map_bring_the_position():
    with openmb4.Simulator(SCENARIO) as chip:
        regs = chip.dsl_regs
        assert (chip.axi_read(0x180), regs.POS_LOST.read()) == (0x454E4305, 1)
        for _ in range(100):
            chip.advance_ns(20_000)
            if not regs.POS_LOST.read():
                break
        assert (regs.POS_LO.read(), regs.POS_HI.read()) == (0x123456, 0)
        # The map is big endian: POS4 is the highest byte.
        assert [regs[name].read() for name in ("POS4", "POS3", "POS2", "POS1", "POS0")] == [0, 0, 0x12, 0x34, 0x56]
        assert (regs.LINK.read(), regs.QM.read(), regs.ID.read()) == (1, 15, 0x454E4305)


def test_write_of_a_byte_leaves_its_word_alone():
    with openmb4.Simulator(SCENARIO) as chip:
        regs = chip.dsl_regs
        assert regs.ES.read() == 1
        regs.OEN.modify(1)
        assert (regs.OEN.read(), regs.ES.read(), chip.pin("dsl_en_o")) == (1, 1, 0)
        regs.OEN.modify(0)
        regs.PRST.modify(1)
        chip.advance_ns(20_000)
        assert (regs.LINK_STATE.read(), chip.pin("dsl_en_o")) == (0, 0)
