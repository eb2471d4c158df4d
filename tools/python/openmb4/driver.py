# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The driver of drivers/ on a simulated chip, through its C binding."""

from typing import Any, Callable, List, NamedTuple, Tuple

import numpy as np

from ._library import Error, driver_error, ffi, lib, simulator_error
from ._opened import Opened

# mb4_config of mb4.h: its members are read and assigned by their C names.
Config = Any


def _dtype(kind: Any) -> np.dtype:
    """The numpy type with the memory layout of a C type."""
    if kind.kind == "primitive":
        return np.dtype("?" if kind.cname == "_Bool" else kind.cname.removesuffix("_t"))
    if kind.kind == "array":
        return np.dtype((_dtype(kind.item), kind.length))
    return np.dtype({"names": [name for name, _ in kind.fields],
                     "formats": [_dtype(field.type) for _, field in kind.fields],
                     "offsets": [field.offset for _, field in kind.fields],
                     "itemsize": ffi.sizeof(kind)})


ROW = _dtype(ffi.typeof("openmb4_row"))


class _Reading(NamedTuple):
    raw: int
    position: int
    crc: int
    crc_stored: bool
    slave_error: bool
    slave_warning: bool
    slave: int


class Reading(_Reading):
    """mb4_reading of mb4.h."""

    __slots__ = ()

    def __getattr__(self, name: str) -> Any:
        if name in ("error", "warning"):
            raise AttributeError(f"'{name}' of a Reading is called 'slave_{name}'")
        raise AttributeError(f"a Reading has no '{name}'")


class Identity(NamedTuple):
    """mb4_identity of mb4.h: what one ID of a bus has answered."""

    device_id: bytes
    manufacturer: bytes
    eds_bank: int
    has_identity: bool
    has_eds: bool


