// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The BiSS C master with N channels on AXI. Paths are relative to this folder; packages come first.
-F ../biss/biss.f
axi_pkg.sv
../../regmap/generated/axi/axi_regs_pkg.sv
../biss/biss_frame_sampler.sv
axi_crc.sv
axi_rule.sv
axi_word.sv
axi_channel.sv
axi_start.sv
axi_regs.sv
axi_stream.sv
axi_page.sv
axi_counters.sv
axi_delays.sv
axi_access.sv
axi_eye.sv
axi_last.sv
axi_extras.sv
axi_core.sv
axi_widths.sv
biss_axi.sv
biss_spi.sv
