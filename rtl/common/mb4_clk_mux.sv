// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Glitch-free choice between two unrelated clocks: 0 may stand still (a pin), 1 always runs when it
// is selected (the oscillator).
//
// Clock domains: each enable lives in its own clock and changes while that clock is low. The new
// clock starts after the old one has been stopped; between them clk_o is low for 1..3 periods of
// each. A clock 0 that never toggled since reset does not block the change to clock 1. One that
// stopped after it has run is given up after 2^TimeoutW - 1 periods of clock 1: it is standing
// still, so that cutting it off makes no pulse; clk_o falls then if it stood high.
// Misuse: a clock 0 slower than that time-out may be cut inside a pulse by the change to clock 1.
// Datasheet: page 23, Table 7 (CLKENI).
// Constraint: both clocks and clk_o are declared as clocks; sel_i and dead_q are false paths.

module mb4_clk_mux #(
  parameter int unsigned TimeoutW = 10  // 51 us at 20 MHz
) (
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
  logic alive_n;
  logic dead_q;
  logic [1:0] en0_sync_q;
  logic [TimeoutW-1:0] wait_q;

  assign alive_n = rst_ni && !dead_q;

  always_ff @(posedge clk0_i or negedge alive_n) begin
    if (!alive_n) want0_q <= 1'b0;
    else          want0_q <= !sel_i && !en1_q;
  end

  always_ff @(negedge clk0_i or negedge alive_n) begin
    if (!alive_n) en0_q <= 1'b0;
    else          en0_q <= want0_q;
  end

  always_ff @(posedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) want1_q <= 1'b0;
    else         want1_q <= sel_i && !en0_q;
  end

  always_ff @(negedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) en1_q <= 1'b0;
    else         en1_q <= want1_q;
  end

  // Clock 1 waits for clock 0 to let go.
  always_ff @(posedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) begin
      en0_sync_q <= 2'b00;
      wait_q     <= '0;
      dead_q     <= 1'b0;
    end else begin
      en0_sync_q <= {en0_sync_q[0], sel_i && en0_q};
      wait_q     <= en0_sync_q[1] ? wait_q + TimeoutW'(1) : '0;
      dead_q     <= wait_q == '1;
    end
  end

  assign clk_o = (clk0_i & en0_q) | (clk1_i & en1_q);

endmodule
