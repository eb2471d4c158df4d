// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What dsl_position does, row by row. Synthesis makes a read-only memory of it.
//
// Clock domain: core. row_o is that of step_i from the next edge with enable_i on.
// A row is a sum over bytes 0 to `last`, or a jump; a jump leaves the flags. The memory is
// undefined after the reset: POWER and LINK write what the others read.
// Misuse: a step without a row is read as IDLE.
// Source: docs/dsl.md, "Position".

module dsl_program (
  input  logic        clk_i,
  input  logic        enable_i,
  input  logic [7:0]  step_i,
  output logic [31:0] row_o       // dsl_program_pkg::sum_t, jump_t
);

  // Values. Those up to WIDE are the record of a frame.
  localparam logic [4:0] FAST    = 5'd0;   // the position, 40 bits
  localparam logic [4:0] SPEED   = 5'd1;   // 24 bits, widened by its sign to 40
  localparam logic [4:0] COUNT   = 5'd2;   // running frames, 32 bits; bytes 4 to 7: status
  localparam logic [4:0] TIME    = 5'd3;   // of the frame's edge
  localparam logic [4:0] SAFE1   = 5'd4;   // bytes 0 to 4: position, 5: summary, 6 and 7: CRC
  localparam logic [4:0] SAFE2   = 5'd5;
  localparam logic [4:0] AGES    = 5'd6;   // of the two in frames, four bytes each
  localparam logic [4:0] WIDE    = 5'd7;   // the position, 64 bits
  localparam logic [4:0] BYTES1  = dsl_program_pkg::BYTES1;   // as SAFE1, of the frame that runs
  localparam logic [4:0] BYTES2  = dsl_program_pkg::BYTES2;
  localparam logic [4:0] WORD    = dsl_program_pkg::WORD;     // the acceleration with its CRC
  // Accelerations, the last one first.
  localparam logic [4:0] A0 = 5'd11, A1 = 5'd12, A2 = 5'd13, A3 = 5'd14, A4 = 5'd15, A5 = 5'd16;
  localparam logic [4:0] MOVED   = 5'd17;  // since the last end of a vertical frame
  localparam logic [4:0] KEPT    = 5'd18;  // position at such an end
  localparam logic [4:0] MASK    = 5'd19;  // ones where the position has bits
  localparam logic [4:0] TOP     = 5'd20;  // its highest bit
  localparam logic [4:0] HIGHEST = 5'd21;  // 1023, the highest acceleration
  localparam logic [4:0] SHORT   = 5'd22;  // FFFFh
  localparam logic [4:0] NEXT    = 5'd23;  // the acceleration of this frame
  localparam logic [4:0] WRONG   = 5'd24;  // how far the position is off
  localparam logic [4:0] EACH    = 5'd25;  // ... the speed
  localparam logic [4:0] REST    = 5'd26;  // of the division
  localparam logic [4:0] LEFT    = 5'd27;  // turns of a loop
  localparam logic [4:0] SINCE   = 5'd28;  // frames since the loss, with its own
  localparam logic [4:0] BY      = 5'd29;  // ... up to the end of its vertical frame
  localparam logic [4:0] NOWHERE = 5'd30;  // only the flags count
  localparam logic [4:0] EIGHT   = 5'd31;

  // Added to a SUM.
  localparam logic [31:0] CARRIED = 32'h80, PLUS_1 = 32'h40, WIDEN_2 = 32'h20, WIDEN_3 = 32'h30,
                          UPPER = 32'h08, DOWN = 32'h04, FITS = 32'h02, HOLD = 32'h01;

  // Added to a SET: safe and fast position should have been the same.
  localparam logic [31:0] STALE_NOW = 32'h1;

  // Conditions: the bits of dsl_program_pkg::conditions_t.
  localparam logic [3:0] ZERO = 4'd0, CARRY = 4'd1, NEGATIVE = 4'd2, ALWAYS = 4'd3, FRAME = 4'd4,
                         BEGUN = 4'd5, GOOD = 4'd6, VERTICAL = 4'd7, NEW1 = 4'd8, NEW2 = 4'd9,
                         STALE = 4'd10, RECOVER = 4'd11, IN_STATE = 4'd12, SIGNED = 4'd13,
                         OVER = 4'd14, CHECK = 4'd15;

  // States: dsl_program_pkg::align_e; inputs: dsl_program_pkg::input_e.
  localparam logic [2:0] FIRST = 3'd0, SECOND = 3'd1, THIRD = 3'd2, FOURTH = 3'd3, ALIGNED = 3'd4,
                         LOST = 3'd5, MENDING = 3'd6, MISMATCH = 3'd7;
  localparam logic [4:0] IN_TIME = 5'd0, IN_STATUS = 5'd1, IN_WIDTH = 5'd2, IN_BITS = 5'd3,
                         IN_TOLERANCE = 5'd4;

  // Sections.
  localparam logic [7:0] POWER = 8'd0, LINK = POWER + 8'd2, BEGIN = LINK + 8'd36,
                         GUESS = BEGIN + 8'd4, KNOWN = GUESS + 8'd11, SCALE = KNOWN + 8'd1,
                         BOUND = SCALE + 8'd4, MISSED = BOUND + 8'd7, ADD = MISSED + 8'd5,
                         WAIT = ADD + 8'd18, SAFE = WAIT + 8'd2, PLACE = SAFE + 8'd17,
                         PAUSE = PLACE + 8'd3, WITHOUT = PAUSE + 8'd1, FAIL = WITHOUT + 8'd2,
                         UNLIKE = FAIL + 8'd1, KEEP = UNLIKE + 8'd1, OFF = KEEP + 8'd3,
                         CORRECT = OFF + 8'd6, MEND = CORRECT + 8'd9, MENDED = MEND + 8'd22,
                         ENDED = MENDED + 8'd12, COMPARE = ENDED + 8'd3, SHIFT = COMPARE + 8'd8,
                         PART = SHIFT + 8'd7, AGREE = PART + 8'd6, SHOW = AGREE + 8'd9,
                         STATUS = SHOW + 8'd5, IDLE = STATUS + 8'd2, CLOSE = IDLE + 8'd4;

  // Rows. The last twelve bits of a sum are source, change and carry, and six that can be added.
  function automatic logic [31:0] plus(input logic [4:0] to, first, second, input logic [2:0] last);
    plus = {dsl_program_pkg::SUM, to, first, second, last, 12'h000};
  endfunction
  function automatic logic [31:0] minus(input logic [4:0] to, first, second,
                                       input logic [2:0] last);
    minus = {dsl_program_pkg::SUM, to, first, second, last, 12'h140};
  endfunction
  function automatic logic [31:0] plus_not(input logic [4:0] to, first, second,
                                          input logic [2:0] last);
    plus_not = {dsl_program_pkg::SUM, to, first, second, last, 12'h100};
  endfunction
  function automatic logic [31:0] masked(input logic [4:0] to, first, second,
                                        input logic [2:0] last);
    masked = {dsl_program_pkg::SUM, to, first, second, last, 12'h240};
  endfunction
  function automatic logic [31:0] copy(input logic [4:0] to, first, input logic [2:0] last);
    copy = {dsl_program_pkg::SUM, to, first, 5'd0, last, 12'h300};
  endfunction
  function automatic logic [31:0] negative_of(input logic [4:0] to, second, input logic [2:0] last);
    negative_of = {dsl_program_pkg::SUM, to, 5'd0, second, last, 12'h940};
  endfunction
  function automatic logic [31:0] not_of(input logic [4:0] to, second, input logic [2:0] last);
    not_of = {dsl_program_pkg::SUM, to, 5'd0, second, last, 12'h900};
  endfunction
  function automatic logic [31:0] less_1(input logic [4:0] to, second, input logic [2:0] last);
    less_1 = {dsl_program_pkg::SUM, to, 5'd0, second, last, 12'hC00};
  endfunction
  function automatic logic [31:0] zeros(input logic [4:0] to, input logic [2:0] last);
    zeros = {dsl_program_pkg::SUM, to, 5'd0, 5'd0, last, 12'hB00};
  endfunction
  function automatic logic [31:0] ones(input logic [4:0] to, input logic [2:0] last);
    ones = {dsl_program_pkg::SUM, to, 5'd0, 5'd0, last, 12'hF00};
  endfunction
  function automatic logic [31:0] take(input logic [4:0] to, second, input logic [2:0] last);
    take = {dsl_program_pkg::SUM, to, 5'd0, second, last, 12'h700};
  endfunction
  function automatic logic [31:0] jump_if(input logic [3:0] condition, input logic [7:0] target);
    jump_if = {dsl_program_pkg::JUMP, 1'b0, condition, target, 17'd0};
  endfunction
  function automatic logic [31:0] jump_unless(input logic [3:0] condition,
                                              input logic [7:0] target);
    jump_unless = {dsl_program_pkg::JUMP, 1'b1, condition, target, 17'd0};
  endfunction
  function automatic logic [31:0] jump_in(input logic [2:0] state, input logic [7:0] target);
    jump_in = {dsl_program_pkg::JUMP, 1'b0, IN_STATE, target, state, 14'd0};
  endfunction
  function automatic logic [31:0] set(input logic [2:0] state, input logic [7:0] target);
    set = {dsl_program_pkg::SET, 1'b0, ALWAYS, target, state, 14'd0};
  endfunction
  function automatic logic [31:0] tell(input logic closes);
    tell = {dsl_program_pkg::TELL, 29'd0, closes};
  endfunction

  logic [31:0] row, row_q;

  always_comb begin
    case (step_i)
      // After the reset: nothing has come, and the record is empty.
      POWER:            row = zeros(COUNT, 3'd7);
      POWER + 8'd1:     row = zeros(TIME, 3'd7);
      // A link begins. HIGHEST is made of ten ones, TOP is 1 doubled up to the position's width.
      LINK:             row = copy(COUNT, COUNT, 3'd3);
      LINK + 8'd1:      row = copy(TIME, TIME, 3'd7);
      LINK + 8'd2:      row = zeros(SPEED, 3'd4);
      LINK + 8'd3:      row = zeros(FAST, 3'd7);
      LINK + 8'd4:      row = zeros(WIDE, 3'd7);
      LINK + 8'd5:      row = zeros(MOVED, 3'd4);
      LINK + 8'd6:      row = zeros(A0, 3'd2);
      LINK + 8'd7:      row = zeros(A1, 3'd1);
      LINK + 8'd8:      row = zeros(A2, 3'd1);
      LINK + 8'd9:      row = zeros(A3, 3'd1);
      LINK + 8'd10:     row = zeros(A4, 3'd1);
      LINK + 8'd11:     row = zeros(A5, 3'd1);
      LINK + 8'd12:     row = zeros(SAFE1, 3'd7);
      LINK + 8'd13:     row = zeros(SAFE2, 3'd7);
      LINK + 8'd14:     row = ones(AGES, 3'd7);
      LINK + 8'd15:     row = zeros(SHORT, 3'd4);
      LINK + 8'd16:     row = ones(SHORT, 3'd1);
      LINK + 8'd17:     row = zeros(HIGHEST, 3'd4) | PLUS_1;
      LINK + 8'd18:     row = plus(HIGHEST, HIGHEST, HIGHEST, 3'd4) | PLUS_1;
      LINK + 8'd19:     row = zeros(LEFT, 3'd0) | PLUS_1;
      LINK + 8'd20:     row = plus(HIGHEST, HIGHEST, HIGHEST, 3'd4) | PLUS_1;
      LINK + 8'd21:     row = plus(LEFT, LEFT, LEFT, 3'd0);
      LINK + 8'd22:     row = jump_unless(ZERO, LINK + 8'd20);
      LINK + 8'd23:     row = zeros(TOP, 3'd7) | PLUS_1;
      LINK + 8'd24:     row = take(LEFT, IN_WIDTH, 3'd0);
      LINK + 8'd25:     row = less_1(LEFT, LEFT, 3'd0);
      LINK + 8'd26:     row = jump_if(ZERO, LINK + 8'd29);
      LINK + 8'd27:     row = plus(TOP, TOP, TOP, 3'd4);
      LINK + 8'd28:     row = jump_if(ALWAYS, LINK + 8'd25);
      LINK + 8'd29:     row = plus(MASK, TOP, TOP, 3'd7);
      LINK + 8'd30:     row = less_1(MASK, MASK, 3'd7);
      LINK + 8'd31:     row = zeros(EIGHT, 3'd0) | PLUS_1;
      LINK + 8'd32:     row = plus(EIGHT, EIGHT, EIGHT, 3'd0);
      LINK + 8'd33:     row = plus(EIGHT, EIGHT, EIGHT, 3'd0);
      LINK + 8'd34:     row = plus(EIGHT, EIGHT, EIGHT, 3'd0);
      LINK + 8'd35:     row = jump_if(ALWAYS, STATUS);
      // The acceleration of a running frame is there.
      BEGIN:            row = take(TIME, IN_TIME, 3'd7);
      BEGIN + 8'd1:     row = copy(COUNT, COUNT, 3'd3) | PLUS_1;
      BEGIN + 8'd2:     row = copy(SINCE, SINCE, 3'd0) | PLUS_1;
      BEGIN + 8'd3:     row = jump_if(GOOD, KNOWN);
      // It is missing: 16 A0 - 8 A1 - 4 A2 - 2 A3 - A4 - A5 in 16 bits is 32 times its change.
      GUESS:            row = plus(NEXT, A0, A0, 3'd1);
      GUESS + 8'd1:     row = minus(NEXT, NEXT, A1, 3'd1);
      GUESS + 8'd2:     row = plus(NEXT, NEXT, NEXT, 3'd1);
      GUESS + 8'd3:     row = minus(NEXT, NEXT, A2, 3'd1);
      GUESS + 8'd4:     row = plus(NEXT, NEXT, NEXT, 3'd1);
      GUESS + 8'd5:     row = minus(NEXT, NEXT, A3, 3'd1);
      GUESS + 8'd6:     row = plus(NEXT, NEXT, NEXT, 3'd1);
      GUESS + 8'd7:     row = minus(NEXT, NEXT, A4, 3'd1);
      GUESS + 8'd8:     row = minus(NEXT, NEXT, A5, 3'd1);
      GUESS + 8'd9:     row = copy(NEXT, NEXT, 3'd3) | WIDEN_2;
      GUESS + 8'd10:    row = jump_if(ALWAYS, SCALE);
      // The word is 32 times the acceleration, and its CRC.
      KNOWN:            row = copy(NEXT, WORD, 3'd3) | WIDEN_2;
      // Both are divided by 32: eight times as much, and a byte less.
      SCALE:            row = plus(NEXT, NEXT, NEXT, 3'd3);
      SCALE + 8'd1:     row = plus(NEXT, NEXT, NEXT, 3'd3);
      SCALE + 8'd2:     row = plus(NEXT, NEXT, NEXT, 3'd3) | DOWN;
      SCALE + 8'd3:     row = jump_if(GOOD, ADD);
      // The guess is kept from -1024 to 1023.
      BOUND:            row = plus(NEXT, NEXT, A0, 3'd2);
      BOUND + 8'd1:     row = minus(NOWHERE, HIGHEST, NEXT, 3'd2);
      BOUND + 8'd2:     row = jump_unless(NEGATIVE, BOUND + 8'd4);
      BOUND + 8'd3:     row = copy(NEXT, HIGHEST, 3'd2);
      BOUND + 8'd4:     row = plus(NOWHERE, NEXT, HIGHEST, 3'd2) | PLUS_1;
      BOUND + 8'd5:     row = jump_unless(NEGATIVE, BOUND + 8'd7);
      BOUND + 8'd6:     row = not_of(NEXT, HIGHEST, 3'd2);
      // A loss opens, or alignment begins anew.
      MISSED:           row = jump_unless(RECOVER, MISSED + 8'd2);
      MISSED + 8'd1:    row = jump_in(ALIGNED, MISSED + 8'd3);
      MISSED + 8'd2:    row = set(FIRST, ADD);
      MISSED + 8'd3:    row = zeros(SINCE, 3'd0) | PLUS_1;
      MISSED + 8'd4:    row = set(LOST, ADD);
      // Sums of the frame, and what stays as it is.
      ADD:              row = copy(A5, A4, 3'd1);
      ADD + 8'd1:       row = copy(A4, A3, 3'd1);
      ADD + 8'd2:       row = copy(A3, A2, 3'd1);
      ADD + 8'd3:       row = copy(A2, A1, 3'd1);
      ADD + 8'd4:       row = copy(A1, A0, 3'd1);
      ADD + 8'd5:       row = copy(A0, NEXT, 3'd2);
      ADD + 8'd6:       row = plus(SPEED, SPEED, NEXT, 3'd4) | WIDEN_3;
      ADD + 8'd7:       row = plus(FAST, FAST, SPEED, 3'd4);
      ADD + 8'd8:       row = masked(FAST, FAST, MASK, 3'd4);
      ADD + 8'd9:       row = plus(MOVED, MOVED, SPEED, 3'd4);
      ADD + 8'd10:      row = copy(AGES, AGES, 3'd3) | PLUS_1;
      ADD + 8'd11:      row = jump_unless(CARRY, ADD + 8'd13);
      ADD + 8'd12:      row = ones(AGES, 3'd3);
      ADD + 8'd13:      row = copy(AGES, AGES, 3'd3) | PLUS_1 | UPPER;
      ADD + 8'd14:      row = jump_unless(CARRY, ADD + 8'd16);
      ADD + 8'd15:      row = ones(AGES, 3'd3) | UPPER;
      ADD + 8'd16:      row = copy(SAFE1, SAFE1, 3'd7);
      ADD + 8'd17:      row = copy(SAFE2, SAFE2, 3'd7);
      // The frame ends.
      WAIT:             row = jump_if(FRAME, WAIT);
      WAIT + 8'd1:      row = jump_unless(VERTICAL, COMPARE);
      // A vertical frame ends.
      SAFE:             row = jump_unless(NEW1, SAFE + 8'd3);
      SAFE + 8'd1:      row = copy(SAFE1, BYTES1, 3'd7);
      SAFE + 8'd2:      row = zeros(AGES, 3'd3);
      SAFE + 8'd3:      row = jump_unless(NEW2, SAFE + 8'd6);
      SAFE + 8'd4:      row = copy(SAFE2, BYTES2, 3'd7);
      SAFE + 8'd5:      row = zeros(AGES, 3'd3) | UPPER;
      SAFE + 8'd6:      row = jump_in(LOST, KEEP);
      SAFE + 8'd7:      row = jump_unless(NEW1, WITHOUT);
      SAFE + 8'd8:      row = jump_in(SECOND, OFF);
      SAFE + 8'd9:      row = jump_in(MENDING, OFF);
      SAFE + 8'd10:     row = plus(WRONG, SAFE1, MOVED, 3'd4);
      SAFE + 8'd11:     row = masked(WRONG, WRONG, MASK, 3'd4);
      SAFE + 8'd12:     row = jump_in(FIRST, PLACE);
      SAFE + 8'd13:     row = jump_in(THIRD, PAUSE);
      SAFE + 8'd14:     row = minus(NOWHERE, WRONG, FAST, 3'd4);
      SAFE + 8'd15:     row = jump_unless(ZERO, UNLIKE);
      SAFE + 8'd16:     row = set(ALIGNED, ENDED);
      PLACE:            row = copy(FAST, WRONG, 3'd4);  // the position is set
      PLACE + 8'd1:     row = copy(KEPT, WRONG, 3'd4);
      PLACE + 8'd2:     row = set(SECOND, ENDED);
      PAUSE:            row = set(FOURTH, ENDED);  // nothing is done
      WITHOUT:          row = jump_in(FOURTH, ENDED);  // there is no safe position
      WITHOUT + 8'd1:   row = jump_in(ALIGNED, ENDED);
      FAIL:             row = set(FIRST, ENDED);  // alignment begins anew
      UNLIKE:           row = set(FIRST, ENDED) | STALE_NOW;
      // The vertical frame of a loss ends.
      KEEP:             row = copy(KEPT, FAST, 3'd4);
      KEEP + 8'd1:      row = copy(BY, SINCE, 3'd0);
      KEEP + 8'd2:      row = set(MENDING, ENDED);
      // The distance from the safe position to the one that was kept, with its sign.
      OFF:              row = minus(WRONG, SAFE1, KEPT, 3'd4);
      OFF + 8'd1:       row = masked(WRONG, WRONG, MASK, 3'd4);
      OFF + 8'd2:       row = masked(NOWHERE, WRONG, TOP, 3'd4);
      OFF + 8'd3:       row = jump_if(ZERO, OFF + 8'd5);
      OFF + 8'd4:       row = plus_not(WRONG, WRONG, MASK, 3'd4);
      OFF + 8'd5:       row = jump_in(MENDING, MEND);
      // The speed gets an eighth of it, the position twice as much as it.
      CORRECT:          row = plus(WRONG, WRONG, WRONG, 3'd4);
      CORRECT + 8'd1:   row = plus(FAST, FAST, WRONG, 3'd4);
      CORRECT + 8'd2:   row = masked(FAST, FAST, MASK, 3'd4);
      CORRECT + 8'd3:   row = plus(WRONG, WRONG, WRONG, 3'd4);
      CORRECT + 8'd4:   row = plus(WRONG, WRONG, WRONG, 3'd4);
      CORRECT + 8'd5:   row = plus(WRONG, WRONG, WRONG, 3'd4);
      CORRECT + 8'd6:   row = plus(WRONG, WRONG, WRONG, 3'd4) | DOWN;
      CORRECT + 8'd7:   row = plus(SPEED, SPEED, WRONG, 3'd4) | WIDEN_3;
      CORRECT + 8'd8:   row = set(THIRD, ENDED);
      // It is divided by BY: bits of EACH go into the rest, those of the quotient follow them.
      MEND:             row = copy(EACH, WRONG, 3'd4);
      MEND + 8'd1:      row = jump_unless(NEGATIVE, MEND + 8'd3);
      MEND + 8'd2:      row = negative_of(EACH, WRONG, 3'd4);
      MEND + 8'd3:      row = minus(NOWHERE, SHORT, EACH, 3'd4);
      MEND + 8'd4:      row = jump_unless(CARRY, FAIL);
      MEND + 8'd5:      row = zeros(REST, 3'd0);
      MEND + 8'd6:      row = zeros(LEFT, 3'd0) | PLUS_1;
      MEND + 8'd7:      row = plus(LEFT, LEFT, LEFT, 3'd0);
      MEND + 8'd8:      row = plus(LEFT, LEFT, LEFT, 3'd0);
      MEND + 8'd9:      row = plus(LEFT, LEFT, LEFT, 3'd0);
      MEND + 8'd10:     row = plus(LEFT, LEFT, LEFT, 3'd0);
      MEND + 8'd11:     row = plus(EACH, EACH, EACH, 3'd1) | CARRIED;
      MEND + 8'd12:     row = plus(REST, REST, REST, 3'd0) | CARRIED;
      MEND + 8'd13:     row = minus(REST, REST, BY, 3'd0) | FITS;
      MEND + 8'd14:     row = less_1(LEFT, LEFT, 3'd0) | HOLD;
      MEND + 8'd15:     row = jump_unless(ZERO, MEND + 8'd11);
      MEND + 8'd16:     row = plus(EACH, EACH, EACH, 3'd1) | CARRIED;
      MEND + 8'd17:     row = copy(NOWHERE, REST, 3'd0);
      MEND + 8'd18:     row = jump_unless(ZERO, FAIL);
      MEND + 8'd19:     row = plus(LEFT, HIGHEST, HIGHEST, 3'd1) | PLUS_1;
      MEND + 8'd20:     row = minus(NOWHERE, LEFT, EACH, 3'd1);
      MEND + 8'd21:     row = jump_unless(CARRY, FAIL);
      // The speed is off by EACH; the position by WRONG, and by EACH in eight frames more.
      MENDED:           row = copy(NOWHERE, WRONG, 3'd4);
      MENDED + 8'd1:    row = jump_unless(NEGATIVE, MENDED + 8'd3);
      MENDED + 8'd2:    row = negative_of(EACH, EACH, 3'd1);
      MENDED + 8'd3:    row = copy(EACH, EACH, 3'd4) | WIDEN_2;
      MENDED + 8'd4:    row = plus(SPEED, SPEED, EACH, 3'd4) | WIDEN_3;
      MENDED + 8'd5:    row = plus(FAST, FAST, WRONG, 3'd4);
      MENDED + 8'd6:    row = plus(EACH, EACH, EACH, 3'd4);
      MENDED + 8'd7:    row = plus(EACH, EACH, EACH, 3'd4);
      MENDED + 8'd8:    row = plus(EACH, EACH, EACH, 3'd4);
      MENDED + 8'd9:    row = plus(FAST, FAST, EACH, 3'd4);
      MENDED + 8'd10:   row = masked(FAST, FAST, MASK, 3'd4);
      MENDED + 8'd11:   row = set(ALIGNED, ENDED);
      // The vertical frame is done.
      ENDED:            row = zeros(MOVED, 3'd4);
      ENDED + 8'd1:     row = jump_unless(STALE, SHOW);
      ENDED + 8'd2:     row = set(FIRST, SHOW);
      // The frame behind a vertical frame: position 1 is shifted right to the bits of position 2,
      // and so is the mask. LEFT is how far, less 8 from PART on.
      COMPARE:          row = jump_unless(CHECK, SHOW);
      COMPARE + 8'd1:   row = take(LEFT, IN_WIDTH, 3'd0);
      COMPARE + 8'd2:   row = take(REST, IN_BITS, 3'd0);
      COMPARE + 8'd3:   row = minus(LEFT, LEFT, REST, 3'd0);
      COMPARE + 8'd4:   row = jump_if(CARRY, COMPARE + 8'd6);
      COMPARE + 8'd5:   row = zeros(LEFT, 3'd0);
      COMPARE + 8'd6:   row = masked(WRONG, SAFE1, MASK, 3'd5);
      COMPARE + 8'd7:   row = copy(EACH, MASK, 3'd5);
      SHIFT:            row = copy(NOWHERE, LEFT, 3'd0);
      SHIFT + 8'd1:     row = jump_if(ZERO, AGREE);
      SHIFT + 8'd2:     row = minus(LEFT, LEFT, EIGHT, 3'd0);
      SHIFT + 8'd3:     row = jump_unless(CARRY, PART);
      SHIFT + 8'd4:     row = copy(WRONG, WRONG, 3'd5) | DOWN;
      SHIFT + 8'd5:     row = copy(EACH, EACH, 3'd5) | DOWN;
      SHIFT + 8'd6:     row = jump_if(ALWAYS, SHIFT);
      PART:             row = plus(WRONG, WRONG, WRONG, 3'd5);
      PART + 8'd1:      row = plus(EACH, EACH, EACH, 3'd5);
      PART + 8'd2:      row = copy(LEFT, LEFT, 3'd0) | PLUS_1;
      PART + 8'd3:      row = jump_unless(ZERO, PART);
      PART + 8'd4:      row = copy(WRONG, WRONG, 3'd5) | DOWN;
      PART + 8'd5:      row = copy(EACH, EACH, 3'd5) | DOWN;
      // Position 2 has come inverted. Both may differ by the tolerance, modulo their bits.
      AGREE:            row = zeros(REST, 3'd4);
      AGREE + 8'd1:     row = take(REST, IN_TOLERANCE, 3'd0);
      AGREE + 8'd2:     row = plus(WRONG, WRONG, SAFE2, 3'd4) | PLUS_1;
      AGREE + 8'd3:     row = plus(WRONG, WRONG, REST, 3'd4);
      AGREE + 8'd4:     row = masked(WRONG, WRONG, EACH, 3'd4);
      AGREE + 8'd5:     row = plus(REST, REST, REST, 3'd4);
      AGREE + 8'd6:     row = minus(NOWHERE, REST, WRONG, 3'd4);
      AGREE + 8'd7:     row = jump_if(CARRY, SHOW);
      AGREE + 8'd8:     row = set(MISMATCH, SHOW);
      // The position as 64 bits, by its sign if it has one.
      SHOW:             row = copy(WIDE, FAST, 3'd7);
      SHOW + 8'd1:      row = jump_unless(SIGNED, STATUS);
      SHOW + 8'd2:      row = masked(NOWHERE, FAST, TOP, 3'd4);
      SHOW + 8'd3:      row = jump_if(ZERO, STATUS);
      SHOW + 8'd4:      row = plus_not(WIDE, WIDE, MASK, 3'd7);
      STATUS:           row = take(COUNT, IN_STATUS, 3'd3) | UPPER;  // its last value
      STATUS + 8'd1:    row = tell(1'b0);
      IDLE:             row = jump_if(FRAME, BEGIN);  // waits
      IDLE + 8'd1:      row = jump_if(BEGUN, LINK);
      IDLE + 8'd2:      row = jump_if(OVER, CLOSE);
      IDLE + 8'd3:      row = jump_if(ALWAYS, IDLE);
      // The link is over: no safe position is young. The first row gives dsl_record time.
      CLOSE:            row = copy(NOWHERE, FAST, 3'd7);
      CLOSE + 8'd1:     row = ones(AGES, 3'd7);
      CLOSE + 8'd2:     row = copy(FAST, FAST, 3'd4);
      CLOSE + 8'd3:     row = copy(SPEED, SPEED, 3'd4);
      CLOSE + 8'd4:     row = copy(COUNT, COUNT, 3'd3);
      CLOSE + 8'd5:     row = copy(TIME, TIME, 3'd7);
      CLOSE + 8'd6:     row = copy(SAFE1, SAFE1, 3'd7);
      CLOSE + 8'd7:     row = copy(SAFE2, SAFE2, 3'd7);
      CLOSE + 8'd8:     row = copy(WIDE, WIDE, 3'd7);
      CLOSE + 8'd9:     row = take(COUNT, IN_STATUS, 3'd3) | UPPER;
      CLOSE + 8'd10:    row = tell(1'b1);
      CLOSE + 8'd11:    row = jump_if(ALWAYS, IDLE);
      default:          row = jump_if(ALWAYS, IDLE);
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (enable_i) row_q <= row;
  end

  assign row_o = row_q;

endmodule
