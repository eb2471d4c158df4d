#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""SL behind DDR input cells (parameter SlCells, biss_sl_capture).

  check_cells.py behave FOLDER      all choices give what the flops give, in Icarus
  check_cells.py self-test FOLDER   cells with exchanged edges are reported
  check_cells.py synth FOLDER       mb4_core for each family: both lines in the family's cell, no
                                    flop at the falling edge but the host's
"""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import yosys  # noqa: E402

CHOICES = ("SL_FLOPS", "SL_ICE40", "SL_ECP5", "SL_XILINX7")
CELLS = {"SL_ICE40": ("SB_IO", "synth_ice40"), "SL_ECP5": ("IDDRX1F", "synth_ecp5"),
         "SL_XILINX7": ("IDDR", "synth_xilinx -family xc7 -flatten -noiopad")}
EXCHANGED = [("SL_ICE40", ".D_IN_0       (pos1_q)", ".D_IN_0       (neg1_q)",
              ".D_IN_1       (neg1_q)", ".D_IN_1       (pos1_q)"),
             ("SL_ECP5", ".Q0   (pos1_q)", ".Q0   (neg1_q)", ".Q1   (neg1_q)", ".Q1   (pos1_q)"),
             ("SL_XILINX7", "OPPOSITE_EDGE", "SAME_EDGE")]


def simulate(folder, *changes):
    """(True if all choices agree, what was said)."""
    source = (project.RTL / "biss" / "biss_sl_capture.sv").read_text(encoding="utf-8")
    for old, new in zip(changes[::2], changes[1::2]):
        if source.count(old) != 1:
            raise SystemExit(f"'{old}' occurs {source.count(old)} times in biss_sl_capture.sv")
        source = source.replace(old, new)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "biss_sl_capture.sv").write_text(source, encoding="utf-8")
    cells = Path(project.tool("yosys")).parents[1] / "share" / "yosys" / "ice40" / "cells_sim.v"
    files = [folder / f"capture_{number}.v" for number in range(len(CHOICES))]
    for number, file in enumerate(files):
        status, text = yosys.execute(
            [f"read_verilog -lib {cells}",
             *yosys.read([project.RTL / "biss" / "biss_pkg.sv", folder / "biss_sl_capture.sv"]),
             f"chparam -set SlCells {number} biss_sl_capture",
             "hierarchy -top biss_sl_capture", "proc", "opt_clean",
             f"rename -top capture_{number}", f"write_verilog -noattr {file}"], folder, file.stem)
        if status != 0:
            raise SystemExit(text)
    program = folder / "cells.vvp"
    status, text = project.run([project.tool("iverilog"), "-g2012",
                                "-DNO_ICE40_DEFAULT_ASSIGNMENTS", "-o", program, "-s", "bench",
                                HERE / "sl_cells.v", cells, *files])
    if status != 0:
        raise SystemExit(text)
    status, text = project.run([project.tool("vvp"), "-n", program])
    return status == 0 and text.strip() == "passed", text


def synth(folder):
    findings = []
    for choice, (cell, command) in CELLS.items():
        status, text = yosys.execute(
            yosys.read() + [f"chparam -set SlCells {CHOICES.index(choice)} mb4_core",
                            f"{command} -top mb4_core", "check -assert",
                            f"tee -q -o {choice}.json stat -json"], folder, choice)
        if status != 0:
            raise SystemExit(text)
        stat = json.loads((folder / f"{choice}.json").read_text(encoding="utf-8"))
        number = stat["design"]["num_cells_by_type"].get(cell, 0)
        if number != 2:
            findings.append(f"{choice}: {number} cells {cell}, not one a line")
    project.finish(findings, "both lines in the cell of each family")


def main():
    mode, folder = sys.argv[1], Path(sys.argv[2]).resolve()
    project.tool("iverilog")
    if mode == "synth":
        synth(folder)
    if mode == "behave":
        good, text = simulate(folder)
        project.finish([] if good else [text], f"{len(CHOICES)} choices agree")
    findings = [f"{choice}: not noticed: {changes}" for choice, *changes in EXCHANGED
                if simulate(folder, *changes)[0]]
    project.finish(findings, f"{len(EXCHANGED)} exchanged edges, all reported")


main()
