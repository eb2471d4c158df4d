# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# nextpnr: clocks of mb4_core, mb4_axil and mb4_wb, whichever is the top, for its option --pre-pack.
#
# nextpnr 0.4 has no false paths and no delays between clocks. It reports such paths apart from fmax, does not place
# for them, and does not fail on them: compare what it calls "Max delay posedge clk_i -> posedge sclk_i" with one period
# of the receiver's clock. It reports no set-up at a pin either: "Max delay <async> -> posedge sclk_i" has that of MOSI,
# with the delay of SCLK to the flop still to be subtracted.
# The board's .pcf can say the same: set_frequency clk_i 20.

CLOCKS = {"clk_i": 20, "sclk_i": 50, "s_axi_aclk": 100, "wb_clk_i": 100}  # MHz: yours to change

for name, _ in ctx.nets:  # noqa: F821
    if name in CLOCKS:
        ctx.addClock(name, CLOCKS[name])  # noqa: F821
