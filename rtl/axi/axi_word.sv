// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The word of one channel: its bits, its CRC, and the results that a frame leaves.
//
// Clock domain: core. load_i comes before the first bit, data_i with the bits of position, error
// and warning, crc_i with those of the CRC. Results change in the clock of ended_i, failed_i or
// late_i, and with start_i, clear_i and enabled_i.
//
// - ended_i: the word is good if the CRC fits or is not checked. A good word goes to the position
//   and the flags, one of single-point mode to the single-point data too. A bad one changes none.
// - A disabled channel has no word: its position is 0 and not good.
// - failed_i, late_i: no CRC has come: both results are 0. Without acknowledge the delay is 1023.
//
// Misuse: bits without load_i before them continue the word before.
// Source: hello-fpga BiSS-C master manual 1.1 and 2.4; docs/axi.md.

module axi_word #(
  parameter bit Wide   = 1'b0,   // up to 64 bits of position
  parameter bit AnyCrc = 1'b0    // 0: the CRC is that of 0x43
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  axi_pkg::frame_t frame_i,
  input  axi_pkg::rule_t  rule_i,
  input  logic       clear_i,        // soft reset
  input  logic       enabled_i,
  input  logic       start_i,
  input  logic       request_i,      // with start_i: clears single_valid_o
  // bits
  input  logic       load_i,
  input  logic       data_i,
  input  logic       crc_i,
  input  logic       bit_valid_i,
  input  logic       bit_i,
  // ends of a frame, each high for one clock
  input  logic       ended_i,
  input  logic       failed_i,
  input  logic       late_i,         // SLO was 0 at the start
  input  logic       ack_i,          // the acknowledge has come
  input  logic [9:0] delay_i,
  output logic       crc_error_o,    // with ended_i
  // results
  output logic       single_valid_o,
  output axi_pkg::result_t result_o,
  output axi_pkg::word_t   word_o,
  output axi_pkg::more_t   more_o
);

  localparam int unsigned SHIFT_W = Wide ? 66 : 34;
  localparam int unsigned CRC_W   = AnyCrc ? 16 : 6;

  logic [SHIFT_W-1:0] shift_q; // position, error, warning
  logic [CRC_W-1:0] received_q;
  logic [CRC_W-1:0] calculated_q;
  logic        fits_q;         // the CRC bits so far fit
  logic        crc_top;
  logic        good;
  axi_pkg::result_t result_q;
  axi_pkg::word_t   word_q;
  logic        single_valid_q;
  logic        unused;

  if (AnyCrc) begin : gen_any_crc
    axi_crc u_crc (
      .clk_i,
      .rst_ni,
      .poly_i  (rule_i.crc_poly),
      .mask_i  (rule_i.crc_top),
      .start_i (rule_i.crc_start),
      .load_i,
      .shift_i (bit_valid_i),
      .feed_i  (data_i),
      .bit_i,
      .top_o   (crc_top)
    );
  end else begin : gen_crc6
    enc_crc #(.Free(1'b0)) u_crc (
      .clk_i,
      .rst_ni,
      .crc16_i (1'b0),
      .poly_i  (8'h43),
      .last_i  (3'd5),
      .start_i (16'h0000),
      .load_i,
      .shift_i (bit_valid_i),
      .feed_i  (data_i),
      .bit_i,
      .top_o   (crc_top)
    );
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      shift_q      <= '0;
      received_q   <= '0;
      calculated_q <= '0;
      fits_q       <= 1'b0;
    end else begin
      if (load_i)                     shift_q <= '0;
      else if (bit_valid_i && data_i) shift_q <= {shift_q[SHIFT_W-2:0], bit_i};
      if (load_i)                     fits_q  <= 1'b1;
      else if (bit_valid_i && crc_i)  fits_q  <= fits_q && bit_i != crc_top;
      if (AnyCrc && load_i) begin
        received_q   <= '0;
        calculated_q <= '0;
      end else if (bit_valid_i && crc_i) begin
        received_q   <= {received_q[CRC_W-2:0], bit_i};
        calculated_q <= {calculated_q[CRC_W-2:0], !crc_top};
      end
    end
  end

  assign good        = fits_q || !frame_i.check;
  assign crc_error_o = ended_i && !fits_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      result_q       <= '0;
      word_q         <= '0;
      word_q.nerr    <= 1'b1;
      word_q.nwarn   <= 1'b1;
      single_valid_q <= 1'b0;
    end else begin
      if (clear_i) begin
        result_q <= '0;
      end else begin
        if (ended_i || failed_i || late_i) begin
          result_q.delay      <= delay_i | {10{!ack_i || late_i}};
          result_q.received   <= received_q[5:0] & {6{ended_i}};
          result_q.calculated <= calculated_q[5:0] & {6{ended_i}};
        end
        if (ended_i && good && frame_i.single) result_q.single <= shift_q[2 +: 32];
      end
      if (clear_i || !enabled_i)  word_q.position <= '0;
      else if (ended_i && good)   word_q.position <= shift_q[2 +: 32];
      if (clear_i) begin
        word_q.nerr  <= 1'b1;
        word_q.nwarn <= 1'b1;
      end else if (ended_i && good) begin
        word_q.nerr  <= shift_q[1];
        word_q.nwarn <= shift_q[0];
      end
      word_q.good    <= !clear_i && enabled_i && !start_i && (ended_i ? good : word_q.good);
      word_q.crc_bad <= !clear_i && enabled_i && !start_i && (ended_i ? !fits_q : word_q.crc_bad);
      single_valid_q <= !clear_i && !(start_i && request_i) &&
                        (single_valid_q || (ended_i && good && frame_i.single));
    end
  end

  // ---- extras -------------------------------------------------------------------------------

  if (Wide) begin : gen_wide
    logic [31:0] single_q;
    logic [31:0] position_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        single_q   <= '0;
        position_q <= '0;
      end else begin
        if (clear_i)                                  single_q <= '0;
        else if (ended_i && good && frame_i.single)   single_q <= shift_q[SHIFT_W-1 -: 32];
        if (clear_i || !enabled_i)                    position_q <= '0;
        else if (ended_i && good)                     position_q <= shift_q[SHIFT_W-1 -: 32];
      end
    end

    assign more_o.single_high   = single_q;
    assign more_o.position_high = position_q;
  end else begin : gen_narrow
    assign more_o.single_high   = '0;
    assign more_o.position_high = '0;
  end

  if (AnyCrc) begin : gen_crc_high
    logic [9:0] received_high_q;
    logic [9:0] calculated_high_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        received_high_q   <= '0;
        calculated_high_q <= '0;
      end else if (clear_i) begin
        received_high_q   <= '0;
        calculated_high_q <= '0;
      end else if (ended_i || failed_i || late_i) begin
        received_high_q   <= received_q[CRC_W-1 -: 10] & {10{ended_i}};
        calculated_high_q <= calculated_q[CRC_W-1 -: 10] & {10{ended_i}};
      end
    end

    assign more_o.received_high   = received_high_q;
    assign more_o.calculated_high = calculated_high_q;
  end else begin : gen_no_crc_high
    assign more_o.received_high   = '0;
    assign more_o.calculated_high = '0;
  end

  assign unused         = (^frame_i) ^ (^rule_i);
  assign single_valid_o = single_valid_q;
  assign result_o       = result_q;
  assign word_o         = word_q;

endmodule
