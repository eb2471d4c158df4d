// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// EOT is 0 exactly while a frame or INIT runs: from the clock after its start, until the third
// clock after its end, when all results have settled (datasheet page 34; decisions 1, 25).
//
// claim: EOT = 0 from the clock after the start to three clocks behind the end, and never else
// clocks: one
// depth: 10
// cover: 10
// unbounded: induction 5
// mutation: mb4/ctrl/mb4_status_flags.sv | (quiet_q == 2'b11) && !busy_i | quiet_q == 2'b11
// mutation: mb4/ctrl/mb4_sequencer.sv | assign busy        = state_d != IDLE
//   | assign busy        = (state_d != IDLE && state_d != INIT)
// mutation: mb4/ctrl/mb4_status_flags.sv | eot_q        <= 1'b1; | eot_q        <= 1'b0;

module proof (
  input logic clk_i, rst_ni,
  input logic [1:0] count_i,
  input mb4_pkg::instr_t written_i,
  input mb4_pkg::kind_t kind_i,
  input logic mem_busy_i, agsmin_i, infinite_i, regvers_i,
  input logic [1:0] idle_i, timeout_i, sl_i, word_ok_i,
  input logic [2*biss_pkg::LINE_EVENT_W-1:0] event_i,
  input logic request_i, missed_i, tick_i, bank_pending_i,
  input logic control_active_i, control_end_i, control_stalled_i, stale_i
);

  logic busy, running, start, frame_end, eot;
  mb4_pkg::instr_t held;
  biss_pkg::line_go_t    go;
  mb4_pkg::bank_cmd_t    bank;
  mb4_pkg::frame_flags_t flags;
  assign start     = go.start;
  assign frame_end = bank.frame_end;
  assign busy      = flags.busy;

  mb4_sequencer u_sequencer (
    .clk_i, .rst_ni, .written_i, .count_i, .mem_busy_i, .agsmin_i, .infinite_i, .regvers_i,
    .kind_i, .agserr_on_hold_i(1'b1), .agserr_on_write_i(1'b0), .ags_clear_i(1'b0),
    .request_i, .missed_i, .tick_i, .idle_i, .timeout_i, .sl_i, .event_i, .word_ok_i,
    .bank_pending_i, .control_active_i, .control_end_i, .control_stalled_i, .stale_i,
    .running_o(running),
    .go_o(go), .bank_o(bank), .held_o(held), .flags_o(flags)
  );

  mb4_status_flags u_flags (
    .clk_i, .rst_ni, .busy_i(busy), .clear_i(1'b0), .scd_en_i(1'b0), .scd_bad_i(1'b0),
    .ags_error_i(1'b0), .bank_fail_i(1'b0), .bank_swapped_i(1'b0), .reg_begin_i(1'b0),
    .reg_end_i(1'b0), .reg_error_i(1'b0), .delay_error_i(1'b0), .eot_o(eot)
  );

  logic started = 1'b0;
  logic start_q, live_q, asked;
  logic [2:0] quiet_q;       // clocks without frame, INIT or a request for one
  always @(posedge clk_i) begin
    started <= 1'b1;
    live_q  <= rst_ni;
    start_q <= start && rst_ni;
  end
  always @* if (!started) assume (!rst_ni);

  // What the host has asked for and what is not done yet makes EOT 0 as well.
  assign asked = busy && !running && !start;

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                        quiet_q <= 3'd4;
    else if (running || start || asked) quiet_q <= 3'd0;
    else if (quiet_q != 3'd4)           quiet_q <= quiet_q + 3'd1;
  end

  logic busy_q, running_q;
  logic [1:0] idle_clocks_q;
  always @(posedge clk_i) {busy_q, running_q} <= {busy && rst_ni, running && rst_ni};
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                     idle_clocks_q <= 2'd3;
    else if (busy)                   idle_clocks_q <= 2'd0;
    else if (idle_clocks_q != 2'd3)  idle_clocks_q <= idle_clocks_q + 2'd1;
  end

  always @* if (started) begin
    if (running) LowWhileRunning_A: assert (!eot);
    if (start_q && live_q && rst_ni) LowBehindStart_A: assert (!eot);
    HighElse_A: assert (eot == (idle_clocks_q == 2'd3));
    if (rst_ni && quiet_q == 3'd4) HighAtRest_A: assert (eot);
    if (running || start) StartIsBusy_A: assert (!rst_ni || busy || frame_end || !start);
    if (running) RunningWasBusy_A: assert (!rst_ni || busy_q);
  end
  always @(posedge clk_i) begin
    Frame_C: cover (running && held.instr == 3'd2);
    Over_C: cover (rst_ni && eot && quiet_q == 3'd3);
  end

endmodule
