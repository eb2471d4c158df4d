// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// EOT is 0 exactly while a frame or INIT runs: from the clock after its start, until the third
// clock after its end, when all results have settled (datasheet page 34; decisions 1, 25).
//
// claim: EOT = 0 from the clock after the start to three clocks after the end, and at no other time
// clocks: one
// depth: 10
// cover: 10
// unbounded: reachability
// mutation: mb4/ctrl/mb4_status_flags.sv | (quiet_q == 2'b11) && !frame_i.busy | quiet_q == 2'b11
// mutation: mb4/ctrl/mb4_sequencer.sv | assign flags_o.busy      = runs ||
//   | assign flags_o.busy      = (runs && state_d == INIT) ||
// mutation: mb4/ctrl/mb4_status_flags.sv | eot_q        <= 1'b1; | eot_q        <= 1'b0;

module proof (
  input logic clk_i, rst_ni,
  input logic [1:0] count_i,
  input mb4_pkg::instr_t written_i,
  input mb4_pkg::kind_t kind_i,
  input mb4_pkg::request_t request_i,
  input mb4_pkg::mem_state_t mem_i,
  input logic regvers_i,
  input logic [1:0] word_bad_i,
  input logic [2*biss_pkg::LINE_STATUS_W-1:0] status_i,
  input logic [2*biss_pkg::LINE_EVENT_W-1:0] event_i,
  input logic missed_i, tick_i,
  input logic control_active_i, control_end_i, control_stalled_i, stale_i
);

  logic busy, running, start, frame_end, eot;
  mb4_pkg::instr_core_t answer;
  mb4_pkg::instr_t held;
  mb4_pkg::flags_t shown;
  biss_pkg::line_go_t    go;
  mb4_pkg::bank_cmd_t    bank;
  mb4_pkg::frame_flags_t flags;
  assign start     = go.start;
  assign frame_end = bank.frame_end;
  assign busy      = flags.busy;
  assign held      = answer.held;
  assign eot       = shown.eot;

  mb4_sequencer u_sequencer (
    .clk_i, .rst_ni, .instr_i({count_i, written_i}), .instr_o(answer), .regvers_i, .kind_i,
    .quirks_i(6'd1 << mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK), .request_i, .missed_i, .tick_i,
    .status_i, .event_i, .word_bad_i, .mem_i,
    .control_active_i, .control_start_i(control_active_i), .control_end_i, .control_stalled_i,
    .stale_i,
    .running_o(running), .go_o(go), .bank_o(bank), .flags_o(flags)
  );

  mb4_status_flags u_flags (
    .clk_i, .rst_ni, .frame_i({busy, 5'd0}), .bank_i('0), .access_i('0), .access_state_i('0),
    .flags_o(shown)
  );

  biss_pkg::line_status_t status1, status2;
  assign {status2, status1} = status_i;

  // mb4_frame_request: with idle lines each request is due, and what is due is a request.
  always @* begin
    assume (request_i.asks || !request_i.due);
    if (status1.idle && status2.idle) assume (request_i.due == request_i.asks);
  end

  logic started = 1'b0;
  logic start_q, live_q, asked;
  logic [2:0] quiet_q;       // clocks without frame, INIT or a request for one
  always @(posedge clk_i) begin
    started <= 1'b1;
    live_q  <= rst_ni;
    start_q <= start && rst_ni;
  end
  always @* if (!started) assume (!rst_ni);

  // A request of the host that is not done yet makes EOT 0 as well.
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
