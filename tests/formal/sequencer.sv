// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sequencer has no dead state. From each state, also from those that it never reaches, BREAK
// leads to idle within three clocks of the host's write, and a reset leads to idle at once. INIT
// gives up waiting. The state is arbitrary at first: what holds here needs no history.
//
// claim: BREAK ends in idle within 3 clocks from any state, reachable or not; reset at once
// clocks: one
// depth: 8
// cover: 9
// unbounded: induction 5
// checks: those of the bench alone, because a check that a state breaks would leave this state out of
//   what holds from any state; the block's own are in eot
// keep: mb4/ctrl/mb4_sequencer.sv | cut_q      <= 1'b1; | cut_q      <= 1'b0;
// look: dut_state = u_dut.state_q
// look: dut_wait = u_dut.wait_q
// look: dut_sync0 = u_dut.u_written.gen_bit[0].u_sync.sync_q
// look: dut_sync1 = u_dut.u_written.gen_bit[1].u_sync.sync_q
// look: dut_taken = u_dut.u_written.taken_q
// look: dut_late = u_dut.u_written.late_q
// look: dut_ack = u_dut.u_written.ack_q
// mutation: mb4/ctrl/mb4_sequencer.sv | if (asked.brk) begin
//   | if (asked.brk && state_q != INIT_TIMEOUT) begin
// mutation: mb4/ctrl/mb4_sequencer.sv | (use_q & ~idle) == 2'b00 || waited;
//   | (use_q & ~idle) == 2'b00;
// mutation: mb4/ctrl/mb4_sequencer.sv | default: state_d = IDLE; | default: state_d = state_q;

module proof (
  input logic clk_i, rst_ni,
  input logic [1:0] count_i,
  input logic check_i,   // free: at which clocks the checks look
  input mb4_pkg::instr_t written_i,
  input mb4_pkg::kind_t kind_i,
  input mb4_pkg::request_t request_i,
  input mb4_pkg::mem_state_t mem_i,
  input logic regvers_i,
  input logic [1:0] word_bad_i,
  input logic [2*biss_pkg::LINE_STATUS_W-1:0] status_i,
  input logic [2*biss_pkg::LINE_EVENT_W-1:0] event_i,
  input logic [mb4_pkg::QUIRKS_W-1:0] quirks_i,
  input logic missed_i, tick_i,
  input logic control_active_i, control_end_i, control_stalled_i, stale_i
);

  logic running, start, abort, ags_error;
  biss_pkg::line_go_t    go;
  mb4_pkg::frame_flags_t flags;
  assign start     = go.start;
  assign abort     = go.stop;
  assign ags_error = flags.ags_error;

  biss_pkg::line_status_t status1, status2;
  assign {status2, status1} = status_i;

  mb4_sequencer u_dut (
    .clk_i, .rst_ni, .instr_i({count_i, written_i}), .regvers_i, .kind_i, .quirks_i,
    .request_i, .missed_i, .tick_i, .status_i, .event_i, .word_bad_i, .mem_i,
    .control_active_i, .control_start_i(control_active_i), .control_end_i, .control_stalled_i,
    .stale_i,
    .running_o(running), .go_o(go), .flags_o(flags)
  );

  // mb4_frame_request: with idle lines each request is due, and what is due is a request.
  always @* begin
    assume (request_i.asks || !request_i.due);
    if (status1.idle && status2.idle) assume (request_i.due == request_i.asks);
  end

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;

  // The host's side: a Gray count that steps once with each byte, held for five clocks at least.
  logic [2:0] age_q = 3'd7;   // clocks since the step
  logic [1:0] count_q = 2'd0;
  logic [1:0] before;         // the count before the last step
  mb4_pkg::instr_t byte_q;
  assign before = {!count_q[0], count_q[1]};
  always @(posedge clk_i) begin
    age_q   <= count_i != count_q ? 3'd1 : age_q == 3'd7 ? 3'd7 : age_q + 3'd1;
    count_q <= count_i;
    byte_q  <= written_i;
    if (!rst_ni) age_q <= 3'd7;
  end
  always @* begin
    if (!started) assume (!rst_ni);
    if (!rst_ni) assume (count_i == 2'd0);
    else begin
      assume (count_i == count_q || count_i == {count_q[0], !count_q[1]});
      if (age_q < 3'd5) assume (count_i == count_q && written_i == byte_q);
    end
  end

  wire [2:0] dut_state;
  wire [11:0] dut_wait;
  wire [1:0] dut_sync0, dut_sync1, dut_taken, dut_late, dut_ack;

  // The count on its way, for the induction.
  always @* if (started && rst_ni) begin
    Way1_A: assert ({dut_sync1[0], dut_sync0[0]} == count_q);
    Way2_A: assert ({dut_sync1[1], dut_sync0[1]} == (age_q == 3'd1 ? before : count_q));
    Way3_A: assert (dut_taken == (age_q <= 3'd2 ? before : count_q));
    Way4_A: assert (dut_late == (age_q <= 3'd3 ? before : count_q));
    Way5_A: assert (dut_ack == (age_q <= 3'd4 ? before : count_q));
    Counted_A: assert (age_q != 3'd0);
  end

  logic [2:0]  state_q;
  logic        live_q, abort_q;
  logic        gave_up_q;  // INIT has waited for SL long enough
  always @(posedge clk_i) begin
    state_q  <= dut_state;
    live_q   <= rst_ni;
    abort_q  <= abort;
    gave_up_q <= dut_state == 3'd4 && dut_wait[10:0] == 11'd0;
  end

  // check_i keeps the induction from assuming that the checks held before, so that the state before
  // is any of the eight codes with any counters.
  always @* if (check_i) begin
    StartOrAbort_A: assert (!(start && abort));
    if (start) StartOnIdle_A: assert (status1.idle && status2.idle);
    if (!rst_ni) ResetIdles_A: assert (!running);
    if (started && rst_ni && age_q == 3'd3 && byte_q.brk) BreakIdles_A: assert (!running);
    if (started && live_q && state_q > 3'd4) NoStray_A: assert (!running);
    if (started && live_q && gave_up_q) InitGivesUp_A: assert (!running);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Frame_C: cover (dut_state == 3'd1 && age_q == 3'd5);
    Broken_C: cover (state_q == 3'd1 && !running && abort_q);
    Init_C: cover (dut_state == 3'd3);
  end

endmodule
