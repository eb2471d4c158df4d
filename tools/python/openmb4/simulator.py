# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A simulated chip with its host and encoders."""

import contextlib
import json
import os
import pathlib
import re
from typing import (Any, Callable, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Union)

import numpy as np

from ._library import Error, RangeMistake, ffi, lib, similar, simulator_error
from ._opened import ERROR_BYTES, Opened, Scenario, Text, document
from .codes import SimulatorCode
from .driver import Driver
from .record import Edges
from .registers import AxiBus, ChipBus, DslBus, Registers

# Names that masters have for pins, to tell those of this one: sim/README.md.
_PINS = ("NCS", "SCLK", "MOSI", "MISO", "ALE", "NRD_RNW", "NWR_E", *(f"DB{i}" for i in range(8)),
         "CFGSPI", "INT_NMOT", "NRES", "CLK", "GETSENS", "NER", "EOT", "MA1", "MA2", "MA2_NMA1", "MO1",
         "MO2", "MO2_NMO1", "SL1", "SL2", "SL2_NSL1", "rst_ni", "ma_o", "sl_i", "irq_o", "trigger_i",
         "spi_clk_o", "txen_o", "irq", "error", "por_n", "aresetn", "ext_sample_clk",
         *(f"{one}{i}" for i in range(16) for one in ("ma", "slo")))
# Places of a line that are no pins, with a number of the channel: MB4SIM_EDGE_...
_PLACES = {"SLO": 3, "OUT": 4, "EN": 5, "IN": 6, "ENCODER": 7}
_EDGE = np.dtype([("time", np.int64), ("name", np.uint32), ("level", np.uint32)])
_LAST_FRAMES = 1024  # mb4sim_slave_sent() keeps


class Hint(NamedTuple):
    """What does not fit between the chip, as its host has told it, and the scenario: mb4sim_report()
    of mb4sim.h. str() is its sentence."""

    kind: str
    place: str
    text: str

    def __str__(self) -> str:
        return self.text


class Frame(NamedTuple):
    """A frame on a line: mb4sim_frame of mb4sim.h."""

    channel: int
    number: int
    start_ns: int
    end_ns: int
    ma_edges: int
    ma_low: bool  # MA rests at 0 after the frame: CDM = 1 in BiSS C
    fault: bool  # a fault lasted in the frame


