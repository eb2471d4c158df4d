// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Glitch-free choice between two unrelated clocks.
//
// Clock domains: each enable lives in its own clock and changes while that clock is low. The new
// clock starts after the old one has been stopped; between them clk_o is low for 1..3 periods of
// each. A clock that never toggled since reset does not block the change to the other one.
// Misuse: if the selected clock stops after it has run, only reset or its return frees the switch.
// Datasheet: page 23, Table 7 (CLKENI).
// Constraint: both clocks and clk_o are declared as clocks; sel_i is a false path.

module mb4_clk_mux (
  input  logic clk0_i,
  input  logic clk1_i,
  input  logic rst_ni,
  input  logic sel_i,
  output logic clk_o
);

  logic want0_q;
  logic want1_q;
  logic en0_q;
  logic en1_q;

  always_ff @(posedge clk0_i or negedge rst_ni) begin
    if (!rst_ni) want0_q <= 1'b0;
    else         want0_q <= !sel_i && !en1_q;
  end

  always_ff @(negedge clk0_i or negedge rst_ni) begin
    if (!rst_ni) en0_q <= 1'b0;
    else         en0_q <= want0_q;
  end

  always_ff @(posedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) want1_q <= 1'b0;
    else         want1_q <= sel_i && !en0_q;
  end

  always_ff @(negedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) en1_q <= 1'b0;
    else         en1_q <= want1_q;
  end

  assign clk_o = (clk0_i & en0_q) | (clk1_i & en1_q);

endmodule
