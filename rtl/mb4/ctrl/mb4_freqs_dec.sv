// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes FREQS: gives the length of half an MA period in clocks.
//
// Combinational. Codes 0x00..0x0F: code + 1. Codes 0x11..0x1F: 10 (code - 15).
// Misuse: the datasheet does not permit code 0x10; the same formula gives f_MA = f_CLK / 20.
// Datasheet: page 30, Table 35.

module mb4_freqs_dec (
  input  logic [4:0] freqs_i,
  output logic [7:0] half_len_o
);

  logic [4:0] steps;

  assign steps      = 5'(freqs_i[3:0]) + 5'd1;
  assign half_len_o = freqs_i[4] ? {steps, 3'b000} + {2'b00, steps, 1'b0} : {3'b000, steps};

endmodule
