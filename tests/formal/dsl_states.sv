// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The states of a DSL link (dsl_link). Frames are as long as they like; windows are in frames with an
// answer only, and each of them is judged once, before its end, after its words and its done_i. The
// identity's frame brings six words in their order, as dsl_rx gives them.
//
// The bench keeps the bytes of the identity and decides by itself whether it is a good one.
//
// claim: plan and purpose are constant in a frame and those of free run; each state has its
//   number of frames; RUN follows the first frame of VSYNC whose S_PAR has it, and nothing else; each frame that does not
//   answer as it should, and no other, ends the link, with its reason; LINK is 1 from an identity that stands there twice,
//   with widths that can be, to that end, and shows it; a gap is never asked for in a gap
// clocks: one
// depth: 60
// cover: 160
// unbounded: induction 2
// look: dut_count = u_dut.count_q
// look: dut_gap = u_dut.gap_q
// look: dut_wrong = u_dut.wrong_q
// look: dut_vsync = u_dut.vsync_q
// look: dut_low = u_dut.low_q
// look: dut_high = u_dut.high_q
// look: dut_top = u_dut.top_q
// mutation: dsl/dsl_link.sv | last = count_q == START_LAST; | last = count_q == START_LAST + 8'd1;
// mutation: dsl/dsl_link.sv | (hold_i && state_q != dsl_pkg::GAP_STATE) | hold_i
// mutation: dsl/dsl_link.sv | && !gap_o && !restart; | && !gap_o;
// mutation: dsl/dsl_link.sv | if (!asks) wrong_d = !match_i; | if (!asks) wrong_d = !match_i && wrong_q;
// mutation: dsl/dsl_link.sv | fails = !good_i || missing_i || misfit_i; | fails = !good_i || misfit_i;
// mutation: dsl/dsl_link.sv | last = vsync_q; | last = vsync_q || count_q == 8'd20;
// mutation: dsl/dsl_link.sv | if (word_i.data != high_q) | if (word_i.data[6:0] != high_q[6:0])
// mutation: dsl/dsl_link.sv | width[4:0] != 5'd0 | width[4:1] != 4'd0
// mutation: dsl/dsl_link.sv | word_i.data[7:4] != word_i.data[3:0] | word_i.data[7:5] != word_i.data[3:1]
// mutation: dsl/dsl_link.sv | if (running && good_i && !missing_i) reason_q | if (running && good_i) reason_q
// mutation: dsl/dsl_link.sv | if (begin_i) begin | if (begin_i || restart) begin
// mutation: dsl/dsl_link.sv | assign restart = judged_i && fails && !gap_o; | assign restart = judged_i && fails;
// mutation: dsl/dsl_link.sv | count == {1'b0, quirks_i.vsync_limit} | count_q == quirks_i.vsync_limit

