#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A SoC without a CPU for the ULX3S (ECP5): one encoder, read by a PC over the board's USB port.

  soc.py FOLDER [--master mb4|axi|clb|dsl] [--bus wishbone|axi-lite] [--features PRESET] [--verilog FILE] [--baud N] [--build]

Writes FOLDER/gateware (Verilog, constraints, build script) and FOLDER/csr.csv. Without --build no tool runs;
with it Yosys and nextpnr-ecp5 make the bitstream. Then `litex_server --uart --uart-port=/dev/ttyUSB0`, and for example
`RemoteClient("csr.csv")` with read(0x3000_0100), which is 0x454E4301 (--master axi: read(0x3000_0040), 0x454E4302; clb:
read(0x3000_0200), 0x454E4304; dsl: read(0x3000_0180), 0x454E4305). LiteX 2024.12 of PyPI; it also needs requests, setuptools, packaging.
"""

import argparse

from litex.build.generic_platform import IOStandard, Pins, Subsignal
from litex.build.io import CRG
from litex.build.lattice import LatticePlatform
from litex.gen import ClockDomain
from litex.soc.cores.clock import ECP5PLL
from litex.soc.integration.builder import Builder
from litex.soc.integration.soc import SoCRegion
from litex.soc.integration.soc_core import SoCMini
from migen import ResetSignal

from mb4_litex import BissAxi, BissClb, DslAxil, Mb4

CLK_HZ = 25_000_000   # of the board, for the bus and the core: f_MA up to 12.5 MHz, with biss_clb 3.125 MHz
DSL_HZ = 75_000_000   # of the core of dsl_axil
ORIGIN = 0x3000_0000
# The transceivers are on GP and GN 0 to 3 of the connector J1.
ENCODER = {
    "mb4": (Subsignal("ma1", Pins("B11")), Subsignal("sl1", Pins("C11")), Subsignal("mo1", Pins("A10")),
            Subsignal("ma2", Pins("A11")), Subsignal("sl2", Pins("A9")), Subsignal("mo2", Pins("B10"))),
    "axi": (Subsignal("ma", Pins("B11")), Subsignal("slo", Pins("C11"))),
    "clb": (Subsignal("ma", Pins("B11")), Subsignal("sl", Pins("C11"))),
    "dsl": (Subsignal("out", Pins("B11")), Subsignal("en", Pins("A10")), Subsignal("in_", Pins("C11")))}
IO = [("clk", 0, Pins("G2"), IOStandard("LVCMOS33")),
      ("rst", 0, Pins("R1"), IOStandard("LVCMOS33")),   # button FIRE1, 1 when pressed
      ("serial", 0, Subsignal("tx", Pins("L4")), Subsignal("rx", Pins("M1")), IOStandard("LVCMOS33"))]


class Soc(SoCMini):
    def __init__(self, master, bus_standard, features, verilog, baud):
        pins = ("encoder", 0, *ENCODER[master], IOStandard("LVCMOS33"))
        platform = LatticePlatform("LFE5U-25F-6BG381C", [*IO, pins], toolchain="trellis")
        clk = platform.request("clk")
        platform.add_period_constraint(clk, 1e9 / CLK_HZ)
        self.crg = CRG(clk, platform.request("rst"))
        SoCMini.__init__(self, platform, clk_freq=CLK_HZ, bus_standard=bus_standard,
                         ident="openmb4 without a CPU", ident_version=False)
        self.add_uartbone(baudrate=baud)
        if master == "mb4":
            module = Mb4(platform, platform.request("encoder"), bus_standard, features, verilog=verilog)
        elif master == "axi":
            module = BissAxi(platform, platform.request("encoder"), extras=1, verilog=verilog)   # the page
        elif master == "clb":
            module = BissClb(platform, platform.request("encoder"), verilog=verilog)
        else:
            self.cd_dsl = ClockDomain()
            self.pll = pll = ECP5PLL()
            self.comb += pll.reset.eq(ResetSignal("sys"))
            pll.register_clkin(clk, CLK_HZ)
            pll.create_clkout(self.cd_dsl, DSL_HZ)
            module = DslAxil(platform, platform.request("encoder"), verilog=verilog)
        self.add_module(master, module)
        self.bus.add_slave(master, module.bus, SoCRegion(origin=ORIGIN, size=module.SIZE, cached=False))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--master", choices=ENCODER, default="mb4")
    parser.add_argument("--bus", choices=("wishbone", "axi-lite"), help="default: wishbone of mb4, axi-lite of the others")
    parser.add_argument("--features", default="single")
    parser.add_argument("--verilog")
    parser.add_argument("--baud", type=int, default=1_000_000)
    parser.add_argument("--build", action="store_true")
    arguments = parser.parse_args()
    bus = arguments.bus or ("wishbone" if arguments.master == "mb4" else "axi-lite")
    soc = Soc(arguments.master, bus, arguments.features, arguments.verilog, arguments.baud)
    Builder(soc, output_dir=arguments.folder, csr_csv=f"{arguments.folder}/csr.csv", compile_software=False,
            compile_gateware=arguments.build).build(build_name="soc", run=arguments.build)


if __name__ == "__main__":
    main()
