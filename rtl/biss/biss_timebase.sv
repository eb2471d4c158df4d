// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time base of all lines: half MA periods, and the four sampling points of each MA period.
//
// Clock domain: core, rising edge. restart_i takes half_len_i for everything that follows and
// begins a half period in which MA is high. tick_o is high in the last clock of each half period;
// half_next_o is the level of MA in the next half period.
//
// The sampling points in sample_o are a (beginning of a half period) and b (middle of it). Both
// come two clocks late, to match SL after its synchroniser. If the half period is one clock, both
// come in the same clock. In an odd half period the middle is at a falling clock edge: b_neg.
//
// Misuse: half_len_i must not be 0. It comes from the host domain and is read only with restart_i,
// so the host may change it while slaves are still in their timeout.
// Datasheet: page 12 (I301..I303 and sampling points), page 30.

`include "enc_check.svh"

module biss_timebase (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [7:0] half_len_i,
  input  logic       run_i,
  input  logic       restart_i,
  output logic       tick_o,
  output logic       half_next_o,
  output biss_pkg::sample_t sample_o,
  output logic       sample_half_o  // MA level of the half period of the points
);

  logic [7:0] len_q;
  logic [7:0] cnt_d;
  logic [7:0] cnt_q;       // clock of the half period, 1 to len_q
  logic       last_d;
  logic       last_q;      // the last clock of a half period
  logic       half_d;
  logic       half_q;
  logic       tick;
  logic       middle;
  logic [1:0] a_q;
  logic [1:0] b_q;
  logic [1:0] h_q;

  // Much logic depends on tick in the same clock, so last_q is prepared one clock before.
  assign tick   = run_i && last_q;
  assign middle = (len_q == 8'd1) ? tick : run_i && cnt_q == {1'b0, len_q[7:1]};

  always_comb begin
    cnt_d  = cnt_q;
    half_d = half_q;
    if (restart_i) begin
      cnt_d  = 8'd1;
      half_d = 1'b1;
    end else if (tick) begin
      cnt_d  = 8'd1;
      half_d = !half_q;
    end else if (run_i) begin
      cnt_d  = cnt_q + 8'd1;
    end
    last_d = restart_i ? half_len_i == 8'd1 : cnt_d == len_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      len_q  <= 8'd1;
      cnt_q  <= 8'd1;
      last_q <= 1'b1;
      half_q <= 1'b1;
      a_q    <= '0;
      b_q    <= '0;
      h_q    <= '0;
    end else begin
      if (restart_i) len_q <= half_len_i;
      cnt_q  <= cnt_d;
      last_q <= last_d;
      half_q <= half_d;
      // A restart drops the sampling points that are still in the delay.
      a_q    <= restart_i ? 2'b00 : {a_q[0], tick};
      b_q    <= restart_i ? 2'b00 : {b_q[0], middle};
      h_q    <= {h_q[0], half_d};
    end
  end

  assign tick_o        = tick;
  assign half_next_o   = !half_q;
  assign sample_o      = {a_q[1], b_q[1], len_q[0]};
  assign sample_half_o = h_q[1];

  `ENC_ASSERT(HalfLength_A, clk_i, rst_ni, len_q != 8'd0)
  `ENC_ASSERT_IF(CountInRange_A, clk_i, rst_ni, run_i,
                 cnt_q != 8'd0 && cnt_q <= len_q)
  `ENC_ASSERT(LastOfHalf_A, clk_i, rst_ni, last_q == (cnt_q == len_q))

endmodule
