// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Serial CRC by x^16 + x^15 + x^12 + x^7 + x^6 + x^4 + x^3 + 1, as enc_crc has it. Without a reset
// of its flops the clear costs no logic.
//
// Clock domain: core. load_i clears the remainder. shift_i takes one bit: with feed_i it goes into
// the division, without feed_i the remainder is shifted out. top_o is its highest bit.
// Misuse: before the first load_i top_o has no meaning.
// Source: docs/dsl.md, "The protocol".

module dsl_crc16 (
  input  logic clk_i,
  input  logic load_i,
  input  logic shift_i,
  input  logic feed_i,
  input  logic bit_i,
  output logic top_o
);

  localparam logic [15:0] POLY = 16'h90D9;

  logic [15:0] rem_q;
  logic        divide;

  assign divide = feed_i && (bit_i ^ rem_q[15]);

  always_ff @(posedge clk_i) begin
    if (load_i)       rem_q <= '0;
    else if (shift_i) rem_q <= {rem_q[14:0], 1'b0} ^ (POLY & {16{divide}});
  end

  assign top_o = rem_q[15];

endmodule