class Simulator(Opened):
    """Opens a scenario: the path of its file (str or pathlib.Path), its TOML text or a dict of its
    tables. A str of one line is a path if it ends with .toml or holds no "="; from_file() and
    from_text() leave no doubt. Time then stands at 1 us. Raises Error with the line that names the
    mistake.

    driver                                 calls of the driver on this chip: Driver
    regs, axi_regs, clb_regs, pru_regs,    registers by name, of the iC-MB4 and its siblings:
    dsl_regs                               Registers

    A process may hold any number of simulators, and each may be used from any thread: calls on one
    simulator wait for each other, calls on several run at the same time. A callback of on_frame()
    may read, but not let time pass. Close a simulator with close() or `with`.
    """

    def __init__(self, scenario: Scenario, /):
        self._waveform: Optional[bytes] = None  # the one that is being written
        super().__init__(scenario)
        self.driver = Driver(self)
        self.regs = Registers(ChipBus(self), "mb4")
        self.axi_regs = Registers(AxiBus(self, "axi"), "axi")
        self.clb_regs = Registers(AxiBus(self, "clb"), "clb")
        self.pru_regs = Registers(AxiBus(self, "pru"), "pru")
        self.dsl_regs = Registers(DslBus(self), "dsl", Registers(AxiBus(self, "dsl"), "dsl_page"))

    @classmethod
    def from_file(cls, path: "Union[str, os.PathLike[str]]") -> "Simulator":
        """Opens the scenario in a file."""
        return cls(pathlib.Path(path))

    @classmethod
    def from_text(cls, text: str) -> "Simulator":
        """Opens a scenario that is TOML text."""
        return cls(Text(text))

    def __repr__(self) -> str:
        if self._sim is None:
            return f"<Simulator of {self._name}, closed>"
        found, slaves = self._describe(), ""
        if found is not None:
            slaves = "".join(f", slave {one.number} {ffi.string(one.protocol).decode()} of "
                             f"{one.data_bits} bits" for one in found.slave[0:found.slaves])
            slaves = f", {ffi.string(found.master).decode()}{slaves or ', no slave'}"
        return f"<Simulator of {self._name}{slaves}, at {self.time_ns / 1000:.3f} us>"

    def __enter__(self) -> "Simulator":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    # --- time ---

    @property
    def time_ns(self) -> int:
        """Time since power-on, rounded down."""
        return int(self._call(lib.mb4sim_time_ns, self._sim))

    @property
    def clk_cycles(self) -> int:
        """Rising edges of the system clock so far."""
        return int(self._call(lib.mb4sim_clk_cycles, self._sim))

    def advance_ns(self, ns: int) -> None:
        """Lets time pass."""
        with self._lock:
            self._call(lib.mb4sim_advance_ns, self._sim, ns)
            error = lib.mb4sim_last_error(self._sim, ffi.NULL, 0)
            if error:
                raise simulator_error(error, "advance_ns")

    def run_until(self, pin: str, level: int, limit_ns: int) -> bool:
        """Lets time pass until a pin has this level; False: it has not within limit_ns."""
        return self._on_pin(f"run_until {pin}", pin, level, lib.mb4sim_run_until, limit_ns) == 1

    # --- pins and slaves ---

    def _pins(self) -> List[str]:
        """The pins of this master, of those that any has."""
        return [name for name in _PINS if lib.mb4sim_pin_read(self._sim, name.encode()) >= 0]

    def _on_pin(self, what: str, name: str, level: int, function: Callable[..., int],
                *arguments: Any) -> int:
        """A call with a pin and its level; its error names both."""
        with self._lock:
            result: int = self._call(function, self._sim, name.encode(), level, *arguments)
        text = ""
        if result == SimulatorCode.UNKNOWN:
            text = self._unknown_pin(name)
        elif result == SimulatorCode.VALUE:
            text = f"level is 0 or 1, not {level}"
        if result < 0:
            raise simulator_error(result, what, text)
        return result

    def _unknown_pin(self, name: str) -> str:
        names = self._pins()
        return (f"there is no pin '{name}'" + (similar(name, names) or
                (f"; there are {', '.join(names)}" if names else "; this master has no pins")))

    def pin(self, name: str) -> int:
        """The level of a pin by its datasheet name."""
        with self._lock:
            level: int = self._call(lib.mb4sim_pin_read, self._sim, name.encode())
        if level < 0:
            raise simulator_error(level, f"pin {name}", self._unknown_pin(name))
        return level

    def record(self, pins: Sequence[str], ns: int) -> Edges:
        """Lets `ns` pass and keeps every edge of these pins with its time in ps. Besides pins there
        are "SLO1", the output of the slave at its end of the cable of channel 1, and on a line of one
        wire "OUT1", "EN1", "IN1", "ENCODER1"."""
        if isinstance(pins, str):
            raise Error(f"record: pins is a list of names: [{pins!r}], not {pins!r}")
        if ns < 0:
            raise Error(f"record: ns is 0 or more, not {ns}")
        names, places, channels = list(dict.fromkeys(pins)), [], []
        for name in names:
            match = re.fullmatch(r"([A-Z]+)([1-9]\d*)", name)
            known = match is not None and match[1] in _PLACES
            places.append(_PLACES[match[1]] if match and known else -1)
            channels.append(int(match[2]) if match and known else 0)
        texts = [ffi.new("char[]", name.encode()) for name in names]
        edges = ffi.new("openmb4_edges *")
        with self._lock:
            start = self.time_ns * 1000
            try:
                result = self._call(lib.openmb4_record, self._sim, ffi.new("char *[]", texts), places,
                                    channels, len(names), ns, edges)
                if result < 0:
                    raise simulator_error(result, "record", self._why_no_record(result, names, places))
                size = edges.count * _EDGE.itemsize
                seen = np.frombuffer(bytes(ffi.buffer(edges.edges, size)) if size else b"", _EDGE)
            finally:
                lib.openmb4_free(edges)
        found = {}
        for index, name in enumerate(names):
            own = seen[seen["name"] == index]
            if not len(own):
                raise Error(f"record: channel {channels[index]} has no line with '{name}'",
                            "MB4SIM_ERROR_UNKNOWN")
            found[name] = own["time"].copy(), own["level"].astype(np.int8)
        start = int(seen["time"][0]) if len(seen) else start
        return Edges(start, start + 1000 * ns, found)

    def _why_no_record(self, result: int, names: Sequence[str], places: Sequence[int]) -> str:
        if result == SimulatorCode.DRIVEN:
            return "edges of CLK are not recorded; its frequency is f_clk_hz of the scenario"
        pins = [name for name, place in zip(names, places) if place < 0]
        unknown = [name for name in pins if lib.mb4sim_pin_read(self._sim, name.encode()) < 0]
        return self._unknown_pin(unknown[0]) if unknown else ""

    def set_pin(self, name: str, level: int) -> None:
        """Drives an input pin. At NER 0 pulls it low and 1 lets it go."""
        self._on_pin(f"set_pin {name}", name, level, lib.mb4sim_pin_write)

    def _on_slave(self, what: str, slave: int, right: Callable[[Any], str],
                  function: Callable[..., int], *arguments: Any) -> None:
        """A call with a slave; its error names those that there are, or by right(description of the
        slave) what the value may be."""
        with self._lock:
            try:
                result: int = self._call(function, self._sim, slave, *arguments)
            except OverflowError as error:
                raise RangeMistake(f"{what}: slave counts from 1, address and value are 0 to 0xFF",
                                   "MB4SIM_ERROR_VALUE") from error
            if result >= 0:
                return
            found = self._describe()
        slaves = {one.number: one for one in found.slave[0:found.slaves]} if found else {}
        text = ""
        if result == SimulatorCode.UNKNOWN and found:
            text = f"there is no slave {slave}; the scenario has " + (
                ", ".join(map(str, slaves)) if slaves else "none")
        elif result == SimulatorCode.VALUE and slave in slaves:
            text = right(slaves[slave])
        raise simulator_error(result, what, text)

    def set_data(self, slave: int, raw: int) -> None:
        """The raw word, flags included, that the slave latches from now on."""
        if not 0 <= raw < 1 << 64:
            raise Error(f"set_data {slave}: raw is at most 64 bits, not {raw}", "MB4SIM_ERROR_VALUE")

        def right(one: Any) -> str:
            if ffi.string(one.protocol) == b"replay":
                return f"slave {slave} plays a recording; it has no word of its own"
            return (f"slave {slave} has {one.data_bits} bits: raw is 0 to "
                    f"0x{(1 << one.data_bits) - 1:X}, not 0x{raw:X}")

        self._on_slave(f"set_data {slave}", slave, right, lib.mb4sim_slave_set_data, raw)

    def slave_register(self, slave: int, address: int) -> int:
        """A register of the slave's own file, without traffic on the line."""
        value = ffi.new("uint8_t *")
        self._on_slave(f"slave_register {slave}", slave, lambda _: "", lib.mb4sim_slave_reg_read,
                       address, value)
        return int(value[0])

    def set_slave_register(self, slave: int, address: int, value: int) -> None:
        """Writes a register of the slave's own file, without traffic on the line."""
        self._on_slave(f"set_slave_register {slave}", slave, lambda _: "",
                       lib.mb4sim_slave_reg_write, address, value)

    def frames(self, slave: int) -> int:
        """Number of frames in which this slave has sent its start bit."""
        return int(self._call(lib.mb4sim_slave_frames, self._sim, slave))

    def sent(self, slave: int, frame: Optional[int] = None) -> int:
        """The raw word that a slave sent in a frame, 1..frames(); by default in its last one. The
        last 1024 are kept."""
        with self._lock:
            raw, frames = ffi.new("uint64_t *"), self.frames(slave)
            which = frames if frame is None else frame

            def right(_: Any) -> str:
                first = max(1, frames - _LAST_FRAMES + 1)
                kept = f"frames {first} to {frames} are kept" if frames else "it has sent no frame yet"
                return f"there is no word of frame {which}; {kept}"

            self._on_slave(f"sent {slave}", slave, right, lib.mb4sim_slave_sent, which, raw)
            return int(raw[0])

    # --- tests of firmware ---

    def inject(self, faults: Union[str, Mapping[str, Any]]) -> None:
        """Adds faults or cable events, as TOML text or a dict; times count from now."""
        text = (faults if isinstance(faults, str) else document(faults)).encode()
        error = ffi.new("char[]", ERROR_BYTES)
        result = self._call(lib.mb4sim_inject, self._sim, text, error, ERROR_BYTES)
        if result < 0:
            said = ffi.string(error).decode(errors="replace")
            raise Error(said, "MB4SIM_ERROR_VALUE") if said else simulator_error(result, "inject")

    def on_frame(self, callback: Optional[Callable[[Frame], Any]]) -> None:
        """Calls `callback` at the end of every frame of a line; None ends it. An exception of the
        callback comes out of the call that lets time pass."""

        def keep(kind: Any, value: BaseException, trace: Any) -> None:
            self._raised = self._raised or value

        def pass_on(_: Any, frame: Any) -> None:
            assert callback is not None
            callback(Frame(frame.channel, frame.number, frame.start_ns, frame.end_ns,
                           frame.ma_edges, bool(frame.flags & lib.MB4SIM_FRAME_MA_LOW),
                           bool(frame.flags & lib.MB4SIM_FRAME_FAULT)))

        with self._lock:
            function = ffi.NULL if callback is None else ffi.callback(
                "mb4sim_frame_callback", pass_on, onerror=keep)
            self._do("on_frame", lib.mb4sim_on_frame, function, ffi.NULL)
            self._callback = function  # C keeps no reference

    def trace_start(self, path: "Union[str, os.PathLike[str]]") -> None:
        """Begins a waveform now: an FST file for GTKWave or Surfer, as `mb4sim run --trace` writes
        it. Its end writes a .gtkw beside it, GTKWave's view with the names of the states. The run
        goes on as without it, but slowly. Raises Error with the reason, and then nothing has
        changed."""
        file = os.fsencode(path)
        if b"\0" in file:
            raise Error("trace_start: the path holds a character of code 0")
        with self._lock:
            self._trace("trace_start", lib.mb4sim_trace_start, file)
            self._waveform = os.path.abspath(file)

    def trace_stop(self) -> None:
        """Ends the waveform, completes its file and writes its view; close() does so too."""
        with self._lock:
            self._trace("trace_stop", lib.mb4sim_trace_stop)
            self._write_view()

    def _write_view(self) -> None:
        file, self._waveform = self._waveform, None
        if file is None:
            return
        error = ffi.new("char[]", ERROR_BYTES)
        view = (file[:-len(b".fst")] if file.endswith(b".fst") else file) + b".gtkw"
        if lib.openmb4_write_view(self._scenario, self._is_path, file, view, error, ERROR_BYTES):
            raise Error(f"trace_stop: {ffi.string(error).decode(errors='replace')}",
                        "MB4SIM_ERROR_TRACE")

    def close(self) -> None:
        """Ends the simulator; a second call does nothing."""
        with self._lock:
            super().close()
            self._write_view()

    @contextlib.contextmanager
    def trace(self, path: "Union[str, os.PathLike[str]]") -> Iterator[None]:
        """A waveform of what the `with` block does, also if the block raises. close() inside the
        block ends it."""
        self.trace_start(path)
        try:
            yield
        finally:
            if self._sim is not None:
                self.trace_stop()

    def _trace(self, what: str, function: Callable[..., int], *arguments: Any) -> None:
        with self._lock:
            result = self._call(function, self._sim, *arguments)
            if result == lib.MB4SIM_ERROR_TRACE:
                why = ffi.new("char[]", ERROR_BYTES)
                lib.mb4sim_last_error(self._sim, why, ERROR_BYTES)
                raise Error(f"{what}: {ffi.string(why).decode(errors='replace')}",
                            "MB4SIM_ERROR_TRACE")
            if result < 0:
                raise simulator_error(result, what)

    def report(self) -> Dict[str, Any]:
        """Faults, what they touched, violations of the host's timing, and hints: what mb4sim_report()
        of mb4sim.h writes."""
        with self._lock:
            size = self._do("report", lib.mb4sim_report, ffi.NULL, 0) + 1
            text = ffi.new("char[]", size)
            self._do("report", lib.mb4sim_report, text, size)
            return dict(json.loads(ffi.string(text)))

    def hints(self) -> List[Hint]:
        """Why words fail that no fault has met: lengths, CRC, protocol and the like that differ between
        the chip's registers and the encoders. Empty if they fit."""
        return [Hint(**hint) for hint in self.report()["hints"]]
