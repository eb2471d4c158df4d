// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The alignment of dsl_position, over its whole program with any numbers in its memory: which states
// follow one another, and that the position becomes certain only at the end of a vertical frame with
// a good safe position 1. What a frame tells stays as it is from its end to tell_o.
//
// The acceleration of a frame comes when the program waits, and its end when the program works on it:
// that is assumed, not proved, as it is a matter of clocks. Numbers decide how many rows a frame
// takes: DslPositionBlock.AtLineSpeed_EachFrameHasItsRecord counts them on the longest and the
// shortest line. A frame that ends earlier is left out (dsl_position, Misuse).
//
// The induction needs the row that stands at each step, and that two decisions of the program still
// hold where it relies on them.
//
// claim: POS is 1 after a missing acceleration, which opens a repair only if the encoder has not marked it, and falls only at the end of a vertical frame with a good safe position 1, after the phases in their order or after
//   one loss; it is 1 without a link; the program never leaves its rows, if each frame finds it waiting
// clocks: one
// depth: 30
// cover: 6
// unbounded: induction 1
// look: align = u_dut.align_q
// look: step = u_dut.step_q
// look: row = u_dut.row
// look: ready = u_dut.ready_q
// look: frame = u_dut.frame_q
// look: vertical = u_dut.vertical_q
// look: stale = u_dut.stale_q
// look: now = u_rows.row
// mutation: dsl/dsl_program.sv | SAFE + 8'd7:      row = jump_unless(NEW1, WITHOUT); | SAFE + 8'd7:      row = jump_unless(NEW2, WITHOUT);
// mutation: dsl/dsl_program.sv | WAIT + 8'd1:      row = jump_unless(VERTICAL, COMPARE); | WAIT + 8'd1:      row = jump_unless(GOOD, COMPARE);
// mutation: dsl/dsl_program.sv | row = set(SECOND, ENDED); | row = set(THIRD, ENDED);
// mutation: dsl/dsl_program.sv | row = set(LOST, ADD); | row = set(ALIGNED, ADD);
// mutation: dsl/dsl_position.sv | if (!answer_i.linked) align_q | if (answer_i.begins) align_q
// mutation: dsl/dsl_position.sv | quirks_i.recover && !told_i.acceleration_marked; | quirks_i.recover;
// mutation: dsl/dsl_program.sv | row = jump_if(ALWAYS, STATUS); | row = jump_if(ALWAYS, STATUS + 8'd40);

