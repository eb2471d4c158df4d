# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Masters as LiteX modules: the iC-MB4-compatible one on Wishbone or AXI4-Lite (docs/buses.md), biss_axi (docs/axi.md),
biss_clb (docs/clb.md) and dsl_axil (docs/dsl.md).

    self.mb4 = Mb4(platform, platform.request("encoder"), features="single")
    self.bus.add_slave("mb4", self.mb4.bus, SoCRegion(size=Mb4.SIZE, cached=False))
    if self.irq.enabled:
        self.irq.add("mb4")

BissAxi, BissClb and DslAxil go into a SoC in the same way. The RTL is that of the repository, or of the release, in which
this file stands; for a copy of the file elsewhere set ROOT.
"""

import re
from pathlib import Path

from litex.gen import LiteXModule
from litex.soc.interconnect import axi, wishbone
from litex.soc.interconnect.csr_eventmanager import EventManager, EventSourceLevel
from migen import ClockSignal, Constant, Instance, ResetSignal, Signal

ROOT = Path(__file__).resolve().parents[2]


def listed(path):
    """The files of a list of RTL, and of those on its lines -F."""
    files = []
    for line in filter(None, map(str.strip, path.read_text(encoding="utf-8").splitlines())):
        if line.startswith("-F "):
            files += listed(path.parent / line[3:])
        elif not line.startswith("//"):
            files.append((path.parent / line).resolve())
    return files


def add_rtl(platform, room):
    """The RTL of a folder of rtl/, and of the folders below it."""
    platform.add_verilog_include_path(str(ROOT / "rtl" / "common"))
    for path in listed(ROOT / "rtl" / room / f"{room}.f"):
        platform.add_source(str(path), language="systemverilog")


def features_of(preset):
    """The word FEATURES of a preset of the iC-MB4."""
    text = (ROOT / "regmap" / "mb4_page.rdl").read_text(encoding="utf-8")
    return int(re.search(rf'"FEATURES_{preset.upper()}", value: (0x\w+)', text).group(1), 16)


def axi_lite_ports(bus, prefix="s_axi_"):
    """The ports of a module that is the bus's slave; they are as large as their prefix."""
    ports = {}
    for name, channel, sent, received in (
            ("aw", bus.aw, ("addr",), ()), ("w", bus.w, ("data", "strb"), ()), ("b", bus.b, (), ("resp",)),
            ("ar", bus.ar, ("addr",), ()), ("r", bus.r, (), ("data", "resp"))):
        ours = "o" if received else "i"   # the side that says valid
        ports[f"{ours}_s_axi_{name}valid"] = channel.valid
        ports[f"{'i' if received else 'o'}_s_axi_{name}ready"] = channel.ready
        ports.update({f"{ours}_s_axi_{name}{field}": getattr(channel, field) for field in sent + received})
    if prefix.isupper():
        return {f"{name[0]}_{name[2:].upper()}": signal for name, signal in ports.items()}
    return ports


def interrupt_of(irq):
    """The event manager of a master's irq_o."""
    events = EventManager()
    events.interrupt = EventSourceLevel(description="irq_o: IRQ_STATUS tells what, and is cleared there")
    events.finalize()
    events.comb += events.interrupt.trigger.eq(irq)
    return events


