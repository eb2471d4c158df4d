// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip without its pins: an SPI host interface and mb4_engine. An FPGA design with an SPI host
// instantiates this module. A design with its own bus takes mb4_engine, whose host side is a byte
// bus.
//
// Clock domains: sclk_i (host) and clk_i (core). Timing and misuse: mb4_spi and mb4_engine.
// Reset: rst_ni is asynchronous; por_ni is the power-on reset and is asserted together with it.
// Datasheet: pages 15..36. Crossings: docs/crossings.md.

module mb4_core #(
  parameter logic [1:0] SlCells = biss_pkg::SL_FLOPS,  // SL: flops or DDR cells (biss_sl_capture)
  // Features (docs/integration.md, "Features"): a preset, and what differs from it
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL,
  parameter int unsigned Lines   = Features[mb4_pkg::TWO_LINES_LSB] ? 2 : 1,
  parameter int unsigned Slaves  = 32'(Features[mb4_pkg::SLAVES_LSB +: 4]),
  parameter bit          BissB   = Features[mb4_pkg::BISS_B_LSB],
  parameter bit          Ssi     = Features[mb4_pkg::SSI_LSB],
  parameter bit          Mo      = Features[mb4_pkg::MO_LSB],
  parameter bit          Control = Features[mb4_pkg::CONTROL_LSB],
  parameter bit          Gray    = Features[mb4_pkg::GRAY_LSB],
  parameter bit          Force   = Features[mb4_pkg::FORCE_LSB],
  parameter bit          FreeCrc = Features[mb4_pkg::FREE_CRC_LSB],
  parameter int unsigned Banks   = Features[mb4_pkg::TWO_BANKS_LSB] ? 2 : 1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,      // power-on reset; asserted together with rst_ni
  // SPI
  input  logic       sclk_i,
  input  logic       cs_ni,
  input  logic       mosi_i,
  output logic       miso_o,
  output logic       miso_oe_o,
  // status
  output logic       eot_o,
  output logic       ner_low_o,   // an error flag is set: pull NER low
  input  logic       ner_i,       // level at NER
  output logic       clkeni_o,    // 1 = internal oscillator
  output logic       paired_o,    // CFGIF: line 1 is differential and takes the pins of line 2
  input  logic       getsens_i,
  // lines
  output logic       ma1_o,
  input  logic       sl1_i,
  output logic       mo1_o,
  output logic       ma2_o,
  input  logic       sl2_i,
  output logic       mo2_o,
  // constants
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i
);

  localparam logic [31:0] FEATURES =
      mb4_pkg::features(Lines, Slaves, Banks, Force, Gray, BissB, Ssi, Mo, Control, FreeCrc);

  mb4_pkg::host_t host;
  logic [7:0] rd_data;

  mb4_spi u_spi (
    .rst_ni,
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o,
    .miso_oe_o,
    .host_o    (host),
    .rd_data_i (rd_data)
  );

  // The core has no second read port and no page.
  logic [7:0] rd2_data;
  mb4_pkg::tap_t tap;
  logic       unused;
  assign unused = ^{rd2_data, tap};

  mb4_engine #(.SlCells(SlCells), .Features(FEATURES)) u_engine (
    .clk_i,
    .rst_ni,
    .por_ni,
    .wr_clk_i   (sclk_i),
    .wr_en_i    (host.wr_en),
    .wr_addr_i  (host.wr_addr),
    .wr_data_i  (host.wr_data),
    .rd_clk_i   (sclk_i),
    .rd_en_i    (host.rd_en),
    .rd_addr_i  (host.rd_addr),
    .rd_data_o  (rd_data),
    .rd2_clk_i  (1'b0),
    .rd2_en_i   (1'b0),
    .rd2_addr_i ('0),
    .rd2_data_o (rd2_data),
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
    .tap_o      (tap),
    .quirks_i
  );

endmodule
