// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CRC choice of a data channel: length, polynomial and top bit of the remainder.
//
// Combinational. SELCRCSx = 0: SCRCLENx names one of seven polynomials; SELCRCSx = 1: SCRCPOLYx is
// the polynomial without its last 1, its degree is the CRC length (1..7).
// Misuse: SCRCLEN codes that Table 14 does not permit, and SCRCPOLY = 0, switch the CRC off.
// Datasheet: pages 24, 25, Tables 13..15.

module mb4_crc_decode (
  input  logic        selcrc_i,
  input  logic [6:0]  crc_code_i,
  output logic [4:0]  crc_len_o,
  output logic [15:0] crc_poly_o,
  output logic [15:0] crc_top_o
);

  logic [6:0] own_top;
  logic [4:0] own_len;

  always_comb begin
    own_top = 7'h00;
    own_len = 5'd0;
    for (int i = 0; i < 7; i++) begin
      if (crc_code_i[i]) begin
        own_top = 7'h01 << i;
        own_len = 5'(i) + 5'd1;
      end
    end
  end

  always_comb begin
    crc_len_o  = 5'd0;
    crc_poly_o = 16'h0000;
    crc_top_o  = 16'h0000;
    if (selcrc_i) begin
      crc_len_o  = own_len;
      crc_poly_o = {8'h00, crc_code_i, 1'b1} & ~{8'h00, own_top, 1'b0};
      crc_top_o  = {9'h000, own_top};
    end else begin
      unique case (crc_code_i)
        7'h03: begin
          crc_len_o  = 5'd3;
          crc_poly_o = 16'h0003;
          crc_top_o  = 16'h0004;
        end
        7'h04: begin
          crc_len_o  = 5'd4;
          crc_poly_o = 16'h0003;
          crc_top_o  = 16'h0008;
        end
        7'h05: begin
          crc_len_o  = 5'd5;
          crc_poly_o = 16'h0005;
          crc_top_o  = 16'h0010;
        end
        7'h06: begin
          crc_len_o  = 5'd6;
          crc_poly_o = 16'h0003;
          crc_top_o  = 16'h0020;
        end
        7'h07: begin
          crc_len_o  = 5'd7;
          crc_poly_o = 16'h0009;
          crc_top_o  = 16'h0040;
        end
        7'h08: begin
          crc_len_o  = 5'd8;
          crc_poly_o = 16'h002F;
          crc_top_o  = 16'h0080;
        end
        7'h10: begin
          crc_len_o  = 5'd16;
          crc_poly_o = 16'h90D9;
          crc_top_o  = 16'h8000;
        end
        default: crc_len_o = 5'd0;
      endcase
    end
  end

endmodule
