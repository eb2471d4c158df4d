#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A top with generics (masters.toml) as an IP for the catalogue of Vivado: component.xml (IEEE 1685-2009 with Vivado's bus
definitions and views), and the Tcl that passes its parameters on.

  vivado_ip.py FOLDER   writes FOLDER/component.xml and FOLDER/xgui/TOP.tcl of the first such top, and the same of others
                        in FOLDER-TOP. A release has them in its folders ipxact/vivado/...: files are named from there
"""

import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import ipxact  # noqa: E402
import project  # noqa: E402
import sv_widths  # noqa: E402
import vhdl  # noqa: E402

NAMESPACE = "http://www.spiritconsortium.org/XMLSchema/SPIRIT/1685-2009"
HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<!-- Made by tools/synth/vivado_ip.py: do not edit. -->
<!-- SPDX-FileCopyrightText: 2026 The openmb4 authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
"""
# Vivado's definitions of the buses that have others in ipxact.BUSES.
KINDS = {"axi4-lite": ("interface", "aximm"), "axi4-stream": ("interface", "axis"), "spi": ("interface", "spi")}


def add(parent, element_name, text=None, /, **attributes):
    element = ElementTree.SubElement(parent, f"{{{NAMESPACE}}}{element_name}", {
        f"{{{NAMESPACE}}}{key}": str(value) for key, value in attributes.items()})
    element.text = None if text is None else str(text)
    return element


def model_value(name):
    return f"spirit:decode(id('MODELPARAM_VALUE.{name}'))"


def dependency(text):
    return re.sub(r"\{(\w+)\}", lambda found: model_value(found[1]), text)


def interfaces(component, top):
    place = add(component, "busInterfaces")
    for told, bus in zip(top.buses, ipxact.TOPS[top.name].buses):
        interface = add(place, "busInterface")
        add(interface, "name", bus.name)
        library, name = KINDS.get(told.kind, ("signal", bus.kind[2]))
        for kind, definition in (("busType", name), ("abstractionType", f"{name}_rtl")):
            add(interface, kind, vendor="xilinx.com", library=library, name=definition, version="1.0")
        role = add(interface, bus.role)
        if told.kind == "axi4-lite":
            add(role, "memoryMapRef", memoryMapRef="registers")
        maps = add(interface, "portMaps")
        for logical, physical in bus.ports.items():
            if told.kind in KINDS and physical in (told.clock, told.reset):
                continue  # interfaces of their own here
            entry = add(maps, "portMap")
            add(add(entry, "logicalPort"), "name", logical)
            add(add(entry, "physicalPort"), "name", physical)
        if bus.parameters:
            values = add(interface, "parameters")
            for key, value in bus.parameters.items():
                parameter = add(values, "parameter")
                add(parameter, "name", key)
                add(parameter, "value", value, id=f"BUSIFPARAM_VALUE.{bus.name.upper()}.{key}")


def memory_map(component):
    place = add(add(component, "memoryMaps"), "memoryMap")
    add(place, "name", "registers")
    block = add(place, "addressBlock")
    for name, value in (("name", "registers"), ("baseAddress", 0), ("range", 256), ("width", 32),
                        ("usage", "register")):
        add(block, name, value)


def model(component, top, parameters):
    place = add(component, "model")
    views = add(place, "views")
    for name, environment, files in (
            ("xilinx_anylanguagesynthesis", "synthesis", "rtl"),
            ("xilinx_anylanguagebehavioralsimulation", "simulation", "rtl"),
            ("xilinx_xpgui", "xgui.ui", "xgui")):
        view = add(views, "view")
        add(view, "name", name)
        add(view, "envIdentifier", f":vivado.xilinx.com:{environment}")
        if files == "rtl":
            add(view, "language", "SystemVerilog")
            add(view, "modelName", top.name)
        add(add(view, "fileSetRef"), "localName", files)
    vectors = sv_widths.parameter_vectors(top.source)
    default = vhdl.generic_ports(top)
    ports = add(place, "ports")
    for name, (direction, width) in default.items():
        port = add(ports, "port")
        add(port, "name", name)
        wire = add(port, "wire")
        add(wire, "direction", {"input": "in", "output": "out"}[direction])
        if width > 1 or name in vectors:
            vector = add(wire, "vector")
            if name in vectors:
                parameter = vectors[name].removesuffix("-1")
                add(vector, "left", width - 1, format="long", resolve="dependent",
                    dependency=f"({model_value(parameter)} - 1)")
            else:
                add(vector, "left", width - 1, format="long")
            add(vector, "right", 0, format="long")
    values = add(place, "modelParameters")
    for name, (_, value, _) in parameters.items():
        parameter = add(values, "modelParameter", dataType="integer")
        add(parameter, "name", name)
        if name in top.generics.formulas:
            add(parameter, "value", top.generics.defaults[name], format="long",
                resolve="dependent", dependency=dependency(top.generics.formulas[name]), id=f"MODELPARAM_VALUE.{name}")
        else:
            add(parameter, "value", value.replace("1'b", ""), format="long", resolve="generated",
                id=f"MODELPARAM_VALUE.{name}")


