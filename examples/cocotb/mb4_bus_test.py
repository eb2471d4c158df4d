# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A cocotb test bench of mb4_axil (cocotbext-axi) and mb4_wb (cocotbext-wishbone): random words with
random back-pressure against the map of docs/buses.md, and positions of a BiSS C encoder by snapshots.
run.py starts it."""

import random

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import First, Timer
from openmb4.biss import BissCEncoder

BUS_NS, CORE_NS = 16, 50
TIMEOUT_NS = 400
OPERATIONS = 300
SEED = 20261125
# docs/buses.md
IDENTITY, FEATURES, IRQ_STATUS, IRQ_ENABLE, SNAPSHOT1 = 0x100, 0x108, 0x10C, 0x110, 0x120


def pauses(rng):
    """A generator of back-pressure: runs of pauses, and times without."""
    while True:
        share = rng.choice((0.0, 0.3, 0.9))
        for _ in range(rng.randrange(1, 40)):
            yield rng.random() < share


class Axi:
    """AXI4-Lite. A read and a write may run at the same time; each channel pauses at random."""

    def __init__(self, dut, rng):
        from cocotbext.axi import AxiLiteBus, AxiLiteMaster
        self.master = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axi"), dut.s_axi_aclk,
                                    dut.s_axi_aresetn, reset_active_level=False)
        sides = (self.master.write_if, self.master.read_if)
        for side in sides:
            side.log.setLevel("WARNING")
        for side, channels in zip(sides, (("aw", "w", "b"), ("ar", "r"))):
            for channel in channels:
                getattr(side, f"{channel}_channel").set_pause_generator(
                    pauses(random.Random(rng.random())))

    async def read(self, address):
        answer = await self.master.read(address, 4)
        assert int(answer.resp) == 0
        return int.from_bytes(answer.data, "little")

    async def write(self, address, data, strobes):
        for first in range(4):  # runs of enabled bytes: each is one write
            if strobes >> first & 1 and not (first and strobes >> (first - 1) & 1):
                length = 1
                while strobes >> (first + length) & 1:
                    length += 1
                answer = await self.master.write(
                    address + first, (data >> 8 * first).to_bytes(8, "little")[:length])
                assert int(answer.resp) == 0


class Wishbone:
    """Classic Wishbone cycles with random pauses in front of each."""

    def __init__(self, dut, rng):
        from cocotbext.wishbone.driver import WBOp, WishboneMaster
        self.operation, self.rng = WBOp, rng
        names = {"cyc": "cyc_i", "stb": "stb_i", "we": "we_i", "adr": "adr_i", "datwr": "dat_i",
                 "datrd": "dat_o", "ack": "ack_o", "sel": "sel_i", "err": "err_o"}
        self.master = WishboneMaster(dut, "wb", dut.wb_clk_i, width=32, timeout=2000,
                                     signals_dict=names)

    async def cycle(self, **operation):
        pause = self.rng.choice((0, 0, 1, self.rng.randrange(20)))
        (answer,) = await self.master.send_cycle([self.operation(idle=pause, **operation)])
        assert answer.ack == 1  # 2 would be ERR
        return int(answer.datrd)

    async def read(self, address):
        return await self.cycle(adr=address // 4)

    async def write(self, address, data, strobes):
        await self.cycle(adr=address // 4, dat=data, sel=strobes)


async def encode(ma, sl, encoder):
    """Plays the encoder on a line: MA has rested for TIMEOUT_NS at the end of a frame."""
    sl.value = encoder.slo
    while True:
        rest = Timer(TIMEOUT_NS, "ns")
        if await First(ma.value_change, rest) is rest:
            sl.value = encoder.timeout()
            await ma.value_change
        sl.value = encoder.ma(int(ma.value))


async def start(dut, encoder, rng):
    """Clocks, reset, an encoder on line 1. Returns the bus."""
    axi = hasattr(dut, "s_axi_aclk")
    for name in ("getsens_i", "quirks_i"):
        getattr(dut, name).value = 0
    for name in ("ner_i", "sl1_i", "sl2_i"):
        getattr(dut, name).value = 1
    reset, active = (dut.s_axi_aresetn, 0) if axi else (dut.wb_rst_i, 1)
    reset.value, dut.por_ni.value = active, 0
    # A master writes its pins at once. At time 0 Icarus 11 would lose what depends on them.
    await Timer(1, "ns")
    bus = Axi(dut, rng) if axi else Wishbone(dut, rng)
    cocotb.start_soon(Clock(dut.s_axi_aclk if axi else dut.wb_clk_i, BUS_NS, "ns").start())
    cocotb.start_soon(Clock(dut.clk_i, CORE_NS, "ns").start())
    await Timer(500, "ns")
    reset.value = 1 - active
    dut.por_ni.value = 1
    cocotb.start_soon(encode(dut.ma1_o, dut.sl1_i, encoder))
    await Timer(5, "us")  # the memories are cleared
    return bus


class Map:
    """What docs/buses.md says that words hold while no frame runs."""

    def __init__(self):
        self.bytes = {}

    @staticmethod
    def mask(address):
        """Bits that keep what was written."""
        if address < 0x40 or 0x80 <= address < 0xE0:  # SCDATA, RDATA, data channels
            return 0xFFFFFFFF
        return 0x1F if address == IRQ_ENABLE else 0

    def write(self, address, data, strobes):
        for place in range(4):
            if strobes >> place & 1:
                keep = self.mask(address) >> 8 * place & 0xFF
                self.bytes[address + place] = data >> 8 * place & keep

    def read(self, address):
        fixed = {IDENTITY: 0x454E4301, FEATURES: 0x83FF}
        if address in fixed:
            return fixed[address]
        return sum(self.bytes.get(address + place, 0) << 8 * place for place in range(4))


@cocotb.test()
async def random_words_are_those_of_the_map(dut):
    rng = random.Random(SEED)
    bus = await start(dut, BissCEncoder(0), rng)
    words = Map()
    places = ([*range(0x00, 0xE0, 4)] * 3 +
              [IDENTITY, FEATURES, IRQ_STATUS, IRQ_ENABLE, 0x11C, 0x1E0, 0x200, 0x7FC, 0xFFC])
    for _ in range(OPERATIONS):
        address = rng.choice(places)
        if rng.randrange(2):
            data, strobes = rng.getrandbits(32), rng.randrange(1, 16)
            if isinstance(bus, Axi) and rng.randrange(2):
                # A read of another word at the same time.
                other = rng.choice([each for each in places if each != address])
                expected = words.read(other)
                running = cocotb.start_soon(bus.read(other))
                await bus.write(address, data, strobes)
                assert await running == expected, hex(other)
            else:
                await bus.write(address, data, strobes)
            words.write(address, data, strobes)
        else:
            got, expected = await bus.read(address), words.read(address)
            assert got == expected, f"{address:#05x}: {got:#010x} instead of {expected:#010x}"
    for address in sorted(set(places)):
        assert await bus.read(address) == words.read(address), hex(address)


@cocotb.test()
async def snapshots_are_the_words_of_the_encoder(dut):
    rng = random.Random(SEED + 1)
    sent = []

    def word():
        sent.append(rng.getrandbits(28))
        return sent[-1]

    bus = await start(dut, BissCEncoder(word), rng)
    await bus.write(0xC0, 0x0000065B, 0xF)  # ENSCD1, 28 bits, CRC of 6 bits
    await bus.write(0xE4, 0x00034000, 0xF)  # REGVERS: BiSS C; FREQS = 3: MA at 2.5 MHz
    await bus.write(0xE8, 0x0000007C, 0xF)  # AGSMIN
    await bus.write(0xEC, 0x00000D10, 0xF)  # line 1 BiSS C, line 2 unused
    await bus.write(0xF4, 0x01, 0x1)  # AGS
    last = 0
    for _ in range(30):
        await Timer(rng.randrange(1, 30_000), "ns")
        ended = len(sent) - 1
        low = await bus.read(SNAPSHOT1)
        flags = await bus.read(SNAPSHOT1 + 0x8)
        number = await bus.read(SNAPSHOT1 + 0xC)
        if number == 0:
            assert ended < 1
            continue
        assert max(ended, last) <= number <= len(sent)
        assert low == sent[number - 1] and flags == 1
        last = number
    assert last > 10
