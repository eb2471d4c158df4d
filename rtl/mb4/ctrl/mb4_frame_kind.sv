// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells what INSTR asks for, and which lines take part.
//
// Combinational. CHSEL, CTS and REGVERS are those that mb4_control_comm keeps for an access; the
// host may change the rest at any time (decision 38). Bit i of a vector {2, 1} is for line i + 1.
//
// - A line is in use unless its code is UNUSED. The codes of a left-out line and of left-out
//   protocols are UNUSED (mb4_control).
// - Control communication runs on the lines that CHSEL names and whose protocol fits: BiSS B with
//   REGVERS = 0, BiSS C or SSI with REGVERS = 1.
// - If both lines fit, a BiSS C register access runs on line 1 alone. A command runs on both lines,
//   and so does a BiSS B access (biss_b_access reads line 1).
//
// Misuse: INSTR 100 or 111 without a line that fits asks for nothing (is_void; decision 37).
// Datasheet: pages 23, 27, 28, 32, Tables 8, 10, 23, 45, 46; decision 43.

module mb4_frame_kind #(
  parameter bit Control = 1'b1
) (
  input  logic [2:0] instr_i,
  input  mb4_pkg::access_t access_i,
  input  logic [3:0] protocol_i,   // codes of lines {2, 1}
  output mb4_pkg::kind_t kind_o
);

  logic [1:0] ssi;
  logic [1:0] biss_b;
  logic [1:0] manual;
  logic [1:0] select;
  logic [1:0] fits;
  logic [1:0] in_use;
  logic       control;
  logic       is_control;
  logic       is_register;
  logic       is_frame;

  for (genvar i = 0; i < 2; i++) begin : gen_line
    assign in_use[i] = protocol_i[2*i +: 2] != biss_pkg::UNUSED;
    assign ssi[i]    = protocol_i[2*i +: 2] == biss_pkg::SSI;
    assign biss_b[i] = protocol_i[2*i +: 2] == biss_pkg::BISS_B;
  end

  assign manual = access_i.chsel == 2'b00 ? 2'b01 : access_i.chsel;
  assign fits   = manual & in_use & (access_i.regvers ? ~biss_b : biss_b) & {2{Control}};
  assign select = {fits[1] && !(fits[0] && access_i.cts && access_i.regvers), fits[0]};

  assign control = instr_i == mb4_regs_pkg::INSTR_CONTROL ||
                   instr_i == mb4_regs_pkg::INSTR_CONTROL_REDUCED;

  assign is_register = control && fits != 2'b00 && !access_i.regvers;
  assign is_control  = control && fits != 2'b00 && access_i.regvers;
  assign is_frame    = is_control || is_register || (instr_i != 3'b000 && !instr_i[2]);
  assign kind_o.in_use      = in_use;
  assign kind_o.ssi         = ssi;
  assign kind_o.manual      = manual;
  assign kind_o.select      = select;
  assign kind_o.frame_use   = is_register ? select : in_use;
  assign kind_o.init_use    = in_use & ~ssi;
  assign kind_o.is_frame    = is_frame;
  assign kind_o.is_control  = is_control;
  assign kind_o.is_register = is_register;
  assign kind_o.is_void     = control && fits == 2'b00;

endmodule
