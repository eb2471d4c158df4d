// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4_core on a ULX3S (ECP5): host (SPI) and line transceivers on J1, the board's 25 MHz as system
// clock: MA up to 12.5 MHz. Pins and clocks: ulx3s.lpf.

module ulx3s #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic clk_i,      // 25 MHz
  input  logic button_ni,  // NRES: button PWR
  // host
  input  logic ncs_i,
  input  logic mosi_i,
  output logic miso_io,
  input  logic sclk_i,
  // lines, open-drain NER, EOT
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
  logic [3:0] por_q = 4'd0;

  // 15 clocks of power-on reset after the configuration.
  always_ff @(posedge clk_i) if (por_q != 4'd15) por_q <= por_q + 4'd1;
  assign por_n = por_q == 4'd15;

  // SL is taken in flops: nextpnr-ecp5 places a DDR input cell only if its pin goes nowhere else, and
  // register 0xF8 shows the pins.
  mb4_core #(.Features(Features)) u_core (
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

  BB u_miso (
    .B (miso_io),
    .T (!miso_oe),
    .I (miso),
    .O ()
  );

  BB u_ner (
    .B (ner_io),
    .T (!ner_low),
    .I (1'b0),
    .O (ner)
  );

endmodule
