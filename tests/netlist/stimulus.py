#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Random inputs, one table entry a module, so that each module does what it is there for.

  stimulus.py   prints the modules: their netlists are compared with the RTL

A step is a complete set of input values. Clocks and data never change in one step, so that neither
simulator has to decide a race; several clocks may."""

# SPI opcodes (datasheet Table 3): write and read with address, read status, write instruction,
# read and write from address 0.
OPCODES = [0x02, 0x03, 0x05, 0x07, 0x09, 0x0B]

# SCRCLEN codes of Table 14, one that it does not permit, own polynomials (bit 7), as the host writes
# them; then polynomials as mb4_crc_code makes them.
CRC_CODES = [0x00, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08, 0x10, 0x21, 0x81, 0x83, 0xA1, 0xC9]
CRC_POLYNOMIALS = [0x00, 0x05, 0x09, 0x12, 0x21, 0x44, 0x97, 0xEC, 0x01, 0x03, 0x49]


class Steps:
    """The steps so far and the values of the inputs now."""

    def __init__(self, rng, widths):
        self.rng = rng
        self.widths = widths
        self.now = {port: 0 for port in widths}
        self.steps = []
        self.compare_from = 0

    def step(self, **values):
        self.now.update(values)
        self.steps.append(dict(self.now))

    def reset(self, ports):
        """Edges, so that flops with an asynchronous reset take their value in both simulators."""
        self.step(**{port: 1 for port in ports})
        self.step(**{port: 0 for port in ports})
        self.compare_from = len(self.steps) - 1
        self.step(**{port: 1 for port in ports})

    def clock(self, port):
        self.step(**{port: 1})
        self.step(**{port: 0})

    def chance(self, probability):
        return self.rng.random() < probability


def any_value(steps, port):
    return steps.rng.getrandbits(steps.widths[port])


def play(steps, clocks, resets, rounds, ports=None, hold=0.5, reset_rate=0.002, one_clock=False):
    """Random data between clock edges. `ports`: name to probability that a one-bit input is 1, or
    to a function of the steps that gives a new value or None for no change. All other inputs keep
    their value with probability `hold`."""
    ports = ports or {}
    data = [p for p in steps.widths if p not in clocks and p not in resets]
    if unknown := ports.keys() - steps.widths.keys():
        raise SystemExit(f"rules for ports that the module does not have: {sorted(unknown)}")
    for _ in range(rounds):
        values = {}
        for port in data:
            rule = ports.get(port)
            if callable(rule):
                value = rule(steps)
                if value is not None:
                    values[port] = value
            elif rule is not None:
                values[port] = int(steps.chance(rule))
            elif not steps.chance(hold):
                values[port] = any_value(steps, port)
        if data:
            steps.step(**values)
        if resets and steps.chance(reset_rate):
            reset = steps.rng.choice(resets)
            steps.step(**{reset: 0})
            steps.step(**{reset: 1})
        edges = [c for c in clocks if steps.chance(0.6)] or clocks[:1]
        if one_clock:
            edges = [steps.rng.choice(clocks)]
        if edges:
            steps.step(**{c: 1 - steps.now[c] for c in edges})


def rarely(port, probability, choose=None):
    """A rule: a new value now and then."""
    def rule(steps):
        if not steps.chance(probability):
            return None
        return choose(steps) if choose else any_value(steps, port)
    return rule


def pack(*fields):
    """A struct from (value, width) pairs, the highest field first."""
    word = 0
    for value, width in fields:
        word = word << width | int(value) & ((1 << width) - 1)
    return word


def struct(port, *fields):
    """A rule for a struct: a new value at each step. A field is (probability, 1) of a 1, or
    (function of the steps, width), or (None, width) for any value."""
    def rule(steps):
        values = []
        for source, width in fields:
            if source is None:
                values.append((steps.rng.getrandbits(width), width))
            elif callable(source):
                values.append((source(steps), width))
            else:
                values.append((steps.chance(source), width))
        return pack(*values)
    return {port: rule}


def host_address(steps):
    """An address of 0xC0..0xFF mostly: where the configuration lives."""
    return steps.rng.getrandbits(6) | 0xC0 if steps.chance(0.9) else steps.rng.getrandbits(8)


def host(wr_address=host_address, wr_data=None):
    """host_t of mb4_pkg: writes and reads of the host."""
    return struct("host_i", (0.5, 1), (wr_address, 8), (wr_data, 8), (0.5, 1), (host_address, 8))


def instruction_byte(steps):
    return steps.rng.choice([0x02, 0x04, 0x06, 0x03, 0x08, 0x09, 0x0E, 0x12, 0x80, 0x40, 0x20, 0x60]) \
        if steps.chance(0.8) else steps.rng.getrandbits(8)


def simple(clocks, resets, rounds=3000, ports=None, **options):
    def make(steps):
        steps.reset(resets)
        play(steps, clocks, resets, rounds, ports, **options)
    return make


def sl_sampler(steps):
    # The flops of armed have no reset: a clock with clear_i gives them their value.
    steps.step(clear_i=1)
    steps.reset(["rst_ni"])
    steps.clock("clk_i")
    steps.compare_from = len(steps.steps)
    play(steps, *CORE, 12000, {
        "ssi_i": rarely("ssi_i", 0.002), "clear_i": 0.002,
        **struct("sample_i", (0.4, 1), (0.4, 1), (None, 1)),
        "sl_i": rarely("sl_i", 0.3, lambda s: int(s.chance(0.99))),
        "armed_a_i": 0.95, "armed_b_i": 0.95}, reset_rate=0.0005)


def crc_decode(steps):
    play(steps, [], [], 1000)


def slave_cfg(steps):
    """A data channel, mostly with a CRC that the chip knows."""
    crc = steps.rng.choice(CRC_POLYNOMIALS) if steps.chance(0.8) else steps.rng.getrandbits(8)
    # mb4_pkg::slave_cfg_t: start, CRC on, bits minus 1, polynomial, the other fields.
    last = 15 if crc >= 0xC0 else max(crc.bit_length() - 1, 0)
    return pack((steps.rng.getrandbits(16), 16), (int(crc != 0), 1), (last, 4), (crc & 0x7F, 7),
                (steps.rng.getrandbits(8), 8))


def spi_bytes(steps, values, between=lambda steps: None):
    """One frame in SPI mode 0."""
    steps.step(cs_ni=0)
    for value in values:
        for bit in range(7, -1, -1):
            steps.step(mosi_i=value >> bit & 1)
            between(steps)
            steps.step(sclk_i=1)
            between(steps)
            steps.step(sclk_i=0)
    steps.step(cs_ni=1)


def select(steps):
    """NCS falls after the last reset, so that the frame's own reset has an edge in the next."""
    steps.step(rst_ni=0, cs_ni=1)
    steps.step(rst_ni=1)
    steps.step(cs_ni=0)


