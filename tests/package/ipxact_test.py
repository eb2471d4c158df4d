#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The IP-XACT of the bus tops has the ports of the VHDL components (which fit the release's Verilog),
the pins of its bus with their directions, the registers of docs/buses.md, and files that exist. Planted
faults are reported.

  ipxact_test.py FOLDER    FOLDER is for what the tool leaves
"""

import os
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import project  # noqa: E402

IPXACT = {"x": "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"}
COMPONENTS = ROOT / "rtl/mb4/vhdl/mb4_components.vhd"
# Directions at the subordinate: IHI0022, part B1 (AWPROT and ARPROT do not exist); Wishbone B4, 2.2.
AXI_IN = ("ACLK ARESETn AWVALID AWADDR WVALID WDATA WSTRB BREADY ARVALID ARADDR RREADY").split()
AXI_OUT = "AWREADY WREADY BVALID BRESP ARREADY RVALID RDATA RRESP".split()
WISHBONE_IN = "CLK_I RST_I CYC_I STB_I WE_I ADR_I DAT_I SEL_I".split()
WISHBONE_OUT = "DAT_O ACK_O ERR_O STALL_O".split()
PINS = {"mb4_axil": (AXI_IN, AXI_OUT, "s_axi_"), "mb4_wb": (WISHBONE_IN, WISHBONE_OUT, "wb_")}
# docs/buses.md, and the register manual of the chip.
REGISTERS = {"ID": 0x100, "FEATURES": 0x108, "IRQ_STATUS": 0x10C, "IRQ_ENABLE": 0x110,
             "TIME_LOW": 0x114, "SNAPSHOT": 0x120, "SCDATA": 0x00, "INSTR": 0xF4, "VERSION": 0x104}


def vhdl_ports(top):
    text = COMPONENTS.read_text(encoding="utf-8")
    body = re.search(rf"component {top}\n(.*?)end component", text, re.S).group(1)
    ports = {}
    for name, way, width in re.findall(
            r"(\w+) +: (in|out) +std_logic(?:_vector\((\d+) downto 0\))?", body):
        ports[name] = (way, int(width or 0) + 1)
    return ports


def number(text):
    return int(text[2:], 16) if text.startswith("'h") else int(text)


def ports_of(root):
    ports = {}
    for port in root.findall("x:model/x:ports/x:port", IPXACT):
        left = port.find(".//x:left", IPXACT)
        width = 1 if left is None else (
            number(left.text) - number(port.find(".//x:right", IPXACT).text) + 1)
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
    inputs, outputs, prefix = PINS[top]
    pins = {entry.find("x:logicalPort/x:name", IPXACT).text:
            entry.find("x:physicalPort/x:name", IPXACT).text
            for entry in root.findall(".//x:portMap", IPXACT)}
    if sorted(pins) != sorted(inputs + outputs):
        found.append(f"pins of the bus: {sorted(set(pins) ^ set(inputs + outputs))}")
    for logical, physical in pins.items():
        if physical.removeprefix(prefix) != logical.lower() or expected.get(
                physical, ("",))[0] != ("in" if logical in inputs else "out"):
            found.append(f"{logical}: {physical}")
    places = registers_of(root)
    for name, address in REGISTERS.items():
        if (name, address, True) not in places:
            found.append(f"{name} is not at {address:#x}")
    if any(not inside for _, _, inside in places):
        found.append("registers outside their block")
    if root.find(".//x:memoryMapRef", IPXACT).get("memoryMapRef") != root.find(
            "x:memoryMaps/x:memoryMap/x:name", IPXACT).text:
        found.append("the bus has no memory map")
    files = [file.text for file in root.findall(".//x:file/x:name", IPXACT)]
    found += [f"{file} is no file" for file in files if not Path(os.path.normpath(folder / file)).is_file()]
    if not files or f"../rtl/mb4/{top}.sv" not in files:
        found.append("files are missing")
    return found


def main():
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    status, text = project.run([sys.executable, "-B", ROOT / "tools/synth/ipxact.py", out])
    wrong = [] if status == 0 else [text]
    faults = (("<ipxact:name>irq_o<", "<ipxact:name>irq<"), ("'hc<", "'h10<"),
              ("<ipxact:direction>in<", "<ipxact:direction>out<"), ("mb4_bus.sv", "mb4_buss.sv"))
    for top, pins in PINS.items():
        good = (out / f"{top}.xml").read_text(encoding="utf-8")
        # A release has the files in a folder beside rtl/.
        wrong += [f"{top}: {each}" for each in findings(top, good, ROOT / "ipxact")]
        for old, new in (*faults, (f">{pins[0][2]}<", ">OTHER<"), (f">{pins[2]}", ">x_")):
            bad = good.replace(old, new, 1)
            if bad == good or not findings(top, bad, ROOT / "ipxact"):
                wrong.append(f"{top}: {old} as {new} is not reported")
    project.finish(wrong, "the IP-XACT fits ports, buses, registers and files")


main()
