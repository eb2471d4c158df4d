// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Glitch-free choice between two unrelated clocks. Clock 0 may stand still (a pin). Clock 1 always
// runs while it is selected (the oscillator).
//
// Clock domains: sel*_q, claim*_q, ready*_q and en*_q run on the clock of their number; the other
// flops run on clock 1. An enable changes while its clock is low. A clock first raises its claim
// and then looks at the claim of the other clock. The claim stays until the enable has fallen. So
// at most one clock is enabled, whenever the choice changes, and also when it changes back.
//
// Latency of a change: three periods of the old clock plus two of the new one, or four periods of
// the new one if that is longer. clk_o is low in between. A clock whose first flop settles late
// needs one period more. If clock 0 runs after a reset, its fourth rising edge is the first one on
// clk_o.
//
// A stopped clock 0: one that has not toggled since the reset does not block the change to clock 1.
// One that stopped after it had run is given up after 2^TimeoutW - 1 periods of clock 1. It stands
// still then, so its end makes no short pulse; if clk_o stood high, it falls.
//
// A claim of clock 0 makes clock 1 pause for a few periods. It occurs when clock 0 comes back after
// a stop, and when only clock 0 has seen a short change of sel_i.
//
// Misuse: the change may cut a pulse of a clock 0 that is slower than the time-out, or that comes
// back in the clocks in which it is given up. If clock 1 stops within five periods after it was
// deselected, clock 0 does not start.
// Datasheet: page 23, Table 7 (CLKENI).
// Constraint: both clocks and clk_o are declared as clocks; sel_i and dead_q are false paths.

module enc_clk_mux #(
  parameter int unsigned TimeoutW = 10  // 51 us at 20 MHz
) (
  input  logic clk0_i,
  input  logic clk1_i,
  input  logic rst_ni,
  input  logic sel_i,
  output logic clk_o
);

  logic sel0_q;
  logic sel1_q;
  logic claim0_q;
  logic claim1_q;
  logic ready0_q;
  logic ready1_q;
  logic en0_q;
  logic en1_q;
  logic alive_n;
  logic dead_q;
  logic [1:0] claim0_sync_q;
  logic [TimeoutW-1:0] wait_q;

  assign alive_n = rst_ni && !dead_q;

  always_ff @(posedge clk0_i or negedge alive_n) begin
    if (!alive_n) begin
      sel0_q   <= 1'b0;
      claim0_q <= 1'b0;
      ready0_q <= 1'b0;
    end else begin
      sel0_q   <= !sel_i;
      claim0_q <= sel0_q || en0_q;
      ready0_q <= sel0_q && claim0_q && !claim1_q;
    end
  end

  always_ff @(negedge clk0_i or negedge alive_n) begin
    if (!alive_n) en0_q <= 1'b0;
    else          en0_q <= ready0_q;
  end

  always_ff @(posedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sel1_q   <= 1'b0;
      claim1_q <= 1'b0;
      ready1_q <= 1'b0;
    end else begin
      sel1_q   <= sel_i;
      claim1_q <= sel1_q || en1_q;
      ready1_q <= sel1_q && claim1_q && !claim0_q;
    end
  end

  always_ff @(negedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) en1_q <= 1'b0;
    else         en1_q <= ready1_q;
  end

  // Time-out: how long clock 1 has waited for the claim of clock 0 to end.
  always_ff @(posedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) begin
      claim0_sync_q <= 2'b00;
      wait_q        <= '0;
      dead_q        <= 1'b0;
    end else begin
      claim0_sync_q <= {claim0_sync_q[0], sel1_q && claim0_q};
      wait_q        <= claim0_sync_q[1] ? wait_q + TimeoutW'(1) : '0;
      dead_q        <= wait_q == '1;
    end
  end

  assign clk_o = (clk0_i & en0_q) | (clk1_i & en1_q);

endmodule
