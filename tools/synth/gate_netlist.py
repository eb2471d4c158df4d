#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The iCE40 netlist of mb4_chip for simulation, with the vendor's cells.

  gate_netlist.py FOLDER [PRESET]   writes gates.v (single-bit nets: Verilator 5.006 is wrong about vectors
                                    of which bits depend on others) and mb4_gate_top.sv (the ports of
                                    mb4_chip around it, and what the simulator looks at)
"""

import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import project  # noqa: E402
import yosys  # noqa: E402

TOP = "mb4_chip"
# What sim/masters/mb4/model looks at, and its name at mb4_gate_top.
PROBES = {"clkeni": "clkeni", "clk": "clk", "paired": "paired",
          "u_engine.u_lines.u_timebase.len_q": "len_q"}


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("preset", nargs="?", default="full", choices=project.presets())
    arguments = parser.parse_args()
    folder = arguments.folder
    chosen = [f"hierarchy -check -top {TOP}"]
    if arguments.preset != "full":
        chosen = [f"chparam -set Features {project.presets()[arguments.preset]} {TOP}", *chosen,
                  f"rename -top {TOP}"]
    commands = yosys.read() + [
        *chosen, "proc", "flatten",
        f"expose {' '.join(f'{TOP}/w:{name}' for name in PROBES)}",
        f"synth_ice40 -top {TOP}", "check -assert",
        "select -assert-none t:$dlatch t:$_DLATCH_* t:$_SR_*",
        "splitnets -ports", "setundef -zero", "opt_clean",
        f"rename {TOP} mb4_gates", "write_json ports.json", "write_verilog -noattr gates.v"]
    status, text = yosys.execute(commands, folder, "gates")
    if status != 0:
        raise SystemExit(text)
    ports = json.loads((folder / "ports.json").read_text(encoding="utf-8"))
    ports = ports["modules"]["mb4_gates"]["ports"]
    widths, connections = {}, []
    for port, data in ports.items():
        base, bit = re.fullmatch(r"(.*?)(?:\[(\d+)\])?", port).groups()
        name = PROBES.get(base, base)
        kind, width = widths.get(name, (data["direction"], 0))
        widths[name] = (kind, max(width, int(bit or 0) + 1))
        connections.append(f"    .\\{port} ({name}{f'[{bit}]' if bit else ''})")
    lines = ["// Made by gate_netlist.py: the netlist behind the ports of mb4_chip.",
             "module mb4_gate_top ("]
    lines.append(",\n".join(
        f"  {kind} wire {f'[{width - 1}:0] ' if width > 1 else ''}{name}"
        for name, (kind, width) in widths.items()))
    lines += [");", "  mb4_gates u_gates (", ",\n".join(connections), "  );", "endmodule", ""]
    (folder / "mb4_gate_top.sv").write_text("\n".join(lines), encoding="utf-8")


main()
