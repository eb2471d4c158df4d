#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""VHDL for each top: a component and an instance, from the ports of the RTL.

  vhdl.py           of a top with generics in masters.toml: rtl/ROOM/vhdl/TOP_component.vhd and TOP_example.vhd; of a master's
                    others with plain = true: ROOM_components.vhd and TOP_example.vhd
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

HEAD = """-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
"""
COMPONENTS = HEAD + """-- The tops of rtl/{room} as VHDL components, made by tools/synth/vhdl.py: do not edit. The module
-- behind a component is the plain Verilog of the release (verilog/TOP.v), or the SystemVerilog of
-- rtl/ with its default parameters. Clocks, resets and misuse: the header of rtl/{room}/TOP.sv.

library ieee;
use ieee.std_logic_1164.all;

package {room}_components is
{components}
end package;
"""
EXAMPLE = HEAD + """-- An instance of {top} to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.{room}_components.all;

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

GENERIC_COMPONENT = HEAD + """-- {top} as a VHDL component, made by tools/synth/vhdl.py: do not edit. The module behind it is
-- {source}, for tools that read both languages. With the default generics it is the
-- plain Verilog of a release too (verilog/{top}.v).{derived}
-- Clock, reset and misuse: the header of {source}.

library ieee;
use ieee.std_logic_1164.all;

package {top}_component is

  component {top}
    generic (
{generics}
    );
    port (
{ports}
    );
  end component;

end package;
"""
DERIVED = """ A default cannot follow another generic
-- here: with other parameters set {names} too, to what the formula
-- beside each of them gives. Another width stops the elaboration, and the error names the right one."""
GENERIC_EXAMPLE = HEAD + """-- An instance of {top} to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.{top}_component.all;

entity {top}_example is
  port (
{ports}
  );
end entity;

architecture rtl of {top}_example is
begin
  u_{top} : {top}
{generics}    port map (
{connections}
    );
end architecture;
"""


def comments(top):
    """{port: what its line in the RTL says behind //}"""
    text = plain_verilog.TOPS[top].source.read_text(encoding="utf-8")
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


def generic_ports(top, values=None):
    """{port: (direction, width)} of a top with generics with these parameters, by default with its defaults."""
    packages = [path for path in project.all_rtl_files() if path.stem.endswith("_pkg")]
    return sv_widths.module_ports(top.source, sv_widths.read_packages(packages),
                                  top.generics.defaults if values is None else values)


def generic_texts(top):
    """Component and example of a top with generics. Ports follow the generics."""
    parameters = sv_widths.module_parameters(top.source)
    vectors = sv_widths.parameter_vectors(top.source)
    rows = []
    longest = max(map(len, parameters), default=0)
    derived = top.generics.defaults
    for number, (name, (kind, value, said)) in enumerate(parameters.items(), 1):
        if name in derived:
            said = value  # the formula
        value = str(derived.get(name, value.replace("1'b", "")))
        limits = "natural range 0 to 1" if kind == "bit" else "natural"
        comment = f"  -- {said}" if said else ""
        rows.append(f"      {name:<{longest}} : {limits} := {value}"
                    f"{';' if number < len(parameters) else ''}{comment}")
    fixed = generic_ports(top, {name: 2 for name in parameters})
    names = {name: (way, vectors.get(name, width)) for name, (way, width) in fixed.items()}
    values = top.generics.example
    longest = max(map(len, names))
    connections = ",\n".join(f"      {name:<{longest}} => {name}" for name in names)
    chosen = ",\n".join(f"      {name} => {value}" for name, value in values.items())
    folder = top.source.parent / "vhdl"
    return {folder / f"{top.name}_component.vhd": GENERIC_COMPONENT.format(
                top=top.name, source=top.source.relative_to(project.ROOT), derived=DERIVED.format(names=" and ".join(derived)) if derived else "",
                generics="\n".join(rows), ports=lines(names, {}, " " * 6)),
            folder / f"{top.name}_example.vhd": GENERIC_EXAMPLE.format(
                top=top.name, generics=f"    generic map (\n{chosen}\n    )\n" if chosen else "",
                ports=lines(generic_ports(top, {**derived, **values}), {}, " " * 4), connections=connections)}


def plain_texts(master):
    """The components of a master's plain tops in a package, and an example of each."""
    found, components = {}, []
    folder = master.list.parent / "vhdl"
    room = master.list.parent.name
    with tempfile.TemporaryDirectory() as place:
        for top in (top for top, one in master.tops.items() if one.plain and one.generics is None):
            ports = verilator_ports.module_ports(top, Path(place) / top)
            said = comments(top)
            components.append(f"\n  component {top}\n    port (\n{lines(ports, said, ' ' * 6)}\n"
                              f"    );\n  end component;")
            longest = max(map(len, ports))
            connections = ",\n".join(f"      {name:<{longest}} => {name}" for name in ports)
            found[folder / f"{top}_example.vhd"] = EXAMPLE.format(
                room=room, top=top, ports=lines(ports, said, " " * 4), connections=connections)
    if components:
        found[folder / f"{room}_components.vhd"] = COMPONENTS.format(room=room, components="\n".join(components))
    return found


def texts():
    """{path: what stands in it}"""
    found = {}
    for top in project.tops("generics").values():
        found.update(generic_texts(top))
    for master in project.MASTERS.values():
        if any(top.plain for top in master.tops.values()):
            found.update(plain_texts(master))
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
