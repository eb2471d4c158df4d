# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The numbers of mb4.h and mb4sim.h by their names."""

from enum import IntEnum


class _Named(IntEnum):
    """Shows itself as it is written: Code.CRC. It is the number too."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}.{self.name}"


class Code(_Named):
    """What a call of the driver says, `code` of a row, MB4_... of mb4.h. docs/driver.md tells the
    causes."""

    OK = 0
    INVALID_ARGUMENT = 1
    INVALID_CONFIG = 2
    UNSUPPORTED = 3
    NOT_CONFIGURED = 4
    TRANSPORT = 5
    NOT_DETECTED = 6
    VERIFY = 7
    TIMEOUT = 8
    LINE_ERROR = 9
    CRC = 10
    NO_DATA = 11
    CORRUPTED = 12
    REGISTER = 13
    REGISTER_DELAY = 14
    COMMAND = 15
    BUSY = 16
    WRONG_MODE = 17
    BANK_SWITCHED = 18
    LINE_DELAY = 19
    JUMP = 20
    SLAVE_ERROR = 21
    NO_WORD = 22


class SimulatorCode(_Named):
    """What a call of the simulator says, MB4SIM_ERROR_... of mb4sim.h."""

    UNKNOWN = -1
    VALUE = -2
    DRIVEN = -3
    STOPPED = -4
    FAILED = -5
    HOST = -6
    CALLBACK = -7
    SILENT = -8
    TRACE = -9


class Protocol(_Named):
    """Protocol of a channel, MB4_PROTOCOL_..."""

    BISS_B = 0
    BISS_C = 1
    SSI = 2
    UNUSED = 3


class ClockSource(_Named):
    """System clock: pin CLK or the oscillator of the chip, MB4_CLOCK_..."""

    EXTERNAL = 0
    INTERNAL = 1


class LineInterface(_Named):
    """Pins of the lines, MB4_LINE_..."""

    TTL = 0
    CMOS = 1
    RS422 = 2
    LVDS = 3


class FrameStart(_Named):
    """What starts automatic frames, MB4_START_..."""

    BACK_TO_BACK = 0
    ON_PIN = 1
    PERIODIC = 2


class Flags(_Named):
    """Data bits that are not part of the position, MB4_FLAGS_..."""

    NONE = 0
    ERROR_WARNING = 1


class SpiCheck(_Named):
    """How the driver checks data on SPI, MB4_SPI_CHECK_..."""

    OFF = 0
    CRC = 1
    FULL = 2
    FULL_AND_RELEASE = 3
