// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The time base: every FREQS code gives the half period of datasheet page 30, Table 35, MA is high
// for one half and low for the other, and the sampling points lie at the beginning and the middle
// of each half (page 12).
//
// claim: half periods of Table 35, duty 50 %, sampling points at beginning and middle
// clocks: one
// depth: 15
// cover: 15
// unbounded: induction 3
// look: dut_len = u_dut.len_q
// look: dut_step = u_dut.step_q
// look: dut_clock = u_dut.clock_q
// look: dut_half = u_dut.half_q
// mutation: biss/biss_timebase.sv | : step_d == last && | : step_q == last &&
// mutation: biss/biss_timebase.sv | END    = 4'd9; | END    = 4'd8;
// mutation: biss/biss_timebase.sv | (last[0] ? END : MIDDLE) | END
// mutation: biss/biss_timebase.sv | (tens || last[0] ? step_q : step_d) | step_q
// mutation: biss/biss_timebase.sv | half_d = half_q ^ tick; | half_d = half_q ^ last_q;

module proof (
  input logic       clk_i,
  input logic       rst_ni,
  input logic [4:0] freqs_i,
  input logic       run_i,
  input logic       restart_i
);

  logic       tick, half_next, smp_a, smp_b, smp_half, smp_b_neg;
  biss_pkg::sample_t sample;
  assign {smp_a, smp_b, smp_b_neg} = sample;

  biss_timebase u_dut (
    .clk_i,
    .rst_ni,
    .last_i      (freqs_i[3:0]),
    .tens_i      (freqs_i[4]),
    .run_i,
    .restart_i,
    .tick_o      (tick),
    .half_next_o (half_next),
    .sample_o    (sample),
    .sample_half_o (smp_half)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  // f_MA = f_CLK / (2 (FREQS + 1)) up to 0x0F, f_CLK / (20 (FREQS - 15)) from 0x11 on.
  logic [8:0] table_len;
  assign table_len = freqs_i < 5'h10 ? 9'(freqs_i) + 9'd1 : 9'd10 * (9'(freqs_i) - 9'd15);

  // Clocks of one whole MA period, from the rising edge on.
  logic [8:0] len_q, at_q;
  logic       tick_exp, middle_exp;
  logic [1:0] a_q, b_q, h_q;

  assign tick_exp   = run_i && (at_q == len_q - 9'd1 || at_q == 2 * len_q - 9'd1);
  assign middle_exp = len_q == 9'd1 ? tick_exp
                    : run_i && (at_q == len_q / 2 - 9'd1 || at_q == len_q + len_q / 2 - 9'd1);

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {len_q, at_q, a_q, b_q, h_q} <= {9'd1, 9'd0, 6'd0};
    end else begin
      if (restart_i)  {len_q, at_q} <= {table_len, 9'd0};
      else if (run_i) at_q <= at_q == 2 * len_q - 9'd1 ? 9'd0 : at_q + 9'd1;
      a_q <= restart_i ? 2'b00 : {a_q[0], tick_exp};
      b_q <= restart_i ? 2'b00 : {b_q[0], middle_exp};
      // Level of the half that a point belongs to: begins with a tick, goes on over a middle.
      h_q <= {h_q[0], restart_i || ((at_q < len_q) ^ tick_exp)};
    end
  end

  always @(posedge clk_i) if (rst_ni) begin
    Tick_A: assert (tick == tick_exp);
    if (tick) Duty_A: assert (half_next == (at_q >= len_q));
    PointA_A: assert (smp_a == a_q[1]);
    PointB_A: assert (smp_b == b_q[1]);
    if (smp_a || smp_b) PointLevel_A: assert (smp_half == h_q[1]);
    OddMiddle_A: assert (smp_b_neg == len_q[0]);
    Fall_C: cover (tick && len_q == 9'd5 && !half_next);
    Rise_C: cover (tick && len_q == 9'd5 && half_next);
  end

  wire [4:0] dut_len;
  wire [3:0] dut_step, dut_clock;
  wire       dut_half;

  // A half period of up to 16 steps of ten clocks, or of one.
  always @* if (started) begin
    SameLength_A: assert (len_q == (dut_len[4] ? 9'd10 : 9'd1) * (9'(dut_len[3:0]) + 9'd1));
    SameHalf_A: assert (dut_half == (at_q < len_q) && at_q < 2 * len_q);
    SameCount_A: assert ((at_q < len_q ? at_q : at_q - len_q) ==
                         (dut_len[4] ? 9'd10 * 9'(dut_step) + 9'(dut_clock) : 9'(dut_step)));
    StepOfTen_A: assert (dut_clock <= 4'd9);
  end

endmodule
