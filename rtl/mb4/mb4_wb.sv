// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip on Wishbone B4, classic or pipelined, 32 bits, 12 bits of byte address: the registers of
// the chip at 0x000..0x0FF, four bytes to a word, and a page of words at 0x100 (docs/buses.md).
//
// Clock domains: wb_clk_i and clk_i (core). They need no relation, and may be one clock; there is
// no clock switch, so CLKENI only goes to clkeni_o.
// Reset: wb_rst_i (active high, without glitches) resets all but MA and its time base; por_ni is
// the power-on reset and is asserted together with it.
// Latency: enc_wb and mb4_bridge. While the core's clock runs, an access waits for the core and
// then ends. After that clock has stopped, the access waits WaitLimit clocks of wb_clk_i and is
// ended by wb_err_o. irq_o is active high and changes with wb_clk_i.
//
// Misuse of the bus: see enc_wb. Addresses that hold nothing read 0 and ignore writes.
// Source: decision 45; Wishbone B4.

module mb4_wb #(
  parameter bit          Pipelined = 1'b0,
  parameter logic [1:0]  SlCells   = biss_pkg::SL_FLOPS,  // SL: flops or DDR cells
  parameter int unsigned WaitLimit = 1024,
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
  // Wishbone
  input  logic        wb_clk_i,
  input  logic        wb_rst_i,
  input  logic        wb_cyc_i,
  input  logic        wb_stb_i,
  input  logic        wb_we_i,
  input  logic [11:2] wb_adr_i,
  input  logic [31:0] wb_dat_i,
  input  logic [3:0]  wb_sel_i,
  output logic [31:0] wb_dat_o,
  output logic        wb_ack_o,
  output logic        wb_err_o,
  output logic        wb_stall_o,  // of pipelined cycles; classic masters leave it open
  output logic        irq_o,
  // core
  input  logic        clk_i,
  input  logic        por_ni,      // power-on reset; asserted together with wb_rst_i
  output logic        eot_o,
  output logic        ner_low_o,   // an error flag is set: pull NER low
  input  logic        ner_i,       // level at NER
  output logic        clkeni_o,    // CLKENI as written
  output logic        paired_o,    // CFGIF: line 1 is differential and takes the pins of line 2
  input  logic        getsens_i,
  // lines
  output logic        ma1_o,
  input  logic        sl1_i,
  output logic        mo1_o,
  output logic        ma2_o,
  input  logic        sl2_i,
  output logic        mo2_o,
  // constants
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i
);

  localparam logic [31:0] FEATURES =
      mb4_pkg::features(Lines, Slaves, Banks, Force, Gray, BissB, Ssi, Mo, Control, FreeCrc);

  logic        rst_n;
  logic        word_req, word_write, word_ready, word_error;
  logic [11:2] word_addr;
  logic [31:0] word_wdata, word_rdata;
  logic [3:0]  word_be;

  enc_wb #(.AddrW(12), .Pipelined(Pipelined)) u_wb (
    .clk_i        (wb_clk_i),
    .rst_ni       (rst_n),
    .wb_cyc_i,
    .wb_stb_i,
    .wb_we_i,
    .wb_adr_i,
    .wb_dat_i,
    .wb_sel_i,
    .wb_dat_o,
    .wb_ack_o,
    .wb_err_o,
    .wb_stall_o,
    .word_req_o   (word_req),
    .word_write_o (word_write),
    .word_addr_o  (word_addr),
    .word_data_o  (word_wdata),
    .word_be_o    (word_be),
    .word_ready_i (word_ready),
    .word_data_i  (word_rdata),
    .word_error_i (word_error)
  );

  mb4_bus #(.SlCells(SlCells), .WaitLimit(WaitLimit), .Features(FEATURES)) u_bus (
    .bus_clk_i       (wb_clk_i),
    .bus_rst_ni      (!wb_rst_i),
    .bus_rst_sync_no (rst_n),
    .word_req_i      (word_req),
    .word_write_i    (word_write),
    .word_addr_i     (word_addr),
    .word_data_i     (word_wdata),
    .word_be_i       (word_be),
    .word_ready_o    (word_ready),
    .word_data_o     (word_rdata),
    .word_error_o    (word_error),
    .irq_o,
    .clk_i,
    .por_ni,
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
    .quirks_i
  );

endmodule
