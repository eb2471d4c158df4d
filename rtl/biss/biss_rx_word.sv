// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Assembles one data word from received bits, most significant bit first, into bytes, and checks
// its CRC.
//
// Clock domain: core. load_i prepares for the word that offer_i describes; offer_i must stay until
// next_o. Each bit_valid_i takes one bit.
//
// - Bytes: a byte is offered for one clock when its lowest bit has come. Data go from the highest
//   used byte down to byte 0; unused bits of a written byte are 0. Then the received CRC,
//   re-inverted and right aligned, goes to byte 7 (a 16-bit CRC to bytes 7 and 6).
// - Gray coded data are decoded. The CRC covers them as they are sent. With Gray = 0 such a word is
//   not decoded, and it is bad.
// - next_o comes with the last bit of every word. rx_o tells only of the words of sensors: the
//   slot of an actuator is counted, but gives no bytes and no result.
// - A CRC that FreeCrc = 0 leaves out is taken with its length, and the word is bad.
//
// Misuse: bits without a load continue the old word. A word that is longer than DataBits ends
// early.
// Datasheet: page 26, Tables 19..22; decisions 11, 28, 29, 44.

module biss_rx_word #(
  parameter int unsigned DataBits = 64,   // the longest word
  parameter bit          FreeCrc  = 1'b1, // any CRC; 0: only 0x43 and 16 bits
  parameter bit          Gray     = 1'b1  // decodes Gray coded data
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  biss_pkg::offer_t offer_i,
  input  logic       run_i,        // a word is on SL
  input  logic       load_i,
  input  logic       bit_valid_i,
  input  logic       bit_i,
  output logic       next_o,
  output biss_pkg::rx_t rx_o
);

  biss_pkg::word_t word;
  logic       sensor_q;  // the word is not that of an actuator
  logic       store_q;   // its CRC is stored
  logic [3:0] crc_last_q; // CRC bits minus 1; word brings them later in the clock
  logic       wr_en;
  logic [2:0] wr_byte;
  logic       ok;
  logic       in_crc_d;
  logic       in_crc_q;
  logic [5:0] left_d;
  logic [5:0] left_q;    // bits of the current part that follow this one
  logic [6:0] part_q;    // the bits before this one, decoded
  logic       skip_d;
  logic       skip_q;    // the stop bit of an actuator comes first
  logic       fresh_q;   // no bit of this word has come yet
  logic       good_d;
  logic       good_q;
  logic       crc_top;
  logic       value;
  logic       crc_fits;
  logic       known;     // the CRC is one that the module has

  // Bits of left_q that are in use: 16 CRC bits need four.
  localparam logic [5:0] LEFT = 6'((32'd1 << (DataBits > 16 ? $clog2(DataBits) : 4)) - 32'd1);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (DataBits < 1 || DataBits > 64) begin : gen_data_bits
    $error("DataBits is 1 to 64");
  end
`endif

  enc_crc #(.Free(FreeCrc)) u_crc (
    .clk_i,
    .rst_ni,
    .crc16_i (crc_last_q[3]),
    .poly_i  (word.crc_poly),
    .last_i  (crc_last_q[2:0]),
    .start_i (word.crc_start),
    .load_i,
    .shift_i (bit_valid_i && !skip_q),
    .feed_i  (!in_crc_q),
    .bit_i,
    .top_o   (crc_top)
  );

  assign word = offer_i.word;

  // CRC bits are sent inverted.
  assign value    = bit_i ^ (in_crc_q || (Gray && word.gray && part_q[0]));
  assign crc_fits = good_q && value == crc_top && known;
  assign known    = FreeCrc || crc_last_q[3] ||
                    (crc_last_q[2:0] == 3'd5 && word.crc_poly[5:0] == 6'h03);

  always_comb begin
    skip_d    = skip_q;
    in_crc_d  = in_crc_q;
    left_d    = left_q;
    good_d    = good_q;
    wr_en   = 1'b0;
    wr_byte = left_q[5:3];
    next_o    = 1'b0;
    ok      = 1'b1;

    if (load_i) begin
      skip_d   = word.stop;
      in_crc_d = 1'b0;
      left_d   = word.data_last & LEFT;
      good_d   = 1'b1;
    end else if (bit_valid_i && skip_q) begin
      skip_d = 1'b0;
    end else if (bit_valid_i) begin
      left_d = (left_q - 6'd1) & LEFT;
      if (!in_crc_q) begin
        wr_en = left_q[2:0] == 3'd0;
        if (left_q == 6'd0) begin
          in_crc_d = 1'b1;
          left_d   = 6'(crc_last_q);
          next_o   = !word.crc_on;
        end
      end else begin
        good_d    = crc_fits;
        ok      = crc_fits;
        next_o    = left_q == 6'd0;
        wr_en   = store_q && left_q[2:0] == 3'd0;
        wr_byte = (crc_last_q[3] && left_q == 6'd0) ? 3'd6 : 3'd7;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      skip_q   <= 1'b0;
      fresh_q  <= 1'b0;
      sensor_q <= 1'b0;
      store_q  <= 1'b0;
      crc_last_q <= '0;
      in_crc_q <= 1'b0;
      left_q   <= '0;
      good_q   <= 1'b0;
    end else begin
      skip_q   <= skip_d;
      if (load_i) begin
        sensor_q   <= !word.actuator;
        store_q    <= word.crc_store;
        crc_last_q <= word.crc_last;
      end
      fresh_q  <= load_i || (fresh_q && !bit_valid_i);
      in_crc_q <= in_crc_d;
      left_q   <= left_d;
      good_q   <= good_d;
    end
  end

  // A part of a word begins with zeros: the data with load_i, the CRC after the last data bit.
  // Without an asynchronous reset this needs no logic cell.
  always_ff @(posedge clk_i) begin
    if (load_i || (bit_valid_i && !skip_q)) begin
      if (load_i || (left_q == 6'd0 && !in_crc_q)) part_q <= '0;
      else                                         part_q <= {part_q[5:0], value};
    end
  end

  // A word that cannot be decoded is bad with any CRC, or without one.
  assign rx_o.slave   = offer_i.slave;
  assign rx_o.wr_en   = wr_en && sensor_q;
  assign rx_o.wr_byte = wr_byte;
  assign rx_o.wr_data = {part_q, value};
  assign rx_o.first   = bit_valid_i && fresh_q && sensor_q;
  assign rx_o.open    = run_i && !load_i && (bit_valid_i || !fresh_q) && !next_o && sensor_q;
  assign rx_o.done    = next_o && sensor_q;
  assign rx_o.ok      = ok && (Gray || !word.gray);

endmodule
