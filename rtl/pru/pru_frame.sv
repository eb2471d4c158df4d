// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A frame on the line: MA, and what SL says, from the first edge of MA to the last bit.
//
// Clock domain: core; sl_i is asynchronous. start_i begins a frame; MA falls half an MA period
// later. over_o is high for one clock, three clocks behind the last sample; found_o then stays
// until the next start, its point until update_i or forget_i. rests_o: MA does not move; if it is 0
// it has been so for half a period at least. latch_o is high in the clock that ends with the first
// rising edge of MA.
//
// MA has 5 rising edges, one for each period of processing time, one for each bit of position, nE,
// nW and CRC, whatever the line delay. With CDM = 1 the last one is not sent, and MA stays 0 until
// the next frame. MA does not stop before the start bit has come: if the line delay is as long as
// the frame, one or two edges more are sent before the start bit is known.
// A frame ends
// - with its last bit;
// - without acknowledge, when the byte of n = 3 + bits periods, too, has been 0xFF;
// - with more than proc_max_i zeros behind the acknowledge: MA returns to 1 at the end of its half
//   period;
// - by stop_i: MA as before, over_o does not come.
//
// Misuse: start_i while rests_o is 0 or while a frame runs is not allowed: the core does not do it.
// plan_i and proc_max_i must not change while a frame runs.
// Source: TIDEP0022, 3.2.4; docs/pru.md.

