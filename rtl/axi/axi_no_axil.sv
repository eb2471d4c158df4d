// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The AXI4-Lite side of a master behind another host: no access is taken, and every output is 0.
//
// Clock domain: none; there are no flops.
// Misuse: a manager here waits for ever.

module axi_no_axil (
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
  output logic [1:0]  s_axi_rresp
);

  logic unused;

  assign s_axi_awready = 1'b0;
  assign s_axi_wready  = 1'b0;
  assign s_axi_bvalid  = 1'b0;
  assign s_axi_bresp   = 2'b00;
  assign s_axi_arready = 1'b0;
  assign s_axi_rvalid  = 1'b0;
  assign s_axi_rdata   = '0;
  assign s_axi_rresp   = 2'b00;
  assign unused = s_axi_awvalid ^ (^s_axi_awaddr) ^ s_axi_wvalid ^ (^s_axi_wdata) ^
                  (^s_axi_wstrb) ^ s_axi_bready ^ s_axi_arvalid ^ (^s_axi_araddr) ^ s_axi_rready;

endmodule
