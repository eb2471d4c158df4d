// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Serial CRC of one word, right aligned: any polynomial up to degree 8, and with crc16_i the
// polynomial of BiSS Safety, 0x190D9.
//
// Clock domain: core. load_i sets the start value. shift_i takes one bit: with feed_i the data bit
// goes into the division, without feed_i the remainder is shifted out. top_o is the highest bit of
// the remainder. The bits above the degree of the polynomial have no meaning, and nothing looks at
// them. So the upper half of the division can always use the polynomial of degree 16.
// With Free = 0 the module knows two polynomials, x^6 + x + 1 (0x43) and the one of degree 16
// (0x190D9), and does not look at poly_i and last_i.
// Misuse: with shift_i and no load_i before it the division continues the word before.
// Datasheet: pages 24, 25; algorithm and vectors: docs/theory.md.

module enc_crc #(
  parameter bit Free = 1'b1      // any polynomial up to degree 8; 0: only 0x43
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        crc16_i,
  input  logic [7:0]  poly_i,    // without the highest power; degree 16: the lower half
  input  logic [2:0]  last_i,    // number of the highest bit of the remainder; crc16_i goes first
  input  logic [15:0] start_i,
  input  logic        load_i,
  input  logic        shift_i,
  input  logic        feed_i,
  input  logic        bit_i,
  output logic        top_o
);

  localparam logic [7:0] POLY16_UPPER = 8'h90;
  localparam logic [7:0] POLY16_LOWER = 8'hD9;
  localparam logic [7:0] POLY6        = 8'h43;

  logic [7:0]  poly;
  logic [15:0] rem_d;
  logic [15:0] rem_q;
  logic        top;
  logic        divide;

  assign poly   = Free ? poly_i : crc16_i ? POLY16_LOWER : POLY6;
  assign top    = crc16_i ? rem_q[15] : rem_q[Free ? {1'b0, last_i} : 4'd5];
  assign divide = feed_i & (bit_i ^ top);

  always_comb begin
    rem_d = {rem_q[14:0], 1'b0} ^ ({POLY16_UPPER, poly} & {16{divide}});
    if (load_i) rem_d = start_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                rem_q <= '0;
    else if (load_i || shift_i) rem_q <= rem_d;
  end

  assign top_o = top;

endmodule
