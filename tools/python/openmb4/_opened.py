# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A scenario that is open, and its host: what driver and registers need of a simulator."""

import functools
import json
import os
import threading
from numbers import Integral
from typing import Any, Callable, List, Mapping, Optional, Tuple, Union

from ._library import Error, ffi, lib, simulator_error

Scenario = Union[str, "os.PathLike[str]", Mapping[str, Any]]
ERROR_BYTES = 1000
STREAM_WORDS = 64  # more than any master has in a beat
_REGISTERS = {"ic-mb4": "regs", "axi": "axi_regs", "clb": "clb_regs", "pru": "pru_regs", "dsl": "dsl_regs"}


def to_toml(value: Any) -> str:
    """A value of a scenario in TOML; tables inside tables stand in one line. Keys may be numbers, as
    register addresses are."""
    if isinstance(value, Mapping):
        pairs = (f"{json.dumps(str(k))} = {to_toml(v)}" for k, v in value.items())
        return f"{{ {', '.join(pairs)} }}"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(to_toml, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Integral):
        return str(int(value)) if value < 1 << 63 else f'"0x{int(value):X}"'
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(float(value))


class Text(str):
    """A text that is no path, whatever it looks like."""


def is_path(scenario: Any) -> bool:
    """A pathlib.Path, or a text of one line that is no TOML: it ends with .toml or sets nothing."""
    if not isinstance(scenario, str) or isinstance(scenario, Text):
        return isinstance(scenario, os.PathLike)
    text = scenario.strip()
    if not text or "\n" in text or text[0] in "#[":
        return False
    return text.endswith(".toml") or "=" not in text


def document(tables: Mapping[str, Any]) -> str:
    """The TOML text of a dict of tables."""
    return "".join(f"{key} = {to_toml(value)}\n" for key, value in tables.items())


