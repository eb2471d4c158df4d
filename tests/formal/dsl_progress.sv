// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// No state of a DSL link (dsl_link) is a dead one. From each state with each count, also from those
// that it never reaches, the frames lead to the running link or to a restart. The state is arbitrary
// at first: what holds here needs no history. Each frame with an answer is judged before its end.
//
// claim: from any state, reachable or not, each frame brings the link or a restart nearer: at most
//   563 frames, 53 and the limit of VSYNC from those that are reached; without a limit it waits for
//   VSYNC alone
// clocks: one
// depth: 12
// cover: 12
// unbounded: induction 2
// look: dut_state = u_dut.state_q
// look: dut_count = u_dut.count_q
// look: dut_vsync = u_dut.vsync_q
// look: dut_gap = u_dut.gap_q
// mutation: dsl/dsl_link.sv | default:                                    last = 1'b1; | default: last = 1'b0;
// mutation: dsl/dsl_link.sv | last = count_q == SYNC_LAST; | last = 1'b0;
// mutation: dsl/dsl_link.sv | state_d = state_q + 4'd1; | state_d = state_q ^ 4'd1;
// mutation: dsl/dsl_link.sv | last = vsync_q; | last = 1'b0;
// mutation: dsl/dsl_link.sv | count_d = count[7:0]; | count_d = count_q;

module proof (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             check_i,   // free: at which clocks the checks look
  input dsl_pkg::quirks_t quirks_i,
  input logic             begin_i,
  input logic             done_i, match_i,
  input logic             valid_i,
  input logic [2:0]       number_i,
  input dsl_pkg::word_t   word_i,
  input logic             judged_i, good_i, missing_i, misfit_i
);

  localparam logic [3:0] GAP = 4'd0, RESET = 4'd1, SYNC = 4'd2, START = 4'd3, LEARN = 4'd4,
                         CHECK = 4'd5, IDENTITY = 4'd6, VSYNC = 4'd7, RUN = 4'd8;

  logic [2:0] reason;

  dsl_link u_dut (
    .clk_i, .rst_ni, .quirks_i, .hold_i (1'b0), .begin_i, .symbol_i (5'h10), .plan_o (), .gap_o (), .forget_o (),
    .purpose_o (), .done_i, .match_i, .valid_i, .number_i, .word_i, .judged_i, .good_i,
    .missing_i, .misfit_i, .start_o (), .linked_o (), .begins_o (), .running_o (),
    .place_o (), .state_o (), .reason_o (reason), .restart_o (), .identity_o (), .width_o ()
  );

  wire [3:0] dut_state;
  wire [7:0] dut_count;
  wire       dut_vsync, dut_gap;

  // Frames up to the last one of this state, with the present one; then those of all later ones.
  logic [7:0]  last;      // number of the state's last frame
  logic [11:0] later;
  logic [11:0] left;
  always @* begin
    case (dut_state)
      RESET:        {last, later} = {8'd1, 12'd51};
      SYNC:         {last, later} = {8'd15, 12'd35};
      START, LEARN: {last, later} = {8'd8, dut_state == START ? 12'd26 : 12'd17};
      CHECK:        {last, later} = {8'd15, 12'd1};
      IDENTITY:     {last, later} = {dut_count, 12'd0};
      VSYNC:        {last, later} = {quirks_i.vsync_limit - 8'd1, 12'd0};
      // To GAP: 15 goes there next.
      default:      {last, later} = {dut_count, {8'd0, 4'd15 - dut_state}};
    endcase
    left = {4'd0, last - dut_count} + 12'd1 + later;
    // The identity has one frame; the limit of VSYNC follows.
    if (dut_state >= RESET && dut_state <= IDENTITY) left = left + 12'd256;
  end

  logic             started = 1'b0;
  logic             live_q, begin_q, judged_seen_q;
  dsl_pkg::quirks_t quirks_q;
  logic [3:0]       state_q;
  logic [11:0]      left_q;
  always @(posedge clk_i) begin
    started  <= 1'b1;
    live_q   <= rst_ni;
    begin_q  <= begin_i;
    quirks_q <= quirks_i;
    state_q  <= dut_state;
    left_q   <= left;
    judged_seen_q <= rst_ni && !begin_i && (judged_seen_q || judged_i);
  end
  always @* begin
    if (!started) assume (!rst_ni);
    if (started) assume (quirks_i == quirks_q);
    if (dut_state == RESET || dut_state == SYNC || dut_state == GAP) assume (!judged_i);
    if (judged_i) assume (!judged_seen_q && !begin_i);
    if (begin_i && dut_state >= START) assume (judged_seen_q);
    if (judged_seen_q || judged_i) assume (!valid_i);
  end

  // A frame that has been judged has its consequence.
  always @* if (started && rst_ni) begin
    if (judged_seen_q && dut_state == VSYNC && !dut_vsync && quirks_i.vsync_limit != 8'd0 &&
        {1'b0, dut_count} + 9'd1 == quirks_i.vsync_limit) Asked_A: assert (dut_gap);
  end

  // check_i keeps the induction from assuming that the checks held before.
  always @* if (check_i && started && rst_ni && live_q && begin_q) begin
    // A gap follows each restart, and RESET each gap.
    if (state_q == GAP) Starts_A: assert (dut_state == RESET || dut_state == GAP);
    else if (state_q != RUN && !(state_q == VSYNC && quirks_i.vsync_limit == 8'd0))
      Nearer_A: assert (dut_state == GAP || dut_state == RUN || left < left_q);
    else Stays_A: assert (dut_state == GAP || dut_state == RUN || state_q == VSYNC);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Begins_C: cover (begin_q && state_q == GAP && dut_state == RESET);
    Next_C:   cover (begin_q && state_q == RESET && dut_state == SYNC);
  end

endmodule
