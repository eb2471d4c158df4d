// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The 28-pin device around mb4_engine: straps, shared pins, clock choice, differential pins.
//
// Pins: a pin that both sides can drive is split into input, output and output enable. The level on
// the wire is decided outside.
//
// Differential lines: with CFGIF = 10 or 11 (RS422, LVDS) the pins of line 2 carry the inverse
// signals of line 1. MA2_NMA1 and MO2_NMO1 send the inverse of MA1 and MO1. SL of line 1 is the
// difference of the pair: 0 with SL1 = 0 and SL2_NSL1 = 1, and 1 with the opposite levels. Equal
// levels are no difference and read 1, as an open cable does. Line 2 sees an open input, 1.
//
// Clock domains: the clocks of the host pins (mb4_host), and the system clock from pin CLK or the
// internal oscillator (CLKENI).
// Reset: NRES stops the system clock at any phase and selects CLK. If MA is low then, it stays low
// until the selected clock runs again. NRES must be low for 250 ns (E08), so that the reset reaches
// every flop of the core. A shorter pulse resets too, if the flops see its edge.
// Datasheet: pages 3, 8, 17..19, 23, Tables 1, 2, 4, 7, 9.

module mb4_chip #(
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
  input  logic       nwr_e_i,     // pin NWR_E: 0 = SPI2 with CFGSPI = 1
  input  logic [7:0] db_i,        // pins DB7..DB0: 0 MOSI; SPI2: 4 NCS, 5 SCLK, 6 MOSI
  output logic [7:0] db_o,        // 1 MISO; 7 MISO of SPI2
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

  localparam logic [31:0] FEATURES =
      mb4_pkg::features(Lines, Slaves, Banks, Force, Gray, BissB, Ssi, Mo, Control, FreeCrc);

  logic clk;
  logic clkeni;
  logic paired;
  logic ma2, mo2;

  mb4_pkg::host_t   host;
  mb4_pkg::mem_rd_t read2;
  logic       wr_clk, rd_clk, rd2_clk;
  logic [7:0] rd_data, rd2_data;
  mb4_pkg::tap_t tap;

  enc_clk_mux u_clk_mux (
    .clk0_i (clk_i),
    .clk1_i (osc_i),
    .rst_ni (nres_i),
    .sel_i  (clkeni),
    .clk_o  (clk)
  );

  mb4_host u_host (
    .rst_ni     (nres_i),
    .cfgspi_i,
    .int_nmot_i,
    .ncs_i,
    .ale_i,
    .nrd_rnw_i,
    .nwr_e_i,
    .db_i,
    .db_o,
    .db_oe_o,
    .wr_clk_o   (wr_clk),
    .rd_clk_o   (rd_clk),
    .host_o     (host),
    .rd_data_i  (rd_data),
    .rd2_clk_o  (rd2_clk),
    .read2_o    (read2),
    .rd2_data_i (rd2_data)
  );

  mb4_engine #(.Port2(1'b1), .Features(FEATURES)) u_engine (
    .clk_i      (clk),
    .rst_ni     (nres_i),
    .por_ni     (npor_i),
    .wr_clk_i   (wr_clk),
    .wr_en_i    (host.wr_en),
    .wr_addr_i  (host.wr_addr),
    .wr_data_i  (host.wr_data),
    .rd_clk_i   (rd_clk),
    .rd_en_i    (host.rd_en),
    .rd_addr_i  (host.rd_addr),
    .rd_data_o  (rd_data),
    .rd2_clk_i  (rd2_clk),
    .rd2_en_i   (read2.en),
    .rd2_addr_i (read2.addr[4:0]),
    .rd2_data_o (rd2_data),
    .eot_o,
    .ner_low_o,
    .ner_i,
    .clkeni_o   (clkeni),
    .paired_o   (paired),
    .getsens_i,
    .ma1_o,
    .sl1_i      (sl1_i || (paired && !sl2_i)),
    .mo1_o,
    .ma2_o      (ma2),
    .sl2_i      (sl2_i || paired),
    .mo2_o      (mo2),
    .tap_o      (tap),
    .quirks_i
  );

  // Only bus tops have a page.
  logic unused;
  assign unused = ^tap;

  assign ma2_o = paired ? !ma1_o : ma2;
  assign mo2_o = paired ? !mo1_o : mo2;

endmodule
