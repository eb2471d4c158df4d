// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A line of BiSS or SSI. Paths are relative to this folder.
-F ../common/common.f
biss_pkg.sv
biss_timebase.sv
biss_sl_capture.sv
biss_sl_sampler.sv
biss_delay_sampler.sv
biss_os_sampler.sv
biss_rx_word.sv
biss_edge_count.sv
biss_ma_drive.sv
biss_frame.sv
biss_mo_tx.sv
biss_line.sv
biss_cdm_timeout.sv
biss_control_frame.sv
biss_b_access.sv
