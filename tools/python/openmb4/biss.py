# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A BiSS C encoder in plain Python for test benches that have their own time, such as cocotb. The
simulator's encoders know more: registers, commands, chains, faults (sim/README.md)."""

from typing import Callable, List, Union

from ._library import Error


def crc(data: int, bits: int, polynomial: int = 0x43, start: int = 0) -> int:
    """CRC of the low `bits` bits of data, first the highest. The polynomial holds its highest bit:
    0x43 is x^6 + x + 1. The line carries it inverted."""
    width = polynomial.bit_length() - 1
    if width < 1:
        raise Error(f"crc: {polynomial:#x} is no polynomial")
    top, mask = 1 << (width - 1), (1 << width) - 1
    value = start & mask
    for bit in range(bits - 1, -1, -1):
        feedback = bool(value & top) != bool(data >> bit & 1)
        value = (value << 1 & mask) ^ (polynomial & mask if feedback else 0)
    return value


class BissCEncoder:
    """One encoder alone on a line. Tell it each edge of MA with ma(), and with timeout() that MA has
    not changed for its timeout; slo is its output.

    word       raw word that it latches at the first rising edge: a number, or a function that is
               called at the latch point
    data_bits  1 or more: position and flags, without CRC
    busy       periods of MA from the acknowledge to the start bit, beyond the first

    A frame begins with the first falling edge of MA after timeout(). cdm is the inverted level of MA
    at the last timeout that ended a frame. Edges beyond the word give 0.
    """

    def __init__(self, word: Union[int, Callable[[], int]], data_bits: int = 28,
                 polynomial: int = 0x43, crc_start: int = 0, busy: int = 0):
        if data_bits < 1 or busy < 0:
            raise Error(f"BissCEncoder: data_bits {data_bits} or busy {busy} is too low")
        self._word, self._bits, self._busy = word, data_bits, busy
        self._polynomial, self._start = polynomial, crc_start
        self._ma = 1
        self._rising = -1  # rising edges of this frame; -1: idle
        self._stream: List[int] = []
        self.slo = 1
        self.cdm = 0
        self.frames = 0
        self.latched = 0

    def ma(self, level: int) -> int:
        """MA has this level now. Returns slo."""
        edge, self._ma = int(level) - self._ma, int(level)
        if edge < 0 and self._rising < 0:
            self._rising = 0
        elif edge > 0 and self._rising >= 0:
            self._rising += 1
            if self._rising == 1:
                self._latch()
            elif self._stream:
                self.slo = self._stream.pop(0)
            else:
                self.slo = 0
        return self.slo

    def _latch(self) -> None:
        word = self._word() if callable(self._word) else self._word
        self.latched = word & (1 << self._bits) - 1
        width = self._polynomial.bit_length() - 1
        check = ~crc(self.latched, self._bits, self._polynomial, self._start) & (1 << width) - 1
        text = self.latched << width | check
        length = self._bits + width
        # From the second rising edge on: acknowledge, start bit, CDS, word and CRC.
        self._stream = [0] * (1 + self._busy) + [1, 0] + [
            text >> bit & 1 for bit in range(length - 1, -1, -1)]
        self.frames += 1

    def timeout(self) -> int:
        """MA has been at rest for the encoder's timeout: the frame is over. Returns slo."""
        if self._rising >= 0:
            self.cdm = 1 - self._ma
        self._rising = -1
        self._stream = []
        self.slo = 1
        return self.slo
