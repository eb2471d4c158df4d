// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SL input of one line: synchroniser for both clock edges, measurement of the line delay, sampling
// of the bits.
//
// Clock domain: core; SL is asynchronous. biss_sl_capture takes it on both clock edges. A sample is
// used two clocks after it was taken.
//
// - Delay: from the second rising MA edge on, quarters_o counts the sampling points up to and
//   including the first point that reads 0 (the acknowledge).
// - Bits: every bit is taken one sampling point after that phase, in the middle of the bit. Without
//   line delay this is the falling MA edge. bit_valid_o is high for one clock for each bit, first
//   in the period after the acknowledge.
// - SSI has no acknowledge: bits are taken at the rising MA edges, the first bit at the second
//   edge.
//
// Misuse: if SL is already low at the first point, quarters_o is 1. quarters_o stops at
// 2^DelayW - 1 (255).
// Datasheet: page 12 (I304, I305, four sampling points), page 14 (I504, I505); decisions 2, 17.

`include "enc_check.svh"

module biss_sl_sampler #(
  parameter logic [1:0]  SlCells = biss_pkg::SL_FLOPS,
  parameter int unsigned DelayW  = 8    // bits of the line delay, 1 to 8
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       sl_i,         // pin
  // time base
  input  biss_pkg::sample_t sample_i,
  input  logic       sample_half_i, // MA level of the half period of the points
  // biss_frame: the second rising MA edge has come, for points a and b; not delayed yet
  input  logic       clear_i,
  input  logic       ssi_i,
  input  logic       armed_a_i,
  input  logic       armed_b_i,
  // results
  output logic       sl_o,         // synchronised level
  output logic       ack_o,        // the line delay is known
  output logic [7:0] quarters_o,
  output logic       late_o,       // quarters_o has reached its end
  output logic       bit_valid_o,
  output logic       bit_o
);

  localparam logic [DelayW-1:0] LONGEST = {DelayW{1'b1}};

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (DelayW < 1 || DelayW > 8) begin : gen_delay
    $error("DelayW is 1 to 8");
  end
`endif

  logic       pos;
  logic       neg;
  logic [1:0] armed_a_q;     // no reset: clear_i comes before a frame
  logic [1:0] armed_b_q;
  logic       value_b;
  logic       look_a;
  logic       look_b;
  logic       hit_a;
  logic       hit_b;
  logic       found_q;
  logic       found_d;
  logic [1:0] phase_q;   // sampling point of the bits: {after the falling edge, middle}
  logic [1:0] phase_d;
  logic       skip_q;
  logic       skip_d;
  logic [DelayW-1:0] quarters_q;
  logic [DelayW-1:0] quarters_d;
  logic              full;        // quarters_q has reached its end, or lacks one
  logic              count_a, count_b;
  logic              unused;
  logic       phase_known;
  logic       at_phase;

  biss_sl_capture #(.SlCells(SlCells)) u_capture (
    .clk_i,
    .rst_ni,
    .sl_i,
    .pos_o (pos),
    .neg_o (neg)
  );

  always_ff @(posedge clk_i) begin
    if (clear_i) {armed_b_q, armed_a_q} <= '0;
    else         {armed_b_q, armed_a_q} <= {armed_b_q[0], armed_b_i, armed_a_q[0], armed_a_i};
  end

  assign value_b = sample_i.b_neg ? neg : pos;
  assign look_a  = sample_i.a && armed_a_q[1] && !found_q && !ssi_i;
  assign look_b  = sample_i.b && armed_b_q[1] && !found_q && !ssi_i;
  assign hit_a   = look_a && !pos;
  assign hit_b   = look_b && !value_b && !hit_a;

  assign phase_known = ssi_i ? armed_b_q[1] : found_q;

  // Point a comes before point b. At the highest MA frequency both come in one clock. The bit below
  // the sum carries count_b into its only adder.
  assign full    = (quarters_q | DelayW'(1)) == LONGEST;
  assign count_a = look_a && !(full && quarters_q[0]);
  assign count_b = look_b && !hit_a && !(full && (quarters_q[0] || count_a));
  assign {quarters_d, unused} = {quarters_q, 1'b1} + (DelayW+1)'({count_a, count_b});

  always_comb begin
    at_phase   = phase_known && sample_half_i != phase_q[1] &&
                 (phase_q[0] ? sample_i.b : sample_i.a);
    found_d    = found_q;
    phase_d    = phase_q;
    skip_d     = skip_q && !at_phase;
    if (clear_i) begin
      found_d    = 1'b0;
      phase_d    = 2'b00;
      skip_d     = 1'b0;
    end else if (!found_q && !ssi_i) begin
      found_d = hit_a || hit_b;
      // The phase of the bits is the point after the one that read 0. This point still lies in the
      // acknowledge, so it is skipped, unless it comes in this same clock.
      if (hit_a) begin
        phase_d = {!sample_half_i, 1'b1};
        skip_d  = !sample_i.b;
      end else if (hit_b) begin
        phase_d = {sample_half_i, 1'b0};
        skip_d  = 1'b1;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      found_q    <= 1'b0;
      phase_q    <= '0;
      skip_q     <= 1'b0;
      quarters_q <= '0;
    end else begin
      found_q    <= found_d;
      phase_q    <= phase_d;
      skip_q     <= skip_d;
      quarters_q <= clear_i ? '0 : quarters_d;
    end
  end

  assign sl_o        = pos;
  assign ack_o       = found_q;
  assign quarters_o  = 8'(quarters_q);
  assign late_o      = quarters_q == LONGEST;
  assign bit_valid_o = at_phase && !skip_q;
  assign bit_o       = phase_q[0] ? value_b : pos;

  `ENC_ASSERT_NEXT(AckIsKept_A, clk_i, rst_ni, found_q && !clear_i, found_q)

endmodule