module proof (
  input logic             clk_i,
  input logic             rst_ni,
  input dsl_pkg::quirks_t quirks_i,
  input dsl_pkg::answer_t answer_i,
  input dsl_pkg::told_t   told_i,
  input logic [7:0]       safe2_bits_i, tolerance_i,
  input logic [7:0]       time_i,
  input logic             record_busy_i
);

  logic lost, tell;
  dsl_position u_dut (
    .clk_i, .rst_ni, .quirks_i, .answer_i, .told_i,
    .status_i         (62'd0),
    .safe2_bits_i,
    .tolerance_i,
    .time_i,
    .time_next_o      (),
    .lost_o           (lost),
    .stale_o          (),
    .mismatch_o       (),
    .record_write_o   (),
    .record_address_o (),
    .record_data_o    (),
    .tell_o           (tell),
    .record_busy_i
  );

  wire [2:0]  align;
  wire [7:0]  step;
  wire [31:0] row;
  wire        ready, frame, vertical;
  wire [1:0]  stale;

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;

  // From the end of a running frame to its record.
  logic       busy_q, linked_q, new1_q, good_q, marked_q, vertical_q;
  logic       lost_q = 1'b1;
  always @(posedge clk_i) lost_q <= lost;
  logic [2:0] align_q;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {busy_q, linked_q, new1_q, good_q, marked_q, vertical_q, align_q} <= '0;
    else begin
      busy_q     <= (busy_q || (answer_i.ends && frame)) && !tell;
      linked_q   <= answer_i.linked;
      new1_q     <= told_i.safe1_valid;
      good_q     <= told_i.acceleration_good;
      marked_q   <= told_i.acceleration_marked;
      vertical_q <= vertical;
      align_q    <= align;
    end
  end

  // Where sections of dsl_program begin.
  localparam logic [7:0] BEGIN = 8'd38, MISSED = 8'd65, ADD = 8'd70, WAIT = 8'd88, SAFE = 8'd90, PLACE = 8'd107,
                         PAUSE = 8'd110, WITHOUT = 8'd111, KEEP = 8'd115, OFF = 8'd118, CORRECT = 8'd124,
                         MEND = 8'd133, ENDED = 8'd167, STATUS = 8'd205, IDLE = 8'd207, CLOSE = 8'd211;
  localparam logic [2:0] FIRST = 3'd0, SECOND = 3'd1, THIRD = 3'd2, FOURTH = 3'd3, ALIGNED = 3'd4,
                         LOST = 3'd5, MENDING = 3'd6;

  logic works;                    // on a frame
  assign works = step >= BEGIN && step < STATUS;

  always @* begin
    assume (rst_ni == started);
    if (busy_q) assume (!answer_i.ends && told_i.safe1_valid == new1_q);
    if (step >= BEGIN && step <= WAIT) assume (told_i.acceleration_good == good_q && told_i.acceleration_marked == marked_q);
    if (works || busy_q || frame) assume (!(answer_i.valid && answer_i.number == 3'd4));
    // The end of a frame comes long after its acceleration.
    if (answer_i.ends) assume (!answer_i.valid && (!frame || works));
    // A link begins long before its first running frame.
    if (answer_i.linked && !linked_q) assume (!works && !busy_q && !frame);
  end

  // The row that stands at this step.
  dsl_program u_rows (
    .clk_i,
    .enable_i (1'b1),
    .step_i   (step),
    .row_o    ()
  );
  wire [31:0] now;

  logic follows;
  always @* begin
    follows = align == align_q || align == FIRST;
    case (align_q)
      FIRST:   follows = follows || align == SECOND;
      SECOND:  follows = follows || align == THIRD;
      THIRD:   follows = follows || align == FOURTH;
      FOURTH:  follows = follows || align == ALIGNED;
      ALIGNED: follows = follows || align == LOST;
      LOST:    follows = follows || align == MENDING;
      MENDING: follows = follows || align == ALIGNED;
      default: ;
    endcase
  end

  always @* if (started) begin
    Order_A:   assert (follows);
    Certain_A: assert (align != ALIGNED || align_q == ALIGNED || (vertical_q && new1_q));
    Link_A:    assert (linked_q || align != ALIGNED);
    Lost_A:    assert (lost || align == ALIGNED);
    Told_A:    assert (lost || !lost_q || tell);
    if (step >= ADD && step <= WAIT && !good_q) Missing_A: assert (align != ALIGNED);
    Step_A:    assert (step < CLOSE + 8'd12);
    Repair_A:  assert (align != LOST || align_q == LOST || !marked_q);
    Range_A:   assert (align <= MENDING && stale <= 2'd3);
    // For the induction.
    Row_A:     assert (!ready || row == now);
    First_A:   assert (ready || step == 8'd0);
    Ends_A:    assert (!works || step > WAIT || frame || busy_q);
    Busy_A:    assert (!works || step <= WAIT || (busy_q && !frame));
    Idle_A:    assert (!busy_q || (step >= BEGIN && step < IDLE && !frame));
    Aligned_A: assert (!linked_q || !(step == MISSED + 8'd3 || step == MISSED + 8'd4) || align == ALIGNED);
    if (step >= MISSED + 8'd1 && step < ADD && step != MISSED + 8'd2) Unmarked_A: assert (!marked_q);
    if (step >= SAFE && step < ENDED) Vertical_A: assert (vertical);
    if ((step > SAFE + 8'd7 && step < WITHOUT) || (step >= OFF && step < ENDED)) New_A: assert (told_i.safe1_valid);
    if (linked_q) begin
      if (step > SAFE + 8'd6 && step < PLACE)  Not1_A:  assert (align != LOST);
      if (step > SAFE + 8'd8 && step < PLACE)  Not2_A:  assert (align != SECOND);
      if (step > SAFE + 8'd9 && step < PLACE)  Not3_A:  assert (align != MENDING);
      if (step > SAFE + 8'd12 && step < PLACE) Not4_A:  assert (align != FIRST);
      if (step > SAFE + 8'd13 && step < PLACE) Not5_A:  assert (align != THIRD);
      if (step >= PLACE && step < PAUSE)       Place_A: assert (align == FIRST);
      if (step == PAUSE)                       Pause_A: assert (align == THIRD);
      if (step >= KEEP && step < OFF)          Keep_A:  assert (align == LOST);
      if (step >= OFF && step < CORRECT)       Off_A:   assert (align == SECOND || align == MENDING);
      if (step >= CORRECT && step < MEND)      Near_A:  assert (align == SECOND);
      if (step >= MEND && step < ENDED)        Mend_A:  assert (align == MENDING);
    end else begin
      Unlinked_A: assert (align == FIRST);
    end
  end

  always @(posedge clk_i) if (started && rst_ni) Linked_C: cover (ready && linked_q && step == 8'd0);

endmodule
