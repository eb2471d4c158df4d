// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CRC choice of a data channel: length, polynomial and top bit of the remainder as mb4_crc takes
// them.
//
// Combinational. SELCRCSx = 0: SCRCLENx names one of seven polynomials; SELCRCSx = 1: SCRCPOLYx is
// the polynomial without its last 1, its degree is the CRC length (1..7).
// Misuse: SCRCLEN codes that Table 14 does not permit, and SCRCPOLY = 0, switch the CRC off.
// Datasheet: pages 24, 25, Tables 13..15.

module mb4_crc_decode (
  input  logic       selcrc_i,
  input  logic [6:0] crc_code_i,
  output logic [4:0] crc_len_o,
  output logic [7:0] crc_poly_o,
  output logic [7:0] crc_top_o
);

  logic [4:0] own_len;
  logic [4:0] named_len;

  always_comb begin
    own_len = 5'd0;
    for (int i = 0; i < 7; i++) begin
      if (crc_code_i[i]) own_len = 5'(i) + 5'd1;
    end
  end

  always_comb begin
    named_len = 5'd0;
    unique case (crc_code_i)
      7'h03, 7'h04, 7'h05, 7'h06, 7'h07, 7'h08, 7'h10: named_len = crc_code_i[4:0];
      default: ;  // off
    endcase
  end

  // The highest power of an own polynomial is bit 7 at most and needs not be taken away: it is
  // above the remainder's highest bit.
  always_comb begin
    unique case (crc_code_i[4:0])
      5'h05:   crc_poly_o = 8'h05;
      5'h07:   crc_poly_o = 8'h09;
      5'h08:   crc_poly_o = 8'h2F;
      5'h10:   crc_poly_o = 8'hD9;
      default: crc_poly_o = 8'h03;  // 3, 4, 6 bits
    endcase
    if (selcrc_i) crc_poly_o = {crc_code_i, 1'b1};
  end

  assign crc_len_o = selcrc_i ? own_len : named_len;

  always_comb begin
    for (int i = 0; i < 8; i++) crc_top_o[i] = crc_len_o == 5'(i) + 5'd1;
  end

endmodule
