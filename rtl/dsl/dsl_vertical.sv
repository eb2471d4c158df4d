// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The checks of an answer's words: CRC5 of the acceleration, and over eight frames CRC16 of both
// safe channels. It counts accelerations that are missing one after another.
//
// Clock domain: core. A word is taken with answer_i.valid and needs the nine clocks behind it. From
// the clock behind answer_i.ends on verdict_o and told_o are those of the frame, and one clock
// later verdict_o.missing; a frame that is not running leaves told_o. told_o.acceleration_good and
// _marked are right earlier: from the ninth clock behind the second word of the acceleration on.
//
// A safe channel is good if neither the code of its eight bytes nor their CRC was wrong, and if no
// special character but K28.x was among them: with one the encoder says that it has no position.
// With the strict check such a character makes an acceleration bad too. With the rules of the
// firmware bit TEST2 of the second channel counts for the quality, its CRC does not. In the
// personality of the SDK it is the value of the position's first byte that says so, FDh or FBh.
// told_o.checks is of the last vertical frame: VSYNC, channels, STATUS2 of a good second channel.
// A good safe position 1 whose bits above the width are not as its sign, or 0, is a misfit: then
// the width of the identity is wrong. That is looked at with strict_id.
// Misuse: a word, or `ends`, less than nine clocks behind a word spoils both. A link that goes on
// after verdict_o.missing counts beyond 31, to 0.
// Source: docs/dsl.md, "The protocol"; CRC16 has its last byte inverted.

