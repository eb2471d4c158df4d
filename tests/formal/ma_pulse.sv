// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MA of a line never shows a pulse, high or low, shorter than half a period of MA, whatever frames,
// BREAK, resets, register access and force bits do and whatever the line answers (datasheet page
// 12: I301..I303). Frame engine and time base as in mb4_lines.
//
// claim: every level of MA lasts half a period at least, whatever happens
// clocks: one
// depth: 14
// cover: 14
// unbounded: induction 2
// checks: those of the bench alone
// look: dut_len = u_timebase.len_q
// look: dut_cnt = u_timebase.cnt_q
// look: dut_last = u_timebase.last_q
// look: dut_state = u_frame.state_q
// look: dut_force = u_frame.u_ma.force_q
// look: dut_clocking = u_frame.u_ma.clocking_q
// mutation: line/mb4_ma_drive.sv | end else if (stop_i) begin
//   | end else if (stop_i) begin ma_d = 1'b1;
// mutation: line/mb4_ma_drive.sv | if (force_i) ma_d = tick_i ? force_level_i : ma_q;
//   | if (force_i) ma_d = force_level_i;
// mutation: line/mb4_frame.sv | if (tick_i && sl_i && !ma_clocks) state_d = IDLE;
//   | if (sl_i) state_d = IDLE;

module proof (
  input logic clk_i, rst_ni, por_ni,
  input logic [1:0] protocol_i,
  input logic bus_i, start_i, use_i, init_i, cdm0_i, cdm1_i, reduced_i, hold_cdm_i, abort_i,
  input logic register_i, register_ma_i, register_end_i, force_i, force_level_i, force_change_i,
  input logic other_busy_i, ack_i, sl_i, bit_valid_i, bit_i, len_valid_i, any_word_i, last_word_i,
  input logic word_done_i,
  input logic [7:0] mo_busy_i, quarters_i,
  input logic [6:0] len_i
);

  (* anyconst *) logic [7:0] half_len;
  logic tick, half_next, idle, ma, restart;

  mb4_timebase u_timebase (
    .clk_i, .rst_ni(por_ni), .half_len_i(half_len),
    .run_i(!idle || other_busy_i || force_i), .restart_i(restart), .tick_o(tick),
    .half_next_o(half_next)
  );
  mb4_frame u_frame (
    .clk_i, .rst_ni, .por_ni, .protocol_i, .bus_i, .mo_busy_i, .start_i, .use_i, .init_i, .cdm0_i,
    .cdm1_i, .reduced_i, .hold_cdm_i, .abort_i, .register_i, .register_ma_i, .register_end_i,
    .force_i, .force_level_i, .tick_i(tick), .half_next_i(half_next), .ack_i, .quarters_i, .sl_i,
    .bit_valid_i, .bit_i, .len_valid_i, .len_i, .any_word_i, .last_word_i, .word_done_i,
    .idle_o(idle), .ma_o(ma)
  );

  assign restart = start_i || force_change_i;

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* begin
    if (!started) assume (!rst_ni && !por_ni);
    if (started)  assume (por_ni);
    assume (half_len != 8'd0 && half_len <= 8'd160);
    // What mb4_sequencer and mb4_lines see to.
    if (start_i) assume (idle && !abort_i);   // proof sequencer
    if (force_change_i) assume (idle && !force_i);
  end

  // Clocks that MA has had its level, the current one included.
  logic [7:0] age_q;
  logic       ma_q, live_q;
  logic [7:0] age;
  assign age = ma != ma_q ? 8'd1 : age_q == 8'hFF ? 8'hFF : age_q + 8'd1;
  always @(posedge clk_i or negedge por_ni) begin
    if (!por_ni) {age_q, ma_q, live_q} <= {8'hFF, 1'b1, 1'b0};
    else         {age_q, ma_q, live_q} <= {age, ma, 1'b1};
  end

  wire [7:0] dut_len, dut_cnt;
  wire [2:0] dut_state;
  wire       dut_last, dut_force, dut_clocking;
  logic [7:0] len_q;
  always @(posedge clk_i) len_q <= dut_len;

  always @* if (started && live_q) begin
    if (ma != ma_q) LongEnough_A: assert (age_q >= len_q);
    // For the induction: MA is never younger than the running half, and at rest only a level
    // that has lasted may be left.
    Younger_A: assert (age > dut_cnt || age == 8'hFF);
    Count_A: assert (dut_cnt < dut_len && dut_len <= 8'd160 && dut_len != 8'd0);
    Last_A: assert (dut_last == (dut_cnt == dut_len - 8'd1));
    if (dut_state == 3'd0 || dut_state >= 3'd6) RestIsNoClock_A: assert (!dut_clocking);
    if (dut_state == 3'd0 && !ma && !dut_force) Rest_A: assert (age > dut_len);
    Length_A: assert (dut_len == half_len || dut_len == 8'd1);
    // 1 until the first frame or force.
    if (dut_state != 3'd6 && (dut_state != 3'd0 || (!ma && !dut_force)))
      Taken_A: assert (dut_len == half_len);
  end
  always @(posedge clk_i) begin
    Clock_C: cover (rst_ni && ma && !ma_q && half_len == 8'd2 && dut_state == 3'd1 && dut_clocking);
    Broken_C: cover (rst_ni && ma && !ma_q && dut_state == 3'd0 && half_len == 8'd2 && !dut_force);
  end

endmodule