def spi(steps):
    select(steps)
    steps.reset(["rst_ni"])
    steps.step(cs_ni=1)

    def between(steps):
        if steps.chance(0.3):
            steps.step(rd_data_i=any_value(steps, "rd_data_i"))
        if steps.chance(0.001):
            steps.step(cs_ni=1)
            steps.step(cs_ni=0)
        if steps.chance(0.0005):
            steps.step(rst_ni=0)
            steps.step(rst_ni=1)

    for _ in range(60):
        opcode = steps.rng.choice(OPCODES) if steps.chance(0.9) else steps.rng.getrandbits(8)
        spi_bytes(steps, [opcode] + [steps.rng.getrandbits(8)
                                     for _ in range(steps.rng.choice([0, 1, 3, 9]))], between)


def timebase(steps):
    steps.step(last_i=0, tens_i=0)
    steps.reset(["rst_ni"])
    lengths = [0, 1, 2, 3, 4, 6]
    play(steps, ["clk_i"], ["rst_ni"], 6000,
         {"last_i": rarely("last_i", 0.01, lambda s: s.rng.choice(lengths)
                           if s.chance(0.95) else s.rng.getrandbits(4)),
          "tens_i": rarely("tens_i", 0.02, lambda s: s.chance(0.3)), "run_i": 0.98, "restart_i": 0.02})


