# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The openmb4 simulator and driver in Python; docs/python.md is the manual.

    with openmb4.Simulator(Path("examples/resolute-26.toml")) as chip:
        chip.driver.configure()
        print(chip.driver.read_frame(1).position)
"""

from ._library import Error, version
from ._sweep import sweep
from .driver import Config, Driver, Identity, Reading
from .registers import Field, Register, Registers
from .simulator import Edges, Frame, Simulator

__version__ = version()
__all__ = ["Config", "Driver", "Edges", "Error", "Field", "Frame", "Identity", "Reading", "Register",
           "Registers", "Simulator", "sweep"]