class Opened:
    """The C object of a simulator with its lock, and the accesses of the host."""

    def __init__(self, scenario: Scenario, /):
        self._lock = threading.RLock()
        self._running = False
        self._raised: Optional[BaseException] = None
        self._callback: Any = ffi.NULL
        self._sim: Any = None
        self._is_path = is_path(scenario)
        if isinstance(scenario, Mapping):
            self._scenario = document(scenario).encode()
        elif isinstance(scenario, (str, os.PathLike)):
            self._scenario = os.fsencode(scenario) if self._is_path else str(scenario).encode()
        else:
            raise Error("Simulator takes the path of a scenario, its text or a dict of its tables, "
                        f"not {type(scenario).__name__}")
        if b"\0" in self._scenario:
            raise Error("scenario: holds a character of code 0")
        error = ffi.new("char[]", ERROR_BYTES)
        opened = lib.mb4sim_open_file if self._is_path else lib.mb4sim_open
        sim = opened(self._scenario, error, ERROR_BYTES)
        if sim == ffi.NULL:
            said = ffi.string(error).decode(errors="replace")
            if self._is_path and isinstance(scenario, str) and not os.path.exists(scenario):
                said += (f" in {os.getcwd()} (a text of one line is a path; "
                         "Simulator.from_text() takes any text)")
            raise Error(said)
        self._sim = ffi.gc(sim, lib.mb4sim_close)

    @property
    def _name(self) -> str:
        """The scenario in a repr."""
        return os.fsdecode(self._scenario) if self._is_path else "scenario"

    def _describe(self) -> Any:
        """openmb4_scenario of the scenario; None where it cannot be read any more."""
        found, error = ffi.new("openmb4_scenario *"), ffi.new("char[]", ERROR_BYTES)
        failed = lib.openmb4_describe(self._scenario, self._is_path, found, error, ERROR_BYTES)
        return None if failed else found

    @functools.cached_property
    def _master(self) -> str:
        """`[master] type` of the scenario; empty where it cannot be read any more."""
        found = self._describe()
        return "" if found is None else str(ffi.string(found.master).decode())

    def _must_be(self, master: str) -> None:
        """Registers of another master have no meaning here, even where an address answers."""
        if self._master not in ("", master):
            own = _REGISTERS.get(self._master)
            raise Error(f"{_REGISTERS[master]} are the registers of the master '{master}'; here it is "
                        f"'{self._master}'" + (f", with {own}" if own else ", which has none"),
                        "MB4SIM_ERROR_HOST")

    def close(self) -> None:
        """Ends the simulator; a second call does nothing."""
        with self._lock:
            if self._running:
                raise simulator_error(lib.MB4SIM_ERROR_CALLBACK, "close")
            if self._sim is not None:
                ffi.release(self._sim)
                self._sim = None

    def _call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Calls C with the other threads released. An exception of a callback comes out here."""
        with self._lock:
            if self._sim is None:
                raise Error("the simulator is closed")
            outer, self._running = self._running, True
            try:
                result = function(*arguments)
            finally:
                self._running = outer
            if self._raised is not None and not outer:
                raised, self._raised = self._raised, None
                raise raised
            return result

    def _do(self, what: str, function: Callable[..., int], *arguments: Any) -> int:
        with self._lock:
            result: int = self._call(function, self._sim, *arguments)
            if result < 0:
                raise simulator_error(result, what)
            return result

    def spi(self, data: bytes) -> bytes:
        """One SPI frame: NCS low, these bytes, NCS high. Returns the chip's bytes."""
        received = ffi.new("uint8_t[]", len(data))
        self._do("spi", lib.mb4sim_spi_transfer, bytes(data), received, len(data))
        return bytes(ffi.buffer(received))

    def bus_write(self, address: int, value: int) -> None:
        """One write cycle of the parallel bus."""
        self._do("bus_write", lib.mb4sim_bus_write, address, value)

    def bus_read(self, address: int) -> int:
        """One read cycle of the parallel bus."""
        value = ffi.new("uint8_t *")
        self._do("bus_read", lib.mb4sim_bus_read, address, value)
        return int(value[0])

    def _on_words(self, what: str, address: int, function: Callable[..., int], *arguments: Any) -> None:
        """An access of a bus of words; its error says what the address may be."""
        what = f"{what} 0x{address:02X}"
        with self._lock:
            result: int = self._call(function, self._sim, address, *arguments)
        if result == lib.MB4SIM_ERROR_VALUE:
            raise simulator_error(result, what, "an address is that of a word, a multiple of 4"
                                  if address % 4 else "the bus of this master does not have this address")
        if result < 0:
            raise simulator_error(result, what)
        if result:
            raise Error(f"{what}: the bus answered with an error")

    def axi_write(self, address: int, value: int, strobe: int = 0xF) -> None:
        """One write of a bus of 32-bit words (AXI4-Lite); bit b of strobe lets byte b be written."""
        for name, number, most in (("value", value, 0xFFFF_FFFF), ("strobe", strobe, 0xF)):
            if not 0 <= number <= most:
                raise Error(f"axi_write 0x{address:02X}: {name} is 0 to 0x{most:X}, not {number}",
                            "MB4SIM_ERROR_VALUE")
        self._on_words("axi_write", address, lib.mb4sim_axi_write, value, strobe)

    def axi_read(self, address: int) -> int:
        """One read of a bus of 32-bit words (AXI4-Lite)."""
        value = ffi.new("uint32_t *")
        self._on_words("axi_read", address, lib.mb4sim_axi_read, value)
        return int(value[0])

    def mem_write(self, address: int, data: bytes) -> None:
        """Writes bytes from any address of the bus of words on, one access a word."""
        what = f"mem_write 0x{address:02X}"
        if self._do(what, lib.mb4sim_mem_write, address, bytes(data), len(data)):
            raise Error(f"{what}: the bus answered with an error")

    def mem_read(self, address: int, count: int) -> bytes:
        """Reads `count` bytes from any address of the bus of words on, one access a word."""
        what, data = f"mem_read 0x{address:02X}", ffi.new("uint8_t[]", count)
        if self._do(what, lib.mb4sim_mem_read, address, data, count):
            raise Error(f"{what}: the bus answered with an error")
        return bytes(ffi.buffer(data))

    def stream_read(self) -> Optional[Tuple[List[int], int]]:
        """The next beat of the stream of a master on AXI, (words, user); None if none waits."""
        words, user = ffi.new("uint32_t[]", STREAM_WORDS), ffi.new("uint32_t *")
        count = self._do("stream_read", lib.mb4sim_stream_read, words, STREAM_WORDS, user)
        return (list(words[0:count]), user[0]) if count else None
