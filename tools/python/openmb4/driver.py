# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The driver of drivers/ on a simulated chip, through its C binding."""

from typing import Any, Callable, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._library import Error, RangeMistake, driver_error, ffi, lib, simulator_error
from ._opened import Opened
from .config import Config, from_c, to_c, what_is_right
from .reading import Identity, Reading
from .table import to_pandas

# What the arguments of a call take: the driver says only that one is out of its range.
_SLAVE = "slave is 1 to 8, and one that the configuration has"
_ACCESS = "channel is 1 or 2, slave_id 0 to 7, address and size together at most 128, size 1 to 128"
_REGISTERS = "address is 0 to 0xFF, size 1 to 64, both together at most 256"


def _dtype(kind: Any) -> "np.dtype[Any]":
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


class Driver:
    """The calls of mb4.h by their names. Each raises Error with the driver's words. The transfers
    are SPI: with a parallel host they fail."""

    def __init__(self, simulator: Opened):
        self._simulator = simulator
        self._session = ffi.new("openmb4_session *")
        self._used: Optional[Config] = None  # what configure() has written
        lib.openmb4_begin(self._session, simulator._sim)
        self._device = ffi.addressof(self._session[0], "device")

    def __repr__(self) -> str:
        how = "not configured: call configure()" if self._used is None else repr(self._used)
        return f"<Driver of {self._simulator._name}, {how}>"

    def _do(self, what: str, function: Callable[..., Any], *arguments: Any, right: str = "",
            config: Optional[Config] = None) -> None:
        """`what` is the call for messages, `right` tells what its arguments take."""
        with self._simulator._lock:
            self._begin()
            try:
                result = self._simulator._call(function, self._device, *arguments)
            except OverflowError as error:
                raise RangeMistake(f"{what}: {right or error}", "MB4_INVALID_ARGUMENT") from error
            self._check_simulator()
        if result.code == lib.MB4_OK:
            return
        if result.code != lib.MB4_INVALID_ARGUMENT:
            right = what_is_right(config, result) if config else ""
        raise driver_error(result, what, right)

    def _begin(self) -> None:
        self._session.error = 0
        if self._simulator._running:  # the driver is in the middle of something
            raise simulator_error(lib.MB4SIM_ERROR_CALLBACK, "driver")

    def _check_simulator(self) -> None:
        if self._session.error:
            raise simulator_error(self._session.error, "driver")

    def config(self) -> Config:
        """The configuration for all slaves of the scenario, as `mb4sim run` makes it. Its members may
        be changed before configure()."""
        config, error = ffi.new("mb4_config *"), ffi.new("char[]", 1000)
        simulator = self._simulator
        if lib.openmb4_config(simulator._scenario, simulator._is_path, config, error, 1000):
            raise Error(ffi.string(error).decode(errors="replace"), "MB4SIM_ERROR_VALUE")
        return from_c(config)

    def configure(self, config: Optional[Config] = None) -> None:
        """Checks and writes a configuration, by default config()."""
        used = self.config() if config is None else config
        given = to_c(used)
        self._do("configure", lib.mb4_configure, given, config=used)
        self._used = from_c(given)

    def probe(self) -> Tuple[int, int]:
        """VERSION and REVISION of the chip."""
        version, revision = ffi.new("uint8_t *"), ffi.new("uint8_t *")
        self._do("probe", lib.mb4_probe, version, revision)
        return version[0], revision[0]

    def verify(self) -> None:
        """Compares the configuration in the chip with that of configure()."""
        self._do("verify", lib.mb4_verify)

    def reset(self) -> None:
        """Brings the chip to the state after its reset; then it is to be configured."""
        self._do("reset", lib.mb4_reset)
        self._used = None

    def initialize(self) -> List[int]:
        """Line delay of both channels in quarters of a period of MA."""
        quarters = ffi.new("uint8_t[]", lib.MB4_CHANNELS)
        self._do("initialize", lib.mb4_initialize, quarters)
        return list(quarters)

    def read_frame(self, slave: int) -> Reading:
        """The word of one slave by a single frame. If its nE is 0 the Error has the code
        MB4_SLAVE_ERROR, and its `reading` is what the slave has sent."""
        reading = ffi.new("mb4_reading *")
        try:
            self._do(f"read_frame({slave})", lib.mb4_read_frame, slave, reading, right=_SLAVE)
        except Error as error:
            if error.code == "MB4_SLAVE_ERROR":
                error.reading = self._reading(reading)
            raise
        return self._reading(reading)

    @staticmethod
    def _reading(reading: Any) -> Reading:
        return Reading(*(getattr(reading, name) for name in Reading._fields))

    def _rows(self, automatic: bool, count: int) -> npt.NDArray[Any]:
        if count < 0:
            raise Error(f"count is 0 or more, not {count}")
        rows = np.zeros(count, ROW)
        memory = ffi.from_buffer("openmb4_row[]", rows, require_writable=True)
        with self._simulator._lock:
            self._begin()
            self._simulator._call(lib.openmb4_read, self._session, automatic, memory, count)
            self._check_simulator()
        if count and rows["result"]["code"][0] in (lib.MB4_NOT_CONFIGURED, lib.MB4_WRONG_MODE):
            raise driver_error(memory[0].result, "automatic_next" if automatic else "read_all")
        return rows

    def read_all(self, count: int = 1) -> npt.NDArray[Any]:
        """Reads frames of all slaves: an array of `count` rows of openmb4_row (native/). Its columns
        are rows["time_ns"], rows["result"] and of slave s rows["frame"]["reading"]["position"][:, s -
        1] with rows["frame"]["code"][:, s - 1], a Code: OK for a good word. A word whose nE is 0 has
        Code.SLAVE_ERROR: its position is not to be trusted."""
        return self._rows(False, count)

    def read_table(self, count: int = 1, slaves: Optional[Sequence[int]] = None) -> Any:
        """The frames of read_all() as a pandas.DataFrame: openmb4.to_pandas()."""
        return to_pandas(self.read_all(count), slaves)

    def write_actuator(self, slave: int, word: int) -> None:
        """Sends a word to an actuator in one frame."""
        self._do(f"write_actuator({slave}, {word:#x})", lib.mb4_write_actuator, slave, word,
                 right=f"{_SLAVE}, word at most its data_bits")

    def break_transmission(self) -> None:
        """Ends what runs on the lines: BREAK."""
        self._do("break_transmission", lib.mb4_break_transmission)

    def read_status(self) -> bytes:
        """Bytes 0xF0..0xF4."""
        status = ffi.new("uint8_t[]", lib.MB4_STATUS_BYTES)
        self._do("read_status", lib.mb4_read_status, status)
        return bytes(status)

    def clear_valid(self, slave: int) -> None:
        """Clears SVALID of a slave."""
        self._do(f"clear_valid({slave})", lib.mb4_clear_valid, slave, right=_SLAVE)

    def automatic_start(self) -> None:
        """Starts automatic frames, by Config.frame_start."""
        self._do("automatic_start", lib.mb4_automatic_start)

    def automatic_stop(self) -> None:
        """Ends automatic frames."""
        self._do("automatic_stop", lib.mb4_automatic_stop)

    def automatic_restart(self) -> None:
        """Starts automatic frames again after an error."""
        self._do("automatic_restart", lib.mb4_automatic_restart)

    def automatic_next(self, count: int = 1) -> npt.NDArray[Any]:
        """The next frames of automatic operation, in the form of read_all()."""
        return self._rows(True, count)

    def slave_read(self, channel: int, slave_id: int, address: int, size: int = 1) -> bytes:
        """Reads registers of a slave through control communication."""
        data = ffi.new("uint8_t[]", size)
        self._do(f"slave_read({channel}, {slave_id}, 0x{address:02X}, {size})", lib.mb4_slave_read,
                 channel, slave_id, address, data, size, right=_ACCESS)
        return bytes(data)

    def slave_write(self, channel: int, slave_id: int, address: int, data: bytes) -> None:
        """Writes registers of a slave through control communication."""
        self._do(f"slave_write({channel}, {slave_id}, 0x{address:02X}, {len(data)} bytes)",
                 lib.mb4_slave_write, channel, slave_id, address, bytes(data), len(data),
                 right=_ACCESS)

    def slave_command(self, channels: int, ids: int, code: int,
                      test_acknowledge: bool = False) -> None:
        """A command; bit masks of channels and IDs as in mb4_command."""
        self._do("slave_command", lib.mb4_slave_command,
                 ffi.new("mb4_command *", [channels, ids, code, test_acknowledge]),
                 right="channels is 1 to 3, code 0 to 3, test_acknowledge not with ids 0")

    def slave_activate(self, ids: int = 0, ids_2: int = 0) -> None:
        """Switches the data and the control communication of BiSS C slaves on. Bit n of `ids` is
        ID n of channel 1, of `ids_2` that of channel 2; both 0: those of the enabled slaves."""
        self._do("slave_activate", lib.mb4_slave_activate, ids, ids_2)

    def scan(self, channel: int) -> List[Identity]:
        """The identities of the IDs that answer on a channel."""
        found, count = ffi.new("mb4_identity[8]"), ffi.new("uint8_t *")
        self._do(f"scan({channel})", lib.mb4_scan, channel, found, 8, count,
                 right="channel is 1 or 2")
        return [Identity(bytes(one.device_id), bytes(one.manufacturer), one.eds_bank,
                         one.has_identity, one.has_eds) for one in found[0:count[0]]]

    def read_registers(self, address: int, size: int = 1) -> bytes:
        """Registers of the chip."""
        data = ffi.new("uint8_t[]", size)
        self._do(f"read_registers(0x{address:02X}, {size})", lib.mb4_read_registers, address, data,
                 size, right=_REGISTERS)
        return bytes(data)

    def write_registers(self, address: int, data: bytes) -> None:
        """Writes registers of the chip, all bits of them."""
        self._do(f"write_registers(0x{address:02X}, {len(data)} bytes)", lib.mb4_write_registers,
                 address, bytes(data), len(data), right=_REGISTERS)
