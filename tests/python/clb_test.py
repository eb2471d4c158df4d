# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The master biss_clb from Python: a frame by its registers."""

from pathlib import Path

import openmb4

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "clb" / "lika-hs58s18.toml"
BITS, HALF, WORDS = 18, 10, 3


def test_frame_by_registers_brings_the_position():
    with openmb4.Simulator(EXAMPLE) as chip:
        regs = chip.clb_regs
        assert chip.axi_read(0x200) == 0x454E4304
        for name, value in (("MA_MATCH1", HALF - 1), ("MA_MATCH2", 2 * HALF - 1), ("RECEIVE_MATCH1", HALF - 1),
                            ("RECEIVE_MATCH2", 2 * HALF - 1), ("SPI_COUNT_MATCH1", 12 * WORDS), ("R0", BITS + 10)):
            regs[name].register.write(value)
        chip.axi_write(0x100, 0x8B)                  # 12 bits, not held
        chip.axi_write(0x104, 0x2000 | 0x20 | WORDS)
        chip.axi_write(0x210, 1)
        chip.axi_write(0x44, 2)
        chip.axi_write(0xC4, 2)
        chip.axi_write(0x00, HALF - 1)
        chip.axi_write(0xC0, 0x81)
        chip.axi_write(0x40, 1)
        chip.advance_ns(10_000)
        assert chip.pin("irq_o") == 1
        line = "".join(f"{chip.axi_read(0x108):012b}" for _ in range(WORDS))
        # START, CDS, position, nE, nW.
        assert (line[0], int(line[2:2 + BITS], 2), line[2 + BITS:4 + BITS]) == ("1", 100_000, "11")
        assert regs.FRAME_STATE.read() == 3
