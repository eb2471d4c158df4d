// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MA of biss_pru (pru_frame), at both clocks: no level is shorter than half a period, whatever SL, the
// lengths, CDM and the limit of the processing time do, and whenever RUN falls. The core begins a frame
// only while MA rests, and changes the frequency only then. A low level lasts half a period of the
// frequency with which it began; a high one half a period of that with which it ends.
//
// claim: every level of MA lasts half a period at least, whatever the line and the host do
// clocks: one
// depth: 12
// cover: 12
// unbounded: induction 2
// checks: those of the bench alone
// look: left80 = u_80.u_frame.u_timebase.left_q
// look: number80 = u_80.u_frame.u_timebase.number_q
// look: clocking80 = u_80.u_frame.u_ma.clocking_q
// look: kill80 = u_80.u_frame.kill_q
// look: lasts80 = u_80.u_frame.lasts_q
// look: left200 = u_200.u_frame.u_timebase.left_q
// look: number200 = u_200.u_frame.u_timebase.number_q
// look: clocking200 = u_200.u_frame.u_ma.clocking_q
// look: kill200 = u_200.u_frame.kill_q
// look: lasts200 = u_200.u_frame.lasts_q
// mutation: pru/pru_frame.sv | (kill_q || lasts_q) | kill_q
// mutation: biss/biss_ma_drive.sv | end else if (stop_i) begin
//   | end else if (stop_i) begin ma_d = 1'b1;
// mutation: pru/pru_timebase.sv | gap_last + 5'(odd_gap && !number_q[0]) | gap_last + 5'(odd_gap && number_q[0])
// mutation: pru/pru_timebase.sv | number_q[1:0] == 2'd3 | number_q[0] == 1'd1
// mutation: pru/pru_timebase.sv | end else if (restart_i) begin | end else if (restart_i && run_i) begin
// mutation: pru/pru_timebase.sv | pru_pkg::MHZ_2:  gap_last = 5'd4; | pru_pkg::MHZ_2:  gap_last = 5'd3;

module proof (
  input logic             clk_i, rst_ni,
  input pru_pkg::quirks_t quirks_i,
  input pru_pkg::plan_t   plan_i,
  input logic [9:0]       proc_max_i,
  input logic [1:0]       start_i,
  input logic             stop_i, forget_i, update_i, sl_i
);

  wire [4:0] left80, left200;
  wire [2:0] number80, number200;
  wire       clocking80, clocking200, kill80, kill200, lasts80, lasts200;

  frame_proof #(.ClockHz(80_000_000), .Covers(1'b1)) u_80 (
    .clk_i, .rst_ni, .quirks_i, .plan_i, .proc_max_i, .start_i (start_i[0]), .stop_i, .forget_i, .update_i, .sl_i,
    .left_i (left80), .number_i (number80), .busy_i (clocking80 || kill80 || lasts80)
  );
  frame_proof #(.ClockHz(200_000_000)) u_200 (
    .clk_i, .rst_ni, .quirks_i, .plan_i, .proc_max_i, .start_i (start_i[1]), .stop_i, .forget_i, .update_i, .sl_i,
    .left_i (left200), .number_i (number200), .busy_i (clocking200 || kill200 || lasts200)
  );

endmodule

// A frame at one clock: what has to hold, and what the induction needs.
module frame_proof #(
  parameter int unsigned ClockHz = 80_000_000,
  parameter bit          Covers  = 1'b0
) (
  input logic             clk_i, rst_ni,
  input pru_pkg::quirks_t quirks_i,
  input pru_pkg::plan_t   plan_i,
  input logic [9:0]       proc_max_i,
  input logic             start_i, stop_i, forget_i, update_i, sl_i,
  input logic [4:0]       left_i,     // clocks before the next sample
  input logic [2:0]       number_i,   // of this sample
  input logic             busy_i      // MA goes on
);

  localparam bit FAST = ClockHz == 200_000_000;

  logic ma, rests;
  pru_frame #(.ClockHz(ClockHz)) u_frame (
    .clk_i, .rst_ni, .quirks_i, .plan_i, .proc_max_i, .start_i, .stop_i, .forget_i, .update_i, .over_o (),
    .rests_o (rests), .latch_o (), .sl_o (), .averages_o (), .found_o (), .ma_o (ma), .sl_i
  );

  // Clocks of half a period, of a short gap between samples, and whether each second gap is longer.
  logic [6:0] half;
  logic [4:0] gap;
  logic       longer;
  always @* begin
    case (plan_i.mhz)
      pru_pkg::MHZ_1: {half, gap, longer} = FAST ? {7'd100, 5'd25, 1'b0} : {7'd40, 5'd10, 1'b0};
      pru_pkg::MHZ_2: {half, gap, longer} = FAST ? {7'd50, 5'd12, 1'b1} : {7'd20, 5'd5, 1'b0};
      pru_pkg::MHZ_5: {half, gap, longer} = FAST ? {7'd20, 5'd5, 1'b0} : {7'd8, 5'd2, 1'b0};
      default:        {half, gap, longer} = FAST ? {7'd10, 5'd2, 1'b1} : {7'd4, 5'd1, 1'b0};
    endcase
  end

  logic       started = 1'b0;
  logic       holds_q;      // a frame runs or begins
  logic [1:0] mhz_q;
  always @(posedge clk_i) begin
    started <= 1'b1;
    holds_q <= !rests || start_i;
    mhz_q   <= plan_i.mhz;
  end
  always @* begin
    assume (rst_ni == started);
    if (start_i) assume (rests && !stop_i);
    if (started && holds_q) assume (plan_i.mhz == mhz_q);
  end

  logic [6:0] age, age_q;   // clocks that MA has had its level, this one included, up to 127
  logic [6:0] low, low_q;   // half period with which the last low level began
  logic       ma_q;
  logic       rise, fall;
  assign rise = ma && !ma_q;
  assign fall = !ma && ma_q;
  assign age  = rise || fall ? 7'd1 : age_q == 7'd127 ? 7'd127 : age_q + 7'd1;
  assign low  = fall ? half : low_q;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {age_q, low_q, ma_q} <= {7'd127, 7'd1, 1'b1};
    else         {age_q, low_q, ma_q} <= {age, low, ma};
  end

  // Clocks before the end of the half period that runs, and whether it is a whole one.
  logic [7:0] rest;
  logic       whole;
  always @* begin
    case (number_i[1:0])
      2'd0:    rest = 8'(left_i) + 8'd3 * 8'(gap) + {6'd0, longer, 1'b0};
      2'd1:    rest = 8'(left_i) + 8'd2 * 8'(gap) + 8'(longer);
      2'd2:    rest = 8'(left_i) + 8'(gap) + 8'(longer);
      default: rest = 8'(left_i);
    endcase
    whole = 8'(age) + rest >= 8'(half) && left_i < gap + 5'(longer && number_i[0]);
  end

  always @* if (started && rst_ni) begin
    if (rise) LowLasts_A: assert (age_q >= low_q);
    if (fall) HighLasts_A: assert (age_q >= half);
    // For the induction.
    if (ma && !rests) High_A: assert (whole);
    if (!ma)          Low_A:  assert (age >= low || (whole && low == half && busy_i && !rests));
    Range_A: assert (low <= 7'd100);
  end

  if (Covers) begin : gen_covers
    always @(posedge clk_i) if (started && rst_ni) begin
      Rise_C: cover (rise && half == 7'd4);
      Stop_C: cover (rise && busy_i && rests);
      Fall_C: cover (fall && half == 7'd4);
      Next_C: cover (rise && start_i);
    end
  end

endmodule
