// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Serial CRC of one word with any polynomial up to degree 16, right aligned. enc_crc has less: any
// polynomial up to degree 8, and one of degree 16.
//
// Clock domain: core. load_i sets the start value. shift_i takes one bit: with feed_i the data bit
// goes into the division, without feed_i the remainder is shifted out. top_o is the highest bit of
// the remainder. Bits above the degree have no meaning, and nothing looks at them.
// Misuse: with shift_i and no load_i before it the division continues the word before.
// Source: docs/axi.md, docs/theory.md.

module axi_crc (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic [15:0] poly_i,    // without the highest power
  input  logic [15:0] mask_i,    // highest bit of the remainder, one-hot
  input  logic [15:0] start_i,
  input  logic        load_i,
  input  logic        shift_i,
  input  logic        feed_i,
  input  logic        bit_i,
  output logic        top_o
);

  logic [15:0] rem_q;
  logic        top;
  logic        divide;

  assign top    = (rem_q & mask_i) != 16'd0;
  assign divide = feed_i & (bit_i ^ top);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)      rem_q <= '0;
    else if (load_i)  rem_q <= start_i;
    else if (shift_i) rem_q <= {rem_q[14:0], 1'b0} ^ (poly_i & {16{divide}});
  end

  assign top_o = top;

endmodule
