// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks of dsl_vertical. The bench sends frames as the line does: six words and an end, nine clocks
// or more apart, with any bytes, errors and special characters; in running frames the place counts. A
// link begins four clocks or more behind the end of a frame.
// It divides by the polynomials bit by bit, as the definition says, and compares whole bytes with
// the remainder: byte 6 with its upper half, byte 7 with the inverse of its lower one, the last five
// bits of the acceleration with the inverse of theirs. Words of the other channel leave a remainder.
//
// The link obeys: after verdict_o.missing no frame runs before the next link.
//
// claim: a safe channel is good if and only if no word had an error of its code, no special character but K28 came, and
//   bytes 6 and 7 are the remainder of bytes 0 to 5 by x^16 + x^15 + x^12 + x^7 + x^6 + x^4 + x^3 + 1, the last one
//   inverted; an acceleration if and only if its words are good and its five bits are the inverted remainder of the eleven
//   others by x^5 + x^2 + 1; the count of missing ones never passes its limit, 0 being as 1; a good safe position 1 is a
//   misfit if and only if a bit above the width differs from its highest bit, or without a sign from 0; K29.7 in the
//   acceleration, and nothing else, marks it
// clocks: one
// depth: 30
// cover: 70
// unbounded: induction 1
// look: rem1 = u_dut.u_crc1.rem_q
// look: rem2 = u_dut.u_crc2.rem_q
// look: rem5 = u_dut.u_crc5.rem_q
// look: byte_in = u_dut.byte_q
// look: bit_in = u_dut.bit_q
// look: shift = u_dut.shift_q
// look: code1 = u_dut.code1_q
// look: mark1 = u_dut.mark1_q
// look: crc1 = u_dut.crc1_q
// look: code2 = u_dut.code2_q
// look: mark2 = u_dut.mark2_q
// look: crc2 = u_dut.crc2_q
// look: bad = u_dut.bad_q
// look: marked = u_dut.marked_q
// look: wide = u_dut.wide1_q
// look: before = u_dut.before_q
// look: event1 = u_dut.event1_q
// look: event2 = u_dut.event2_q
// mutation: dsl/dsl_vertical.sv | localparam logic [7:0] POLY5       = 8'h05; | localparam logic [7:0] POLY5       = 8'h03;
// mutation: dsl/dsl_crc16.sv | POLY = 16'h90D9; | POLY = 16'h90DB;
// mutation: dsl/dsl_vertical.sv | if (vertical  && top1 == (level ^ last ^ 1'b1)) | if (vertical  && top1 == (level ^ 1'b1))
// mutation: dsl/dsl_vertical.sv | .shift_i (shift_q && secondary), | .shift_i (shift_q && !acceleration),
// mutation: dsl/dsl_vertical.sv | bit_q >= CRC5_BIT; | bit_q > CRC5_BIT;
// mutation: dsl/dsl_vertical.sv | if (shift_q && crc5_part && top5 == level) bad_q | if (shift_q && crc5_part && top5 != level) bad_q
// mutation: dsl/dsl_vertical.sv | else if (bit_q == 3'd7) shift_q | else if (bit_q == 3'd6) shift_q
// mutation: dsl/dsl_vertical.sv | whole        = answer_i.ends && (last || !answer_i.running) | whole        = answer_i.ends && last
// mutation: dsl/dsl_vertical.sv | safe1_valid_q <= !code1_q && !crc1_q && !mark1_q; | safe1_valid_q <= !code1_q && !crc1_q;
// mutation: dsl/dsl_vertical.sv | bad_q ? missing_q + 5'd1 : 5'd0; | bad_q ? missing_q + 5'd1 : missing_q;
// mutation: dsl/dsl_vertical.sv | ABOVE       = 7'd41; | ABOVE       = 7'd42;
// mutation: dsl/dsl_vertical.sv | (top ? signed_i && level : before_q) | (top ? level : before_q)
// mutation: dsl/dsl_vertical.sv | if (shift_q && vertical) before_q <= level; | if (shift_q) before_q <= level;
// mutation: dsl/dsl_vertical.sv | && missing_q != 5'd0; | ;
// mutation: dsl/dsl_vertical.sv | if (mark && answer_i.word.data == MARKER) | if (answer_i.word.data == MARKER)
// mutation: dsl/dsl_vertical.sv | event1_q <= answer_i.word.error && !code1_q; | event1_q <= answer_i.word.error;

