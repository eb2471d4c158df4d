// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MA of either line never shows a pulse, high or low, shorter than half a period of MA, whatever
// frames, BREAK, resets, register access and force bits do, whatever the lines answer, and whenever
// the host changes FREQS, the protocol or the use of a line (datasheet page 12: I301..I303;
// decision 40). A low level lasts half a period of the FREQS with which it began; a high one of
// that with which it ends. Both lines as in the chip; presets with one line have ONE_LINE defined, MA of
// the other one is 1.
//
// claim: every level of MA on two lines lasts half a period at least, whatever happens
// clocks: one
// depth: 8
// cover: 12
// unbounded: induction 2
// checks: those of the bench alone
// look: dut_len = u_lines.u_timebase.len_q
// look: dut_step = u_lines.u_timebase.step_q
// look: dut_clock = u_lines.u_timebase.clock_q
// look: dut_last = u_lines.u_timebase.last_q
// look: dut_state1 = u_lines.gen_line[0].u_line.u_frame.state_q
// look: dut_state2 = u_lines.gen_line[1].u_line.u_frame.state_q
// look: dut_clock1 = u_lines.gen_line[0].u_line.u_frame.u_ma.clocking_q
// look: dut_clock2 = u_lines.gen_line[1].u_line.u_frame.u_ma.clocking_q
// mutation: biss/biss_ma_drive.sv | end else if (stop_i) begin
//   | end else if (stop_i) begin ma_d = 1'b1;
// mutation: biss/biss_ma_drive.sv | if (force_q) ma_d = (tick_i && !start_i) ? level_q : ma_q;
//   | if (force_q) ma_d = level_q;
// mutation: biss/biss_ma_drive.sv | if (force_q) ma_d = (tick_i && !start_i) ? level_q : ma_q;
//   | if (force_q) ma_d = tick_i ? level_q : ma_q;
// mutation: biss/biss_ma_drive.sv | (!force_i || (tick_i && ma_q && !level_q)); | !force_i;
// mutation: biss/biss_frame.sv | if (tick_i && sl_high && !ma_clocks) state_d = IDLE;
//   | if (sl_high) state_d = IDLE;
// mutation: biss/biss_frame.sv | if (tick_i) state_d = IDLE; | state_d = IDLE;
// mutation: biss/biss_timebase.sv | if (restart_i) len_q <= {tens_i, last_i}; | len_q <= {tens_i, last_i};

