// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The states of the link: what each frame is, when the next state comes, when the link begins again
// and why. It keeps the identity of the encoder.
//
// Clock domain: core. A state lasts from begin_i to begin_i, the clock before the first bit of a
// frame: plan_o and purpose_o are constant in between. judged_i decides whether the link goes on;
// from the next clock on gap_o asks dsl_tx for a gap, so judged_i must come at least two clocks
// before the slot_i that ends the trailer.
//
// RESET 2 frames, SYNC 16, START 9, LEARN 9, CHECK 16, one ID request, INIT up to VSYNC, then
// frames without end. A frame that has to answer and does not as it should is the last one: a gap
// follows, and RESET. linked_o is 1 from a good identity to the frame that ends the link. An
// identity is good if its two copies agree, and if its widths can be: 8 to 11 bits for the
// acceleration, 40 at most for the position. With strict_id it also has to be whole, and the link
// ends with a safe position that has bits above the width. A vsync_limit of 0 is none.
// symbol_i may change with begin_i alone.
// hold_i: the frame is finished, then the driver is off up to the end of hold_i. This is no restart
// that counts.
// Misuse: none.
// Source: docs/dsl.md, "The protocol".

module dsl_link (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  dsl_pkg::quirks_t quirks_i,
  input  logic             hold_i,
  // frames
  input  logic             begin_i,
  input  logic [4:0]       symbol_i,       // of M_PAR in a running frame
  output dsl_pkg::plan_t   plan_o,
  output logic             gap_o,
  // windows
  output logic             forget_o,
  output logic [1:0]       purpose_o,      // dsl_pkg::purpose_e
  input  logic             done_i,
  input  logic             match_i,        // with done_i: the test pattern was where it has to be
  // answers
  input  logic             valid_i,
  input  logic [2:0]       number_i,
  input  dsl_pkg::word_t   word_i,
  input  logic             judged_i,
  input  logic             good_i,         // the quality is
  input  logic             missing_i,      // too many accelerations
  input  logic             misfit_i,       // a safe position has bits above its width
  output logic             start_o,        // linked_o is 1 from the next clock on
  output logic             linked_o,
  output logic             begins_o,       // its first clock
  output logic             running_o,
  output logic [2:0]       place_o,        // of a running frame in its vertical frame
  output logic [3:0]       state_o,        // dsl_pkg::state_e
  output logic [2:0]       reason_o,       // dsl_pkg::reason_e
  output logic             restart_o,      // one clock: the link begins again
  output logic [19:0]      identity_o,
  output logic [5:0]       width_o         // of the position, less 8
);

  localparam logic [7:0] RESET_LAST = 8'd1;
  localparam logic [7:0] SYNC_LAST  = 8'd15;     // CHECK too
  localparam logic [7:0] START_LAST = 8'd8;      // LEARN too
  localparam logic [3:0] MOST_ACCELERATION = 4'd11 - 4'd8;
  localparam logic [7:0] FIRST      = 8'h80;     // bits of M_PAR

  logic [3:0]  state_d, state_q;
  logic [7:0]  count_d, count_q;   // frames of this state before this one
  logic [8:0]  count;              // ... with this one
  logic        gap_q;              // no frame comes next
  logic        vsync_q;            // has come in this frame
  logic        wrong_d, wrong_q;   // the pattern or the identity of this frame
  logic        linked_q, begins_q;
  logic [2:0]  reason_q;
  logic [7:0]  low_q, high_q;      // bytes of the identity
  logic [3:0]  top_q;
  logic        last;               // frame of this state
  logic        waits, running, asks;
  logic        fails;              // the frame does
  logic        restart;
  logic [6:0]  width;              // of the position, less 8
  logic        wide;
  logic        more;               // another part of the identity would follow

  assign asks    = state_q == dsl_pkg::ID_STATE;
  assign waits   = state_q == dsl_pkg::VSYNC_STATE;
  assign running = state_q == dsl_pkg::RUN_STATE;
  assign count   = {1'b0, count_q} + 9'd1;

  // Frames.
  always_comb begin
    case (state_q)
      dsl_pkg::RESET_STATE:                       last = count_q == RESET_LAST;
      dsl_pkg::SYNC_STATE, dsl_pkg::CHECK_STATE:  last = count_q == SYNC_LAST;
      dsl_pkg::START_STATE, dsl_pkg::LEARN_STATE: last = count_q == START_LAST;
      dsl_pkg::VSYNC_STATE:                       last = vsync_q;
      dsl_pkg::RUN_STATE:                         last = 1'b0;
      default:                                    last = 1'b1;
    endcase
  end
  always_comb begin
    state_d = state_q;
    count_d = count[7:0];
    if (gap_o) begin
      // The driver is off, then it sends zeros.
      state_d = dsl_pkg::GAP_STATE;
      count_d = '0;
    end else if (last) begin
      state_d = state_q + 4'd1;
      count_d = '0;
    end
  end

  always_comb begin
    plan_o                = '0;
    plan_o.answer         = 1'b1;
    plan_o.parameter_byte = FIRST | {3'd0, dsl_pkg::IDLE};
    case (state_q)
      dsl_pkg::RESET_STATE: begin
        plan_o.answer         = 1'b0;
        plan_o.parameter_byte = {3'd0, dsl_pkg::RESET};
      end
      dsl_pkg::SYNC_STATE: begin
        plan_o.answer         = 1'b0;
        plan_o.parameter_byte = {3'd0, dsl_pkg::SYNC};
      end
      dsl_pkg::START_STATE: begin
        plan_o.parameter_byte = {3'd0, dsl_pkg::START};
        plan_o.blocks         = quirks_i.start_blocks;
      end
      dsl_pkg::LEARN_STATE: plan_o.parameter_byte = {3'd0, dsl_pkg::LEARN};
      dsl_pkg::CHECK_STATE: plan_o.parameter_byte = {3'd0, dsl_pkg::CHECK};
      dsl_pkg::ID_STATE:    plan_o.parameter_byte = {3'd0, dsl_pkg::ID_REQUEST};
      dsl_pkg::VSYNC_STATE: plan_o.parameter_byte = FIRST | {3'd0, dsl_pkg::INIT};
      dsl_pkg::RUN_STATE: begin
        plan_o.parameter_byte[4:0] = symbol_i;
        // msync changes with each vertical frame.
        plan_o.parameter_byte[6]   = count_q[3];
      end
      default: ;
    endcase
  end
  always_comb begin
    case (state_q)
      dsl_pkg::START_STATE:                       purpose_o = dsl_pkg::FOR_START;
      dsl_pkg::ID_STATE:                          purpose_o = dsl_pkg::FOR_IDENTITY;
      dsl_pkg::LEARN_STATE, dsl_pkg::CHECK_STATE: purpose_o = dsl_pkg::FOR_MATCH;
      default:                                    purpose_o = dsl_pkg::FOR_WORDS;
    endcase
  end

  // The identity stands there twice. Errors of the code are not looked at.
  assign width = {1'b0, high_q[1:0], low_q[7:4]} + {3'd0, low_q[3:0]};
  assign wide  = width[6] || (width[5] && width[4:0] != 5'd0);    // more than 40 bits
  assign more  = top_q[3] && quirks_i.strict_id;
  always_comb begin
    wrong_d = wrong_q;
    if (done_i) begin
      if (!asks) wrong_d = !match_i;
      else if (low_q[3:0] > MOST_ACCELERATION || wide || more) wrong_d = 1'b1;
    end
    if (asks && valid_i) begin
      case (number_i)
        3'd2:    if (word_i.data[7:4] != word_i.data[3:0]) wrong_d = 1'b1;
        3'd3:    if (word_i.data != high_q)                wrong_d = 1'b1;
        3'd4:    if (word_i.data != low_q)                 wrong_d = 1'b1;
        default: ;
      endcase
    end
    if (begin_i) wrong_d = 1'b0;
  end

  // The end of a frame with an answer.
  always_comb begin
    fails = wrong_q;
    if (waits)   fails = !vsync_q && count == {1'b0, quirks_i.vsync_limit};
    if (running) fails = !good_i || missing_i || misfit_i;
  end
  assign restart = judged_i && fails && !gap_o;
  assign start_o = judged_i && !wrong_q && asks && !gap_o;
  assign gap_o   = gap_q || hold_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= dsl_pkg::GAP_STATE;
      count_q  <= '0;
      gap_q    <= 1'b0;
      vsync_q  <= 1'b0;
      wrong_q  <= 1'b0;
      linked_q <= 1'b0;
      begins_q <= 1'b0;
      reason_q <= dsl_pkg::NO_RESTART;
      low_q    <= '0;
      high_q   <= '0;
      top_q    <= '0;
    end else begin
      if (begin_i) begin
        state_q <= state_d;
        count_q <= count_d;
      end
      // A gap that has begun is not asked for again; hold_i itself makes it longer.
      gap_q    <= !begin_i && (gap_q || restart || (hold_i && state_q != dsl_pkg::GAP_STATE));
      wrong_q  <= wrong_d;
      linked_q <= (linked_q || start_o) && !gap_o && !restart;
      begins_q <= start_o;
      if (begin_i)                                vsync_q <= 1'b0;
      else if (valid_i && waits && number_i == 3'd1) vsync_q <= word_i.data[7] && !word_i.error;
      if (restart) begin
        // Each state has its reason, RUN three.
        reason_q <= (state_q[2:0] - 3'd2) | {2'd0, running && good_i};
        if (running && good_i && !missing_i) reason_q <= dsl_pkg::BAD_IDENTITY;
      end
      if (asks && valid_i && number_i == 3'd0) low_q  <= word_i.data;
      if (asks && valid_i && number_i == 3'd1) high_q <= word_i.data;
      if (asks && valid_i && number_i == 3'd2) top_q  <= word_i.data[3:0];
    end
  end

  assign forget_o   = begin_i && gap_o;
  assign linked_o   = linked_q;
  assign begins_o   = begins_q;
  assign running_o  = running;
  assign place_o    = count_q[2:0];
  assign state_o    = state_q;
  assign reason_o   = reason_q;
  assign restart_o  = restart;
  assign identity_o = {top_q, high_q, low_q};
  assign width_o    = width[5:0];

endmodule