class Mb4(LiteXModule):
    """pads: ma1, sl1; if they are there mo1, ma2, sl2, mo2, and ner (its level; the driver is ner_low), getsens.

    bus_standard   "wishbone" or "axi-lite", as that of the SoC
    features       preset of the core: "full", "drive", "single", "reader"
    core           clock domain of the core, up to 25 MHz by the datasheet. The bus is in "sys". Give the tool the
                   lines of rtl/mb4/constraints if the two differ
    verilog        plain Verilog of the top with these features (tools/synth/plain_verilog.py), for tools that do not
                   read SystemVerilog. None: the RTL of this repository
    """

    SIZE = 0x1000

    def __init__(self, platform, pads, bus_standard="wishbone", features="full", core="sys", verilog=None):
        self.irq = Signal()
        self.eot = Signal()
        self.ner_low = Signal()   # pull NER low
        self.clkeni = Signal()
        self.paired = Signal()
        top = {"wishbone": "mb4_wb", "axi-lite": "mb4_axil"}[bus_standard]
        ports = {"o_irq_o": self.irq, "i_clk_i": ClockSignal(core), "i_por_ni": ~ResetSignal("sys"),
                 "o_eot_o": self.eot, "o_ner_low_o": self.ner_low, "i_ner_i": getattr(pads, "ner", ~self.ner_low),
                 "o_clkeni_o": self.clkeni, "o_paired_o": self.paired, "i_getsens_i": getattr(pads, "getsens", Constant(0, 1)),
                 "o_ma1_o": pads.ma1, "i_sl1_i": pads.sl1, "o_mo1_o": getattr(pads, "mo1", Signal()),
                 "o_ma2_o": getattr(pads, "ma2", Signal()), "i_sl2_i": getattr(pads, "sl2", Constant(1, 1)),
                 "o_mo2_o": getattr(pads, "mo2", Signal()),
                 "i_quirks_i": Constant(0, 6)}   # mb4_pkg::QUIRKS_DEFAULT
        ports.update(self._wishbone() if top == "mb4_wb" else self._axi_lite())
        if verilog is None:
            ports["p_Features"] = features_of(features)
            add_rtl(platform, "mb4")
        else:
            platform.add_source(str(verilog), language="verilog")
        self.specials += Instance(top, **ports)

        self.ev = interrupt_of(self.irq)

    def _wishbone(self):
        self.bus = bus = wishbone.Interface(data_width=32, adr_width=10, addressing="word")
        ack, err = Signal(), Signal()
        # LiteX's masters wait for ACK and look at ERR with it.
        self.comb += [bus.ack.eq(ack | err), bus.err.eq(err)]
        return {"i_wb_clk_i": ClockSignal("sys"), "i_wb_rst_i": ResetSignal("sys"),
                "i_wb_cyc_i": bus.cyc, "i_wb_stb_i": bus.stb, "i_wb_we_i": bus.we, "i_wb_adr_i": bus.adr,
                "i_wb_dat_i": bus.dat_w, "i_wb_sel_i": bus.sel, "o_wb_dat_o": bus.dat_r,
                "o_wb_ack_o": ack, "o_wb_err_o": err, "o_wb_stall_o": Signal()}

    def _axi_lite(self):
        self.bus = bus = axi.AXILiteInterface(data_width=32, address_width=12)
        return {"i_s_axi_aclk": ClockSignal("sys"), "i_s_axi_aresetn": ~ResetSignal("sys"), **axi_lite_ports(bus)}


class BissAxi(LiteXModule):
    """biss_axi, in the clock domain "sys". pads: ma and slo, each with a bit for each channel; if it is there
    ext_sample_clk.

    channels       1 to 16
    extras         sum of the values of docs/axi.md; without PAGE (1) there is no interrupt
    timeout        clocks for which the encoders may stay in their timeout: 40 us or more
    stream         a sink of LiteX's stream with stream mode 1: `stream.Endpoint` with data, 32 bits, or 64 with the
                   extra WIDE, and channel, and good. None: words are read by the bus, and mode 0 has no sink
    verilog        plain Verilog of the top (tools/synth/plain_verilog.py --top biss_axi --set ...) with these parameters, for
                   tools that do not read SystemVerilog. None: the RTL of this repository
    """

    SIZE = 0x100

    def __init__(self, platform, pads, channels=1, extras=0, timeout=4000, stream=None, verilog=None):
        self.irq = Signal()
        self.error_n, self.warn_n = Signal(), Signal()   # 0: a good word has brought nE = 0, nW = 0
        self.sample_clk = Signal()
        self.sample_en = Signal(reset=1)
        self.bus = axi.AXILiteInterface(data_width=32, address_width=8)
        data, user = Signal(32 * channels * (2 if extras & 2 else 1)), Signal(channels)
        ready, valid, last = Constant(1, 1), Signal(), Signal()
        if stream is not None:
            data, user, ready, valid, last = stream.data, Signal(16), stream.ready, stream.valid, stream.last
            self.comb += [stream.good.eq(user[0]), stream.channel.eq(user[8:16])]
        ports = {"i_axi_aclk": ClockSignal("sys"), "i_axi_aresetn": ~ResetSignal("sys"), "i_por_n": Constant(1, 1),
                 "o_ma": pads.ma, "i_slo": pads.slo, "i_ext_sample_clk": getattr(pads, "ext_sample_clk", Constant(0, 1)),
                 "o_sample_clk_output": self.sample_clk, "i_sample_en": self.sample_en, "o_error": self.error_n,
                 "o_warn": self.warn_n, "o_irq": self.irq, "o_s_axis_tdata": data, "o_s_axis_tuser": user,
                 "o_s_axis_tvalid": valid, "o_s_axis_tlast": last, "i_s_axis_tready": ready,
                 **axi_lite_ports(self.bus, "S_AXI_")}
        if verilog is None:
            ports.update(p_BISS_CHANNEL_WIDTH=channels, p_EXTRAS=extras, p_TIMEOUT_LIMIT=timeout,
                         p_STREAM_MODE=int(stream is not None), p_STREAM_WIDTH=64 if stream is not None and extras & 2 else 32)
            add_rtl(platform, "axi")
        else:
            platform.add_source(str(verilog), language="verilog")
        self.specials += Instance("biss_axi", **ports)
        self.ev = interrupt_of(self.irq)


