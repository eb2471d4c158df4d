// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4_core's ports around the other tops, so that bench.sv can drive them: `define ENGINE or CHIP.
`timescale 1ns/1ps

module mb4_core (
  input  wire       clk_i, rst_ni, por_ni, sclk_i, cs_ni, mosi_i,
  output wire       miso_o, miso_oe_o, eot_o, ner_low_o,
  input  wire       ner_i,
  output wire       clkeni_o, paired_o,
  input  wire       getsens_i,
  output wire       ma1_o,
  input  wire       sl1_i,
  output wire       mo1_o, ma2_o,
  input  wire       sl2_i,
  output wire       mo2_o,
  input  wire [5:0] quirks_i
);

`ifdef ENGINE
  wire       wr_en, rd_en;
  wire [7:0] wr_addr, wr_data, rd_addr, rd_data;

  mb4_spi u_spi (
    .rst_ni(rst_ni), .sclk_i(sclk_i), .cs_ni(cs_ni), .mosi_i(mosi_i), .miso_o(miso_o),
    .miso_oe_o(miso_oe_o), .host_o({wr_en, wr_addr, wr_data, rd_en, rd_addr}),
    .rd_data_i(rd_data)
  );

  mb4_engine u_engine (
    .clk_i(clk_i), .rst_ni(rst_ni), .por_ni(por_ni), .wr_clk_i(sclk_i), .wr_en_i(wr_en),
    .wr_addr_i(wr_addr), .wr_data_i(wr_data), .rd_clk_i(sclk_i), .rd_en_i(rd_en),
    .rd_addr_i(rd_addr), .rd_data_o(rd_data), .rd2_clk_i(1'b0), .rd2_en_i(1'b0),
    .rd2_addr_i(5'd0), .rd2_data_o(), .tap_o(), .eot_o(eot_o), .ner_low_o(ner_low_o), .ner_i(ner_i),
    .clkeni_o(clkeni_o), .paired_o(paired_o), .getsens_i(getsens_i), .ma1_o(ma1_o),
    .sl1_i(sl1_i), .mo1_o(mo1_o), .ma2_o(ma2_o), .sl2_i(sl2_i), .mo2_o(mo2_o),
    .quirks_i(quirks_i)
  );
`endif

`ifdef CHIP
  wire [7:0] db, db_oe;

  mb4_chip u_chip (
    .clk_i(clk_i), .osc_i(1'b0), .nres_i(rst_ni), .npor_i(por_ni), .cfgspi_i(1'b1),
    .int_nmot_i(1'b0), .ncs_i(cs_ni), .ale_i(sclk_i), .nrd_rnw_i(1'b1), .nwr_e_i(1'b1),
    .db_i({7'b0, mosi_i}), .db_o(db), .db_oe_o(db_oe), .eot_o(eot_o), .ner_i(ner_i),
    .ner_low_o(ner_low_o), .getsens_i(getsens_i), .ma1_o(ma1_o), .ma2_o(ma2_o), .mo1_o(mo1_o),
    .mo2_o(mo2_o), .sl1_i(sl1_i), .sl2_i(sl2_i), .quirks_i(quirks_i)
  );
  assign miso_o    = db[1];
  assign miso_oe_o = db_oe[1];
  assign clkeni_o  = 1'b0;
  assign paired_o  = 1'b0;
`endif

endmodule
