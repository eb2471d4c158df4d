#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The iCE40 netlist of a design of masters.toml for simulation, with the vendor's cells.

  gate_netlist.py FOLDER [DESIGN [PRESET]]   writes gates.v (single-bit nets: Verilator 5.006 is
                                     wrong about vectors of which bits depend on others) and
                                     DESIGN_gate_top.sv (the ports of the RTL around it, and what the
                                     simulator looks at: the probes there). DESIGN is mb4 by default; PRESET is
                                     for a master that has them
"""

import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import project  # noqa: E402
import yosys  # noqa: E402


DESIGNS = project.all_of("gates")


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    parser.add_argument("design", nargs="?", default="mb4", choices=DESIGNS)
    parser.add_argument("preset", nargs="?", default="full", choices=project.presets())
    arguments = parser.parse_args()
    folder, name = arguments.folder, arguments.design
    design = DESIGNS[name]
    top, parameters = design.top, dict(design.parameters)
    if arguments.preset != "full":
        if not design.master.presets:
            parser.error(f"{name} has no presets")
        parameters["Features"] = project.presets()[arguments.preset]
    commands = yosys.read(project.listed(design.master.list)) + yosys.choose(top, parameters) + [
        f"hierarchy -check -top {top}", f"rename -top {top}", "proc", "flatten",
        *([f"expose {' '.join(f'{top}/w:{probe}' for probe in design.probes)}"] if design.probes else []),
        f"synth_ice40 -top {top}", "check -assert",
        "select -assert-none t:$dlatch t:$_DLATCH_* t:$_SR_*",
        "splitnets -ports", "setundef -zero", "opt_clean",
        f"rename {top} {name}_gates", "write_json ports.json", "write_verilog -noattr gates.v"]
    status, text = yosys.execute(commands, folder, "gates")
    if status != 0:
        raise SystemExit(text)
    ports = json.loads((folder / "ports.json").read_text(encoding="utf-8"))
    ports = ports["modules"][f"{name}_gates"]["ports"]
    widths, connections = {}, []
    for port, data in ports.items():
        base, bit = re.fullmatch(r"(.*?)(?:\[(\d+)\])?", port).groups()
        pin = design.probes.get(base, base)
        kind, width = widths.get(pin, (data["direction"], 0))
        widths[pin] = (kind, max(width, int(bit or 0) + 1))
        connections.append(f"    .\\{port} ({pin}{f'[{bit}]' if bit else ''})")
    lines = [f"// Made by gate_netlist.py: the netlist behind the ports of {top}.",
             f"module {name}_gate_top ("]
    lines.append(",\n".join(
        f"  {kind} wire {f'[{width - 1}:0] ' if width > 1 else ''}{pin}"
        for pin, (kind, width) in widths.items()))
    lines += [");", f"  {name}_gates u_gates (", ",\n".join(connections), "  );", "endmodule", ""]
    (folder / f"{name}_gate_top.sv").write_text("\n".join(lines), encoding="utf-8")


main()
