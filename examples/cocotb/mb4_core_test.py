# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A cocotb test bench of mb4_core: SPI host and BiSS C encoder are coroutines; registers have the
names of the register manual. run.py starts it."""

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import First, Timer
from openmb4.biss import BissCEncoder
from openmb4.registers import Registers

READ, WRITE, INSTRUCTION = 0x03, 0x02, 0x07  # opcodes of table 69
NAMES = Registers(None, "mb4")  # names and addresses, without a simulator
WORD = 0x2ABCDEF
SCLK_NS = 200
TIMEOUT_NS = 1000


def address(name):
    """Address of a register, or of the register that holds a field."""
    found = NAMES[name]
    return getattr(found, "register", found).address


async def spi(dut, data):
    """One SPI frame in mode 0. Returns what MISO brought."""
    received = []
    dut.cs_ni.value = 0
    await Timer(SCLK_NS, "ns")
    for byte in data:
        value = 0
        for bit in range(7, -1, -1):
            dut.mosi_i.value = byte >> bit & 1
            await Timer(SCLK_NS // 2, "ns")
            dut.sclk_i.value = 1
            value = value << 1 | (int(dut.miso_o.value) if dut.miso_o.value.is_resolvable else 0)
            await Timer(SCLK_NS // 2, "ns")
            dut.sclk_i.value = 0
        received.append(value)
    await Timer(SCLK_NS, "ns")
    dut.cs_ni.value = 1
    await Timer(SCLK_NS, "ns")
    return received


async def encode(ma, sl, encoder):
    """Plays the encoder on a line: MA has rested for TIMEOUT_NS at the end of a frame."""
    sl.value = encoder.slo
    while True:
        rest = Timer(TIMEOUT_NS, "ns")
        if await First(ma.value_change, rest) is rest:
            sl.value = encoder.timeout()
            await ma.value_change
        sl.value = encoder.ma(int(ma.value))


async def start(dut, encoder):
    """Clock, reset and configuration: one BiSS C encoder of 28 bits on line 1, MA at 2.5 MHz."""
    for name in ("sclk_i", "mosi_i", "getsens_i", "quirks_i"):
        getattr(dut, name).value = 0
    for name in ("cs_ni", "ner_i", "sl1_i", "sl2_i"):
        getattr(dut, name).value = 1
    dut.rst_ni.value = dut.por_ni.value = 0
    cocotb.start_soon(Clock(dut.clk_i, 50, "ns").start())
    await Timer(500, "ns")
    dut.rst_ni.value = dut.por_ni.value = 1
    cocotb.start_soon(encode(dut.ma1_o, dut.sl1_i, encoder))
    await Timer(500, "ns")
    await spi(dut, [WRITE, address("SCDLEN1"), 0x40 | 28 - 1])  # ENSCD1 = 1
    await spi(dut, [WRITE, address("SCRCLEN1"), 6])
    await spi(dut, [WRITE, address("CFGCH1"), 0x01])  # BiSS C
    await spi(dut, [WRITE, address("FREQS"), 3])


async def read_word(dut):
    """One frame by INSTR = 010; SCDATA1 and SVALID1 behind it."""
    await spi(dut, [INSTRUCTION, 0x04])
    await Timer(40, "us")
    valid = (await spi(dut, [READ, address("SVALID1"), 0]))[2]
    data = (await spi(dut, [READ, address("SCDATA_BYTE1"), *[0] * 5]))[2:]
    return valid, int.from_bytes(bytes(data[:4]), "little")


@cocotb.test()
async def reads_the_word_of_the_encoder(dut):
    words = iter((WORD, 0x0000001, 0xFFFFFFF))
    encoder = BissCEncoder(words.__next__)
    await start(dut, encoder)
    assert (await spi(dut, [READ, address("VERSION"), 0]))[2] == 0x84
    for expected in (WORD, 0x0000001, 0xFFFFFFF):
        valid, word = await read_word(dut)
        assert word == expected == encoder.latched
        assert valid & 0x02, "SVALID1 is the second bit"


@cocotb.test()
async def wrong_crc_is_not_valid(dut):
    encoder = BissCEncoder(WORD, crc_start=1)  # the chip checks with start value 0
    await start(dut, encoder)
    valid, _ = await read_word(dut)
    assert encoder.frames == 1 and not valid & 0x02
