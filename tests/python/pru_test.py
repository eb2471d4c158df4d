# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The master biss_pru from Python: frames by its memory, and a register of the encoder by its control word."""

from pathlib import Path

import openmb4

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "pru" / "encoder.toml"


def test_frames_by_the_memory_bring_positions():
    with openmb4.Simulator(EXAMPLE) as chip:
        regs = chip.pru_regs
        assert chip.axi_read(0x200) == 0x454E4303
        chip.axi_write(0x000, 5 << 16 | 8 << 8 | 12)
        chip.axi_write(0x210, 1)
        chip.axi_write(0x220, 1)

        def frame():
            while chip.pin("irq_o") == 0:
                chip.advance_ns(1000)
            chip.axi_write(0x20C, 0x1F)
            return regs.POS_HI.read() << 32 | regs.POS_LO.read()

        assert [frame() for _ in range(5)] == [1000, 1003, 1006, 1009, 1012]
        assert (regs.FRAME_COUNT.read(), regs.LINE_DELAY.read(), regs.NE.read()) == (5, 1, 1)
        # TIDEP0022, Table 7 and 11: register 0x67 is 0x5F.
        chip.axi_write(0x004, 0x8CE54000)
        for _ in range(47):
            frame()
        assert (regs.CTRL_RESULT.read(), regs.CMD_CRC_ERR.read(), chip.axi_read(0x004)) == (0x5F, 0, 0)
