// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Brings the CRC choice of a data channel (SELCRCSx with SCRCLENx or SCRCPOLYx) into one form,
// poly_o.
//
// poly_o is the polynomial without its last 1; its highest 1 is the highest power. 0 means no CRC.
// The polynomial of degree 16 does not fit: 0xEC stands for it. The lower byte of that polynomial,
// 0xD9, follows from 0xEC as from any other code, and no other code has both bit 7 and bit 6 set.
//
// SELCRCSx = 0: SCRCLENx names one of seven polynomials. SELCRCSx = 1: SCRCPOLYx is the polynomial
// without its last 1, and its degree (1..7) is the CRC length.
//
// Clock domain: host; combinational. The conversion stands where the host writes, once for all
// readers; mb4_crc_decode goes on from it.
// Misuse: SCRCLEN codes that Table 14 does not permit, and SCRCPOLY = 0, switch the CRC off.
// Datasheet: pages 24, 25, Tables 13..15.

module mb4_crc_code (
  input  logic       selcrc_i,
  input  logic [6:0] code_i,     // SCRCLENx, SCRCPOLYx
  output logic [7:0] poly_o
);

  always_comb begin
    unique case (code_i)
      mb4_regs_pkg::CRC_LENGTH_CRC3:  poly_o = 8'h05;  // 0x0B
      mb4_regs_pkg::CRC_LENGTH_CRC4:  poly_o = 8'h09;  // 0x13
      mb4_regs_pkg::CRC_LENGTH_CRC5:  poly_o = 8'h12;  // 0x25
      mb4_regs_pkg::CRC_LENGTH_CRC6:  poly_o = 8'h21;  // 0x43
      mb4_regs_pkg::CRC_LENGTH_CRC7:  poly_o = 8'h44;  // 0x89
      mb4_regs_pkg::CRC_LENGTH_CRC8:  poly_o = 8'h97;  // 0x12F
      mb4_regs_pkg::CRC_LENGTH_CRC16: poly_o = 8'hEC;  // 0x190D9
      default:                        poly_o = 8'h00;
    endcase
    if (selcrc_i) poly_o = {1'b0, code_i};
  end

endmodule
