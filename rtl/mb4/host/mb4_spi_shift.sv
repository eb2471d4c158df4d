// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SPI serial-parallel conversion in mode 0: SCLK idles low, MOSI is taken at the rising edge, MISO
// changes at the falling edge. The most significant bit comes first.
//
// Clock domain: SCLK; no system clock is needed. NCS high resets the bit count, so an aborted byte
// has no effect.
// Latency: byte_o is combinational from MOSI. byte_valid_o and byte_o are valid up to the rising
// SCLK edge that completes a byte, because the next falling edge already carries the first bit of
// the answer (no dummy byte).
// Misuse: SCLK high while NCS falls counts no bit; the SPI frame starts with the next rising edge.
// Datasheet: pages 11, 17..19.

module mb4_spi_shift (
  input  logic       sclk_i,
  input  logic       frame_rst_ni,  // low with NCS high or NRES low
  input  logic       mosi_i,
  output logic       miso_o,
  // to and from the command decoder, rising SCLK edge
  output logic       byte_valid_o,
  output logic [7:0] byte_o,
  input  logic       tx_en_i,       // 0: send zeros
  input  logic [7:0] tx_byte_i
);

  logic [2:0] bit_q;
  logic [6:0] shift_q;
  logic       miso_q;
  logic [6:0] out_q;     // the bits after miso_q

  always_ff @(posedge sclk_i or negedge frame_rst_ni) begin
    if (!frame_rst_ni) begin
      bit_q   <= 3'd0;
      shift_q <= '0;
    end else begin
      bit_q   <= bit_q + 3'd1;
      shift_q <= {shift_q[5:0], mosi_i};
    end
  end

  assign byte_valid_o = bit_q == 3'd7;
  assign byte_o       = {shift_q, mosi_i};

  // After k rising edges of a byte the falling edge puts out bit 7 - k. The byte comes late, so the
  // falling edge of its first bit takes all of it. The later bits come from a shift register and
  // have a short path to MISO.
  always_ff @(negedge sclk_i or negedge frame_rst_ni) begin
    if (!frame_rst_ni)      {miso_q, out_q} <= 8'h00;
    else if (bit_q == 3'd0) {miso_q, out_q} <= tx_byte_i & {8{tx_en_i}};
    else                    {miso_q, out_q} <= {out_q, 1'b0};
  end

  assign miso_o = miso_q;

endmodule
