// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Chooses the CDM bit of the next frame: from the running control communication, otherwise from
// INSTR. Only the lines that CHSEL selects get it; the other line sends 0.
//
// Clock domain: core; combinational. cdm0_o is the CDM to send if CDS of the same frame is 0,
// cdm1_o if it is 1. Both have one bit for each line.
// Datasheet: pages 27, 32, Tables 23, 45.

module mb4_cdm_select (
  input  logic [1:0] manual_i,    // lines that CHSEL selects
  input  logic [2:0] instr_i,
  input  logic       active_i,    // a control communication runs
  input  logic [1:0] control0_i,  // its bits
  input  logic [1:0] control1_i,
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o
);

  always_comb begin
    cdm0_o = 2'b00;
    cdm1_o = 2'b00;
    if (active_i) begin
      cdm0_o = control0_i;
      cdm1_o = control1_i;
    end else if (instr_i == mb4_regs_pkg::INSTR_CDM1) begin
      cdm0_o = manual_i;
      cdm1_o = manual_i;
    end else if (instr_i == mb4_regs_pkg::INSTR_CDM_NOT_CDSSEL) begin
      cdm0_o = manual_i;
    end
  end

endmodule
