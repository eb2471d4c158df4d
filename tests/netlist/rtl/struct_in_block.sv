// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Not for use: a struct variable declared inside always_comb, of which Yosys 0.23 makes wrong
// hardware without a message. Shows that the comparison of netlist and RTL reports such a thing.

module struct_in_block (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  mb4_pkg::instr_t data_i,
  output logic [3:0]      data_o
);

  logic [3:0] data_d;

  always_comb begin
    mb4_pkg::instr_t both;
    both   = data_i;
    data_d = {both.instr, both.ags};
    if (both.brk) data_d = {both.holdbank, both.swbank, both.init, both.ags};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) data_o <= '0;
    else         data_o <= data_d;
  end

endmodule
