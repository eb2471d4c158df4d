// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip with the parallel host bus alone, Intel or Motorola: bus pins before mb4_engine
// (instances only). It is an example of a design without SPI, and serves to measure its area.
//
// Clock domains: the strobes (mb4_par_bus) and clk_i (mb4_engine).
// Datasheet: pages 9, 10, 17, Table 2.

module mb4_parallel #(
  parameter bit Intel = 1'b1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,
  // host
  input  logic       cs_ni,
  input  logic       ale_i,
  input  logic       nrd_rnw_i,
  input  logic       nwr_e_i,
  input  logic [7:0] db_i,
  output logic [7:0] db_o,
  output logic       db_oe_o,
  // status
  output logic       eot_o,
  output logic       ner_low_o,
  input  logic       ner_i,
  input  logic       getsens_i,
  // lines
  output logic       ma1_o,
  input  logic       sl1_i,
  output logic       mo1_o,
  output logic       ma2_o,
  input  logic       sl2_i,
  output logic       mo2_o
);

  logic       wr_clk, rd_clk, clkeni, paired;
  logic [7:0] addr, rd2_data;
  mb4_pkg::tap_t tap;   // only bus tops use it

  mb4_par_bus u_bus (
    .rst_ni,
    .enable_i   (1'b1),
    .int_nmot_i (Intel),
    .cs_ni,
    .ale_i,
    .nrd_rnw_i,
    .nwr_e_i,
    .db_i,
    .wr_clk_o   (wr_clk),
    .rd_clk_o   (rd_clk),
    .addr_o     (addr),
    .db_oe_o
  );

  mb4_engine u_engine (
    .clk_i,
    .rst_ni,
    .por_ni,
    .wr_clk_i   (wr_clk),
    .wr_en_i    (1'b1),
    .wr_addr_i  (addr),
    .wr_data_i  (db_i),
    .rd_clk_i   (rd_clk),
    .rd_en_i    (1'b1),
    .rd_addr_i  (addr),
    .rd_data_o  (db_o),
    .rd2_clk_i  (1'b0),
    .rd2_en_i   (1'b0),
    .rd2_addr_i ('0),
    .rd2_data_o (rd2_data),
    .eot_o,
    .ner_low_o,
    .ner_i,
    .clkeni_o   (clkeni),
    .paired_o   (paired),
    .getsens_i,
    .ma1_o,
    .sl1_i,
    .mo1_o,
    .ma2_o,
    .sl2_i,
    .mo2_o,
    .tap_o      (tap),
    .quirks_i   (mb4_pkg::QUIRKS_DEFAULT)
  );

endmodule