def slave_cfg_store(steps):
    """Memory contents are unknown until written: write every row, then read once."""
    steps.reset(["rst_ni"])
    for address in range(32):
        steps.step(host_i=pack((1, 1), (0xC0 | address, 8), (steps.rng.getrandbits(8), 8), (0, 9)))
        steps.clock("wr_clk_i")
    steps.step(host_i=1 << 8, list_en_i=0xF)
    steps.clock("rd_clk_i")
    steps.clock("clk_i")
    steps.compare_from = len(steps.steps)
    # A write and a read of one row never share a clock edge: which byte is read is left open.
    play(steps, ["wr_clk_i", "rd_clk_i", "clk_i"], ["rst_ni"], 12000,
         host(lambda s: 0xC0 | s.rng.getrandbits(5 + int(s.chance(0.2))),
              # 0x10 is the CRC of 16 bits, 0x81 that of one bit.
              lambda s: s.rng.choice([0x10, 0x81]) if s.chance(0.2) else s.rng.getrandbits(8)),
         one_clock=True)


def memory(steps):
    """Memory contents are unknown until written: clear all, then read once."""
    for address in range(64):
        steps.step(clear_i=pack((1, 1), (address, 6), (0, 8)))
        steps.clock("clk_i")
    steps.step(clear_i=0, rd_i=1 << 6, eng_rd_i=1 << 6)
    steps.clock("rd_clk_i")
    steps.clock("clk_i")
    steps.compare_from = len(steps.steps)
    # Few bytes, the same in both banks.
    def place(s):
        return s.rng.getrandbits(1) << 5 | s.rng.getrandbits(2) * 9

    few = {}
    for port, probability in (("clear_i", 0.05), ("eng_wr_i", 0.5), ("host_wr_i", 0.5)):
        few |= struct(port, (probability, 1), (place, 6), (None, 8))
    for port in ("eng_rd_i", "rd_i", "rd2_i"):
        few |= struct(port, (0.5, 1), (place, 6))
    # A write and a read of one address never share a clock edge: which byte is read is left open.
    play(steps, ["clk_i", "rd_clk_i"], [], 6000, few, one_clock=True)


def posted(steps):
    """The data output is unknown until the first byte has come."""
    steps.reset(["wr_rst_ni", "rst_ni"])
    steps.step(wr_en_i=1, wr_data_i=0x1234)
    steps.clock("wr_clk_i")
    steps.step(wr_en_i=0)
    for _ in range(5):
        steps.clock("clk_i")
    steps.compare_from = len(steps.steps)
    play(steps, ["wr_clk_i", "clk_i"], ["wr_rst_ni", "rst_ni"], 6000, {"wr_en_i": 0.2},
         reset_rate=0.0, one_clock=True)


def kind(steps):
    """kind_t of mb4_pkg: six pairs of lines, is_frame, is_control, is_register, is_void."""
    value = steps.rng.choice([1, 2, 3, 3, 3]) << 10 | steps.rng.getrandbits(10)
    return (value << 4 | steps.chance(0.9) << 3 | steps.chance(0.3) << 2 | steps.chance(0.2) << 1 |
            steps.chance(0.1))


def line_event(steps):
    """line_event_t of biss_pkg: line_end, init_done, init_fail."""
    return steps.rng.getrandbits(2) << 1 | steps.chance(0.07)


def line_status(steps):
    """line_status_t of biss_pkg: idle, timeout, cds, cdm, sl; mostly idle with SL = 1."""
    return pack((steps.chance(0.9), 1), (steps.rng.getrandbits(3), 3), (steps.chance(0.9), 1))


