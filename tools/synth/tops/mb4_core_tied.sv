// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4_core as a product has it, for docs/resources.md: the quirks are constants. Not for use in a design.

module mb4_core_tied #(
  parameter logic [31:0] Features = mb4_page_regs_pkg::FEATURES_FULL
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic por_ni,
  input  logic sclk_i,
  input  logic cs_ni,
  input  logic mosi_i,
  output logic miso_o,
  output logic miso_oe_o,
  output logic eot_o,
  output logic ner_low_o,
  input  logic ner_i,
  output logic clkeni_o,
  output logic paired_o,
  input  logic getsens_i,
  output logic ma1_o,
  input  logic sl1_i,
  output logic mo1_o,
  output logic ma2_o,
  input  logic sl2_i,
  output logic mo2_o
);

  mb4_core #(.Features(Features)) u_core (
    .clk_i,
    .rst_ni,
    .por_ni,
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o,
    .miso_oe_o,
    .eot_o,
    .ner_low_o,
    .ner_i,
    .clkeni_o,
    .paired_o,
    .getsens_i,
    .ma1_o,
    .sl1_i,
    .mo1_o,
    .ma2_o,
    .sl2_i,
    .mo2_o,
    .quirks_i (mb4_pkg::QUIRKS_DEFAULT)
  );

endmodule
