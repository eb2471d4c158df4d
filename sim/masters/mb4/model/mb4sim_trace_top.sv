// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Top of the traced model: the chip, and beside it levels outside the chip for the waveform. The
// simulator drives the probe inputs. No logic reads them.

module mb4sim_trace_top (
  input  logic       clk_i,
  input  logic       osc_i,
  input  logic       nres_i,
  input  logic       npor_i,
  input  logic       cfgspi_i,
  input  logic       int_nmot_i,
  input  logic       ncs_i,
  input  logic       ale_i,
  input  logic       nrd_rnw_i,
  input  logic       nwr_e_i,
  input  logic [7:0] db_i,
  output logic [7:0] db_o,
  output logic [7:0] db_oe_o,
  output logic       eot_o,
  input  logic       ner_i,
  output logic       ner_low_o,
  input  logic       getsens_i,
  output logic       ma1_o,
  output logic       ma2_o,
  output logic       mo1_o,
  output logic       mo2_o,
  input  logic       sl1_i,
  input  logic       sl2_i,
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i,
  // The probes are for the waveform only.
  /* verilator lint_off UNUSEDSIGNAL */
  input  logic [1:0] slaves_ma_i,   // MA as it arrives at the slaves of channel 1, 2
  input  logic [7:0] slaves_slo_i,  // SLO of slave 1 to 8
  input  logic [7:0] slaves_idle_i  // 1 = timeout of slave 1 to 8 has elapsed
  /* verilator lint_on UNUSEDSIGNAL */
);

  mb4_chip u_chip (
    .clk_i,
    .osc_i,
    .nres_i,
    .npor_i,
    .cfgspi_i,
    .int_nmot_i,
    .ncs_i,
    .ale_i,
    .nrd_rnw_i,
    .nwr_e_i,
    .db_i,
    .db_o,
    .db_oe_o,
    .eot_o,
    .ner_i,
    .ner_low_o,
    .getsens_i,
    .ma1_o,
    .ma2_o,
    .mo1_o,
    .mo2_o,
    .sl1_i,
    .sl2_i,
    .quirks_i
  );

endmodule
