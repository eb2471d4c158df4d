#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""IP-XACT (IEEE 1685-2014) of the tops with a bus of words or SPI: bus interfaces, ports, parameters, files, and
the registers of their maps.

  ipxact.py FOLDER   writes FOLDER/TOP.xml. A release has them in its folder ipxact/: files are named
                     from there
"""

import copy
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import project  # noqa: E402
import sv_widths  # noqa: E402

NAMESPACE = "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"
HEAD = f"""<?xml version="1.0" encoding="UTF-8"?>
<!-- Made by tools/synth/ipxact.py from the ports of the RTL and regmap/generated: do not edit. -->
<!-- SPDX-FileCopyrightText: 2026 The openmb4 authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
"""
PAGE = 0x100  # first byte of the page


class Bus:
    """A bus interface: its name and role, the bus definition, its abstraction, the port behind each
    logical name, and parameters."""

    def __init__(self, name, role, kind, abstraction, ports, parameters=None):
        self.name, self.role, self.kind, self.abstraction = name, role, kind, abstraction
        self.ports, self.parameters = ports, parameters or {}


AXI_NAMES = ("AWVALID", "AWREADY", "AWADDR", "WVALID", "WREADY", "WDATA", "WSTRB", "BVALID", "BREADY",
             "BRESP", "ARVALID", "ARREADY", "ARADDR", "RVALID", "RREADY", "RDATA", "RRESP")
STREAM_NAMES = ("TVALID", "TREADY", "TDATA", "TLAST", "TUSER")
WISHBONE_NAMES = ("CLK_I", "RST_I", "CYC_I", "STB_I", "WE_I", "ADR_I", "DAT_I", "SEL_I", "DAT_O",
                  "ACK_O", "ERR_O", "STALL_O")


# Kind of a bus in masters.toml: the role of the interface, its definition, the abstraction, the logical names.
BUSES = {"axi4-lite": ("slave", ("amba.com", "AMBA4", "AXI4-Lite", "r0p0_0"), "AXI4-Lite_rtl", AXI_NAMES),
         "axi4-stream": ("master", ("amba.com", "AMBA4", "AXI4Stream", "r0p0_1"), "AXI4Stream_rtl", STREAM_NAMES),
         "wishbone": ("slave", ("opencores.org", "interface", "wishbone", "B4"), "wishbone_rtl", WISHBONE_NAMES)}
# An SPI slave: its port behind each logical name, with the definition that Vivado has for it.
SPI = {"SCK_I": "sclk_i", "SS_I": "cs_ni", "IO0_I": "mosi_i", "IO1_O": "miso_o"}
# A port of its own: role, logical name. The definitions are those that Vivado has for clocks, resets, interrupts.
SIGNALS = {"clock": ("slave", "CLK"), "reset": ("slave", "RST"), "interrupt": ("master", "INTERRUPT")}


def bus_of(bus):
    """A Bus of an interface of masters.toml."""
    if bus.kind in SIGNALS:
        role, logical = SIGNALS[bus.kind]
        return Bus(bus.name, role, ("xilinx.com", "signal", bus.kind, "1.0"), f"{bus.kind}_rtl", {logical: bus.name}, bus.values)
    if bus.kind == "spi":
        return Bus(bus.name, "slave", ("xilinx.com", "interface", "spi", "1.0"), "spi_rtl", SPI, bus.values)
    role, kind, abstraction, logical = BUSES[bus.kind]
    clocks = {"ACLK": bus.clock, "ARESETn": bus.reset} if bus.clock else {}
    # The names of a port are as large as its prefix.
    ports = {name: bus.prefix + (name if bus.prefix.isupper() else name.lower()) for name in logical}
    return Bus(bus.name, role, kind, abstraction, {**clocks, **ports}, bus.values)


class Top:
    """A module: its source, its list of files, its register maps with their first bytes (the second is the page), its bus
    interfaces, and whether its parameters are those of the component."""

    def __init__(self, top):
        self.source, self.list, self.generics = top.source, top.master.list, top.generics is not None
        self.maps = tuple(zip(top.master.maps, (0, PAGE)[:len(top.master.maps)], strict=True))
        self.buses = tuple(bus_of(bus) for bus in top.buses)


TOPS = {name: Top(top) for name, top in project.tops("buses").items()}


def add(parent, name, text=None, **attributes):
    element = ElementTree.SubElement(parent, f"{{{NAMESPACE}}}{name}", attributes)
    element.text = None if text is None else str(text)
    return element


def names(parent, vendor, library, name, version):
    """As elements of a component."""
    for kind, text in zip(("vendor", "library", "name", "version"), (vendor, library, name, version)):
        add(parent, kind, text)


def reference(parent, kind, vendor, library, name, version):
    add(parent, kind).attrib.update(vendor=vendor, library=library, name=name, version=version)


def find(element, path):
    return element.find("/".join(f"{{{NAMESPACE}}}{step}" for step in path.split("/")))


def bus_interfaces(component, top):
    interfaces = add(component, "busInterfaces")
    for bus in TOPS[top].buses:
        interface = add(interfaces, "busInterface")
        add(interface, "name", bus.name)
        reference(interface, "busType", *bus.kind)
        abstract = add(add(interface, "abstractionTypes"), "abstractionType")
        reference(abstract, "abstractionRef", bus.kind[0], bus.kind[1], bus.abstraction, bus.kind[3])
        maps = add(abstract, "portMaps")
        for logical, physical in bus.ports.items():
            entry = add(maps, "portMap")
            add(add(entry, "logicalPort"), "name", logical)
            add(add(entry, "physicalPort"), "name", physical)
        role = add(interface, bus.role)
        if bus is TOPS[top].buses[0]:
            add(role, "memoryMapRef", memoryMapRef="registers")
        if bus.parameters:
            place = add(interface, "parameters")
            for name, value in bus.parameters.items():
                parameter = add(place, "parameter")
                add(parameter, "name", name)
                add(parameter, "value", value)


def memory_map(component, top):
    """The blocks of its maps. The page's registers count from its beginning."""
    place = add(add(component, "memoryMaps"), "memoryMap")
    add(place, "name", "registers")
    version = None
    for name, base in TOPS[top].maps:
        path = project.ROOT / "regmap" / "generated" / name / f"{name}.ipxact.xml"
        source = ElementTree.parse(path).getroot()
        version = find(source, "version").text
        block = copy.deepcopy(find(source, "memoryMaps/memoryMap/addressBlock"))
        find(block, "baseAddress").text = f"'h{base:x}"
        find(block, "range").text = f"'h{int(find(block, 'range').text[2:], 16) - base:x}"
        for register in block:
            offset = find(register, "addressOffset")
            if offset is not None:
                offset.text = f"'h{int(offset.text[2:], 16) - base:x}"
        place.append(block)
    add(place, "addressUnitBits", 8)
    return version


