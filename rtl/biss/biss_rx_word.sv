// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Assembles one data word from received bits, most significant bit first, into bytes, and checks
// its CRC.
//
// Clock domain: core. load_i prepares for the word that word_i describes; word_i must stay until
// done_o. Each bit_valid_i takes one bit.
//
// - Bytes: a byte is offered for one clock when its lowest bit has come. Data go from the highest
//   used byte down to byte 0; unused bits of a written byte are 0. Then the received CRC,
//   re-inverted and right aligned, goes to byte 7 (a 16-bit CRC to bytes 7 and 6).
// - Gray coded data are decoded. The CRC covers them as they are sent.
// - begin_o comes with the first bit. open_o is high when bits of the word have come and more
//   follow. done_o comes with the last bit, and ok_o is the result of the CRC then.
// - The slot of an actuator is only counted: it gives no bytes, and ok_o = 1.
//
// Misuse: bits without a load continue the old word.
// Datasheet: page 26, Tables 19..22; decisions 11, 28, 29.

module biss_rx_word (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  biss_pkg::word_t word_i,
  input  logic       run_i,        // a word is on SL
  input  logic       load_i,
  input  logic       bit_valid_i,
  input  logic       bit_i,
  output logic       wr_en_o,
  output logic [2:0] wr_byte_o,
  output logic [7:0] wr_data_o,
  output logic       begin_o,
  output logic       open_o,
  output logic       done_o,
  output logic       ok_o
);

  logic       in_crc_d;
  logic       in_crc_q;
  logic [5:0] left_d;
  logic [5:0] left_q;    // bits of the current part that follow this one
  logic [6:0] part_d;
  logic [6:0] part_q;
  logic       skip_d;
  logic       skip_q;    // the stop bit of an actuator comes first
  logic       fresh_q;   // no bit of this word has come yet
  logic       bin_q;     // the previous data bit, decoded
  logic       good_d;
  logic       good_q;
  logic       crc_top;
  logic       value;
  logic       crc_fits;

  enc_crc u_crc (
    .clk_i,
    .rst_ni,
    .crc16_i (word_i.crc_last[3]),
    .poly_i  (word_i.crc_poly),
    .top_i   (word_i.crc_top),
    .start_i (word_i.crc_start),
    .load_i,
    .shift_i (bit_valid_i && !skip_q),
    .feed_i  (!in_crc_q),
    .bit_i,
    .top_o   (crc_top)
  );

  // CRC bits are sent inverted.
  assign value    = bit_i ^ (in_crc_q || (word_i.gray && bin_q));
  assign crc_fits = (good_q && value == crc_top) || word_i.actuator;

  always_comb begin
    skip_d    = skip_q;
    in_crc_d  = in_crc_q;
    left_d    = left_q;
    part_d    = part_q;
    good_d    = good_q;
    wr_en_o   = 1'b0;
    wr_byte_o = left_q[5:3];
    wr_data_o = {part_q, value};
    done_o    = 1'b0;
    ok_o      = 1'b1;

    if (load_i) begin
      skip_d   = word_i.stop;
      in_crc_d = 1'b0;
      left_d   = word_i.data_last;
      part_d   = '0;
      good_d   = 1'b1;
    end else if (bit_valid_i && skip_q) begin
      skip_d = 1'b0;
    end else if (bit_valid_i) begin
      left_d = left_q - 6'd1;
      part_d = (left_q[2:0] == 3'd0) ? 7'h00 : {part_q[5:0], value};
      if (!in_crc_q) begin
        wr_en_o = left_q[2:0] == 3'd0 && !word_i.actuator;
        if (left_q == 6'd0) begin
          in_crc_d = 1'b1;
          left_d   = 6'(word_i.crc_last);
          done_o   = !word_i.crc_on;
        end
      end else begin
        good_d    = crc_fits;
        ok_o      = crc_fits;
        done_o    = left_q == 6'd0;
        wr_en_o   = word_i.crc_store && !word_i.actuator && left_q[2:0] == 3'd0;
        wr_byte_o = (word_i.crc_last[3] && left_q == 6'd0) ? 3'd6 : 3'd7;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      skip_q   <= 1'b0;
      fresh_q  <= 1'b0;
      bin_q    <= 1'b0;
      in_crc_q <= 1'b0;
      left_q   <= '0;
      part_q   <= '0;
      good_q   <= 1'b0;
    end else begin
      skip_q   <= skip_d;
      fresh_q  <= load_i || (fresh_q && !bit_valid_i);
      if (load_i)           bin_q <= 1'b0;
      else if (bit_valid_i) bin_q <= value;
      in_crc_q <= in_crc_d;
      left_q   <= left_d;
      part_q   <= part_d;
      good_q   <= good_d;
    end
  end

  assign begin_o = bit_valid_i && fresh_q;
  assign open_o  = run_i && !load_i && (bit_valid_i || !fresh_q) && !done_o;

endmodule
