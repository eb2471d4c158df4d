# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A cocotb test bench of dsl_axil without an encoder (cocotbext-axi): random accesses with random
pauses on every channel of the bus, which has a clock of its own, against docs/dsl.md; and the line at
the start of a link, tick by tick. run.py starts it."""

import random

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ReadOnly, RisingEdge, Timer

TICK_PS, BUS_PS = 13334, 8700
OPERATIONS = 120
SEED = 20261130
SYS_CTRL, SYNC_CTRL, IRQ_ENABLE, ID, STATUS = 0x000, 0x001, 0x190, 0x180, 0x100
# Bytes that keep what is written, and their bits.
BYTES = {SYNC_CTRL: 0xFF, IRQ_ENABLE: 0x13}
TICKS = 8  # of a bit
FRAME = 108  # bits
SYNC, SAMPLE, CYCLE, TRAILER = "001011", "110", "110", "00000011"
# The begin of a free-running link: equalisation and master parameter of its frames.
RESET, SYNCHRONISE = "0101001011", "1001100100"
FRAMES = [("0000", RESET), ("1101", RESET), ("1101", SYNCHRONISE), ("0000", SYNCHRONISE), ("0000", SYNCHRONISE)]


def pauses(rng):
    """A generator of back-pressure: runs of pauses, and times without."""
    while True:
        share = rng.choice((0.0, 0.3, 0.9))
        for _ in range(rng.randrange(1, 40)):
            yield rng.random() < share


async def bus_of(dut, rng):
    """Clocks and resets; the line reads what the master drives, else 1."""
    from cocotbext.axi import AxiLiteBus, AxiLiteMaster
    dut.rst_ni.value = 0
    dut.s_axi_aresetn.value = 0
    dut.dsl_in_i.value = 1
    # A master writes its pins at once. At time 0 Icarus 11 would lose what depends on them.
    await Timer(1, "ns")
    bus = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axi"), dut.s_axi_aclk, dut.s_axi_aresetn,
                        reset_active_level=False)
    for side, channels in ((bus.write_if, "aw w b"), (bus.read_if, "ar r")):
        side.log.setLevel("WARNING")
        for channel in channels.split():
            getattr(side, f"{channel}_channel").set_pause_generator(pauses(random.Random(rng.random())))
    cocotb.start_soon(Clock(dut.s_axi_aclk, BUS_PS, "ps").start())
    cocotb.start_soon(Clock(dut.clk_i, TICK_PS, "ps").start())
    await Timer(200, "ns")
    dut.rst_ni.value = 1
    dut.s_axi_aresetn.value = 1
    return bus


@cocotb.test()
async def registers_keep_what_the_page_says(dut):
    rng = random.Random(SEED)
    bus = await bus_of(dut, rng)
    held = {SYNC_CTRL: 1, IRQ_ENABLE: 0}
    for _ in range(OPERATIONS):
        address = rng.choice([*BYTES, ID])
        if address != ID and rng.randrange(2):
            data = rng.getrandbits(8)
            await bus.write(address, bytes([data]))
            held[address] = data & BYTES[address]
        elif address == ID:
            assert int.from_bytes((await bus.read(ID, 4)).data, "little") == 0x454E4305
        else:
            got = (await bus.read(address, 1)).data[0] & BYTES[address]
            assert got == held[address], f"{address:#05x}: {got:#04x} instead of {held[address]:#04x}"


@cocotb.test()
async def link_begins_with_the_frames_of_the_law(dut):
    bus = await bus_of(dut, random.Random(SEED + 1))
    # The driver stays off while PRST is 1; the change to 0 starts the link.
    await bus.write(SYS_CTRL, b"\x80")
    await bus.write(SYS_CTRL, b"\x00")
    samples = ""
    while len(samples) < (40 + FRAME * (len(FRAMES) + 1)) * TICKS:
        await RisingEdge(dut.clk_i)
        await ReadOnly()
        if int(dut.dsl_en_o.value):
            samples += str(int(dut.dsl_out_o.value))
        elif samples:
            samples += "-"
    begin = next(at for at in range(len(samples)) if is_bits(samples[at:], SYNC + SAMPLE + CYCLE))
    for number, (equalisation, parameter) in enumerate(FRAMES):
        frame = samples[begin + number * FRAME * TICKS:][:FRAME * TICKS]
        head = SYNC + SAMPLE + CYCLE + equalisation + parameter
        assert is_bits(frame, head), f"frame {number}: {frame[4::TICKS][:len(head)]} instead of {head}"
        assert is_bits(frame[(FRAME - len(TRAILER)) * TICKS:], TRAILER), f"trailer of frame {number}"
    assert int.from_bytes((await bus.read(STATUS, 4)).data, "little") & 2 == 0  # no link


def is_bits(samples, bits):
    return samples.startswith("".join(bit * TICKS for bit in bits))
