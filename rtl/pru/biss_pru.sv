// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C master with the memory of TIDEP0022 on AXI4-Lite: DATA_LENGTH to LINE_DELAY at 0x000, the
// page of the family at 0x200.
//
// Clock domain: clk_i, 200 or 80 MHz as ClockHz says. sl_i and trigger_i are asynchronous: each has
// two flops. ma_o is a flop.
//
// Reset and misuse: pru_core.
// Source: TIDEP0022; docs/pru.md.

module biss_pru #(
  parameter int unsigned ClockHz  = 200_000_000,  // or 80_000_000
  parameter bit          SMA_WRAP = 1'b0,         // average of bit numbers, as published
  parameter bit          FIRST_LOW = 1'b0,        // sample point from the first low sample
  parameter bit          EXTRA_10 = 1'b1          // LINE_DELAY shows two periods more at 10 MHz
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // AXI4-Lite
  input  logic        s_axi_awvalid,
  output logic        s_axi_awready,
  input  logic [11:0] s_axi_awaddr,
  input  logic        s_axi_wvalid,
  output logic        s_axi_wready,
  input  logic [31:0] s_axi_wdata,
  input  logic [3:0]  s_axi_wstrb,
  output logic        s_axi_bvalid,
  input  logic        s_axi_bready,
  output logic [1:0]  s_axi_bresp,
  input  logic        s_axi_arvalid,
  output logic        s_axi_arready,
  input  logic [11:0] s_axi_araddr,
  output logic        s_axi_rvalid,
  input  logic        s_axi_rready,
  output logic [31:0] s_axi_rdata,
  output logic [1:0]  s_axi_rresp,
  output logic        irq_o,
  input  logic        trigger_i,   // its rising edge starts a frame
  // BiSS C
  output logic        ma_o,
  input  logic        sl_i
);

  pru_pkg::quirks_t quirks;

  always_comb begin
    quirks.sma_wrap  = SMA_WRAP;
    quirks.first_low = FIRST_LOW;
    quirks.extra_10  = EXTRA_10;
  end

  pru_core #(.ClockHz(ClockHz)) u_core (
    .clk_i,
    .rst_ni,
    .quirks_i (quirks),
    .s_axi_awvalid,
    .s_axi_awready,
    .s_axi_awaddr,
    .s_axi_wvalid,
    .s_axi_wready,
    .s_axi_wdata,
    .s_axi_wstrb,
    .s_axi_bvalid,
    .s_axi_bready,
    .s_axi_bresp,
    .s_axi_arvalid,
    .s_axi_arready,
    .s_axi_araddr,
    .s_axi_rvalid,
    .s_axi_rready,
    .s_axi_rdata,
    .s_axi_rresp,
    .irq_o,
    .trigger_i,
    .ma_o,
    .sl_i
  );

endmodule
