#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the encoders of external-clock.toml at each rising edge of pin ext_sample_clk, 20 kHz. The
words come by the stream."""

from pathlib import Path

import openmb4

SETUP = {"MA_DIVIDER": 5,  # 100 MHz / 10
         "POSITION_BITS": 26, "CRC_CHECK": 1, "EXTERNAL_CLOCK": 1, "SINGLE_POINT": 0,
         "CHANNEL_ENABLE": 0b11}

with openmb4.Simulator(Path(__file__).with_name("external-clock.toml")) as chip:
    for name, value in SETUP.items():
        chip.axi_regs[name].register.write(value)
    chip.advance_ns(100_000)
    for _ in range(4):
        for level in (1, 0):
            chip.set_pin("ext_sample_clk", level)
            chip.advance_ns(25_000)
        beat = chip.stream_read()
        assert beat is not None
        words, good = beat
        if not chip.pin("error"):  # one of the encoders has sent nE = 0: no position is used
            good = 0
        print(f"{chip.time_ns / 1000:7.1f} us  positions {words[:2]}, good {good:02b}")