module dsl_vertical (
  input  logic              clk_i,
  input  logic              rst_ni,
  input  dsl_pkg::quirks_t  quirks_i,
  input  logic [4:0]        limit_i,      // of missing accelerations; 0 is as 1
  input  logic [5:0]        width_i,      // of the position, less 8
  input  logic              signed_i,     // it has a sign
  input  dsl_pkg::answer_t  answer_i,
  output dsl_pkg::verdict_t verdict_o,
  output dsl_pkg::told_t    told_o
);

  localparam logic [2:0] VERTICAL    = 3'd0;
  localparam logic [2:0] PARAMETER   = 3'd1;
  localparam logic [2:0] HIGH_WORD   = 3'd3;
  localparam logic [2:0] LOW_WORD    = 3'd4;
  localparam logic [2:0] SECONDARY   = 3'd5;
  localparam logic [2:0] FIRST_PLACE = 3'd0;
  localparam logic [2:0] CRC_PLACE   = 3'd6;
  localparam logic [2:0] CRC5_BIT    = 3'd3;  // of the low word: the first bit of its CRC
  localparam logic [7:0] POLY5       = 8'h05;
  localparam logic [2:0] POLY5_LAST  = 3'd4;
  localparam logic [4:0] K28         = 5'd28;
  localparam logic [7:0] MARKER      = 8'hFD;
  localparam logic [7:0] MARKER2     = 8'hFB;
  localparam logic [6:0] ABOVE       = 7'd41; // RX0, 40 bits less the 8 of the width, the sign

  // The bits of a word, one a clock.
  logic [7:0] byte_q;
  logic [2:0] bit_q;          // number, the first one is 0
  logic       shift_q;
  logic       level;
  logic       crc16_part;     // the bit is one of a CRC
  logic       crc5_part;
  logic       top1, top2, top5;
  logic       first, last;    // frame of a vertical frame
  logic       vertical, acceleration, secondary;
  logic       mark;           // a special character but K28.x
  logic       marks;          // ... of a safe channel; the SDK looks for a value alone
  logic       firmware;
  logic       whole;          // a vertical frame ends, or none runs
  logic [6:0] number;         // of a bit in the channel, with the width
  logic       unused;
  logic       above;          // the bit is above the position, or its sign
  logic       top;            // ... the first one
  logic       before_q;       // the bit before
  // what has been wrong in this vertical frame
  logic       code1_q, mark1_q, crc1_q, wide1_q;
  logic       code2_q, mark2_q, crc2_q;
  logic       early_q;            // VSYNC was in another frame
  logic       late_q;             // ... in the first one, as it was missing before
  logic       missing1_q;         // it is in the last frame
  logic       missing0_q;         // ... was in that of the vertical frame before
  logic [2:0] status2_q;          // TOG2, TEST2, ERR2 of this vertical frame
  logic       fix2_q;             // FIX2 is another
  logic       toggles_q;          // a good STATUS2 has come in this link
  logic       toggle_q;           // what TOG2 has to be
  logic       good2;              // STATUS2 is
  dsl_pkg::safe_checks_t checks_q;
  // ... in this frame
  logic       event1_q, event2_q;
  logic       bad_q, marked_q;
  logic [4:0] missing_q;
  logic       many_q;             // ... reach the limit, a clock later
  logic       error1_q, good1_q, error2_q;    // verdict_o
  logic       misfit_q;
  logic       safe1_valid_q, safe2_valid_q;   // told_o

  assign first        = answer_i.place == FIRST_PLACE;
  assign last         = answer_i.place == dsl_pkg::LAST_PLACE;
  assign vertical     = answer_i.number == VERTICAL;
  assign acceleration = answer_i.number == HIGH_WORD || answer_i.number == LOW_WORD;
  assign secondary    = answer_i.number == SECONDARY;
  assign mark         = answer_i.word.special && !answer_i.word.error
                     && answer_i.word.data[4:0] != K28;
  always_comb begin
    marks = mark;
    if (quirks_i.sdk_map) begin
      marks = answer_i.place == 3'd1 && !answer_i.word.error
           && answer_i.word.data == (secondary ? MARKER2 : MARKER);
    end
  end
  assign good2        = !code2_q && !crc2_q;
  assign firmware     = quirks_i.rules == dsl_pkg::FIRMWARE;
  assign whole        = answer_i.ends && (last || !answer_i.running);
  assign level        = byte_q[7];
  assign crc16_part   = answer_i.place >= CRC_PLACE;
  assign crc5_part    = answer_i.number == LOW_WORD && bit_q >= CRC5_BIT;
  // RX1 begins with bit 39. Those above the position are 0, or with a sign all as the sign is.
  assign {number, unused} = {1'b0, answer_i.place, bit_q, 1'b1} + {1'b0, width_i, !signed_i};
  assign above        = shift_q && vertical && !first && number < ABOVE;
  assign top          = {answer_i.place, bit_q} == {3'd1, 3'd0};

  dsl_crc16 u_crc1 (
    .clk_i,
    .load_i  (whole),
    .shift_i (shift_q && vertical),
    .feed_i  (!crc16_part),
    .bit_i   (level),
    .top_o   (top1)
  );

  dsl_crc16 u_crc2 (
    .clk_i,
    .load_i  (whole),
    .shift_i (shift_q && secondary),
    .feed_i  (!crc16_part),
    .bit_i   (level),
    .top_o   (top2)
  );

  enc_crc u_crc5 (
    .clk_i,
    .rst_ni,
    .crc16_i (1'b0),
    .poly_i  (POLY5),
    .last_i  (POLY5_LAST),
    .start_i (16'd0),
    .load_i  (answer_i.ends),
    .shift_i (shift_q && acceleration),
    .feed_i  (!crc5_part),
    .bit_i   (level),
    .top_o   (top5)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      byte_q  <= '0;
      bit_q   <= '0;
      shift_q <= 1'b0;
    end else begin
      byte_q <= answer_i.valid ? answer_i.word.data : {byte_q[6:0], 1'b0};
      if (answer_i.valid) shift_q <= 1'b1;
      else if (bit_q == 3'd7) shift_q <= 1'b0;
      bit_q <= answer_i.valid || !shift_q ? 3'd0 : bit_q + 3'd1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {code1_q, mark1_q, crc1_q} <= '0;
      {code2_q, mark2_q, crc2_q} <= '0;
      {event1_q, event2_q}       <= '0;
      {bad_q, marked_q}          <= '0;
      {wide1_q, before_q}        <= '0;
      {early_q, late_q, missing1_q} <= '0;
      {status2_q, fix2_q}        <= '0;
    end else begin
      if (answer_i.valid && vertical) begin
        if (answer_i.word.error) code1_q <= 1'b1;
        if (marks)               mark1_q <= 1'b1;
        event1_q <= answer_i.word.error && !code1_q;
      end
      if (answer_i.valid && secondary) begin
        if (answer_i.word.error) code2_q <= 1'b1;
        if (marks)               mark2_q <= 1'b1;
        event2_q <= (answer_i.word.error && !code2_q)
                 || (firmware && first && answer_i.word.data[6]);
        if (first) begin
          status2_q <= answer_i.word.data[7:5];
          fix2_q    <= answer_i.word.data[4:0] != K28;
        end
      end
      if (answer_i.valid && answer_i.number == PARAMETER && !answer_i.word.error) begin
        if (answer_i.word.data[7] && !last) begin
          if (first && missing0_q) late_q  <= 1'b1;
          else                     early_q <= 1'b1;
        end
        if (!answer_i.word.data[7] && last) missing1_q <= 1'b1;
      end
      if (answer_i.valid && acceleration) begin
        if (answer_i.word.error || (quirks_i.strict_code && mark)) bad_q <= 1'b1;
        if (mark && answer_i.word.data == MARKER)                  marked_q <= 1'b1;
      end
      if (shift_q && crc16_part) begin
        if (vertical  && top1 == (level ^ last ^ 1'b1)) crc1_q <= 1'b1;
        if (secondary && top2 == (level ^ last ^ 1'b1)) crc2_q <= 1'b1;
      end
      if (shift_q && crc5_part && top5 == level) bad_q <= 1'b1;
      if (shift_q && vertical) before_q <= level;
      if (above && level != (top ? signed_i && level : before_q)) wide1_q <= 1'b1;
      if (whole) begin
        {code1_q, mark1_q, crc1_q} <= '0;
        wide1_q                    <= 1'b0;
        {code2_q, mark2_q, crc2_q} <= '0;
        {early_q, late_q, missing1_q} <= '0;
      end
      // The first word of the next frame comes before the acceleration.
      if (answer_i.valid && vertical) {bad_q, marked_q} <= '0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      missing_q                      <= '0;
      {error1_q, good1_q, error2_q}  <= '0;
      misfit_q                       <= 1'b0;
      safe1_valid_q                  <= 1'b0;
      safe2_valid_q                  <= 1'b0;
      {toggles_q, toggle_q}          <= '0;
      missing0_q                     <= 1'b0;
      checks_q                       <= '0;
    end else if (answer_i.begins) begin
      missing_q                      <= '0;
      safe1_valid_q                  <= 1'b0;
      safe2_valid_q                  <= 1'b0;
      toggles_q                      <= 1'b0;
      missing0_q                     <= 1'b0;
      checks_q                       <= '0;
    end else if (answer_i.ends && answer_i.running) begin
      missing_q <= bad_q ? missing_q + 5'd1 : 5'd0;
      error1_q  <= event1_q || (last && !code1_q && crc1_q);
      good1_q   <= last && !code1_q && !crc1_q;
      error2_q  <= event2_q || (last && !code2_q && crc2_q && !firmware);
      misfit_q  <= last && !code1_q && !crc1_q && !mark1_q && wide1_q && quirks_i.strict_id;
      if (last) begin
        safe1_valid_q <= !code1_q && !crc1_q && !mark1_q;
        safe2_valid_q <= good2 && !mark2_q;
        missing0_q    <= missing1_q;
        toggles_q     <= toggles_q || good2;
        toggle_q      <= good2 ? !status2_q[2] : !toggle_q;
        checks_q.vsync_late    <= late_q;
        checks_q.vsync_missing <= missing0_q && !late_q;
        checks_q.vsync_early   <= early_q;
        checks_q.code2         <= code2_q;
        checks_q.code1         <= code1_q;
        checks_q.crc2          <= crc2_q && !code2_q;
        checks_q.crc1          <= crc1_q && !code1_q;
        checks_q.marked2       <= mark2_q;
        checks_q.marked1       <= mark1_q;
        checks_q.fix2          <= good2 && fix2_q;
        checks_q.err2          <= good2 && status2_q[0];
        checks_q.test2         <= good2 && status2_q[1];
        checks_q.tog2          <= good2 && toggles_q && status2_q[2] != toggle_q;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) many_q <= 1'b0;
    else         many_q <= missing_q >= limit_i && missing_q != 5'd0;
  end

  assign verdict_o.safe1_error = error1_q;
  assign verdict_o.safe1_good  = good1_q;
  assign verdict_o.safe2_error = error2_q;
  assign verdict_o.misfit      = misfit_q;
  assign verdict_o.missing     = many_q;

  assign told_o.checks              = checks_q;
  assign told_o.acceleration_good   = !bad_q;
  assign told_o.acceleration_marked = marked_q;
  assign told_o.missing             = missing_q;
  assign told_o.safe1_valid         = safe1_valid_q;
  assign told_o.safe1_error         = checks_q.code1 || checks_q.crc1;
  assign told_o.safe2_valid         = safe2_valid_q;
  assign told_o.safe2_error         = checks_q.code2 || checks_q.crc2;

endmodule