`include "enc_check.svh"

module pru_frame #(
  parameter int unsigned ClockHz = 200_000_000
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  pru_pkg::quirks_t quirks_i,
  input  pru_pkg::plan_t plan_i,
  input  logic [9:0] proc_max_i,
  input  logic       start_i,
  input  logic       stop_i,
  // sample points of the frames before
  input  logic       forget_i,
  input  logic       update_i,     // the frame's point is one of those before from now on
  // results
  output logic       over_o,
  output logic       rests_o,
  output logic       latch_o,
  output logic       sl_o,         // synchronised level
  output logic       averages_o,   // the average is on
  output pru_pkg::found_t found_o,
  // pins
  output logic       ma_o,
  input  logic       sl_i
);

  localparam logic [7:0] MORE_EDGES = 8'd5;  // belong to no bit of the word
  localparam logic [6:0] MORE_BYTES = 7'd3;

  typedef enum logic [2:0] {
    REST,
    EDGES,      // the second rising edge of MA has not come
    SEARCH,     // of the acknowledge
    START,      // of the start bit
    CDS,
    POSITION,
    TAIL        // nE, nW, CRC
  } state_e;

  state_e      state_d, state_q;
  logic        first_q;        // one rising edge has come
  logic        second;
  logic        kill_q;         // MA has to return to 1
  logic        lasts_q;        // the half period that runs began with a falling edge of the clock
  logic        ends_ma;
  logic        seen_q;         // the start bit has come, or no acknowledge
  logic [6:0]  bits_q;         // of the word
  logic [7:0]  edges_q;
  logic [7:0]  ahead_q;        // rising edges minus periods of processing
  logic        enough;
  logic        run, sample, sample_last, tick, half_next;
  logic        byte_done, acked, bit_valid, sl_bit;
  logic [3:0]  place, point;
  logic [7:0]  raw;
  logic        valid;
  logic        rise, ma_clocks, ma;
  logic        unused_released, unused_release;
  logic [6:0]  line_q;
  logic [10:0] processing_q;
  logic        zero;           // a period of processing
  logic        one;            // the start bit
  logic        late;           // too much processing time
  logic        longest_q;      // the line delay cannot be longer
  logic        limit_q;        // one period of processing more is too much
  logic        silent;         // no acknowledge
  logic [5:0]  left_q;         // bits of a part that have not come
  logic        last_of_part_q, in_crc_q;
  logic [1:0]  flag_q;         // the next bit of the tail is the first, the second one
  logic        last;
  logic        over;
  logic [62:0] position_q;
  logic [5:0]  crc_q;
  logic        flag_nerr_q, flag_nwarn_q;
  logic        cds_q;
  logic        fits_q;         // the CRC bits so far fit
  logic        late_q;
  logic        has_crc;
  logic        crc_top;

  pru_timebase #(.ClockHz(ClockHz)) u_timebase (
    .clk_i,
    .rst_ni,
    .mhz_i       (plan_i.mhz),
    .run_i       (run),
    .restart_i   (start_i),
    .sample_o    (sample),
    .last_o      (sample_last),
    .tick_o      (tick),
    .half_next_o (half_next)
  );

  biss_ma_drive u_ma (
    .clk_i,
    .rst_ni,
    .por_ni        (rst_ni),
    .tick_i        (tick),
    .half_next_i   (half_next),
    .start_i,
    .begin_i       (start_i),
    .clocked_i     (1'b1),
    .stop_i        (ends_ma && !tick),
    .enough_i      (enough),
    .cdm_i         (plan_i.cdm),
    .high_i        (kill_q),
    .register_i    (1'b0),
    .register_ma_i (1'b1),
    .force_i       (1'b0),
    .force_level_i (1'b1),
    .released_o    (unused_released),
    .release_next_o (unused_release),
    .rise_o        (rise),
    .clocking_o    (ma_clocks),
    .ma_o          (ma)
  );

  biss_os_sampler u_sampler (
    .clk_i,
    .rst_ni,
    .sl_i,
    .sample_i    (sample),
    .last_i      (sample_last),
    .clear_i     (start_i),
    .search_i    (state_q == SEARCH || second),
    .first_low_i (quirks_i.first_low),
    .point_i     (point),
    .sl_o,
    .byte_o      (byte_done),
    .found_o     (acked),
    .raw_o       (raw),
    .place_o     (place),
    .bit_valid_o (bit_valid),
    .bit_o       (sl_bit)
  );

  pru_average u_average (
    .clk_i,
    .rst_ni,
    .clear_i (forget_i),
    .push_i  (update_i && acked),
    .off_i   (plan_i.mhz == pru_pkg::MHZ_10),
    .wrap_i  (quirks_i.sma_wrap),
    .place_i (place),
    .valid_o (valid),
    .point_o (point)
  );

  enc_crc #(.Free(1'b0)) u_crc (
    .clk_i,
    .rst_ni,
    .crc16_i (1'b0),
    .poly_i  (8'h43),
    .last_i  (3'd5),
    .start_i (16'h0000),
    .load_i  (state_q == CDS),
    .shift_i (bit_valid),
    .feed_i  (!in_crc_q),
    .bit_i   (sl_bit),
    .top_o   (crc_top)
  );

  assign run    = state_q != REST || ma_clocks || (!ma && (kill_q || lasts_q));
  // A tick makes its edge: MA keeps the places of its edges to the last one.
  assign ends_ma = stop_i || late || kill_q;
  assign second = state_q == EDGES && rise && first_q;
  assign enough = seen_q && ahead_q >= edges_q;

  assign silent = byte_done && !acked && longest_q;
  assign zero   = state_q == START && bit_valid && !sl_bit;
  assign one    = state_q == START && bit_valid && sl_bit;
  assign late   = zero && limit_q;
  assign has_crc = plan_i.tail_bits > 6'd5;
  assign last = bit_valid && last_of_part_q &&
                ((state_q == POSITION && plan_i.tail_bits == 6'd0) || state_q == TAIL);
  assign over = silent || late || last;

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      REST:     if (start_i) state_d = EDGES;
      EDGES:    if (second) state_d = SEARCH;
      SEARCH:   if (acked) state_d = START;
      START:    if (one) state_d = CDS;
      CDS:      if (bit_valid) state_d = POSITION;
      POSITION: if (bit_valid && last_of_part_q) state_d = TAIL;
      TAIL:;   // up to its last bit
      default:  state_d = REST;
    endcase
    if (over || stop_i) state_d = REST;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q      <= REST;
      first_q      <= 1'b0;
      kill_q       <= 1'b0;
      lasts_q      <= 1'b0;
      seen_q       <= 1'b0;
      ahead_q      <= '0;
      line_q       <= '0;
      processing_q <= '0;
      left_q       <= '0;
    end else begin
      state_q <= state_d;
      first_q <= state_q == EDGES && (first_q || rise);
      kill_q  <= !start_i && (kill_q || stop_i || late);
      if (tick) lasts_q <= ma_clocks && !half_next;
      seen_q  <= !start_i && (seen_q || one || silent);

      if (start_i)           ahead_q <= '0;
      else if (zero != rise) ahead_q <= zero ? ahead_q - 8'd1 : ahead_q + 8'd1;

      if (start_i)                             line_q <= '0;
      else if (byte_done && !acked && !silent) line_q <= line_q + 7'd1;

      if (start_i)   processing_q <= '0;
      else if (zero) processing_q <= processing_q + 11'd1;

      if (state_q == CDS)                   left_q <= plan_i.data_bits;
      else if (bit_valid && last_of_part_q) left_q <= plan_i.tail_bits;
      else if (bit_valid)                   left_q <= left_q - 6'd1;
    end
  end

  // Sums and compares of what stays for two clocks at least before it is used: the plan, and counts
  // that change once a period.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bits_q         <= '0;
      edges_q        <= '0;
      longest_q      <= 1'b0;
      limit_q        <= 1'b0;
      last_of_part_q <= 1'b0;
      in_crc_q       <= 1'b0;
    end else begin
      bits_q         <= {1'b0, plan_i.data_bits} + {1'b0, plan_i.tail_bits};
      edges_q        <= {1'b0, bits_q} + MORE_EDGES - 8'(plan_i.cdm);
      longest_q      <= line_q == bits_q + MORE_BYTES;
      limit_q        <= processing_q == {1'b0, proc_max_i};
      last_of_part_q <= left_q == 6'd1;
      in_crc_q       <= state_q == TAIL && has_crc && left_q < 6'd7;
    end
  end

  // ---- The word -----------------------------------------------------------------------------

  // No reset: a frame clears them before its first bit.
  always_ff @(posedge clk_i) begin
    if (state_q == CDS)                        position_q <= '0;
    else if (state_q == POSITION && bit_valid) position_q <= {position_q[61:0], sl_bit};
    if (state_q == CDS)                        crc_q <= '0;
    else if (in_crc_q && bit_valid)              crc_q <= {crc_q[4:0], sl_bit};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      flag_q       <= '0;
      flag_nerr_q  <= 1'b1;
      flag_nwarn_q <= 1'b1;
      cds_q        <= 1'b0;
      fits_q       <= 1'b1;
      late_q       <= 1'b0;
    end else begin
      if (state_q == CDS) begin
        flag_q       <= 2'b01;
        flag_nerr_q  <= 1'b1;
        flag_nwarn_q <= 1'b1;
        fits_q       <= 1'b1;
      end else if (state_q == TAIL && bit_valid) begin
        flag_q <= {flag_q[0], 1'b0};
        if (!in_crc_q && flag_q[0]) flag_nerr_q  <= sl_bit;
        if (!in_crc_q && flag_q[1]) flag_nwarn_q <= sl_bit;
        if (in_crc_q)             fits_q       <= fits_q && sl_bit != crc_top;
      end
      if (start_i)                          cds_q <= 1'b0;
      else if (state_q == CDS && bit_valid) cds_q <= sl_bit;
      late_q <= !start_i && (late_q || late);
    end
  end

  always_comb begin
    found_o.acked      = acked;
    found_o.late       = late_q;
    found_o.crc_bad    = has_crc && !fits_q;
    found_o.place      = place;
    found_o.point      = point;
    found_o.raw        = raw;
    found_o.line       = line_q;
    found_o.processing = processing_q;
    found_o.cds        = cds_q;
    found_o.position   = position_q;
    found_o.nerr       = flag_nerr_q;
    found_o.nwarn      = flag_nwarn_q;
    found_o.crc        = crc_q;
  end

  assign over_o     = over;
  assign rests_o    = !run;
  assign latch_o    = rise && state_q == EDGES && !first_q;
  assign averages_o = valid;
  assign ma_o       = ma;

  `ENC_ASSERT_IF(PlaceInRange_A, clk_i, rst_ni, acked, place >= 4'd4 && place <= 4'd11)
  `ENC_ASSERT_IF(StartAtRest_A, clk_i, rst_ni, start_i, rests_o)

endmodule
