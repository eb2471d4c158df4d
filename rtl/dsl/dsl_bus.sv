// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// DSL master for one line on AXI4-Lite, 32 bits, 12 bits of address. Its quirks are a port, so that
// a simulator can set them; dsl_axil ties them to parameters.
//
// Clock domains: s_axi_aclk for the bus and irq_o, any frequency; clk_i, 75 MHz, for the rest. They
// need no relation. With SameClock = 1 both ports have the clock of 75 MHz, and the crossing is
// left out. quirks_i stands still; dsl_in_i is asynchronous; outputs: dsl_core.
// Reset: s_axi_aresetn resets the bus side, rst_ni the core with its registers. Both may fall and
// rise at any time; an access that meets a core in reset waits for it, or for WaitLimit.
// Latency: enc_axil, dsl_bridge and dsl_regs; an access takes 11 clocks of the core, and 6 of the
// bus. An access without an answer within WaitLimit clocks of the bus ends with SLVERR: the clock
// of the core stands still. A write is done all the same when it runs again.
// Misuse of the bus: enc_axil. Addresses that hold nothing read 0 and ignore writes.
// Source: docs/dsl.md; AMBA AXI and ACE protocol specification (IHI0022), part B1.

module dsl_bus #(
  parameter bit          SameClock = 1'b0,
  parameter int unsigned WaitLimit = 1024
) (
  // AXI4-Lite
  input  logic             s_axi_aclk,
  input  logic             s_axi_aresetn,
  input  logic             s_axi_awvalid,
  output logic             s_axi_awready,
  input  logic [11:0]      s_axi_awaddr,
  input  logic             s_axi_wvalid,
  output logic             s_axi_wready,
  input  logic [31:0]      s_axi_wdata,
  input  logic [3:0]       s_axi_wstrb,
  output logic             s_axi_bvalid,
  input  logic             s_axi_bready,
  output logic [1:0]       s_axi_bresp,
  input  logic             s_axi_arvalid,
  output logic             s_axi_arready,
  input  logic [11:0]      s_axi_araddr,
  output logic             s_axi_rvalid,
  input  logic             s_axi_rready,
  output logic [31:0]      s_axi_rdata,
  output logic [1:0]       s_axi_rresp,
  output logic             irq_o,
  // core
  input  logic             clk_i,
  input  logic             rst_ni,
  input  dsl_pkg::quirks_t quirks_i,
  output logic             link_o,
  output logic             sample_edge_o,
  output logic             position_ready_o,
  output logic [4:0]       interrupts_o,
  // DSL
  output logic             dsl_out_o,
  output logic             dsl_en_o,
  input  logic             dsl_in_i
);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (WaitLimit < 16 || WaitLimit > 65536) begin : gen_wait
    $error("WaitLimit is 16 to 65536");
  end
`endif

  logic        bus_rst_n, bridge_rst_n;
  logic        word_req, word_write, word_ready, word_error;
  logic [11:2] word_addr;
  logic [31:0] word_wdata, word_rdata;
  logic [3:0]  word_be;
  logic        core_req, core_write, core_ready, core_irq;
  logic [11:2] core_addr;
  logic [31:0] core_wdata, core_rdata;
  logic [3:0]  core_be;
  logic        unused;

  enc_reset_sync u_bus_rst (
    .clk_i       (s_axi_aclk),
    .rst_ni      (s_axi_aresetn),
    .rst_sync_no (bus_rst_n)
  );

  // Both halves of the crossing begin anew together.
  enc_reset_sync u_bridge_rst (
    .clk_i,
    .rst_ni      (s_axi_aresetn),
    .rst_sync_no (bridge_rst_n)
  );

  enc_axil #(.AddrW(12)) u_axil (
    .clk_i         (s_axi_aclk),
    .rst_ni        (bus_rst_n),
    .s_axi_awvalid,
    .s_axi_awready,
    .s_axi_awaddr  (s_axi_awaddr[11:2]),
    .s_axi_wvalid,
    .s_axi_wready,
    .s_axi_wdata,
    .s_axi_wstrb,
    .s_axi_bvalid,
    .s_axi_bready,
    .s_axi_bresp,
    .s_axi_arvalid,
    .s_axi_arready,
    .s_axi_araddr  (s_axi_araddr[11:2]),
    .s_axi_rvalid,
    .s_axi_rready,
    .s_axi_rdata,
    .s_axi_rresp,
    .word_req_o    (word_req),
    .word_write_o  (word_write),
    .word_addr_o   (word_addr),
    .word_data_o   (word_wdata),
    .word_be_o     (word_be),
    .word_ready_i  (word_ready),
    .word_data_i   (word_rdata),
    .word_error_i  (word_error)
  );

  dsl_bridge #(.SameClock(SameClock), .WaitLimit(WaitLimit)) u_bridge (
    .bus_clk_i    (s_axi_aclk),
    .bus_rst_ni   (bus_rst_n),
    .bus_req_i    (word_req),
    .bus_write_i  (word_write),
    .bus_addr_i   (word_addr),
    .bus_data_i   (word_wdata),
    .bus_be_i     (word_be),
    .bus_ready_o  (word_ready),
    .bus_data_o   (word_rdata),
    .bus_error_o  (word_error),
    .bus_irq_o    (irq_o),
    .clk_i,
    .rst_ni       (bridge_rst_n),
    .core_req_o   (core_req),
    .core_write_o (core_write),
    .core_addr_o  (core_addr),
    .core_data_o  (core_wdata),
    .core_be_o    (core_be),
    .core_ready_i (core_ready),
    .core_data_i  (core_rdata),
    .core_irq_i   (core_irq)
  );

  dsl_core u_core (
    .clk_i,
    .rst_ni,
    .quirks_i,
    .word_req_i       (core_req),
    .word_write_i     (core_write),
    .word_addr_i      (core_addr),
    .word_data_i      (core_wdata),
    .word_be_i        (core_be),
    .word_ready_o     (core_ready),
    .word_data_o      (core_rdata),
    .irq_o            (core_irq),
    .link_o,
    .sample_edge_o,
    .position_ready_o,
    .interrupts_o,
    .dsl_out_o,
    .dsl_en_o,
    .dsl_in_i
  );

  assign unused = ^{s_axi_awaddr[1:0], s_axi_araddr[1:0]};

endmodule
