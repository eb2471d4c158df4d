#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the Verilated iCE40 netlist of a design of gate_netlist.py: FOLDER/VDESIGN_gate__ALL.a.

  gate_model.py FOLDER DESIGN [PRESET]
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOOLS = HERE.parents[1] / "tools" / "synth"
sys.path.insert(0, str(TOOLS))

import project  # noqa: E402

# Netlists have unused signals and cells.
QUIET = ["-Wno-DECLFILENAME", "-Wno-UNDRIVEN", "-Wno-UNUSEDSIGNAL", "-Wno-UNUSEDPARAM"]


def cells():
    """The vendor's cell models of Yosys."""
    return Path(project.tool("yosys")).parents[1] / "share" / "yosys" / "ice40" / "cells_sim.v"


def main():
    folder, design = Path(sys.argv[1]).resolve(), sys.argv[2]
    folder.mkdir(parents=True, exist_ok=True)
    status, text = project.run([sys.executable, "-B", TOOLS / "gate_netlist.py", folder,
                                *sys.argv[2:]])
    if status == 0:
        # Verilator does not read the default values of the cells' inputs.
        status, text = project.run(
            [project.tool("verilator"), "--cc", "--build", "-j", "2", "-fno-const-bit-op-tree",
             *project.verilator_flags(), *QUIET, "-DNO_ICE40_DEFAULT_ASSIGNMENTS", "-O3",
             "-CFLAGS", "-std=c++20 -DVL_USER_STOP", "-MAKEFLAGS", "OPT_FAST=-O3 OPT_SLOW=-O0",
             "--top-module", f"{design}_gate_top",
             "--prefix", f"V{design}_gate", "--Mdir", folder, cells(), folder / "gates.v",
             folder / f"{design}_gate_top.sv"], cwd=folder)
    if status != 0:
        raise SystemExit(text)


main()