def files(component, top):
    sets = add(component, "fileSets")
    rtl = add(sets, "fileSet")
    add(rtl, "name", "rtl")
    for path in (*sorted(project.INCLUDE.glob("*.svh")),
                 *project.listed(top.master.list)):
        file = add(rtl, "file")
        add(file, "name", f"../../{path.relative_to(project.ROOT).as_posix()}")
        add(file, "fileType", "systemVerilogSource")
        if path.suffix == ".svh":
            add(file, "isIncludeFile", "true")
    gui = add(sets, "fileSet")
    add(gui, "name", "xgui")
    file = add(gui, "file")
    add(file, "name", f"xgui/{top.name}.tcl")
    add(file, "fileType", "tclSource")


def component_text(top, version):
    parameters = sv_widths.module_parameters(top.source)
    component = ElementTree.Element(f"{{{NAMESPACE}}}component")
    for name, text in (("vendor", "openmb4"), ("library", "ip"), ("name", top.name), ("version", version)):
        add(component, name, text)
    interfaces(component, top)
    memory_map(component)
    model(component, top, parameters)
    files(component, top)
    add(component, "description", top.master.what)
    values = add(component, "parameters")
    for name, (kind, value, said) in parameters.items():
        if name in top.generics.formulas:
            continue
        low, high = (0, 1) if kind == "bit" else top.generics.limits[name]
        parameter = add(values, "parameter")
        add(parameter, "name", name)
        if said:
            add(parameter, "description", said)
        add(parameter, "value", value.replace("1'b", ""), format="long", resolve="user",
            id=f"PARAM_VALUE.{name}", minimum=low, maximum=high, rangeType="long")
    ElementTree.register_namespace("spirit", NAMESPACE)
    ElementTree.indent(component)
    return HEAD + ElementTree.tostring(component, encoding="unicode") + "\n"


def gui_text(top):
    names = [name for name in sv_widths.module_parameters(top.source) if name not in top.generics.formulas]
    lines = ["# SPDX-FileCopyrightText: 2026 The openmb4 authors", "# SPDX-License-Identifier: Apache-2.0",
             "#", "# Made by tools/synth/vivado_ip.py: do not edit.", "", "proc init_gui { IPINST } {",
             '  ipgui::add_param $IPINST -name "Component_Name"',
             '  set page [ipgui::add_page $IPINST -name "Page 0"]']
    lines += [f'  ipgui::add_param $IPINST -name "{name}" -parent ${{page}}' for name in names] + ["}"]
    for name in names:
        lines += ["", f"proc update_PARAM_VALUE.{name} {{ PARAM_VALUE.{name} }} {{}}",
                  f"proc validate_PARAM_VALUE.{name} {{ PARAM_VALUE.{name} }} {{ return true }}",
                  f"proc update_MODELPARAM_VALUE.{name} {{ MODELPARAM_VALUE.{name} PARAM_VALUE.{name} }} {{",
                  f"  set_property value [get_property value ${{PARAM_VALUE.{name}}}] "
                  f"${{MODELPARAM_VALUE.{name}}}", "}"]
    return "\n".join(lines) + "\n"


def write(top, folder):
    (folder / "xgui").mkdir(parents=True, exist_ok=True)
    name = top.master.maps[0]
    source = project.ROOT / "regmap" / "generated" / name / f"{name}.ipxact.xml"
    # Vivado counts a version as MAJOR.MINOR.
    version = ".".join(ipxact.find(ElementTree.parse(source).getroot(), "version").text.split(".")[:2])
    for path, text in ((folder / "component.xml", component_text(top, version)),
                       (folder / "xgui" / f"{top.name}.tcl", gui_text(top))):
        path.write_text(text, encoding="utf-8")
        print(path)


def place_of(folder, place, top):
    """The folder of a top, the first or a later one."""
    return folder if place == 0 else folder.with_name(f"{folder.name}-{top.name}")


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    for place, top in enumerate(project.tops("generics").values()):
        write(top, place_of(folder, place, top))


if __name__ == "__main__":
    main()