module proof (
  input logic clk_i, rst_ni, por_ni,
  input mb4_pkg::cfg_t cfg_i,
  input logic [7:0] enscd_i,
  input logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_i,
  input logic [1:0] sl_i,
  input logic [2*biss_pkg::LINE_CMD_W-1:0] cmd_i,
  input biss_pkg::line_go_t go_i,
  input logic [2*biss_pkg::LINE_START_W-1:0] start_i,
  input biss_pkg::register_ma_t register_ma_i,
  input logic time_run_i, time_restart_i,
  input logic [15:0] mo_data_i
);

  logic [1:0] idle, ma, forced_q;
  biss_pkg::line_status_t status1, status2;
  assign idle = {status2.idle, status1.idle};
  biss_pkg::line_cmd_t cmd1, cmd2;
  assign {cmd2, cmd1} = cmd_i;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) forced_q <= 2'b00;
    else         forced_q <= {cmd2.forced, cmd1.forced};
  end

  mb4_lines u_lines (
    .clk_i, .rst_ni, .por_ni, .cfg_i, .enscd_i, .slave_cfg_i, .cmd_i, .go_i, .start_i,
    .register_ma_i, .time_run_i, .time_restart_i, .mo_data_i, .sl_i,
    .status_o({status2, status1}), .ma_o(ma)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* begin
    if (!started) assume (!rst_ni && !por_ni);
    if (started)  assume (por_ni);
    // Which lines a start is for, and whether they are in use, is free.
    if (go_i.start) assume (idle == 2'b11 && !go_i.stop);  // proof sequencer
    // mb4_control: a forced level counts half periods. The lines take it one clock late.
    if (forced_q != 2'b00) assume (time_run_i && !time_restart_i);
  end

  wire [4:0] dut_len;    // half period: tens_i, last_i
  wire [3:0] dut_step, dut_clock;
  wire       dut_last, dut_clock1, dut_clock2;
  wire [2:0] dut_state1, dut_state2;
`ifdef ONE_LINE
  localparam logic One = 1'b1;
  assign {dut_state2, dut_clock2} = 4'd0;
  always @* if (started) Other_A: assert (ma[1]);
`else
  localparam logic One = 1'b0;
`endif

  logic [7:0] len, cnt;   // clocks of the half period; those before this one
  assign len = (dut_len[4] ? 8'd10 : 8'd1) * (8'(dut_len[3:0]) + 8'd1);
  assign cnt = dut_len[4] ? 8'd10 * 8'(dut_step) + 8'(dut_clock) : 8'(dut_step);

  logic [7:0] len_q;
  logic       live_q;
  always @(posedge clk_i or negedge por_ni) begin
    if (!por_ni) {len_q, live_q} <= {8'd1, 1'b0};
    else         {len_q, live_q} <= {len, 1'b1};
  end

  always @* if (started && live_q) begin
    Count_A: assert (dut_step <= dut_len[3:0] && dut_clock <= 4'd9);
    Last_A:  assert (dut_last == (cnt == len - 8'd1));
  end

  logic [1:0] rise;
  line_proof #(.Covers(1'b1), .One(One)) u_line1 (
    .clk_i, .por_ni, .live_i(started && live_q), .reset_i(!rst_ni), .len_i(len),
    .len_q_i(len_q), .cnt_i(cnt), .ma_i(ma[0]), .idle_i(idle[0]), .force_i(forced_q[0]),
    .state_i(dut_state1), .clocking_i(dut_clock1), .other_i(dut_state2),
    .other_rise_i(rise[1]), .rise_o(rise[0])
  );
  line_proof u_line2 (
    .clk_i, .por_ni, .live_i(started && live_q), .reset_i(!rst_ni), .len_i(len),
    .len_q_i(len_q), .cnt_i(cnt), .ma_i(ma[1]), .idle_i(idle[1]), .force_i(forced_q[1]),
    .state_i(dut_state2), .clocking_i(dut_clock2), .other_i(dut_state1),
    .other_rise_i(rise[0]), .rise_o(rise[1])
  );

endmodule

// One line: what has to hold, and what the induction needs.
module line_proof #(
  parameter logic Covers = 1'b0,  // the cover points, once for both lines
  parameter logic One = 1'b0      // there is no other line
) (
  input logic       clk_i, por_ni, live_i, reset_i,
  input logic [7:0] len_i, len_q_i, cnt_i,   // half period, now and a clock before; clocks of it
  input logic       ma_i, idle_i, force_i, clocking_i,
  input logic [2:0] state_i, other_i,        // of the frame, and of that on the other line
  input logic       other_rise_i,            // MA of the other line rises
  output logic      rise_o
);

  localparam logic [2:0] IDLE = 3'd0, REQUEST = 3'd1, RELEASE = 3'd6;

  logic [7:0] age, age_q;   // clocks that MA has had its level, the current one included
  logic [7:0] low, low_q;   // half period with which the last low level began
  logic       ma_q;
  logic       rise, fall;
  assign rise = ma_i && !ma_q;
  assign rise_o = rise;
  assign fall = !ma_i && ma_q;
  assign age = rise || fall ? 8'd1 : age_q == 8'hFF ? 8'hFF : age_q + 8'd1;
  assign low = fall ? len_i : low_q;
  always @(posedge clk_i or negedge por_ni) begin
    if (!por_ni) {age_q, low_q, ma_q} <= {8'hFF, 8'd1, 1'b1};
    else         {age_q, low_q, ma_q} <= {age, low, ma_i};
  end

  always @* if (live_i) begin
    if (rise) LowLasts_A: assert (age_q >= low_q);
    if (fall) HighLasts_A: assert (age_q >= len_q_i && age_q >= len_i);
    // For the induction: a high level is older than the running half period. A low one has lasted,
    // or is older than the running half period, which is its own, and keeps the line busy.
    if (ma_i)  High_A: assert (age > cnt_i || age == 8'hFF);
    if (!ma_i) Low_A:  assert (age >= low || (age > cnt_i && low == len_i && !idle_i));
    Range_A: assert (low <= 8'd160);
    if (state_i == IDLE || state_i >= RELEASE) RestIsNoClock_A: assert (!clocking_i);
  end

  if (Covers) begin : gen_covers
    always @(posedge clk_i) if (live_i && !reset_i) begin
      // Both lines at once.
      Clock_C:  cover (rise && (other_rise_i || One) && len_i == 8'd2 && state_i == REQUEST &&
                       (other_i == REQUEST || One) && clocking_i);
      Broken_C: cover (rise && (other_rise_i || One) && len_i == 8'd2 && state_i == IDLE &&
                       other_i == IDLE && !force_i);
      // The other line has just started with a shorter half period: this one had ended before.
      Other_C:  cover ((rise && low_q == 8'd2 && len_i == 8'd1 && other_i == REQUEST) || One);
      Forced_C: cover (fall && force_i && (other_i == REQUEST || One));
    end
  end

endmodule
