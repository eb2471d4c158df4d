# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The driver's configuration: mb4_config of mb4.h with names, limits and a repr."""

from dataclasses import dataclass, field, fields
from enum import IntEnum
from typing import Any, ClassVar, Dict, List, Type

from ._library import Error, NameMistake, ffi, field_name, lib, similar
from .codes import ClockSource, Flags, FrameStart, LineInterface, Protocol, SpiCheck

# What a member takes, where one sentence says it. C++ (mb4/config/members.hpp) knows the rest.
LIMITS = {
    "f_clk_hz": "1_000_000 to 25_000_000; the internal clock from 10_000_000 on",
    "ma_hz": "one of the 31 frequencies of the chip: openmb4.ma_hz_at_most() chooses",
    "frame_period_clk": "with FrameStart.PERIODIC a period of the chip, else 0: "
                        "openmb4.frame_period_clk_at_least() chooses",
    "frame_timeout_us": "0 to 1_000_000",
    "register_busy_us": "0 to 10_000_000",
    "mo_busy": "0 to 255; 0 without mo",
    "register_divider": "2, 4, 8, 16, 32, 64, 128 or 256",
    "register_timeout_us": "up to 1_000_000",
    "pin_period_us": "with FrameStart.ON_PIN 0 to 1_000_000, else 0",
    "data_bits": "1 to 64; with flags 3 to 64",
    "crc_polynomial": "0, a polynomial of degree up to 8 with its highest bit, or 0x190D9",
    "crc_start": "0 to 0xFFFF; 0 without a CRC",
}


class _Members:
    """Refuses members that do not exist and shows those that are not at their default."""

    _what: ClassVar[str] = ""

    def __setattr__(self, name: str, value: Any) -> None:
        names = [one.name for one in fields(self)]
        if name not in names:
            raise NameMistake(f"{self._what} has no member '{name}'{similar(name, names)}")
        object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        default = type(self)()
        shown = []
        for one in fields(self):
            value, usual = getattr(self, one.name), getattr(default, one.name)
            if one.name == "slaves" and len(value) == len(usual):
                shown += [f"slaves[{i}]={each!r}" for i, each in enumerate(value) if each != usual[i]]
            elif value != usual:
                shown.append(f"{one.name}={value!r}")
        return f"{self._what}({', '.join(shown)})"


@dataclass(repr=False)
class SlaveConfig(_Members):
    """One data channel of the chip.

    enabled         it has data in the frames
    data_bits       1 to 64: position and flags, without CRC; with flags 3 to 64
    flags           Flags.ERROR_WARNING: the last two data bits are nE and nW
    crc_start       start value of the CRC
    crc_polynomial  with the highest bit, 0x43 is x^6 + x + 1; 0: no CRC
    gray            SSI: the encoder sends Gray code
    actuator        takes a word: Driver.write_actuator()
    stop_bit        actuators: a stop bit comes before the word
    """

    _what: ClassVar[str] = "SlaveConfig"
    enabled: bool = False
    data_bits: int = 0
    flags: int = Flags.ERROR_WARNING
    crc_start: int = 0
    crc_polynomial: int = 0x43
    gray: bool = False
    actuator: bool = False
    stop_bit: bool = True


@dataclass(repr=False)
class Config(_Members):
    """The configuration of one chip. Driver.config() makes that of the scenario; members may be
    changed. repr() shows the members that are not at their default.

    f_clk_hz                system clock, 1_000_000 to 25_000_000; internal from 10_000_000 on
    ma_hz                   clock at pin MA: openmb4.ma_hz_at_most()
    frame_period_clk        FrameStart.PERIODIC: openmb4.frame_period_clk_at_least(), else 0
    frame_timeout_us        from the request of a frame to its end, up to 1_000_000; 0: calculated
    register_busy_us        longest register access beyond its frames, up to 10_000_000; 0: the
                            chip's own limit
    clock_source            ClockSource
    line_interface          LineInterface
    frame_start             FrameStart, of automatic frames
    spi_check               SpiCheck
    single_bank             without a second bank; then no automatic frames
    hold_cdm                MA keeps its level from frame to frame
    mo                      pin MO is wired to SLI of the last slave
    mo_busy                 periods of MA, up to 255; 0 without mo
    register_divider        MA over the register clock of BiSS B: 2, 4, 8 ... 256
    register_timeout_us     longest timeout of the BiSS B slaves, up to 1_000_000
    protocol                Protocol of each channel; [0] is channel 1
    slaves                  eight SlaveConfig; [0] is slave 1
    hold_beside_access      the bank is held beside register accesses too
    activate_at_initialize  slave_activate() in initialize()
    pin_period_us           FrameStart.ON_PIN: from pulse to pulse, up to 1_000_000; 0: unknown
    """

    _what: ClassVar[str] = "Config"
    f_clk_hz: int = 20_000_000
    ma_hz: int = 0
    frame_period_clk: int = 0
    frame_timeout_us: int = 0
    register_busy_us: int = 0
    clock_source: int = ClockSource.EXTERNAL
    line_interface: int = LineInterface.TTL
    frame_start: int = FrameStart.BACK_TO_BACK
    spi_check: int = SpiCheck.FULL
    single_bank: bool = False
    hold_cdm: bool = False
    mo: bool = False
    mo_busy: int = 0
    register_divider: int = 64
    register_timeout_us: int = 2000
    protocol: List[int] = field(default_factory=lambda: [Protocol.UNUSED, Protocol.UNUSED])
    slaves: List[SlaveConfig] = field(
        default_factory=lambda: [SlaveConfig() for _ in range(8)])
    hold_beside_access: bool = True
    activate_at_initialize: bool = False
    pin_period_us: int = 0