class Driver:
    """The calls of mb4.h by their names. Each raises Error with the driver's words. The transfers
    are SPI: with a parallel host they fail."""

    def __init__(self, simulator: Opened):
        self._simulator = simulator
        self._session = ffi.new("openmb4_session *")
        lib.openmb4_begin(self._session, simulator._sim)
        self._device = ffi.addressof(self._session[0], "device")

    def _do(self, function: Callable[..., Any], *arguments: Any) -> None:
        with self._simulator._lock:
            self._begin()
            result = self._simulator._call(function, self._device, *arguments)
            self._check_simulator()
        if result.code != lib.MB4_OK:
            raise driver_error(result)

    def _begin(self) -> None:
        self._session.error = 0
        if self._simulator._running:  # the driver is in the middle of something
            raise simulator_error(lib.MB4SIM_ERROR_CALLBACK, "driver")

    def _check_simulator(self) -> None:
        if self._session.error:
            raise simulator_error(self._session.error, "driver")

    def config(self) -> Config:
        """The configuration for all slaves of the scenario, as `mb4sim run` makes it: an mb4_config,
        whose members may be changed before configure()."""
        config, error = ffi.new("mb4_config *"), ffi.new("char[]", 1000)
        simulator = self._simulator
        if lib.openmb4_config(simulator._scenario, simulator._is_path, config, error, 1000):
            raise Error(ffi.string(error).decode(errors="replace"), "MB4SIM_ERROR_VALUE")
        return config

    def configure(self, config: Config = None) -> None:
        """Checks and writes a configuration, by default config()."""
        self._do(lib.mb4_configure, self.config() if config is None else config)

    def probe(self) -> Tuple[int, int]:
        """VERSION and REVISION of the chip."""
        version, revision = ffi.new("uint8_t *"), ffi.new("uint8_t *")
        self._do(lib.mb4_probe, version, revision)
        return version[0], revision[0]

    def verify(self) -> None:
        self._do(lib.mb4_verify)

    def reset(self) -> None:
        self._do(lib.mb4_reset)

    def initialize(self) -> List[int]:
        """Line delay of both channels in quarters of a period of MA."""
        quarters = ffi.new("uint8_t[]", lib.MB4_CHANNELS)
        self._do(lib.mb4_initialize, quarters)
        return list(quarters)

    def read_frame(self, slave: int) -> Reading:
        """The word of one slave by a single frame. If its nE is 0 the Error has the code
        MB4_SLAVE_ERROR, and its `reading` is what the slave has sent."""
        reading = ffi.new("mb4_reading *")
        try:
            self._do(lib.mb4_read_frame, slave, reading)
        except Error as error:
            if error.code == "MB4_SLAVE_ERROR":
                error.reading = self._reading(reading)
            raise
        return self._reading(reading)

    @staticmethod
    def _reading(reading: Any) -> Reading:
        return Reading(*(getattr(reading, name) for name in Reading._fields))

    def _rows(self, automatic: bool, count: int) -> np.ndarray:
        rows = np.zeros(count, ROW)
        memory = ffi.from_buffer("openmb4_row[]", rows, require_writable=True)
        with self._simulator._lock:
            self._begin()
            self._simulator._call(lib.openmb4_read, self._session, automatic, memory, count)
            self._check_simulator()
        if count and rows["result"]["code"][0] in (lib.MB4_NOT_CONFIGURED, lib.MB4_WRONG_MODE):
            raise driver_error(memory[0].result)
        return rows

    def read_all(self, count: int = 1) -> np.ndarray:
        """Reads frames of all slaves: an array of `count` rows of openmb4_row (native/). Its columns
        are rows["time_ns"], rows["result"] and of slave s rows["frame"]["reading"]["position"][:, s -
        1] with rows["frame"]["code"][:, s - 1], which is 0 for a good word. A word whose nE is 0 has
        the code of MB4_SLAVE_ERROR, 21: its position is not to be trusted."""
        return self._rows(False, count)

    def write_actuator(self, slave: int, word: int) -> None:
        self._do(lib.mb4_write_actuator, slave, word)

    def break_transmission(self) -> None:
        self._do(lib.mb4_break_transmission)

    def read_status(self) -> bytes:
        """Bytes 0xF0..0xF4."""
        status = ffi.new("uint8_t[]", lib.MB4_STATUS_BYTES)
        self._do(lib.mb4_read_status, status)
        return bytes(status)

    def clear_valid(self, slave: int) -> None:
        self._do(lib.mb4_clear_valid, slave)

    def automatic_start(self) -> None:
        self._do(lib.mb4_automatic_start)

    def automatic_stop(self) -> None:
        self._do(lib.mb4_automatic_stop)

    def automatic_restart(self) -> None:
        self._do(lib.mb4_automatic_restart)

    def automatic_next(self, count: int = 1) -> np.ndarray:
        """The next frames of automatic operation, in the form of read_all()."""
        return self._rows(True, count)

    def slave_read(self, channel: int, slave_id: int, address: int, size: int = 1) -> bytes:
        """Reads registers of a slave through control communication."""
        data = ffi.new("uint8_t[]", size)
        self._do(lib.mb4_slave_read, channel, slave_id, address, data, size)
        return bytes(data)

    def slave_write(self, channel: int, slave_id: int, address: int, data: bytes) -> None:
        self._do(lib.mb4_slave_write, channel, slave_id, address, bytes(data), len(data))

    def slave_command(self, channels: int, ids: int, code: int,
                      test_acknowledge: bool = False) -> None:
        """A command; bit masks of channels and IDs as in mb4_command."""
        self._do(lib.mb4_slave_command,
                 ffi.new("mb4_command *", [channels, ids, code, test_acknowledge]))

    def slave_activate(self, ids: int = 0, ids_2: int = 0) -> None:
        """Switches the data and the control communication of BiSS C slaves on. Bit n of `ids` is
        ID n of channel 1, of `ids_2` that of channel 2; both 0: those of the enabled slaves."""
        self._do(lib.mb4_slave_activate, ids, ids_2)

    def scan(self, channel: int) -> List[Identity]:
        """The identities of the IDs that answer on a channel."""
        found, count = ffi.new("mb4_identity[8]"), ffi.new("uint8_t *")
        self._do(lib.mb4_scan, channel, found, 8, count)
        return [Identity(bytes(one.device_id), bytes(one.manufacturer), one.eds_bank,
                         one.has_identity, one.has_eds) for one in found[0:count[0]]]

    def read_registers(self, address: int, size: int = 1) -> bytes:
        """Registers of the chip."""
        data = ffi.new("uint8_t[]", size)
        self._do(lib.mb4_read_registers, address, data, size)
        return bytes(data)

    def write_registers(self, address: int, data: bytes) -> None:
        self._do(lib.mb4_write_registers, address, bytes(data), len(data))
