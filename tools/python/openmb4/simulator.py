# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A simulated chip with its host and encoders."""

import contextlib
import json
import os
from typing import Any, Callable, Dict, Iterator, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from ._library import Error, ffi, lib, simulator_error
from ._opened import ERROR_BYTES, Opened, document
from .driver import Driver
from .registers import AxiBus, ChipBus, Registers


class Frame(NamedTuple):
    """A frame on a line: mb4sim_frame of mb4sim.h."""

    channel: int
    number: int
    start_ns: int
    end_ns: int
    ma_edges: int
    ma_low: bool  # MA rests at 0 after the frame: CDM = 1 in BiSS C
    fault: bool  # a fault lasted in the frame


class Edges(NamedTuple):
    """What record() saw: of each pin the times in ns at which a level began, the first at start_ns,
    and these levels."""

    start_ns: int
    end_ns: int
    pins: Dict[str, Tuple[np.ndarray, np.ndarray]]


class Simulator(Opened):
    """Opens a scenario: TOML text (str), the path of a file (os.PathLike) or a dict of its tables.
    Time then stands at 1 us. Raises Error with the line that names the mistake.

    A process may hold any number of simulators, and each may be used from any thread: calls on one
    simulator wait for each other, calls on several run at the same time. A callback of on_frame()
    may read, but not let time pass. Close a simulator with close() or `with`.
    """

    def __init__(self, scenario: Union[str, os.PathLike, Mapping[str, Any]], /):
        super().__init__(scenario)
        self.driver = Driver(self)
        self.regs = Registers(ChipBus(self), "mb4")
        self.axi_regs = Registers(AxiBus(self), "axi")
        self.clb_regs = Registers(AxiBus(self), "clb")
        self.pru_regs = Registers(AxiBus(self), "pru")

    def __enter__(self) -> "Simulator":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    # --- time ---

    @property
    def time_ns(self) -> int:
        """Time since power-on, rounded down."""
        return self._call(lib.mb4sim_time_ns, self._sim)

    @property
    def clk_cycles(self) -> int:
        """Rising edges of the system clock so far."""
        return self._call(lib.mb4sim_clk_cycles, self._sim)

    def advance_ns(self, ns: int) -> None:
        with self._lock:
            self._call(lib.mb4sim_advance_ns, self._sim, ns)
            error = lib.mb4sim_last_error(self._sim, ffi.NULL, 0)
            if error:
                raise simulator_error(error, "advance_ns")

    def run_until(self, pin: str, level: int, limit_ns: int) -> bool:
        """Lets time pass until a pin has this level; False: it has not within limit_ns."""
        return self._do(f"run_until {pin}", lib.mb4sim_run_until, pin.encode(), level,
                        limit_ns) == 1

    # --- pins and slaves ---

    def pin(self, name: str) -> int:
        """The level of a pin by its datasheet name."""
        return self._do(f"pin {name}", lib.mb4sim_pin_read, name.encode())

    def record(self, pins: Sequence[str], ns: int, step_ns: int = 10) -> Edges:
        """Lets `ns` pass and looks at these pins every `step_ns`: an edge is told up to one step
        late, and a pulse shorter than a step may be missed."""
        if ns < 0 or step_ns < 1:
            raise Error(f"record: ns must be 0 or more and step_ns 1 or more, not {ns} and {step_ns}")
        with self._lock:
            start = now = self.time_ns
            seen = {name: [(start, self.pin(name))] for name in pins}
            while now < start + ns:
                self.advance_ns(min(step_ns, start + ns - now))
                now = self.time_ns
                for name, edges in seen.items():
                    level = self.pin(name)
                    if level != edges[-1][1]:
                        edges.append((now, level))
        return Edges(start, now, {name: (np.array([at for at, _ in edges], np.int64),
                                         np.array([level for _, level in edges], np.int8))
                                  for name, edges in seen.items()})

    def set_pin(self, name: str, level: int) -> None:
        """Drives an input pin. At NER 0 pulls it low and 1 lets it go."""
        self._do(f"set_pin {name}", lib.mb4sim_pin_write, name.encode(), level)

    def set_data(self, slave: int, raw: int) -> None:
        """The raw word, flags included, that the slave latches from now on."""
        self._do(f"set_data {slave}", lib.mb4sim_slave_set_data, slave, raw)

    def slave_register(self, slave: int, address: int) -> int:
        """A register of the slave's own file, without traffic on the line."""
        value = ffi.new("uint8_t *")
        self._do(f"slave_register {slave}", lib.mb4sim_slave_reg_read, slave, address, value)
        return value[0]

    def set_slave_register(self, slave: int, address: int, value: int) -> None:
        self._do(f"set_slave_register {slave}", lib.mb4sim_slave_reg_write, slave, address, value)

    def frames(self, slave: int) -> int:
        """Number of frames in which this slave has sent its start bit."""
        return self._call(lib.mb4sim_slave_frames, self._sim, slave)

    def sent(self, slave: int, frame: Optional[int] = None) -> int:
        """The raw word that a slave sent in a frame, 1..frames(); by default in its last one. The
        last 1024 are kept."""
        with self._lock:
            raw = ffi.new("uint64_t *")
            self._do(f"sent {slave}", lib.mb4sim_slave_sent, slave,
                     self.frames(slave) if frame is None else frame, raw)
            return raw[0]

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
            callback(Frame(frame.channel, frame.number, frame.start_ns, frame.end_ns,
                           frame.ma_edges, bool(frame.flags & lib.MB4SIM_FRAME_MA_LOW),
                           bool(frame.flags & lib.MB4SIM_FRAME_FAULT)))

        with self._lock:
            function = ffi.NULL if callback is None else ffi.callback(
                "mb4sim_frame_callback", pass_on, onerror=keep)
            self._do("on_frame", lib.mb4sim_on_frame, function, ffi.NULL)
            self._callback = function  # C keeps no reference

    def trace_start(self, path: Union[str, os.PathLike]) -> None:
        """Begins a waveform now: an FST file for GTKWave or Surfer, as `mb4sim run --trace` writes
        it. The run goes on as without it, but slowly. Raises Error with the reason, and then nothing
        has changed."""
        file = os.fsencode(path)
        if b"\0" in file:
            raise Error("trace_start: the path holds a character of code 0")
        self._trace("trace_start", lib.mb4sim_trace_start, file)

    def trace_stop(self) -> None:
        """Ends the waveform and completes its file; close() does so too."""
        self._trace("trace_stop", lib.mb4sim_trace_stop)

    @contextlib.contextmanager
    def trace(self, path: Union[str, os.PathLike]) -> Iterator[None]:
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

    def report(self) -> dict:
        """Faults, what they touched, and violations of the host's timing: what mb4sim_report() of
        mb4sim.h writes."""
        with self._lock:
            size = self._do("report", lib.mb4sim_report, ffi.NULL, 0) + 1
            text = ffi.new("char[]", size)
            self._do("report", lib.mb4sim_report, text, size)
            return json.loads(ffi.string(text))