module proof (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             next_i,      // the next word, or the end
  input logic             runs_i,      // the next frame is a running one
  input logic             begins_i,
  input logic [7:0]       data_i,
  input logic             error_i,
  input logic             special_i
);

  (* anyconst *) logic       strict;
  (* anyconst *) logic       firmware;
  (* anyconst *) logic [4:0] limit;
  (* anyconst *) logic       strict_id;
  (* anyconst *) logic       has_sign;
  (* anyconst *) logic [5:0] less8;      // width of the position

  // ---- The line ----------------------------------------------------------------------------------

  localparam logic [3:0] FAR = 4'd9;

  logic       started = 1'b0;
  logic [3:0] gap_q;         // clocks since the last word or end, up to 9
  logic [2:0] word_q;        // number of the next one; 6: the end
  logic [2:0] last_q;        // number of the last one
  logic       running_q;
  logic [2:0] place_q;
  logic       valid, ends, begins;
  logic [7:0] data_q;
  logic       error_q, special_q;
  logic       stops_q;       // the link does, up to the next one

  dsl_pkg::quirks_t  quirks;
  dsl_pkg::answer_t  answer;
  dsl_pkg::verdict_t verdict;
  dsl_pkg::told_t    told;

  assign valid  = next_i && gap_q == FAR && word_q != 3'd6;
  assign ends   = next_i && gap_q == FAR && word_q == 3'd6;
  assign begins = begins_i && gap_q >= 4'd4 && word_q == 3'd0 && !valid && !running_q;

  always @* begin
    quirks             = '0;
    quirks.strict_code = strict;
    quirks.strict_id   = strict_id;
    quirks.rules       = firmware ? dsl_pkg::FIRMWARE : dsl_pkg::SICK;
    answer             = '0;
    answer.linked      = 1'b1;
    answer.begins      = begins;
    answer.running     = running_q;
    answer.place       = place_q;
    answer.valid       = valid;
    answer.number      = valid ? word_q : last_q;
    answer.word.data    = valid ? data_i : data_q;
    answer.word.error   = valid ? error_i : error_q;
    answer.word.special = valid ? special_i : special_q;
    answer.ends        = ends;
    assume (rst_ni == started);
    assume (less8 <= 6'd32);
  end

  dsl_vertical u_dut (
    .clk_i, .rst_ni,
    .quirks_i  (quirks),
    .limit_i   (limit),
    .width_i   (less8),
    .signed_i  (has_sign),
    .answer_i  (answer),
    .verdict_o (verdict),
    .told_o    (told)
  );

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {gap_q, word_q, last_q, running_q, place_q} <= {FAR, 3'd0, 3'd0, 1'b0, 3'd0};
      {data_q, error_q, special_q, stops_q}       <= '0;
    end else begin
      if (valid || ends)     gap_q <= 4'd1;
      else if (gap_q != FAR) gap_q <= gap_q + 4'd1;
      if (valid) begin
        {data_q, error_q, special_q} <= {data_i, error_i, special_i};
        word_q <= word_q + 3'd1;
        last_q <= word_q;
      end
      if (ends) begin
        word_q    <= 3'd0;
        running_q <= runs_i && !missing_next && !stops_q;
        place_q   <= running_q ? place_q + 3'd1 : 3'd0;
        if (running_q && !(runs_i && !missing_next)) place_q <= 3'd0;
        if (missing_next) stops_q <= 1'b1;
      end
      if (begins) stops_q <= 1'b0;
    end
  end
  always @(posedge clk_i) started <= 1'b1;

  // ---- What has to be told -----------------------------------------------------------------------

  // One bit into a division.
  function [15:0] divide16(input [15:0] rest, input in);
    divide16 = {rest[14:0], 1'b0} ^ (rest[15] ^ in ? 16'h90D9 : 16'h0000);
  endfunction
  function [4:0] divide5(input [4:0] rest, input in);
    divide5 = {rest[3:0], 1'b0} ^ (rest[4] ^ in ? 5'h05 : 5'h00);
  endfunction

  logic [15:0] r1_q, r2_q;     // remainders of bytes 0 to 5
  logic [4:0]  r5_q;           // remainder of the eleven bits
  logic        high_seen_q;    // the acceleration is not 0
  logic        w1_q, w2_q;     // byte 6 or 7 was wrong
  logic        c1_q, c2_q, m1_q, m2_q, bad_word_q;
  logic        e1_q, e2_q;     // of this frame
  logic [4:0]  count_q;        // missing
  logic        v1_q, v2_q, x1_q, x2_q, s1_q, g1_q, s2_q;
  logic        mark, missing_next;
  logic        many_q;         // the count reached the limit a clock before
  logic        sign_q;         // bit 39 of safe position 1
  logic        above_q;        // a bit above the width is wrong
  logic        fits_not_q;     // verdict.misfit
  logic        marked_q;
  logic [4:0]  most;           // missing ones
  logic [7:0]  want1, want2;

  assign mark  = special_i && !error_i && data_i[4:0] != 5'd28;
  assign want1 = place_q == 3'd6 ? r1_q[15:8] : ~r1_q[7:0];
  assign want2 = place_q == 3'd6 ? r2_q[15:8] : ~r2_q[7:0];

  logic [15:0] t1, t2;
  logic [4:0]  t5;
  always @* begin
    t1 = r1_q;
    t2 = r2_q;
    t5 = word_q == 3'd3 ? 5'd0 : r5_q;
    for (int i = 7; i >= 0; i--) begin
      t1 = divide16(t1, data_i[i]);
      t2 = divide16(t2, data_i[i]);
      if (word_q == 3'd3 || i >= 5) t5 = divide5(t5, data_i[i]);
    end
  end

  assign most         = limit == 5'd0 ? 5'd1 : limit;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) many_q <= 1'b0;
    else         many_q <= count_q >= most;
  end
  assign missing_next = running_q && (bad_word_q ? count_q + 5'd1 : 5'd0) >= most;

  // Bits of this byte of safe position 1, and what they have to be where the position has none.
  logic [5:0] bit_number;
  logic       should, wrong_above;
  always @* begin
    wrong_above = 1'b0;
    should      = has_sign && (place_q == 3'd1 ? data_i[7] : sign_q);
    for (int i = 7; i >= 0; i--) begin
      bit_number = 6'd40 - {place_q, 3'd0} + 6'(i);
      if (bit_number >= less8 + 6'd8 - {5'd0, has_sign} && data_i[i] != should) wrong_above = 1'b1;
    end
  end

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {r1_q, r2_q, r5_q, w1_q, w2_q}                <= '0;
      {c1_q, c2_q, m1_q, m2_q, bad_word_q}          <= '0;
      {e1_q, e2_q, count_q, high_seen_q}            <= '0;
      {v1_q, v2_q, x1_q, x2_q, s1_q, g1_q, s2_q}    <= '0;
      {sign_q, above_q, fits_not_q, marked_q}       <= '0;
    end else begin
      if (valid && word_q == 3'd0) begin
        if (place_q < 3'd6)       r1_q <= t1;
        else if (data_i != want1) w1_q <= 1'b1;
        e1_q <= error_i && !c1_q;
        if (error_i) c1_q <= 1'b1;
        if (mark)    m1_q <= 1'b1;
        {bad_word_q, marked_q} <= '0;
        if (place_q == 3'd1) sign_q <= data_i[7];
        if (place_q >= 3'd1 && place_q <= 3'd5 && wrong_above) above_q <= 1'b1;
      end
      if (valid && word_q == 3'd5) begin
        if (place_q < 3'd6)       r2_q <= t2;
        else if (data_i != want2) w2_q <= 1'b1;
        e2_q <= (error_i && !c2_q) || (firmware && place_q == 3'd0 && data_i[6]);
        if (error_i) c2_q <= 1'b1;
        if (mark)    m2_q <= 1'b1;
      end
      if (valid && (word_q == 3'd3 || word_q == 3'd4)) begin
        r5_q <= t5;
        if (word_q == 3'd3) high_seen_q <= data_i != 8'd0;
        if (error_i || (strict && mark))                     bad_word_q <= 1'b1;
        if (special_i && !error_i && data_i == 8'hFD)        marked_q <= 1'b1;
        if (word_q == 3'd4 && data_i[4:0] != ~t5)            bad_word_q <= 1'b1;
      end
      if (ends && (!running_q || place_q == 3'd7)) begin
        {r1_q, r2_q, w1_q, w2_q} <= '0;
        {c1_q, c2_q, m1_q, m2_q} <= '0;
        above_q                  <= 1'b0;
      end
      if (begins) begin
        {count_q, v1_q, v2_q, x1_q, x2_q} <= '0;
      end else if (ends && running_q) begin
        count_q <= bad_word_q ? count_q + 5'd1 : 5'd0;
        s1_q    <= e1_q || (place_q == 3'd7 && !c1_q && w1_q);
        g1_q    <= place_q == 3'd7 && !c1_q && !w1_q;
        fits_not_q <= strict_id && place_q == 3'd7 && !c1_q && !w1_q && !m1_q && above_q;
        s2_q    <= e2_q || (place_q == 3'd7 && !c2_q && w2_q && !firmware);
        if (place_q == 3'd7) begin
          {v1_q, x1_q} <= {!c1_q && !w1_q && !m1_q, c1_q || w1_q};
          {v2_q, x2_q} <= {!c2_q && !w2_q && !m2_q, c2_q || w2_q};
        end
      end
    end
  end

  always @* if (started) begin
    Valid1_A:  assert (told.safe1_valid == v1_q && told.safe1_error == x1_q);
    Valid2_A:  assert (told.safe2_valid == v2_q && told.safe2_error == x2_q);
    Verdict_A: assert (verdict.safe1_error == s1_q && verdict.safe1_good == g1_q
                       && verdict.safe2_error == s2_q);
    Missing_A: assert (told.missing == count_q && verdict.missing == many_q);
    Limit_A:   assert (count_q <= most);
    Below_A:   assert (stops_q || count_q < most);
    Misfit_A:  assert (verdict.misfit == fits_not_q);
    if (gap_q == FAR && word_q == 3'd5) Good_A: assert (told.acceleration_good == !bad_word_q);
    if (word_q >= 3'd5) Marked_A: assert (told.acceleration_marked == marked_q);
  end

  // ---- For the induction -------------------------------------------------------------------------

  wire [15:0] rem1, rem2, rem5;
  wire [7:0]  byte_in;
  wire [2:0]  bit_in;
  wire        shift, code1, mark1, crc1, code2, mark2, crc2, bad, event1, event2;
  wire        marked, wide, before;

  // Bits of the last word that are still to come stand in byte_in; the remainders with all of them are
  // those of the bench.
  logic [3:0]  left;
  logic [15:0] u1, u2;
  logic [4:0]  u5;
  logic        n1, n2, nb;
  always @* begin
    left = shift ? 4'd8 - {1'b0, bit_in} : 4'd0;
    {u1, u2, u5} = {rem1, rem2, rem5[4:0]};
    {n1, n2, nb} = {crc1, crc2, bad};
    for (int i = 0; i < 8; i++) if (i < left) begin
      if (last_q == 3'd0 && place_q < 3'd6) u1 = divide16(u1, byte_in[7 - i]);
      if (last_q == 3'd5 && place_q < 3'd6) u2 = divide16(u2, byte_in[7 - i]);
      if (last_q == 3'd0 && place_q >= 3'd6) begin
        if (byte_in[7 - i] != (u1[15] ^ (place_q == 3'd7))) n1 = 1'b1;
        u1 = {u1[14:0], 1'b0};
      end
      if (last_q == 3'd5 && place_q >= 3'd6) begin
        if (byte_in[7 - i] != (u2[15] ^ (place_q == 3'd7))) n2 = 1'b1;
        u2 = {u2[14:0], 1'b0};
      end
      if (last_q == 3'd3 || (last_q == 3'd4 && bit_in + i < 3)) u5 = divide5(u5, byte_in[7 - i]);
      if (last_q == 3'd4 && bit_in + i >= 3) begin
        if (byte_in[7 - i] == u5[4]) nb = 1'b1;
        u5 = {u5[3:0], 1'b0};
      end
    end
  end

  // Bits of safe position 1: {place, bit} is 8 for bit 39, and less than 49 - width above the position.
  logic [5:0] at, seen;        // of a bit, of the last one that has been compared
  logic       nw, previous;
  always @* begin
    nw       = wide;
    previous = before;
    for (int i = 0; i < 8; i++) if (i < left && last_q == 3'd0) begin
      at = {place_q, bit_in + 3'(i)};
      if (place_q != 3'd0 && {1'b0, at} + less8 + !has_sign < 7'd41
          && byte_in[7 - i] != (at == 6'd8 ? has_sign && byte_in[7 - i] : previous)) nw = 1'b1;
      previous = byte_in[7 - i];
    end
    seen = last_q == 3'd0 && shift ? {place_q, bit_in} - 6'd1
         : {place_q, 3'd0} + (word_q != 3'd0 ? 6'd7 : 6'd63);
  end

  // A remainder that has been compared is shifted out: byte 6, byte 7.
  logic       whole1, whole2;
  assign whole1 = word_q != 3'd0;                  // this frame's byte has come
  assign whole2 = word_q == 3'd6;

  always @* if (started) begin
    Gap_A:    assert (gap_q >= 4'd1 && gap_q <= FAR && word_q <= 3'd6 && last_q <= 3'd5);
    Order_A:  assert (word_q == 3'd0 || last_q == word_q - 3'd1);
    Count_A:  assert (!shift || (gap_q >= 4'd1 && {1'b0, bit_in} + 4'd1 == gap_q && word_q != 3'd0));
    Rest_A:   assert (shift || bit_in == 3'd0);
    Busy_A:   assert (word_q == 3'd0 || shift || gap_q == FAR);
    Wide_A:   assert (nw == above_q);
    Mark_A:   assert (marked == marked_q);
    if (running_q && place_q == 3'd1 && last_q == 3'd0 && shift && bit_in == 3'd0) First_A: assert (byte_in[7] == sign_q);
    if (running_q && seen >= 6'd8 && {1'b0, seen} + less8 + !has_sign < 7'd41)
      Before_A: assert (wide || before == (has_sign && sign_q));
    Place_A:  assert (running_q || place_q == 3'd0);
    Stops_A:  assert (!(stops_q && running_q));
    Code_A:   assert (code1 == c1_q && mark1 == m1_q && code2 == c2_q && mark2 == m2_q);
    Event_A:  assert (event1 == e1_q && event2 == e2_q);
    Wrong_A:  assert (n1 == w1_q && n2 == w2_q && (word_q == 3'd0 || nb == bad_word_q));
    // A frame that does not run clears the remainders at its end.
    Rest1_A:  assert (!running_q || u1 == (place_q < 3'd6 || (place_q == 3'd6 && !whole1) ? r1_q
                           : place_q == 3'd6 || !whole1 ? {r1_q[7:0], 8'd0} : 16'd0));
    Rest2_A:  assert (!running_q || u2 == (place_q < 3'd6 || (place_q == 3'd6 && !whole2) ? r2_q
                           : place_q == 3'd6 || !whole2 ? {r2_q[7:0], 8'd0} : 16'd0));
    if (word_q == 3'd4) Rest5_A: assert (u5 == r5_q);
    if (word_q < 3'd4)  Clear5_A: assert (rem5[4:0] == 5'd0);
    if (word_q == 3'd0) Clean_A: assert (nb == bad);
  end

  always @(posedge clk_i) if (started && rst_ni) begin
    Word_C: cover (word_q == 3'd1 && rem1 != 16'd0 && c1_q);
    Good_C: cover (gap_q == FAR && word_q == 3'd6 && !bad_word_q && high_seen_q);
  end

endmodule
