// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host of the BiSS C master: AXI4-Lite, or with Spi = 1 SPI, in front of its word bus, which
// never waits. The pins of the other one do not count; outputs to it are 0.
//
// Clock domain: clk_i; sclk_i, cs_ni and mosi_i are asynchronous. Latency and misuse: enc_axil,
// enc_spi.

module axi_host #(
  parameter bit Spi = 1'b0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // AXI4-Lite
  input  logic        s_axi_awvalid,
  output logic        s_axi_awready,
  input  logic [7:0]  s_axi_awaddr,
  input  logic        s_axi_wvalid,
  output logic        s_axi_wready,
  input  logic [31:0] s_axi_wdata,
  input  logic [3:0]  s_axi_wstrb,
  output logic        s_axi_bvalid,
  input  logic        s_axi_bready,
  output logic [1:0]  s_axi_bresp,
  input  logic        s_axi_arvalid,
  output logic        s_axi_arready,
  input  logic [7:0]  s_axi_araddr,
  output logic        s_axi_rvalid,
  input  logic        s_axi_rready,
  output logic [31:0] s_axi_rdata,
  output logic [1:0]  s_axi_rresp,
  // SPI
  input  logic        sclk_i,
  input  logic        cs_ni,
  input  logic        mosi_i,
  output logic        miso_o,
  output logic        miso_oe_o,
  // word bus
  output logic        word_req_o,
  output logic        word_write_o,
  output logic [7:2]  word_addr_o,
  output logic [31:0] word_data_o,
  output logic [3:0]  word_be_o,
  input  logic [31:0] word_data_i
);

  logic unused;

  if (Spi) begin : gen_spi
    enc_spi #(.AddrW(8)) u_spi (
      .clk_i,
      .rst_ni,
      .sclk_i,
      .cs_ni,
      .mosi_i,
      .miso_o,
      .miso_oe_o,
      .word_req_o,
      .word_write_o,
      .word_addr_o,
      .word_data_o,
      .word_be_o,
      .word_ready_i (1'b1),
      .word_data_i,
      .word_error_i (1'b0)
    );
    assign s_axi_awready = 1'b0;
    assign s_axi_wready  = 1'b0;
    assign s_axi_bvalid  = 1'b0;
    assign s_axi_bresp   = 2'b00;
    assign s_axi_arready = 1'b0;
    assign s_axi_rvalid  = 1'b0;
    assign s_axi_rdata   = '0;
    assign s_axi_rresp   = 2'b00;
    assign unused        = s_axi_awvalid ^ (^s_axi_awaddr) ^ s_axi_wvalid ^ (^s_axi_wdata) ^
                           (^s_axi_wstrb) ^ s_axi_bready ^ s_axi_arvalid ^ (^s_axi_araddr) ^
                           s_axi_rready;
  end else begin : gen_axil
    enc_axil #(.AddrW(8)) u_axil (
      .clk_i,
      .rst_ni,
      .s_axi_awvalid,
      .s_axi_awready,
      .s_axi_awaddr (s_axi_awaddr[7:2]),
      .s_axi_wvalid,
      .s_axi_wready,
      .s_axi_wdata,
      .s_axi_wstrb,
      .s_axi_bvalid,
      .s_axi_bready,
      .s_axi_bresp,
      .s_axi_arvalid,
      .s_axi_arready,
      .s_axi_araddr (s_axi_araddr[7:2]),
      .s_axi_rvalid,
      .s_axi_rready,
      .s_axi_rdata,
      .s_axi_rresp,
      .word_req_o,
      .word_write_o,
      .word_addr_o,
      .word_data_o,
      .word_be_o,
      .word_ready_i (1'b1),
      .word_data_i,
      .word_error_i (1'b0)
    );
    assign miso_o    = 1'b0;
    assign miso_oe_o = 1'b0;
    assign unused    = sclk_i ^ cs_ni ^ mosi_i ^ (^{s_axi_awaddr[1:0], s_axi_araddr[1:0]});
  end

endmodule