def component_parameters(component, parameters):
    if not parameters:
        return
    place = add(component, "parameters")
    for name, (kind, value, said) in parameters.items():
        derived = any(other in value for other in parameters)
        parameter = add(place, "parameter", parameterId=name, type="bit" if kind == "bit" else "int",
                        resolve="generated" if derived else "user")
        add(parameter, "name", name)
        if said:
            add(parameter, "description", said)
        add(parameter, "value", value)


def model(component, top, ports, parameters, vectors):
    place = add(component, "model")
    view = add(add(place, "views"), "view")
    add(view, "name", "rtl")
    add(view, "envIdentifier", "::")
    add(view, "componentInstantiationRef", "systemverilog")
    instance = add(add(place, "instantiations"), "componentInstantiation")
    add(instance, "name", "systemverilog")
    add(instance, "language", "SystemVerilog")
    add(instance, "moduleName", top)
    if parameters:
        list_ = add(instance, "moduleParameters")
        for name, (kind, _, _) in parameters.items():
            parameter = add(list_, "moduleParameter", parameterId=f"module_{name}",
                            type="bit" if kind == "bit" else "int")
            add(parameter, "name", name)
            add(parameter, "value", name)
    add(add(instance, "fileSetRef"), "localName", "rtl")
    lowest = sv_widths.lowest_bits(TOPS[top].source)
    list_ = add(place, "ports")
    for name, (direction, width) in ports.items():
        port = add(list_, "port")
        add(port, "name", name)
        wire = add(port, "wire")
        add(wire, "direction", {"input": "in", "output": "out"}[direction])
        if width > 1 or name in vectors:
            vector = add(add(wire, "vectors"), "vector")
            low = lowest.get(name, 0)
            add(vector, "left", vectors.get(name, width - 1 + low))
            add(vector, "right", low)


def files(component, top):
    place = add(add(component, "fileSets"), "fileSet")
    add(place, "name", "rtl")
    for path in (*sorted(project.INCLUDE.glob("*.svh")), *project.listed(TOPS[top].list)):
        file = add(place, "file")
        add(file, "name", f"../{path.relative_to(project.ROOT).as_posix()}")
        add(file, "fileType", "systemVerilogSource")
        if path.suffix == ".svh":
            add(file, "isIncludeFile", "true")


def text(top):
    component = ElementTree.Element(f"{{{NAMESPACE}}}component")
    heads = ElementTree.Element("later")
    version = memory_map(heads, top)
    source = TOPS[top].source
    parameters = sv_widths.module_parameters(source) if TOPS[top].generics else {}
    vectors = sv_widths.parameter_vectors(source) if parameters else {}
    names(component, "openmb4", "ip", top, version)
    bus_interfaces(component, top)
    component.extend(heads)
    packages = [path for path in project.all_rtl_files() if path.stem.endswith("_pkg")]
    # Ports that follow a parameter have their width in `vectors`.
    ports = sv_widths.module_ports(source, sv_widths.read_packages(packages),
                                   {name: 2 for name in parameters})
    model(component, top, ports, parameters, vectors)
    files(component, top)
    component_parameters(component, parameters)
    ElementTree.register_namespace("ipxact", NAMESPACE)
    for element in component.iter():  # the indentation of the sources goes
        element.tail = None
        if element.text is not None and not element.text.strip():
            element.text = None
    ElementTree.indent(component)
    return HEAD + ElementTree.tostring(component, encoding="unicode") + "\n"


def main():
    parser = project.Arguments(__doc__)
    parser.add_argument("folder", type=parser.folder)
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for top in TOPS:
        path = folder / f"{top}.xml"
        path.write_text(text(top), encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main()
