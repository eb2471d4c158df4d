# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A cocotb test bench of biss_axi with two channels, stream mode 1 and the extras PAGE and COUNTERS
(cocotbext-axi): random words with random pauses on every channel of the bus against the map of
docs/axi.md, and the words of two BiSS C encoders through a sink that pauses at random. run.py starts it."""

import random

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import First, Timer
from openmb4.biss import BissCEncoder

CLOCK_NS = 10
TIMEOUT_NS = 2000
OPERATIONS = 300
FRAMES = 60
SEED = 20261125
# docs/axi.md: the words that keep what is written, and how many bits of it.
WIDTHS = {0x00: 1, 0x04: 1, 0x08: 1, 0x10: 28, 0x14: 8, 0x18: 8, 0x1C: 1, 0x20: 2, 0x24: 1, 0x28: 2}
(SAMPLE_CLOCK, MODE, REQUEST, SAMPLE_DIVIDER, MA_DIVIDER, POSITION_BITS, CRC_CHECK, ENABLE) = (
    0x04, 0x08, 0x0C, 0x10, 0x14, 0x18, 0x1C, 0x20)
ID, STREAM_STATUS = 0x40, 0xA0


def pauses(rng):
    """A generator of back-pressure: runs of pauses, and times without."""
    while True:
        share = rng.choice((0.0, 0.3, 0.9))
        for _ in range(rng.randrange(1, 40)):
            yield rng.random() < share


async def encode(dut, channel, encoder, delay_ns):
    """Plays the encoder on a line of a length. SLO of both lines is one port."""
    def drive(level):
        levels = int(dut.slo.value)
        dut.slo.value = levels | 1 << channel if level else levels & ~(1 << channel)

    async def later(level):
        await Timer(delay_ns, "ns")
        drive(level)

    drive(encoder.slo)
    before = 1
    while True:
        rest = Timer(TIMEOUT_NS, "ns")
        if await First(dut.ma.value_change, rest) is rest:
            cocotb.start_soon(later(encoder.timeout()))
            await dut.ma.value_change
        level = int(dut.ma.value) >> channel & 1
        if level != before:
            before = level
            cocotb.start_soon(later(encoder.ma(level)))


class Bench:
    async def start(self, dut, rng):
        from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiStreamBus, AxiStreamSink
        dut.slo.value = 3
        dut.ext_sample_clk.value = 0
        dut.sample_en.value = 1
        dut.axi_aresetn.value = 0
        dut.por_n.value = 1
        # A master writes its pins at once. At time 0 Icarus 11 would lose what depends on them.
        await Timer(1, "ns")
        self.master = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "S_AXI"), dut.axi_aclk,
                                    dut.axi_aresetn, reset_active_level=False)
        for side, channels in ((self.master.write_if, "aw w b"), (self.master.read_if, "ar r")):
            side.log.setLevel("WARNING")
            for channel in channels.split():
                getattr(side, f"{channel}_channel").set_pause_generator(
                    pauses(random.Random(rng.random())))
        # A beat is a word: one lane of 32 bits.
        self.sink = AxiStreamSink(AxiStreamBus.from_prefix(dut, "s_axis"), dut.axi_aclk,
                                  dut.axi_aresetn, reset_active_level=False, byte_lanes=1)
        self.sink.log.setLevel("WARNING")
        cocotb.start_soon(Clock(dut.axi_aclk, CLOCK_NS, "ns").start())
        await Timer(500, "ns")
        dut.axi_aresetn.value = 1
        await Timer(100, "ns")
        return self

    async def read(self, address):
        answer = await self.master.read(address, 4)
        assert int(answer.resp) == 0
        return int.from_bytes(answer.data, "little")

    async def write(self, address, data, length=4):
        answer = await self.master.write(address, (data & 0xFFFFFFFF).to_bytes(4, "little")[:length])
        assert int(answer.resp) == 0


@cocotb.test()
async def random_words_are_those_of_the_map(dut):
    rng = random.Random(SEED)
    bus = await Bench().start(dut, rng)
    held = dict.fromkeys(WIDTHS, 0)
    for _ in range(OPERATIONS):
        address = rng.choice([*WIDTHS, ID, 0xF0])
        if rng.randrange(2) and address in WIDTHS:
            data, length = rng.getrandbits(32), rng.choice((1, 2, 4, 4))
            if address == ENABLE:
                data &= ~3  # no channel may run: frames would change words
            bits = (1 << 8 * length) - 1
            # A read of another word may run at the same time.
            other = rng.choice([each for each in WIDTHS if each != address])
            running = cocotb.start_soon(bus.read(other))
            await bus.write(address, data, length)
            assert await running == held[other], hex(other)
            held[address] = (held[address] & ~bits | data & bits) & (1 << WIDTHS[address]) - 1
        else:
            expected = {ID: 0x454E4302}.get(address, held.get(address, 0))
            got = await bus.read(address)
            assert got == expected, f"{address:#04x}: {got:#010x} instead of {expected:#010x}"


@cocotb.test()
async def words_of_both_encoders_leave_in_order(dut):
    rng = random.Random(SEED + 1)
    bus = await Bench().start(dut, rng)
    sent = [[], []]

    def source(channel):
        def word():
            sent[channel].append(rng.getrandbits(26) << 2 | 3)
            return sent[channel][-1]
        return word

    for channel, delay_ns in enumerate((35, 430)):
        cocotb.start_soon(encode(dut, channel, BissCEncoder(source(channel)), delay_ns))
    for address, data in ((SAMPLE_DIVIDER, 600), (MA_DIVIDER, 5), (POSITION_BITS, 26), (CRC_CHECK, 1)):
        await bus.write(address, data)
    bus.sink.set_pause_generator(pauses(random.Random(rng.random())))
    await bus.write(ENABLE, 3)
    for frame in range(FRAMES):
        beats = await bus.sink.recv()
        words = [int(each) for each in beats.tdata]
        users = [int(each) for each in beats.tuser]
        assert words == [sent[channel][frame] >> 2 for channel in (0, 1)], frame
        # Good, nE, nW, no CRC error, and the channel.
        assert users == [0x0007, 0x0107], [hex(user) for user in users]
    assert await bus.read(STREAM_STATUS) == 0
