// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What INSTR asks for, and which lines take part in it.
//
// Combinational; the configuration must be stable while frames run. A line is in use unless CFGCHx
// is 11, line 2 only with SLAVELOC5 = 1. Bit i of a vector {2, 1} belongs to line i + 1.
// Misuse: INSTR 100 and 111 with REGVERS = 0 and no BiSS B line selected: no frame at all.
// Datasheet: pages 23, 27, 28, 32, Tables 8, 10, 23, 45, 46.

module mb4_frame_kind (
  input  logic [2:0] instr_i,
  input  logic       regvers_i,
  input  logic       slaveloc5_i,
  input  logic [1:0] cfgch1_i,
  input  logic [1:0] cfgch2_i,
  input  logic [1:0] select_i,       // by CHSEL
  output logic [1:0] use_o,
  output logic [1:0] ssi_o,
  output logic [1:0] frame_use_o,    // lines of the frame that INSTR asks for
  output logic [1:0] init_use_o,     // lines of INIT
  output logic       is_frame_o,
  output logic       is_control_o,   // BiSS C control communication
  output logic       is_register_o   // BiSS B register access
);

  logic [1:0] biss_b;
  logic       control;

  assign use_o  = {cfgch2_i != mb4_regs_pkg::PROTOCOL_UNUSED && slaveloc5_i,
                   cfgch1_i != mb4_regs_pkg::PROTOCOL_UNUSED};
  assign ssi_o  = {cfgch2_i == mb4_regs_pkg::PROTOCOL_SSI, cfgch1_i == mb4_regs_pkg::PROTOCOL_SSI};
  assign biss_b = {cfgch2_i == mb4_regs_pkg::PROTOCOL_BISS_B,
                   cfgch1_i == mb4_regs_pkg::PROTOCOL_BISS_B} & use_o;

  assign control = instr_i == mb4_regs_pkg::INSTR_CONTROL ||
                   instr_i == mb4_regs_pkg::INSTR_CONTROL_REDUCED;

  assign is_control_o  = control && regvers_i;
  assign is_register_o = control && !regvers_i && (biss_b & select_i) != 2'b00;
  assign is_frame_o    = is_control_o || is_register_o || (instr_i != 3'b000 && !instr_i[2]);
  assign frame_use_o   = is_register_o ? biss_b & select_i : use_o;
  assign init_use_o    = use_o & ~ssi_o;

endmodule