def sequencer(steps):
    """Any traffic; in between lines that rest for 1024 clocks, because INIT waits for this behind a
    reset and a BREAK, and then traffic without either."""
    def instruction(byte):
        return steps.rng.getrandbits(2) << 8 | byte

    busy = {
        **struct("mem_i", (0.02, 1), (None, 1)), "tick_i": 0.9,
        "status_i": rarely("status_i", 0.3, lambda s: line_status(s) << 5 | line_status(s)),
        "regvers_i": rarely("regvers_i", 0.02), "kind_i": rarely("kind_i", 0.3, kind),
        "event_i": rarely("event_i", 0.9, lambda s: line_event(s) << 3 | line_event(s)),
        "quirks_i": rarely("quirks_i", 0.01)}
    any_byte = rarely("instr_i", 0.1, lambda s: instruction(instruction_byte(s)))
    no_break = rarely("instr_i", 0.1, lambda s: instruction(instruction_byte(s) & 0x7F))
    idle = pack((1, 1), (0, 3), (1, 1))
    clocks, resets = CORE
    steps.reset(resets)
    for _ in range(4):
        play(steps, clocks, resets, 3000, {**busy, "instr_i": any_byte})
        steps.step(status_i=idle << 5 | idle, event_i=0, instr_i=instruction(0x10))
        play(steps, clocks, resets, 2200, {
            "status_i": lambda s: None, "event_i": lambda s: None, "instr_i": lambda s: None,
            "kind_i": lambda s: None}, reset_rate=0)
        play(steps, clocks, resets, 600, {**busy, "instr_i": no_break}, reset_rate=0)


def word_cfg(steps, crc, store_gray, actuator, stop):
    """word_t of biss_pkg, data_last first, with a polynomial and start value of any kind."""
    word = steps.rng.getrandbits(6)
    for value, width in ((int(crc > 0), 1), (max(crc, 1) - 1, 4), (steps.rng.getrandbits(8), 8),
                         (steps.rng.getrandbits(16), 16), (store_gray, 2),
                         (int(actuator), 1), (int(stop), 1)):
        word = word << width | value
    return word


def rx_word(steps):
    steps.reset(["rst_ni"])
    for number in range(120):
        crc = steps.rng.choice([0, 0, 1, 3, 5, 6, 7, 8, 16])
        word = word_cfg(steps, crc, steps.rng.getrandbits(2), steps.chance(0.2), steps.chance(0.2))
        steps.step(offer_i=steps.rng.getrandbits(5) << 39 | word, load_i=1, bit_valid_i=0, run_i=int(steps.chance(0.9)))
        steps.clock("clk_i")
        if number == 0:
            steps.compare_from = len(steps.steps)   # the part of the word has no reset
        steps.step(load_i=0)
        for _ in range(steps.rng.randint(1, 90)):
            steps.step(bit_valid_i=int(steps.chance(0.8)), bit_i=steps.rng.getrandbits(1))
            steps.clock("clk_i")


def control_crc(value):
    """Data byte and the inverted CRC behind it, x^4 + x + 1, as bits."""
    crc = 0
    bits = [value >> i & 1 for i in range(7, -1, -1)]
    for bit in bits:
        crc = (crc << 1 & 0xF) ^ (3 if bit ^ crc >> 3 else 0)
    return bits + [~crc >> i & 1 for i in range(3, -1, -1)]


def access(steps, cts, write, count):
    """access_t of biss_pkg: an access of `count` bytes anywhere."""
    return pack((cts, 1), (write, 1), (steps.rng.getrandbits(7), 7), (count - 1, 6),
                (steps.rng.getrandbits(3), 3))


