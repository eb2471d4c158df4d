// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host pins of the 28-pin device. The straps choose SPI, with SPI2 beside it, or the parallel
// bus. All of them use one host byte bus; SPI2 has a read port of its own.
//
// Clock domains: wr_clk_o and rd_clk_o are SCLK with SPI, and the strobes with the parallel bus.
// The straps are constant, so the multiplexers in the clock paths make no edge.
// Misuse: a strap that changes may make a clock edge, and with it an access to some address.
// Datasheet: pages 3, 17..19, Tables 1, 2, 4.

module mb4_host (
  input  logic       rst_ni,
  // straps
  input  logic       cfgspi_i,    // 1 = SPI, 0 = parallel
  input  logic       int_nmot_i,  // 1 = Intel, 0 = Motorola
  // pins
  input  logic       ncs_i,
  input  logic       ale_i,       // SCLK
  input  logic       nrd_rnw_i,
  input  logic       nwr_e_i,     // with SPI: 0 = SPI2 is in use
  input  logic [7:0] db_i,        // 0 MOSI; 4 NCS, 5 SCLK, 6 MOSI of SPI2
  output logic [7:0] db_o,        // 1 MISO; 7 MISO of SPI2
  output logic [7:0] db_oe_o,
  // host byte bus
  output logic       wr_clk_o,
  output logic       rd_clk_o,
  output mb4_pkg::host_t host_o,
  input  logic [7:0] rd_data_i,
  // second read port: SCDATA5..8
  output logic       rd2_clk_o,
  output mb4_pkg::mem_rd_t read2_o,
  input  logic [7:0] rd2_data_i
);

  mb4_pkg::host_t spi;
  logic       miso, miso_oe, miso2, miso2_oe;
  logic       par_wr_clk, par_rd_clk, par_oe;
  logic [7:0] par_addr;

  mb4_spi u_spi (
    .rst_ni,
    .sclk_i    (ale_i),
    .cs_ni     (ncs_i || !cfgspi_i),
    .mosi_i    (db_i[0]),
    .miso_o    (miso),
    .miso_oe_o (miso_oe),
    .host_o    (spi),
    .rd_data_i
  );

  mb4_spi2 u_spi2 (
    .rst_ni,
    .sclk_i    (db_i[5]),
    .cs_ni     (db_i[4] || nwr_e_i || !cfgspi_i),
    .mosi_i    (db_i[6]),
    .miso_o    (miso2),
    .miso_oe_o (miso2_oe),
    .read_o    (read2_o),
    .rd_data_i (rd2_data_i)
  );

  mb4_par_bus u_par_bus (
    .rst_ni,
    .enable_i   (!cfgspi_i),
    .int_nmot_i,
    .cs_ni      (ncs_i),
    .ale_i,
    .nrd_rnw_i,
    .nwr_e_i,
    .db_i,
    .wr_clk_o   (par_wr_clk),
    .rd_clk_o   (par_rd_clk),
    .addr_o     (par_addr),
    .db_oe_o    (par_oe)
  );

  assign wr_clk_o  = cfgspi_i ? ale_i : par_wr_clk;
  assign rd_clk_o  = cfgspi_i ? ale_i : par_rd_clk;
  assign host_o    = cfgspi_i ? spi : {1'b1, par_addr, db_i, 1'b1, par_addr};
  assign rd2_clk_o = db_i[5];

  assign db_o    = cfgspi_i ? {miso2, 5'b00000, miso, 1'b0} : rd_data_i;
  assign db_oe_o = cfgspi_i ? {miso2_oe, 5'b00000, miso_oe, 1'b0} : {8{par_oe}};

endmodule
