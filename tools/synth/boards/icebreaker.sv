// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4_core on an iCEBreaker (iCE40 UP5K): host on Pmod 1A (SPI, Pmod type 2), line transceivers on
// Pmod 1B, the board's 12 MHz as system clock. Pins: icebreaker.pcf.

module icebreaker (
  input  logic clk_i,      // 12 MHz
  input  logic button_ni,  // NRES
  // Pmod 1A: host
  input  logic ncs_i,
  input  logic mosi_i,
  output logic miso_io,
  input  logic sclk_i,
  // Pmod 1B: lines, open-drain NER, EOT
  output logic ma1_o,
  input  logic sl1_i,
  output logic mo1_o,
  output logic eot_o,
  output logic ma2_o,
  input  logic sl2_i,
  output logic mo2_o,
  output logic ner_io
);

  logic       por_n;
  logic       miso, miso_oe, ner_low, ner;
  logic       clkeni, paired;
  logic [3:0] por_q;

  // Flops are 0 after the configuration: 15 clocks of power-on reset.
  always_ff @(posedge clk_i) if (por_q != 4'd15) por_q <= por_q + 4'd1;
  assign por_n = por_q == 4'd15;

  // SL is taken in the I/O cells: both edges see the same delay from the pin.
  mb4_core #(.SlCells(biss_pkg::SL_ICE40)) u_core (
    .clk_i,
    .rst_ni    (por_n && button_ni),
    .por_ni    (por_n),
    .sclk_i,
    .cs_ni     (ncs_i),
    .mosi_i,
    .miso_o    (miso),
    .miso_oe_o (miso_oe),
    .eot_o,
    .ner_low_o (ner_low),
    .ner_i     (ner),
    .clkeni_o  (clkeni),
    .paired_o  (paired),
    .getsens_i (1'b0),
    .ma1_o,
    .sl1_i,
    .mo1_o,
    .ma2_o,
    .sl2_i,
    .mo2_o,
    .quirks_i  (mb4_pkg::QUIRKS_DEFAULT)
  );

  SB_IO #(.PIN_TYPE(6'b1010_01)) u_miso (
    .PACKAGE_PIN   (miso_io),
    .OUTPUT_ENABLE (miso_oe),
    .D_OUT_0       (miso)
  );

  SB_IO #(.PIN_TYPE(6'b1010_01), .PULLUP(1'b1)) u_ner (
    .PACKAGE_PIN   (ner_io),
    .OUTPUT_ENABLE (ner_low),
    .D_OUT_0       (1'b0),
    .D_IN_0        (ner)
  );

endmodule
