#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""IP-XACT (IEEE 1685-2014) of the tops with a bus of words: bus interfaces, ports, parameters, files, and
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


def axi(name, clock, reset, ports):
    return Bus(name, "slave", ("amba.com", "AMBA4", "AXI4-Lite", "r0p0_0"), "AXI4-Lite_rtl",
               {"ACLK": clock, "ARESETn": reset, **ports})


def signal(name, role, kind, logical, **parameters):
    """A port of its own. The definitions are those that Vivado has for clocks, resets, interrupts."""
    return Bus(name, role, ("xilinx.com", "signal", kind, "1.0"), f"{kind}_rtl", {logical: name},
               parameters)


class Top:
    """A module, its folder below rtl/, its list of files, its register maps with their first bytes,
    its bus interfaces."""

    def __init__(self, folder, files, maps, buses):
        self.folder, self.files, self.maps, self.buses = folder, files, maps, buses


MB4_MAPS = (("mb4", 0), ("mb4_page", PAGE))
TOPS = {
    "mb4_axil": Top("mb4", "mb4.f", MB4_MAPS, (
        axi("bus", "s_axi_aclk", "s_axi_aresetn", {name: f"s_axi_{name.lower()}" for name in AXI_NAMES}),)),
    "mb4_wb": Top("mb4", "mb4.f", MB4_MAPS, (
        Bus("bus", "slave", ("opencores.org", "interface", "wishbone", "B4"), "wishbone_rtl",
            {name: f"wb_{name.lower()}" for name in WISHBONE_NAMES}),)),
    "biss_axi": Top("axi", "axi.f", (("axi", 0),), (
        axi("S_AXI", "axi_aclk", "axi_aresetn", {name: f"S_AXI_{name}" for name in AXI_NAMES}),
        Bus("s_axis", "master", ("amba.com", "AMBA4", "AXI4Stream", "r0p0_1"), "AXI4Stream_rtl",
            {"ACLK": "axi_aclk", "ARESETn": "axi_aresetn",
             **{name: f"s_axis_{name.lower()}" for name in STREAM_NAMES}}),
        signal("axi_aclk", "slave", "clock", "CLK", ASSOCIATED_BUSIF="S_AXI:s_axis",
               ASSOCIATED_RESET="axi_aresetn"),
        signal("axi_aresetn", "slave", "reset", "RST", POLARITY="ACTIVE_LOW"),
        signal("por_n", "slave", "reset", "RST", POLARITY="ACTIVE_LOW"),
        signal("irq", "master", "interrupt", "INTERRUPT", SENSITIVITY="LEVEL_HIGH"))),
}


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
    list_ = add(place, "ports")
    for name, (direction, width) in ports.items():
        port = add(list_, "port")
        add(port, "name", name)
        wire = add(port, "wire")
        add(wire, "direction", {"input": "in", "output": "out"}[direction])
        if width > 1 or name in vectors:
            vector = add(add(wire, "vectors"), "vector")
            low = 2 if name == "wb_adr_i" else 0  # words
            add(vector, "left", vectors.get(name, width - 1 + low))
            add(vector, "right", low)


def files(component, top):
    place = add(add(component, "fileSets"), "fileSet")
    add(place, "name", "rtl")
    for path in (*sorted(project.INCLUDE.glob("*.svh")), *project.listed(project.RTL / TOPS[top].folder / TOPS[top].files)):
        file = add(place, "file")
        add(file, "name", f"../{path.relative_to(project.ROOT).as_posix()}")
        add(file, "fileType", "systemVerilogSource")
        if path.suffix == ".svh":
            add(file, "isIncludeFile", "true")


def text(top):
    component = ElementTree.Element(f"{{{NAMESPACE}}}component")
    heads = ElementTree.Element("later")
    version = memory_map(heads, top)
    source = project.RTL / TOPS[top].folder / f"{top}.sv"
    parameters = sv_widths.module_parameters(source) if top == "biss_axi" else {}
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
