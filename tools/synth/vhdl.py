#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""VHDL for each top: a component and an instance, from the ports of the RTL.

  vhdl.py           writes rtl/mb4/vhdl/mb4_components.vhd and rtl/mb4/vhdl/TOP_example.vhd, and the same
                    of biss_axi with its parameters as generics in rtl/axi/vhdl
  vhdl.py --check   they are what it would write
"""

import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import plain_verilog  # noqa: E402
import project  # noqa: E402
import sv_widths  # noqa: E402
import verilator_ports  # noqa: E402

FOLDER = project.RTL / "mb4" / "vhdl"
PACKAGE = "mb4_components"
HEAD = """-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
"""
COMPONENTS = HEAD + """-- The tops of rtl/mb4 as VHDL components, made by tools/synth/vhdl.py: do not edit. The module
-- behind a component is the plain Verilog of the release (verilog/TOP.v), or the SystemVerilog of
-- rtl/ with its default parameters. Clocks, resets and misuse: the header of rtl/mb4/TOP.sv.

library ieee;
use ieee.std_logic_1164.all;

package mb4_components is
{components}
end package;
"""
EXAMPLE = HEAD + """-- An instance of {top} to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.mb4_components.all;

entity {top}_example is
  port (
{ports}
  );
end entity;

architecture rtl of {top}_example is
begin
  u_{top} : {top}
    port map (
{connections}
    );
end architecture;
"""

AXI_FOLDER = project.RTL / "axi" / "vhdl"
AXI_SOURCE = project.RTL / "axi" / "biss_axi.sv"
AXI_COMPONENT = HEAD + """-- biss_axi as a VHDL component, made by tools/synth/vhdl.py: do not edit. The module behind it is
-- rtl/axi/biss_axi.sv, for tools that read both languages. A default cannot follow another generic
-- here: with other parameters set S_AXIS_TDATA_WIDTH and S_AXIS_TUSER_WIDTH too, to what the formula
-- beside each of them gives. Another width stops the elaboration, and the error names the right one.
-- Clock, reset and misuse: the header of rtl/axi/biss_axi.sv.

library ieee;
use ieee.std_logic_1164.all;

package biss_axi_component is

  component biss_axi
    generic (
{generics}
    );
    port (
{ports}
    );
  end component;

end package;
"""
AXI_EXAMPLE = HEAD + """-- An instance of biss_axi with four channels to copy, made by tools/synth/vhdl.py: do not edit. The
-- entity only passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.biss_axi_component.all;

entity biss_axi_example is
  port (
{ports}
  );
end entity;

architecture rtl of biss_axi_example is
begin
  u_biss_axi : biss_axi
    generic map (
      BISS_CHANNEL_WIDTH => 4,
      S_AXIS_TDATA_WIDTH => 128,
      S_AXIS_TUSER_WIDTH => 4
    )
    port map (
{connections}
    );
end architecture;
"""


def comments(top):
    """{port: what its line in the RTL says behind //}"""
    text = (project.RTL / "mb4" / f"{top}.sv").read_text(encoding="utf-8")
    return dict(re.findall(r"^ +(?:input|output)\b.*?(\w+),? *// (.*)$", text, re.M))


def lines(ports, said, indent):
    """The ports of a component or an entity. A width is a number, or the text of the highest bit."""
    longest = max(map(len, ports))
    result = []
    for number, (name, (direction, width)) in enumerate(ports.items(), 1):
        left = width if isinstance(width, str) else width - 1
        kind = "std_logic" if width == 1 else f"std_logic_vector({left} downto 0)"
        end = ";" if number < len(ports) else ""
        comment = f"  -- {said[name]}" if name in said else ""
        way = {"input": "in ", "output": "out"}[direction]
        result.append(f"{indent}{name:<{longest}} : {way} {kind}{end}{comment}")
    return "\n".join(result)


def axi_ports(values):
    """{port: (direction, width)} of biss_axi with these parameters."""
    packages = [path for path in project.all_rtl_files() if path.stem.endswith("_pkg")]
    return sv_widths.module_ports(AXI_SOURCE, sv_widths.read_packages(packages), values)


def axi_texts():
    """Component and example of biss_axi. Ports follow the generics."""
    parameters = sv_widths.module_parameters(AXI_SOURCE)
    vectors = sv_widths.parameter_vectors(AXI_SOURCE)
    rows = []
    longest = max(map(len, parameters))
    derived = {"S_AXIS_TDATA_WIDTH": "32", "S_AXIS_TUSER_WIDTH": "1"}
    for number, (name, (kind, value, said)) in enumerate(parameters.items(), 1):
        if name in derived:
            said = value  # the formula
        value = derived.get(name, value.replace("1'b", ""))
        limits = "natural range 0 to 1" if kind == "bit" else "natural"
        comment = f"  -- {said}" if said else ""
        rows.append(f"      {name:<{longest}} : {limits} := {value}"
                    f"{';' if number < len(parameters) else ''}{comment}")
    fixed = axi_ports({name: 2 for name in parameters})
    names = {name: (way, vectors.get(name, width)) for name, (way, width) in fixed.items()}
    four = axi_ports({"BISS_CHANNEL_WIDTH": 4, "S_AXIS_TDATA_WIDTH": 128, "S_AXIS_TUSER_WIDTH": 4})
    longest = max(map(len, names))
    connections = ",\n".join(f"      {name:<{longest}} => {name}" for name in names)
    return {AXI_FOLDER / "biss_axi_component.vhd": AXI_COMPONENT.format(
                generics="\n".join(rows), ports=lines(names, {}, " " * 6)),
            AXI_FOLDER / "biss_axi_example.vhd": AXI_EXAMPLE.format(
                ports=lines(four, {}, " " * 4), connections=connections)}


def texts():
    """{path: what stands in it}"""
    found = axi_texts()
    components = []
    with tempfile.TemporaryDirectory() as folder:
        for top in plain_verilog.TOPS:
            ports = verilator_ports.module_ports(top, Path(folder) / top)
            said = comments(top)
            components.append(f"\n  component {top}\n    port (\n{lines(ports, said, ' ' * 6)}\n"
                              f"    );\n  end component;")
            longest = max(map(len, ports))
            connections = ",\n".join(f"      {name:<{longest}} => {name}" for name in ports)
            found[FOLDER / f"{top}_example.vhd"] = EXAMPLE.format(
                top=top, ports=lines(ports, said, " " * 4), connections=connections)
    found[FOLDER / f"{PACKAGE}.vhd"] = COMPONENTS.format(components="\n".join(components))
    return found


def stale():
    """Findings: files that are not what this program writes."""
    return [f"{path}: is not what tools/synth/vhdl.py writes" for path, text in texts().items()
            if not path.exists() or path.read_text(encoding="utf-8") != text]


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("--check", action="store_true")
    if not parser.parse_args().check:
        for path, text in texts().items():
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return
    project.finish(stale(), "the VHDL has the ports of the RTL")


if __name__ == "__main__":
    main()
