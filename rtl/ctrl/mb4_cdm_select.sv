// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The CDM bit of the next frame: from the running control communication, else from INSTR. Only the
// lines that CHSEL selects get it; the other sends 0.
//
// Clock domain: core; combinational. cdm0_o and cdm1_o are the CDM if the frame's own CDS is 0 or
// 1, one bit a line.
// Misuse: CHSEL = 11 with register communication selects line 1 (page 27: one line at a time).
// Datasheet: pages 27, 32, Tables 23, 45.

module mb4_cdm_select (
  input  logic [1:0] chsel_i,
  input  logic       cts_i,
  input  logic [2:0] instr_i,
  input  logic       active_i,    // control communication runs
  input  logic [1:0] control0_i,  // its bits
  input  logic [1:0] control1_i,
  output logic [1:0] select_o,    // lines that carry control communication
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o
);

  logic [1:0] manual;

  always_comb begin
    manual = chsel_i;
    if (chsel_i == 2'b00) manual = 2'b01;
    select_o = manual;
    if (cts_i && chsel_i == 2'b11) select_o = 2'b01;
  end

  always_comb begin
    cdm0_o = 2'b00;
    cdm1_o = 2'b00;
    if (active_i) begin
      cdm0_o = control0_i;
      cdm1_o = control1_i;
    end else if (instr_i == mb4_regs_pkg::INSTR_CDM1) begin
      cdm0_o = manual;
      cdm1_o = manual;
    end else if (instr_i == mb4_regs_pkg::INSTR_CDM_NOT_CDSSEL) begin
      cdm0_o = manual;
    end
  end

endmodule
