// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time base of all lines: half MA periods, and the sampling points, two in each half period.
//
// Clock domain: core, rising edge. restart_i takes last_i and tens_i for everything that follows
// and begins a half period in which MA is high. A half period has last_i + 1 steps. A step is one
// clock, with tens_i ten clocks. tick_o is high in the last clock of each half period; half_next_o
// is the level of MA in the next half period.
//
// The sampling points in sample_o are a (beginning of a half period) and b (middle of it). Both
// come two clocks late, to match SL after its synchroniser. If the half period is one clock, both
// come in the same clock. In an odd half period the middle is at a falling clock edge: b_neg.
//
// Misuse: tens_i = 1 without Tens stops tick_o. last_i and tens_i come from the host domain and are
// read only with restart_i, so the host may change them while slaves are still in their timeout.
// Datasheet: page 12 (I301..I303 and sampling points), page 30.

`include "enc_check.svh"

module biss_timebase #(
  parameter int unsigned LastW = 4,    // bits of last_i
  parameter bit          Tens  = 1'b1  // tens_i may be 1
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic [LastW-1:0] last_i,
  input  logic             tens_i,
  input  logic             run_i,
  input  logic             restart_i,
  output logic             tick_o,
  output logic             half_next_o,
  output biss_pkg::sample_t sample_o,
  output logic             sample_half_o  // MA level of the half period of the points
);

  localparam logic [3:0] MIDDLE = 4'd4;   // last clock before the middle of a long step
  localparam logic [3:0] END    = 4'd9;   // its last clock

  logic [LastW:0]   len_q;   // of this half period: tens_i, last_i
  logic             tens;
  logic [LastW-1:0] last;
  logic [3:0]       clock_d;
  logic [3:0]       clock_q; // clock of a long step, from 0
  logic [LastW-1:0] step_d;
  logic [LastW-1:0] step_q;  // step of the half period, from 0
  logic       last_d;
  logic       last_q;        // the last clock of a half period
  logic       half_d;
  logic       half_q;
  logic       tick;
  logic       middle;
  logic [1:0] a_q;
  logic [1:0] b_q;
  logic [1:0] h_q;

  // Much logic depends on tick in the same clock, so last_q is prepared one clock before.
  assign tick = run_i && last_q;
  assign {tens, last} = len_q;

  // restart_i comes late, so what follows without it is prepared.
  always_comb begin
    clock_d = clock_q;
    step_d  = step_q;
    if (run_i) begin
      clock_d = !Tens || clock_q == END ? 4'd0 : clock_q + 4'd1;
      if (tick)                         step_d = '0;
      else if (!tens || clock_q == END) step_d = step_q + LastW'(1);
    end
    half_d = half_q ^ tick;
    last_d = restart_i ? last_i == '0 && !tens_i
                       : step_d == last && (!tens || clock_d == END);
  end

  // The middle is the end of the first half of the clocks. With an odd number of short steps (last
  // is even) it lies half a clock after the end of the last whole clock before it: b_neg tells so.
  assign middle = run_i && (tens || last[0] ? step_q : step_d) == last >> 1 &&
                  (!tens || clock_q == (last[0] ? END : MIDDLE));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      len_q   <= '0;
      clock_q <= '0;
      step_q  <= '0;
      last_q  <= 1'b1;
      half_q  <= 1'b1;
      a_q     <= '0;
      b_q     <= '0;
      h_q     <= '0;
    end else begin
      if (restart_i) len_q <= {tens_i, last_i};
      clock_q <= restart_i ? 4'd0 : clock_d;
      step_q  <= restart_i ? '0 : step_d;
      last_q  <= last_d;
      half_q  <= restart_i || half_d;
      // A restart drops the sampling points that are still in the delay, and those of its clock.
      a_q     <= restart_i ? 2'b00 : {a_q[0], tick};
      b_q     <= restart_i ? 2'b00 : {b_q[0], middle};
      h_q     <= {h_q[0], half_d};
    end
  end

  assign tick_o        = tick;
  assign half_next_o   = !half_q;
  assign sample_o.a     = a_q[1];
  assign sample_o.b     = b_q[1];
  assign sample_o.b_neg = !last[0] && !tens;
  assign sample_half_o = h_q[1];

  `ENC_ASSERT_IF(CountInRange_A, clk_i, rst_ni, run_i, step_q <= last && clock_q <= END)
  `ENC_ASSERT(LastOfHalf_A, clk_i, rst_ni,
              last_q == (step_q == last && (!tens || clock_q == END)))

endmodule
