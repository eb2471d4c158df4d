// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The BiSS C master with the registers of TIDM-1010. Paths are relative to this folder; packages
// come first.
-F ../common/common.f
clb_pkg.sv
../../regmap/generated/clb/clb_regs_pkg.sv
clb_state.sv
clb_counter.sv
clb_frame.sv
clb_receive.sv
clb_fifo.sv
clb_page.sv
clb_regs.sv
biss_clb.sv
