// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time base of all lines: half MA periods and the four sampling points of each MA period.
//
// Clock domain: core, rising edge. restart_i begins a half period in which MA is high. tick_o is
// high in the last clock of each half period; half_next_o is MA's level in the one that follows.
// smp_*_o mark the sampling points, two clocks late to meet SL behind its synchroniser: smp_a_o at
// the half period's beginning, smp_b_o at its middle (both in the same clock if half_len_i is 1).
// With an odd half_len_i the middle lies on a falling clock edge: smp_b_neg_o.
// Misuse: half_len_i of 0 is not possible (mb4_freqs_dec); a change takes effect with the next tick.
// Datasheet: page 12 (I301..I303 and sampling points), page 30.

`include "mb4_check.svh"

module mb4_timebase (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [7:0] half_len_i,
  input  logic       run_i,
  input  logic       restart_i,
  output logic       tick_o,
  output logic       half_next_o,
  output logic       smp_a_o,
  output logic       smp_b_o,
  output logic       smp_half_o,   // MA level of the half period the points belong to
  output logic       smp_b_neg_o
);

  logic [7:0] cnt_d;
  logic [7:0] cnt_q;
  logic       half_d;
  logic       half_q;
  logic       tick;
  logic       middle;
  logic [1:0] a_q;
  logic [1:0] b_q;
  logic [1:0] h_q;

  assign tick   = run_i && cnt_q == half_len_i - 8'd1;
  assign middle = (half_len_i == 8'd1) ? tick : run_i && cnt_q == {1'b0, half_len_i[7:1]} - 8'd1;

  always_comb begin
    cnt_d  = cnt_q;
    half_d = half_q;
    if (restart_i) begin
      cnt_d  = 8'd0;
      half_d = 1'b1;
    end else if (tick) begin
      cnt_d  = 8'd0;
      half_d = !half_q;
    end else if (run_i) begin
      cnt_d  = cnt_q + 8'd1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      cnt_q  <= '0;
      half_q <= 1'b1;
      a_q    <= '0;
      b_q    <= '0;
      h_q    <= '0;
    end else begin
      cnt_q  <= cnt_d;
      half_q <= half_d;
      a_q    <= {a_q[0], tick};
      b_q    <= {b_q[0], middle};
      h_q    <= {h_q[0], half_d};
    end
  end

  assign tick_o      = tick;
  assign half_next_o = !half_q;
  assign smp_a_o     = a_q[1];
  assign smp_b_o     = b_q[1];
  assign smp_half_o  = h_q[1];
  assign smp_b_neg_o = half_len_i[0];

  `MB4_ASSERT(HalfLength_A, clk_i, rst_ni, half_len_i != 8'd0)
  `MB4_ASSERT_IF(CountInRange_A, clk_i, rst_ni, run_i, cnt_q < half_len_i)

endmodule
