// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CRC of a data word: makes the length and the inputs of enc_crc from the polynomial
// (mb4_crc_code).
//
// Combinational, host domain: it stands where the host writes, once for all word lists.
// Misuse: none; every code has a defined result.
// Datasheet: pages 24, 25, Tables 13..15.

module mb4_crc_decode (
  input  logic [7:0] poly_i,      // polynomial without its last 1; 0: no CRC
  output logic       crc_on_o,
  output logic [3:0] crc_last_o,  // CRC bits minus 1; 0 without CRC; only 16 bits set bit 3
  output logic [7:0] crc_poly_o
);

  logic [2:0] last;
  logic       crc16;

  assign crc16    = poly_i[7] && poly_i[6];
  assign crc_on_o = poly_i != 8'h00;

  // The highest power does not have to be removed. In degree 8 it falls out; in lower degrees it is
  // above the highest bit of the remainder, where enc_crc does not look.
  assign crc_poly_o = {poly_i[6:0], 1'b1};

  always_comb begin
    last = 3'd0;
    for (int i = 0; i < 8; i++) begin
      if (poly_i[i]) last = 3'(i);
    end
  end

  // The code of degree 16 has bit 7 set, as degree 8.
  assign crc_last_o = {crc16, last};

endmodule
