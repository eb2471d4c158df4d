// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4_core on an iCEBreaker (iCE40 UP5K): host on Pmod 1A (SPI, Pmod type 2), line transceivers on
// Pmod 1B. The PLL makes 19.875 MHz, the system clock, of the board's 12 MHz: MA up to 9.9 MHz.
// Pins and clocks: icebreaker.pcf.

module icebreaker #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
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

  logic       clk, locked;
  logic       por_n;
  logic       miso, miso_oe, ner_low, ner;
  logic       clkeni, paired;
  logic [3:0] por_q;

  SB_PLL40_PAD #(
    .FEEDBACK_PATH ("SIMPLE"),
    .DIVR          (4'd0),
    .DIVF          (7'd52),
    .DIVQ          (3'd5),
    .FILTER_RANGE  (3'd1)
  ) u_pll (
    .PACKAGEPIN    (clk_i),
    .PLLOUTGLOBAL  (clk),
    .LOCK          (locked),
    .RESETB        (1'b1),
    .BYPASS        (1'b0)
  );

  // Flops are 0 after the configuration: 15 clocks of power-on reset after the PLL has locked.
  always_ff @(posedge clk) if (locked && por_q != 4'd15) por_q <= por_q + 4'd1;
  assign por_n = por_q == 4'd15;

  // SL is taken in the I/O cells: both edges see the same delay from the pin.
  mb4_core #(.SlCells(biss_pkg::SL_ICE40), .Features(Features)) u_core (
    .clk_i     (clk),
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