def control_frame(steps):
    """Register accesses of many bytes with a slave that answers right, then anything."""
    steps.reset(["rst_ni"])
    for number in range(4):
        write, value, count = number & 1, steps.rng.getrandbits(8), steps.rng.randint(33, 64)
        steps.step(post_busy_i=0, access_i=access(steps, 1, write, count), select_i=1 + (number >> 1), rdata_i=value,
                   cdm_timeout_i=1, begin_i=1)
        steps.clock("clk_i")
        steps.step(begin_i=0, expired_i=0)
        answers = [0] * 17 + [1 - write, write] + ([0, 1] + control_crc(value) + [0]) * count
        for cds in answers:
            steps.step(start_i=1)
            steps.clock("clk_i")
            steps.step(start_i=0, frame_done_i=1, cds_i=3 * cds)
            steps.clock("clk_i")
            steps.step(frame_done_i=0)
    # A slave whose start bit does not come.
    steps.step(access_i=access(steps, 1, 0, 1), begin_i=1)
    steps.clock("clk_i")
    steps.step(begin_i=0)
    for cds in [0] * 17 + [1] + [0] * 4:
        steps.step(start_i=1)
        steps.clock("clk_i")
        steps.step(start_i=0, frame_done_i=1, cds_i=3 * cds, expired_i=1)
        steps.clock("clk_i")
        steps.step(frame_done_i=0)
    play(steps, ["clk_i"], ["rst_ni"], 24000, {
        "begin_i": 0.3, "post_busy_i": 0.3, "abort_i": 0.0005, "start_i": 0.7, "frame_done_i": 0.7,
        "cdm_timeout_i": 0.9, "expired_i": 0.4,
        "select_i": rarely("select_i", 0.01, lambda s: s.rng.choice([1, 1, 2, 3])),
        "access_i": rarely("access_i", 0.01, lambda s: access(
            s, s.rng.getrandbits(1), s.rng.getrandbits(1), s.rng.choice([1, 2, 3]))),
        "ida_invert_i": rarely("ida_invert_i", 0.003),
        "rdata_i": rarely("rdata_i", 0.003, lambda s: s.rng.choice([0, 0x80, 0xC0, 0x5A]))})


def enc_spi(steps):
    """Frames of SPI with all opcodes, most of them whole, a word bus that waits now and then."""
    steps.reset(["rst_ni"])
    steps.step(cs_ni=1)
    for number in range(60):
        bits = 56 if steps.chance(0.7) else steps.rng.randint(1, 70)
        value = steps.rng.choice([2, 2, 3, 3, 3, 4, 7]) << bits - 8 | steps.rng.getrandbits(bits - 8) if bits > 8 else 0
        slow = 0.02 if steps.chance(0.2) else 0.7
        for bit in range(-2, bits + 3):
            for level in range(4):
                inside = 0 <= bit < bits
                steps.step(cs_ni=int(bit < -1 or bit > bits), sclk_i=int(inside and level > 1),
                           mosi_i=value >> bits - 1 - bit & 1 if inside else 0, word_ready_i=int(steps.chance(slow)),
                           word_error_i=int(steps.chance(0.1)), word_data_i=any_value(steps, "word_data_i"))
                steps.clock("clk_i")
    play(steps, ["clk_i"], ["rst_ni"], 3000, {"cs_ni": 0.02, "word_ready_i": 0.3})


def mo_tx(steps):
    """Frames of a few words; a rising MA edge every second clock at most."""
    steps.reset(["rst_ni"])
    for _ in range(60):
        word = 0
        # line_cmd_t: protocol, mo_en, mo_busy, hold_cdm, forced, force_level, mo_low; line_go_t: four
        # fields, mo_return, stop.
        steps.step(cmd_i=pack((0, 2), (steps.chance(0.9), 1), (steps.rng.choice([0, 0, 1, 5]), 8),
                              (0, 3), (steps.chance(0.1), 1)),
                   go_i=pack((0, 3), (steps.chance(0.1), 1), (0, 2)), begin_i=1,
                   line_idle_i=0, biss_c_i=steps.rng.getrandbits(1), ma_clocks_i=1, rise_i=0)
        steps.clock("clk_i")
        steps.step(begin_i=0)
        for _ in range(steps.rng.randint(10, 150)):
            if steps.chance(0.03):
                word = word_cfg(steps, steps.rng.choice([0, 3, 5, 6, 8, 16]), 0, steps.chance(0.8),
                                steps.rng.getrandbits(1))
            # offer_t: any, last, slave, word.
            steps.step(offer_i=pack((steps.chance(0.9), 1), (steps.chance(0.3), 1),
                                    (steps.rng.getrandbits(3), 3), (word, 39)),
                       data_i=any_value(steps, "data_i"), line_idle_i=int(steps.chance(0.005)),
                       ma_clocks_i=int(steps.chance(0.95)),
                       final_rise_i=int(steps.chance(0.3)), rise_i=1)
            steps.clock("clk_i")
            steps.step(final_rise_i=0, rise_i=0)
            if steps.chance(0.003):
                steps.step(go_i=steps.rng.choice([1, 2]))
            steps.clock("clk_i")


