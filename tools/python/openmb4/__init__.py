# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The openmb4 simulator and driver in Python; docs/python.md is the manual.

    with openmb4.Simulator("examples/resolute-26.toml") as chip:
        chip.driver.configure()
        print(chip.driver.read_frame(1).position)
"""

from ._library import Error, version
from ._sweep import sweep
from .codes import (ClockSource, Code, Flags, FrameStart, LineInterface, Protocol, SimulatorCode,
                    SpiCheck)
from .config import Config, SlaveConfig, frame_period_clk_at_least, ma_hz_at_most
from .driver import Driver
from .paths import examples, files
from .reading import Identity, Reading
from .record import Edges
from .registers import Field, Register, Registers
from .simulator import Frame, Hint, Simulator
from .table import to_pandas

__version__ = version()
__all__ = ["ClockSource", "Code", "Config", "Driver", "Edges", "Error", "Field", "Flags", "Frame",
           "FrameStart", "Hint", "Identity", "LineInterface", "Protocol", "Reading", "Register",
           "Registers", "Simulator", "SimulatorCode", "SlaveConfig", "SpiCheck", "examples",
           "files", "frame_period_clk_at_least", "ma_hz_at_most", "sweep", "to_pandas", "version"]