_ENUMS: Dict[str, Type[IntEnum]] = {
    "clock_source": ClockSource, "line_interface": LineInterface, "frame_start": FrameStart,
    "spi_check": SpiCheck, "protocol": Protocol, "flags": Flags}


def _mistake(place: str, value: Any, right: str) -> Error:
    return Error(f"{place} is {right}, not {value!r}", "MB4_INVALID_CONFIG")


def _number(place: str, name: str, value: Any) -> Any:
    """A member for C; one of an enum must be a member of it."""
    kind = _ENUMS.get(name)
    if kind is None:
        return value
    try:
        return int(kind(value))
    except ValueError:
        names = ", ".join(one.name for one in kind)
        raise _mistake(place, value, f"of {kind.__name__}: {names}") from None


def _fill(to: Any, of: _Members, place: str) -> None:
    for one in fields(of):
        name, value, where = one.name, getattr(of, one.name), f"{place}.{one.name}"
        if name == "slaves":
            if len(value) != lib.MB4_SLAVES:
                raise _mistake(where, len(value), "a list of 8 SlaveConfig")
            for i, slave in enumerate(value):
                _fill(to.slaves[i], slave, f"slaves[{i}]")
            continue
        try:
            if name == "protocol":
                to.protocol = [_number(f"{where}[{i}]", name, each) for i, each in enumerate(value)]
            else:
                setattr(to, name, _number(where, name, value))
        except (OverflowError, TypeError, IndexError) as error:
            right = LIMITS.get(name, "True or False" if isinstance(one.default, bool) else "a number")
            raise _mistake(where, value, right) from error


def to_c(config: Config) -> Any:
    """The mb4_config of a Config. Members of a wrong type are named here, all else by the driver."""
    if not isinstance(config, Config):
        raise Error(f"configure: takes a Config, as config() makes it, not {type(config).__name__}")
    found = ffi.new("mb4_config *")
    _fill(found, config, "Config")
    return found


def _member(name: str, value: Any) -> Any:
    return _ENUMS[name](value) if name in _ENUMS else value


def from_c(found: Any) -> Config:
    """The Config of an mb4_config."""
    values = {one.name: _member(one.name, getattr(found, one.name)) for one in fields(Config)
              if one.name not in ("protocol", "slaves")}
    slaves = [SlaveConfig(**{one.name: _member(one.name, getattr(slave, one.name))
                             for one in fields(SlaveConfig)}) for slave in found.slaves]
    return Config(protocol=[Protocol(each) for each in found.protocol], slaves=slaves, **values)


def what_is_right(config: Config, result: Any) -> str:
    """For a member that the driver refuses: what it takes, and its value."""
    name = field_name(result)
    if name not in LIMITS:
        return ""
    place: Any = config
    if name in SlaveConfig.__dataclass_fields__ and result.number:
        place = config.slaves[result.number - 1]
    return f"it is {LIMITS[name]}, not {getattr(place, name)!r}"


def ma_hz_at_most(f_clk_hz: int, limit_hz: int) -> int:
    """The largest frequency of MA that is at most `limit_hz`; 0 if there is none."""
    return int(lib.mb4_ma_hz_at_most(f_clk_hz, limit_hz))


def frame_period_clk_at_least(f_clk_hz: int, period_ns: int) -> int:
    """The shortest period of automatic frames that is at least `period_ns`, in clocks; 0 if there is
    none."""
    return int(lib.mb4_frame_period_clk_at_least(f_clk_hz, period_ns))
