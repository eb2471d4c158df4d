// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells what INSTR asks for, and which lines take part.
//
// Combinational. CHSEL, CTS and REGVERS are those that mb4_control keeps for an access; the host
// may change the rest at any time (decision 38). Bit i of a vector {2, 1} is for line i + 1.
//
// - A line is in use unless CFGCHx is 11. Line 2 also needs SLAVELOC5 = 1.
// - Control communication runs on the lines that CHSEL names and whose protocol fits: BiSS B with
//   REGVERS = 0, BiSS C or SSI with REGVERS = 1.
// - If both lines fit, a BiSS C register access runs on line 1 alone. A command runs on both lines,
//   and so does a BiSS B access (biss_b_access reads line 1).
//
// Misuse: INSTR 100 or 111 without a line that fits asks for nothing (is_void_o; decision 37).
// Datasheet: pages 23, 27, 28, 32, Tables 8, 10, 23, 45, 46; decision 43.

module mb4_frame_kind (
  input  logic [2:0] instr_i,
  input  logic [1:0] chsel_i,
  input  logic       cts_i,
  input  logic       regvers_i,
  input  logic       slaveloc5_i,
  input  logic [1:0] cfgch1_i,
  input  logic [1:0] cfgch2_i,
  output mb4_pkg::kind_t kind_o,
  output logic [1:0] ssi_o,
  output logic [1:0] manual_o,       // lines that CHSEL names
  output logic [1:0] select_o        // lines of the control communication
);

  logic [1:0] biss_b;
  logic [1:0] fits;
  logic [1:0] in_use;
  logic       control;
  logic       is_control;
  logic       is_register;
  logic       is_frame;

  assign in_use  = {cfgch2_i != mb4_regs_pkg::PROTOCOL_UNUSED && slaveloc5_i,
                   cfgch1_i != mb4_regs_pkg::PROTOCOL_UNUSED};
  assign ssi_o  = {cfgch2_i == mb4_regs_pkg::PROTOCOL_SSI, cfgch1_i == mb4_regs_pkg::PROTOCOL_SSI};
  assign biss_b = {cfgch2_i == mb4_regs_pkg::PROTOCOL_BISS_B,
                   cfgch1_i == mb4_regs_pkg::PROTOCOL_BISS_B};

  assign manual_o = chsel_i == 2'b00 ? 2'b01 : chsel_i;
  assign fits     = manual_o & in_use & (regvers_i ? ~biss_b : biss_b);
  assign select_o = {fits[1] && !(fits[0] && cts_i && regvers_i), fits[0]};

  assign control = instr_i == mb4_regs_pkg::INSTR_CONTROL ||
                   instr_i == mb4_regs_pkg::INSTR_CONTROL_REDUCED;

  assign is_register = control && fits != 2'b00 && !regvers_i;
  assign is_control  = control && fits != 2'b00 && regvers_i;
  assign is_frame    = is_control || is_register || (instr_i != 3'b000 && !instr_i[2]);
  assign kind_o      = {in_use, is_register ? select_o : in_use, in_use & ~ssi_o, is_frame,
                        is_control, is_register, control && fits == 2'b00};

endmodule
