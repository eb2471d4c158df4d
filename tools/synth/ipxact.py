#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""IP-XACT (IEEE 1685-2014) of the tops with a bus of words: bus interface, ports, files, and the
registers of both maps.

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

# The bus definition, its abstraction, and the port behind each logical name.
AXI = (("amba.com", "AMBA4", "AXI4-Lite", "r0p0_0"), "AXI4-Lite_rtl",
       {"ACLK": "s_axi_aclk", "ARESETn": "s_axi_aresetn",
        **{name: f"s_axi_{name.lower()}" for name in (
            "AWVALID", "AWREADY", "AWADDR", "WVALID", "WREADY", "WDATA", "WSTRB", "BVALID",
            "BREADY", "BRESP", "ARVALID", "ARREADY", "ARADDR", "RVALID", "RREADY", "RDATA",
            "RRESP")}})
WISHBONE = (("opencores.org", "interface", "wishbone", "B4"), "wishbone_rtl",
            {name: f"wb_{name.lower()}" for name in (
                "CLK_I", "RST_I", "CYC_I", "STB_I", "WE_I", "ADR_I", "DAT_I", "SEL_I", "DAT_O",
                "ACK_O", "ERR_O", "STALL_O")})
BUSES = {"mb4_axil": AXI, "mb4_wb": WISHBONE}


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


def bus_interface(component, top):
    kind, abstraction, ports = BUSES[top]
    interface = add(add(component, "busInterfaces"), "busInterface")
    add(interface, "name", "bus")
    reference(interface, "busType", *kind)
    abstract = add(add(interface, "abstractionTypes"), "abstractionType")
    reference(abstract, "abstractionRef", kind[0], kind[1], abstraction, kind[3])
    maps = add(abstract, "portMaps")
    for logical, physical in ports.items():
        entry = add(maps, "portMap")
        add(add(entry, "logicalPort"), "name", logical)
        add(add(entry, "physicalPort"), "name", physical)
    add(add(interface, "slave"), "memoryMapRef", memoryMapRef="registers")


def memory_map(component):
    """The blocks of both maps. The page's registers count from its beginning."""
    place = add(add(component, "memoryMaps"), "memoryMap")
    add(place, "name", "registers")
    version = None
    for name, base in (("mb4", 0), ("mb4_page", PAGE)):
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


def model(component, top, ports):
    place = add(component, "model")
    view = add(add(place, "views"), "view")
    add(view, "name", "rtl")
    add(view, "envIdentifier", "::")
    add(view, "componentInstantiationRef", "systemverilog")
    instance = add(add(place, "instantiations"), "componentInstantiation")
    add(instance, "name", "systemverilog")
    add(instance, "language", "SystemVerilog")
    add(instance, "moduleName", top)
    add(add(instance, "fileSetRef"), "localName", "rtl")
    list_ = add(place, "ports")
    for name, (direction, width) in ports.items():
        port = add(list_, "port")
        add(port, "name", name)
        wire = add(port, "wire")
        add(wire, "direction", {"input": "in", "output": "out"}[direction])
        if width > 1:
            vector = add(add(wire, "vectors"), "vector")
            low = 2 if name == "wb_adr_i" else 0  # words
            add(vector, "left", width - 1 + low)
            add(vector, "right", low)


def files(component):
    place = add(add(component, "fileSets"), "fileSet")
    add(place, "name", "rtl")
    for path in (*sorted(project.INCLUDE.glob("*.svh")), *project.rtl_files()):
        file = add(place, "file")
        add(file, "name", f"../{path.relative_to(project.ROOT).as_posix()}")
        add(file, "fileType", "systemVerilogSource")
        if path.suffix == ".svh":
            add(file, "isIncludeFile", "true")


def text(top):
    component = ElementTree.Element(f"{{{NAMESPACE}}}component")
    heads = ElementTree.Element("later")
    version = memory_map(heads)
    names(component, "openmb4", "ip", top, version)
    bus_interface(component, top)
    component.extend(heads)
    model(component, top, sv_widths.module_ports(project.RTL / "mb4" / f"{top}.sv",
                                                 sv_widths.read_packages(project.rtl_packages())))
    files(component)
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
    for top in BUSES:
        path = folder / f"{top}.xml"
        path.write_text(text(top), encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main()