def biss_b(steps):
    """Register accesses with a slave that answers right, then anything."""
    steps.reset(["rst_ni"])
    for number in range(6):
        write, value, count = number & 1, steps.rng.getrandbits(8), steps.rng.choice([3, 64, 64])
        steps.step(cell_shift_i=0, access_i=access(steps, 1, write, count), mo_i=number >> 1 & 1, start_use_i=1 + number % 3,
                   rdata_i=value, init_i=0, start_i=1, sl_i=3, tick_i=1, expired_i=0)
        steps.clock("clk_i")
        steps.step(start_i=0, sl_i=0)
        # A clock of the register access lasts four ticks of one clock each; the slave answers in
        # the middle of it.
        answers = [0] * (19 - 2 * write) + ([1] + control_crc(value) + [0]) * count
        for bit in answers:
            for _ in range(4):
                steps.clock("clk_i")
            steps.step(sl_i=3 * bit)
        play(steps, ["clk_i"], [], 40, {"tick_i": 0.9, "start_i": 0, "abort_i": 0.1})
        steps.step(abort_i=1)
        steps.clock("clk_i")
        steps.step(abort_i=0)
    play(steps, ["clk_i"], ["rst_ni"], 12000, {
        "start_i": 0.3, "abort_i": 0.0005, "tick_i": 0.9, "expired_i": 0.3, "init_i": 0.1,
        "cell_shift_i": rarely("cell_shift_i", 0.003, lambda s: s.rng.choice([0, 0, 1])),
        "access_i": rarely("access_i", 0.01, lambda s: access(
            s, 1, s.rng.getrandbits(1), s.rng.choice([1, 2]))),
        "mo_i": rarely("mo_i", 0.01), "start_use_i": rarely("start_use_i", 0.003),
        "rdata_i": rarely("rdata_i", 0.003)})


def core(steps):
    """Whole chip without pins: a host that configures, starts frames and reads, noisy slaves."""
    rng = steps.rng
    # Selected and with clocks before, so that the derived resets have an edge.
    steps.step(sl1_i=1, sl2_i=1, ner_i=1, quirks_i=4, rst_ni=1, por_ni=1)
    select(steps)
    for _ in range(3):
        steps.clock("clk_i")
    steps.reset(["rst_ni", "por_ni"])
    steps.step(cs_ni=1)

    # Pins that this table does not know get random levels, so that a new one is not forgotten.
    driven = {"clk_i", "rst_ni", "por_ni", "sclk_i", "cs_ni", "mosi_i", "sl1_i", "sl2_i", "quirks_i", "ner_i"}
    others = [port for port in steps.widths if port not in driven]

    def between(steps):
        for port in others:
            if steps.chance(0.01):
                steps.step(**{port: any_value(steps, port)})
        for _ in range(rng.randint(0, 3)):
            steps.clock("clk_i")
            for line in ("sl1_i", "sl2_i"):
                if steps.chance(0.3):
                    steps.step(**{line: rng.getrandbits(1)})

    def write(address, *values):
        spi_bytes(steps, [0x02, address, *values], between)

    for _ in range(100):
        steps.clock("clk_i")
    for number in range(4):
        # Line 2 takes part in every other round at least.
        both = number % 2 == 0
        steps.step(quirks_i=rng.getrandbits(6), ner_i=rng.getrandbits(1))
        write(0xED, 5 if both else rng.choice([5, 15, 1]))
        write(0xEC, 0x10 if both else 0x00)
        write(0xE2, rng.getrandbits(8), rng.getrandbits(1), rng.choice([0, 1, 2, 3]),
              0x40 | rng.getrandbits(8))
        write(0xE6, rng.choice([0, 0, 1, 2]))
        write(0xF5, rng.getrandbits(8))
        write(0xE8, rng.choice([0x7C, 0x7F, 0x01, 0x00]))
        for slave in rng.sample(range(8), 3):
            write(0xC0 + 4 * slave, 0x40 | rng.getrandbits(4), rng.choice(CRC_CODES),
                  rng.getrandbits(8), rng.getrandbits(8))
        for _ in range(4):
            spi_bytes(steps, [0x07, instruction_byte(steps)], between)
            for _ in range(120):
                between(steps)
            spi_bytes(steps, [0x05] + [0] * rng.randint(1, 5), between)
            spi_bytes(steps, [0x03, rng.choice([0x00, 0x08, 0x20, 0x80, 0xC0, 0xE2, 0xEA, 0xF0])]
                      + [0] * 8, between)
        write(rng.choice([0x00, 0x20, 0x80]), *[rng.getrandbits(8) for _ in range(4)])
        write(0xF1, rng.getrandbits(8), rng.getrandbits(8))
        if steps.chance(0.2):
            steps.step(rst_ni=0)
            if steps.chance(0.5):
                steps.step(por_ni=0)
                steps.step(por_ni=1)
            steps.step(rst_ni=1)


