#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""VHDL for each top: a component and an instance, from the ports of the RTL.

  vhdl.py           writes rtl/mb4/vhdl/mb4_components.vhd and rtl/mb4/vhdl/TOP_example.vhd
  vhdl.py --check   they are what it would write
"""

import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import plain_verilog  # noqa: E402
import project  # noqa: E402
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


def comments(top):
    """{port: what its line in the RTL says behind //}"""
    text = (project.RTL / "mb4" / f"{top}.sv").read_text(encoding="utf-8")
    return dict(re.findall(r"^ +(?:input|output)\b.*?(\w+),? *// (.*)$", text, re.M))


def lines(ports, said, indent):
    """The ports of a component or an entity."""
    longest = max(map(len, ports))
    result = []
    for number, (name, (direction, width)) in enumerate(ports.items(), 1):
        kind = "std_logic" if width == 1 else f"std_logic_vector({width - 1} downto 0)"
        end = ";" if number < len(ports) else ""
        comment = f"  -- {said[name]}" if name in said else ""
        way = {"input": "in ", "output": "out"}[direction]
        result.append(f"{indent}{name:<{longest}} : {way} {kind}{end}{comment}")
    return "\n".join(result)


def texts():
    """{path: what stands in it}"""
    found = {}
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
