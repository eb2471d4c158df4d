// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The 28-pin device around mb4_core: straps, shared pins, oscillator choice.
//
// Every pin that can be driven from both sides is split into input, output and output enable, so
// that the level on the wire is decided outside. SPI uses ALE = SCLK, DB0 = MOSI, DB1 = MISO with
// CFGSPI = 1. In this version CFGSPI = 0 (parallel bus) and SPI2 (NWR_E = 0) are not there yet:
// the data bus stays in high impedance.
// Clock domains: SCLK; the system clock, from CLK or the internal oscillator (CLKENI). NRES stops
// it at any phase and selects CLK: MA that was low stays so until the selected clock runs again.
// Datasheet: pages 3, 17, 23.

module mb4_chip (
  // clocks and reset
  input  logic       clk_i,       // pin CLK
  input  logic       osc_i,       // internal oscillator
  input  logic       nres_i,      // pin NRES
  input  logic       npor_i,      // internal power-on reset, low together with NRES
  // straps
  input  logic       cfgspi_i,    // pin CFGSPI
  input  logic       int_nmot_i,  // pin INT_NMOT
  // host
  input  logic       ncs_i,       // pin NCS
  input  logic       ale_i,       // pin ALE: SCLK with CFGSPI = 1
  input  logic       nrd_rnw_i,   // pin NRD_RNW
  input  logic       nwr_e_i,     // pin NWR_E
  input  logic [7:0] db_i,        // pins DB7..DB0: DB0 = MOSI
  output logic [7:0] db_o,        // DB1 = MISO
  output logic [7:0] db_oe_o,     // 1 = pin is driven
  // status and frame control
  output logic       eot_o,       // pin EOT
  input  logic       ner_i,       // level at pin NER
  output logic       ner_low_o,   // 1 = pin NER is pulled low by the chip
  input  logic       getsens_i,   // pin GETSENS
  // BiSS/SSI lines
  output logic       ma1_o,       // pin MA1
  output logic       ma2_o,       // pin MA2_NMA1
  output logic       mo1_o,       // pin MO1
  output logic       mo2_o,       // pin MO2_NMO1
  input  logic       sl1_i,       // pin SL1
  input  logic       sl2_i,       // pin SL2_NSL1
  // constants
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i
);

  logic clk;
  logic clkeni;
  logic cs_n;
  logic miso;
  logic miso_oe;

  // Not SPI: the serial interface never sees a selection.
  assign cs_n = ncs_i || !cfgspi_i;

  mb4_clk_mux u_clk_mux (
    .clk0_i (clk_i),
    .clk1_i (osc_i),
    .rst_ni (nres_i),
    .sel_i  (clkeni),
    .clk_o  (clk)
  );

  mb4_core u_core (
    .clk_i     (clk),
    .rst_ni    (nres_i),
    .por_ni    (npor_i),
    .sclk_i    (ale_i),
    .cs_ni     (cs_n),
    .mosi_i    (db_i[0]),
    .miso_o    (miso),
    .miso_oe_o (miso_oe),
    .eot_o,
    .ner_low_o,
    .ner_i,
    .clkeni_o  (clkeni),
    .getsens_i,
    .ma1_o,
    .sl1_i,
    .mo1_o,
    .ma2_o,
    .sl2_i,
    .mo2_o,
    .quirks_i
  );

  assign db_o    = {6'b000000, miso, 1'b0};
  assign db_oe_o = {6'b000000, miso_oe, 1'b0};

  // Pins of functions that this version does not have.
  logic unused;
  assign unused = ^{int_nmot_i, nrd_rnw_i, nwr_e_i, db_i[7:1]};

endmodule