class BissClb(LiteXModule):
    """biss_clb, in the clock domain "sys". pads: ma, sl; if they are there txen, spi_clk.

    watchdog       MA clocks after which a frame without a start bit ends
    verilog        plain Verilog of the top (tools/synth/plain_verilog.py), for tools that do not read SystemVerilog; the
                   watchdog then is that of the file. None: the RTL of this repository
    """

    SIZE = 0x1000

    def __init__(self, platform, pads, watchdog=4096, verilog=None):
        self.irq = Signal()
        self.bus = axi.AXILiteInterface(data_width=32, address_width=12)
        ports = {"i_clk_i": ClockSignal("sys"), "i_rst_ni": ~ResetSignal("sys"), "o_irq_o": self.irq, "o_ma_o": pads.ma,
                 "i_sl_i": pads.sl, "o_txen_o": getattr(pads, "txen", Signal()),
                 "o_spi_clk_o": getattr(pads, "spi_clk", Signal()), **axi_lite_ports(self.bus)}
        if verilog is None:
            ports["p_Watchdog"] = watchdog
            add_rtl(platform, "clb")
        else:
            platform.add_source(str(verilog), language="verilog")
        self.specials += Instance("biss_clb", **ports)
        self.ev = interrupt_of(self.irq)


class DslAxil(LiteXModule):
    """dsl_axil; its bus is in the clock domain "sys", which need not know the other one. pads: out, en, in_.

    core           clock domain of 75 MHz, give or take 100 ppm, for the line. Give the tool the lines of
                   rtl/dsl/constraints
    sdk_map        the registers as the published firmware has them
    verilog        plain Verilog of the top (tools/synth/plain_verilog.py), for tools that do not read SystemVerilog; the
                   map then is that of the file. None: the RTL of this repository
    """

    SIZE = 0x1000

    def __init__(self, platform, pads, core="dsl", sdk_map=False, verilog=None):
        self.irq = Signal()
        self.link = Signal()
        self.sample_edge = Signal()      # high for a clock of the core: the encoder samples now
        self.position_ready = Signal()   # ... its position stands in the registers
        self.bus = axi.AXILiteInterface(data_width=32, address_width=12)
        ports = {"i_s_axi_aclk": ClockSignal("sys"), "i_s_axi_aresetn": ~ResetSignal("sys"), "i_clk_i": ClockSignal(core),
                 "i_rst_ni": ~ResetSignal(core), "o_irq_o": self.irq, "o_link_o": self.link,
                 "o_sample_edge_o": self.sample_edge, "o_position_ready_o": self.position_ready,
                 "o_dsl_out_o": pads.out, "o_dsl_en_o": pads.en, "i_dsl_in_i": pads.in_, **axi_lite_ports(self.bus)}
        if verilog is None:
            ports["p_SDK_MAP"] = int(sdk_map)
            add_rtl(platform, "dsl")
        else:
            platform.add_source(str(verilog), language="verilog")
        self.specials += Instance("dsl_axil", **ports)
        self.ev = interrupt_of(self.irq)