CORE = (["clk_i"], ["rst_ni"])
HOST = (["wr_clk_i"], ["rst_ni"])

MODULES = {
    "enc_clk_mux": simple(["clk0_i", "clk1_i"], ["rst_ni"], 4000,
                          {"sel_i": rarely("sel_i", 0.02)}),
    "enc_posted": posted,
    "mb4_memory": memory,
    "mb4_spi": spi,
    "mb4_spi2": spi,
    "mb4_par_bus": simple(["ale_i", "nrd_rnw_i", "nwr_e_i"], ["rst_ni"], 4000, {
        "enable_i": rarely("enable_i", 0.02), "int_nmot_i": rarely("int_nmot_i", 0.02),
        "cs_ni": 0.2}),
    "mb4_cfg_regs": simple(*HOST, 6000, host(), hold=0.2),
    "mb4_slave_cfg": slave_cfg_store,
    "mb4_instr_reg": simple(*HOST, 4000, host(
        lambda s: 0xF4 ^ (int(s.chance(0.3)) << s.rng.randrange(8)))),
    "mb4_host_read": simple(["rd_clk_i"], ["rst_ni"], 6000, host()),
    "mb4_bank_ctrl": simple(*CORE, 4000, struct(
        "bank_i", (0.5, 1), (None, 1), (0.2, 1), (None, 1), (0.1, 1), (None, 1))),
    "mb4_crc_decode": crc_decode,
    "mb4_word_list": simple(*CORE, 6000, {
        "start_i": 0.02, "next_i": 0.2,
        "enscd_i": rarely("enscd_i", 0.02), "cfg_i": rarely("cfg_i", 0.5, slave_cfg)}),
    "mb4_sequencer": sequencer,
    "mb4_frame_request": simple(*CORE, 12000, {
        "ags_i": 0.999, "restart_i": 0.001, "busy_i": 0.3, "taken_i": 0.05, "lines_idle_i": 0.8,
        "getsens_i": rarely("getsens_i", 0.1), "hold_cdm_i": rarely("hold_cdm_i", 0.01),
        "freqags_i": rarely("freqags_i", 0.003,
                            lambda s: s.rng.choice([0, 1, 2, 3, 0x7C, 0x7F, 0x80]))}),
    "biss_cdm_timeout": simple(*CORE, 4000, {"cdm_i": 0.02, "clear_i": 0.01}),
    "mb4_status_flags": simple(*CORE, 4000, {
        **struct("frame_i", (None, 1), (0.05, 1), (None, 1), (0.2, 1), (0.05, 1), (0.1, 1)),
        **struct("bank_i", (None, 1), (0.1, 1))}),
    "biss_control_frame": control_frame,
    "mb4_cds_bank": simple(*CORE, 3000),
    "biss_timebase": timebase,
    "biss_sl_sampler": sl_sampler,
    # A manager that keeps its requests now and then, and breaks every rule in between.
    "enc_axil": simple(*CORE, 4000, {
        "s_axi_awvalid": 0.8, "s_axi_wvalid": 0.8, "s_axi_arvalid": 0.5, "s_axi_bready": 0.7,
        "s_axi_rready": 0.7, "word_ready_i": 0.6, "word_error_i": 0.2}),
    "enc_wb": simple(*CORE, 4000, {
        "wb_cyc_i": 0.95, "wb_stb_i": 0.8, "word_ready_i": 0.6, "word_error_i": 0.2}),
    # Frames with an edge of SCLK about every fourth clock, some of them whole.
    "enc_spi": enc_spi,
    "enc_crc": simple(*CORE, 4000, {
        "load_i": 0.02, "shift_i": 0.8, "feed_i": 0.8, "poly_i": rarely("poly_i", 0.02),
        "last_i": rarely("last_i", 0.02)}),
    "biss_rx_word": rx_word,
    "biss_frame": simple(["clk_i"], ["rst_ni", "por_ni"], 12000, {
        # start, init, register_access, reduced, mo_return, stop.
        **struct("go_i", (0.1, 1), (0.1, 1), (0.1, 1), (None, 1), (None, 1), (0.003, 1)),
        **struct("start_i", (0.95, 1), (None, 1), (None, 1)),
        # protocol, mo_en, mo_busy, hold_cdm, forced, force_level, mo_low.
        "cmd_i": rarely("cmd_i", 0.01, lambda s: pack(
            (s.rng.choice([1, 1, 1, 0, 2, 3]), 2), (0, 1), (s.rng.getrandbits(8), 8),
            (s.chance(0.2), 1), (s.chance(0.2), 1), (s.rng.getrandbits(2), 2))),
        **struct("offer_i", (None, 1), (0.3, 1), (None, 42)),
        **struct("register_ma_i", (None, 1), (0.05, 1)), "bit_valid_i": 0.3,
        "tick_i": 0.5, "len_valid_i": 0.01,
        "len_last_i": rarely("len_last_i", 0.5, lambda s: s.rng.choice([0, 6, 29, 79])),
        "word_done_i": 0.2, "sl_i": 0.7, "mo_bus_i": rarely("mo_bus_i", 0.01),
        "ack_i": 0.2, "late_i": 0.002}),
    "biss_edge_count": simple(*CORE, 6000, {
        "begin_i": 0.05, "rise_i": 0.5, "len_valid_i": 0.03, "wait_i": 0.05,
        "len_last_i": rarely("len_last_i", 0.5, lambda s: s.rng.choice([0, 1, 6, 79])),
        "mo_busy_i": rarely("mo_busy_i", 0.1, lambda s: s.rng.choice([0, 1, 5]))}),
    "biss_ma_drive": simple(["clk_i"], ["rst_ni", "por_ni"], 4000, {
        "begin_i": 0.05, "stop_i": 0.01, "tick_i": 0.6, "enough_i": 0.1,
        "force_i": rarely("force_i", 0.02)}),
    "biss_mo_tx": mo_tx,
    "biss_b_access": biss_b,
    "mb4_core": core,
}
# A module of tests/netlist/rtl, which Yosys builds wrong.
PLANTED = {"struct_in_block": simple(*CORE, 500)}

# Output bits that no input can change.
CONSTANT = {
    "enc_axil": ["s_axi_bresp[0]", "s_axi_rresp[0]"],   # OKAY or SLVERR
    "enc_spi": [f"word_be_o[{i}]" for i in (3, 2, 1, 0)],   # whole words
    "mb4_crc_decode": ["crc_poly_o[0]"],  # every polynomial ends in 1
    "mb4_cfg_regs": [f"rd_data_o[{i}]" for i in (7, 6, 5, 3, 2)],   # mb4_recent reads them back
    "mb4_word_list": ["offer_o[20]"],
    # BREAK never reads 1; MO returns 1024 half periods after INIT's acknowledge
    "mb4_sequencer": ["instr_o[7]", "go_o[1]"],
    "mb4_memory": [f"rd2_data_o[{i}]" for i in range(16)],  # Port2 = 0
}


if __name__ == "__main__":
    print(*MODULES)