module proof (
  input logic             clk_i,
  input logic             rst_ni,
  input dsl_pkg::quirks_t quirks_i,
  input logic             hold_i, begin_i,
  input logic [4:0]       symbol_i,
  input logic             done_i, match_i,
  input logic             valid_i,
  input logic [2:0]       number_i,
  input dsl_pkg::word_t   word_i,
  input logic             judged_i, good_i, missing_i, misfit_i
);

  localparam logic [3:0] GAP = 4'd0, RESET = 4'd1, SYNC = 4'd2, START = 4'd3, LEARN = 4'd4,
                         CHECK = 4'd5, IDENTITY = 4'd6, VSYNC = 4'd7, RUN = 4'd8;

  dsl_pkg::plan_t plan;
  logic           gap, forget, start, linked, begins, running;
  logic [1:0]     purpose;
  logic [2:0]     place, reason;
  logic [3:0]     state;
  logic           restart;
  logic [19:0]    identity;
  logic [5:0]     width;

  dsl_link u_dut (
    .clk_i, .rst_ni, .quirks_i, .hold_i, .begin_i, .symbol_i, .plan_o (plan), .gap_o (gap), .forget_o (forget),
    .purpose_o (purpose), .done_i, .match_i, .valid_i, .number_i, .word_i, .judged_i, .good_i,
    .missing_i, .misfit_i, .start_o (start), .linked_o (linked), .begins_o (begins), .running_o (running),
    .place_o (place), .state_o (state), .reason_o (reason), .restart_o (restart),
    .identity_o (identity), .width_o (width)
  );

  wire [7:0] dut_count;
  wire       dut_gap, dut_wrong, dut_vsync;
  wire [7:0] dut_low, dut_high;
  wire [3:0] dut_top;

  logic             started = 1'b0;
  logic             live_q;                     // the clock before had no reset
  dsl_pkg::quirks_t quirks_q;
  dsl_pkg::plan_t   plan_q;
  logic [1:0]       purpose_q;
  logic [3:0]       state_q;
  logic             begin_q, gap_q, linked_q, hold_q, ended_q, judged_q;
  logic [2:0]       reason_q, expected_q;
  logic [7:0]       count_q;
  logic             restart_q;
  logic [4:0]       symbol_q;
  logic             done_seen_q, judged_seen_q; // in this frame
  logic             wrong_q;                    // the pattern of this frame
  logic             vsync_q;                    // S_PAR of this frame has it
  logic             vsync_was_q;                // ... before its end
  logic             bad;
  logic [2:0]       next_q;                     // number of the word that comes next
  logic [7:0]       b0_q, b1_q, b2_q, b3_q, b4_q;
  logic [19:0]      linked_id_q;                // that of the link
  logic [7:0]       waited_q;                   // frames in VSYNC

  assign bad = state == VSYNC ? !vsync_q && waited_q + 9'd1 == quirks_i.vsync_limit
             : state == RUN   ? !good_i || missing_i || misfit_i
             : state == IDENTITY ? !identity_good : wrong_q;

  // Both copies of the identity, and what its numbers can be.
  logic [6:0] acceleration_bits, position_bits;
  logic       cannot_be, identity_good;
  assign acceleration_bits = {3'd0, b0_q[3:0]} + 7'd8;
  assign position_bits     = {1'b0, b1_q[1:0], b0_q[7:4]} + acceleration_bits;
  assign cannot_be         = acceleration_bits > 7'd11 || position_bits > 7'd40
                          || (quirks_i.strict_id && b2_q[3]);
  assign identity_good     = b4_q == b0_q && b3_q == b1_q && b2_q[7:4] == b2_q[3:0] && !cannot_be;

  always @(posedge clk_i) begin
    started   <= 1'b1;
    live_q    <= rst_ni;
    quirks_q  <= quirks_i;
    plan_q    <= plan;
    purpose_q <= purpose;
    state_q   <= state;
    count_q   <= dut_count;
    begin_q   <= begin_i;
    gap_q     <= gap;
    hold_q    <= hold_i;
    linked_q  <= linked;
    reason_q  <= reason;
    restart_q <= restart;
    symbol_q  <= symbol_i;
    judged_q  <= judged_i;
    ended_q   <= judged_i && bad && !gap;
    expected_q <= state == RUN ? (!good_i ? 3'd6 : missing_i ? 3'd7 : 3'd4) : 3'(state - 4'd2);
    vsync_was_q <= vsync_q;
    if (valid_i) begin
      case (number_i)
        3'd0:    b0_q <= word_i.data;
        3'd1:    b1_q <= word_i.data;
        3'd2:    b2_q <= word_i.data;
        3'd3:    b3_q <= word_i.data;
        3'd4:    b4_q <= word_i.data;
        default: ;
      endcase
    end
    next_q <= begin_i || !rst_ni ? 3'd0 : next_q + {2'd0, valid_i};
    if (start) linked_id_q <= {b2_q[3:0], b1_q, b0_q};
    if (begin_i || !rst_ni) begin
      {done_seen_q, judged_seen_q, wrong_q, vsync_q} <= 4'd0;
    end else begin
      if (done_i) begin
        done_seen_q <= 1'b1;
        wrong_q     <= !match_i;
      end
      if (judged_i) judged_seen_q <= 1'b1;
      if (valid_i && number_i == 3'd1) vsync_q <= word_i.data[7] && !word_i.error;
    end
    if (begin_i) waited_q <= state == VSYNC ? waited_q + 8'd1 : 8'd0;
    if (!rst_ni) waited_q <= 8'd0;
  end

  // Number of a state's last frame; VSYNC has none.
  function automatic logic [7:0] last_of(logic [3:0] which);
    case (which)
      RESET:        last_of = 8'd1;
      SYNC, CHECK:  last_of = 8'd15;
      START, LEARN: last_of = 8'd8;
      VSYNC:        last_of = count_q;
      default:      last_of = 8'd0;
    endcase
  endfunction

  always @* begin
    if (!started) assume (!rst_ni);
    if (started) assume (quirks_i == quirks_q);
    if (started && !begin_q) assume (symbol_i == symbol_q);
    if (state < START) assume (!done_i && !judged_i && !valid_i);
    if (done_seen_q || done_i) assume (!valid_i);
    if (valid_i) assume (number_i == next_q && next_q < 3'd6);
    if (done_i && state == IDENTITY) assume (next_q == 3'd6);
    if (done_seen_q) assume (!done_i);
    if (judged_i) assume (done_seen_q && !judged_seen_q && !begin_i);
    if (begin_i) assume (!done_i && !valid_i && (state < START || judged_seen_q));
  end

  always @* if (started && rst_ni) begin
    States_A: assert (state <= RUN && running == (state == RUN));
    FreeRun_A: assert (plan.extra == 4'd0 && plan.rest == 3'd0 && plan.added == 4'd0);
    if (state == RESET || state == SYNC) NoAnswer_A: assert (!plan.answer);
    if (state >= START) Answer_A: assert (plan.answer);
    if (state == GAP || state == IDENTITY) One_A: assert (dut_count == 8'd0);
    if (state == RESET) Two_A: assert (dut_count <= 8'd1);
    if (state == START || state == LEARN) Nine_A: assert (dut_count <= 8'd8);
    if (state == SYNC || state == CHECK) Sixteen_A: assert (dut_count <= 8'd15);
    if (state == VSYNC) Waited_A: assert (dut_count == waited_q);
    if (state == VSYNC && quirks_i.vsync_limit != 8'd0 && !gap)
      Limit_A: assert (waited_q < quirks_i.vsync_limit);
    if (state == GAP) Begun_A: assert (!dut_gap);
    if (linked) Linked_A: assert (state >= IDENTITY && !dut_gap);
    // For the induction.
    if (state >= START && state <= CHECK && done_seen_q) Pattern_A: assert (dut_wrong == wrong_q);
    if (state == VSYNC) Vsync_A: assert (dut_vsync == vsync_q);
    if (state != VSYNC) NoVsync_A: assert (!dut_vsync);
    if (!(state >= START && done_seen_q) && state != IDENTITY) NotYet_A: assert (!dut_wrong);
    if (state >= VSYNC || (state == IDENTITY && judged_seen_q)) Link_A: assert (linked || dut_gap);
    if (state >= START && state <= CHECK && judged_seen_q && wrong_q) Asked_A: assert (dut_gap);
    if (state == VSYNC && judged_seen_q && !vsync_q && quirks_i.vsync_limit != 8'd0 &&
        waited_q + 9'd1 == quirks_i.vsync_limit) Late_A: assert (dut_gap);
    if (judged_seen_q) Done_A: assert (done_seen_q);
    if (linked && state == IDENTITY) Judged_A: assert (judged_seen_q);
    if (linked) Identity_A: assert (identity == linked_id_q);
    if (linked) Width_A: assert (width <= 6'd32 && {1'b0, width} == {1'b0, linked_id_q[9:4]}
                                 + {3'd0, linked_id_q[3:0]});
    // The identity up to the last word that has come.
    if (state == IDENTITY) begin
      if (next_q > 3'd0) Low_A:  assert (dut_low == b0_q);
      if (next_q > 3'd1) High_A: assert (dut_high == b1_q);
      if (next_q > 3'd2) Top_A:  assert (dut_top == b2_q[3:0]);
      Twice_A: assert (dut_wrong == ((next_q > 3'd2 && b2_q[7:4] != b2_q[3:0])
                                     || (next_q > 3'd3 && b3_q != b1_q)
                                     || (next_q > 3'd4 && b4_q != b0_q)
                                     || (done_seen_q && cannot_be)));
      Whole_A: assert (!done_seen_q || next_q == 3'd6);
    end
    Number_A: assert (next_q <= 3'd6);
    if (state < START) None_A: assert (!done_seen_q && !judged_seen_q);
  end

  always @* if (started && rst_ni && live_q) begin
    if (!begin_q) begin
      Plan_A: assert (plan == plan_q && purpose == purpose_q && state == state_q);
    end else begin
      Next_A: assert (gap_q ? state == GAP : state == state_q || state == state_q + 4'd1);
      if (!gap_q && state != state_q) Length_A: assert (count_q == last_of(state_q));
      if (!gap_q && state_q == VSYNC) Run_A: assert (state == (vsync_was_q ? RUN : VSYNC));
      if (state == RUN && state_q != RUN) OnlyVsync_A: assert (state_q == VSYNC && vsync_was_q);
    end
    Ended_A:  assert (restart_q == ended_q);
    Reason_A: assert (reason == (ended_q ? expected_q : reason_q));
    if (ended_q) Gap_A: assert (gap && !linked);
    if (!ended_q && !hold_q && !hold_i && !gap_q) NoGap_A: assert (!gap);
    if (linked && !linked_q) Begins_A: assert (begins && judged_q && state == IDENTITY);
    if (!linked && linked_q) Falls_A: assert (ended_q || gap_q);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Run_C:     cover (state == RUN && linked && plan.parameter_byte == 8'h90);
    Vsync_C:   cover (state == VSYNC && ended_q);
    Learn_C:   cover (state == LEARN && ended_q);
  end

endmodule
