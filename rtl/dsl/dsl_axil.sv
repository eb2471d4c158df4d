// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// DSL master for one line on AXI4-Lite: dsl_bus with its quirks as parameters, which are those in
// capitals (docs/dsl.md, "Quirks").
//
// Clock domains, reset, latency, misuse, source: dsl_bus.

module dsl_axil #(
  parameter bit          SameClock    = 1'b0,
  parameter int unsigned WaitLimit    = 1024,
  parameter bit          SDK_MAP      = 1'b0,
  parameter bit          RECOVER      = !SDK_MAP,
  parameter bit          STRICT_CODE  = 1'b1,
  parameter bit          STRICT_ID    = 1'b1,
  parameter int unsigned SAMPLE       = SDK_MAP ? 0 : 2,
  parameter int unsigned RULES        = SDK_MAP ? 2 : 1,   // document, sick, firmware
  parameter bit          RSSI_TABLE   = 1'b0,
  parameter int unsigned RX_START     = 5,
  parameter int unsigned START_BLOCKS = 4,
  parameter int unsigned VSYNC_LIMIT  = 64,
  parameter int unsigned STALE_LIMIT  = SDK_MAP ? 0 : 2,
  parameter bit          CHECK_ANSWERS = !SDK_MAP
) (
  // AXI4-Lite
  input  logic        s_axi_aclk,
  input  logic        s_axi_aresetn,
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
  // core
  input  logic        clk_i,
  input  logic        rst_ni,
  output logic        link_o,
  output logic        sample_edge_o,
  output logic        position_ready_o,
  output logic [4:0]  interrupts_o,
  // DSL
  output logic        dsl_out_o,
  output logic        dsl_en_o,
  input  logic        dsl_in_i
);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (SAMPLE > 2 || RULES > 2 || RX_START > 15 || START_BLOCKS > 26 || VSYNC_LIMIT > 255
      || STALE_LIMIT > 3) begin : gen_quirks
    $error("a quirk is too large: docs/dsl.md has the limits");
  end
`endif

  dsl_pkg::quirks_t quirks;

  always_comb begin
    quirks.check_answers = CHECK_ANSWERS;
    quirks.sdk_map      = SDK_MAP;
    quirks.recover      = RECOVER;
    quirks.strict_code  = STRICT_CODE;
    quirks.strict_id    = STRICT_ID;
    quirks.sample       = 2'(SAMPLE);
    quirks.rules        = 2'(RULES);
    quirks.rssi_table   = RSSI_TABLE;
    quirks.rx_start     = 4'(RX_START);
    quirks.start_blocks = 5'(START_BLOCKS);
    quirks.vsync_limit  = 8'(VSYNC_LIMIT);
    quirks.stale_limit  = 2'(STALE_LIMIT);
  end

  dsl_bus #(.SameClock(SameClock), .WaitLimit(WaitLimit)) u_bus (
    .s_axi_aclk,
    .s_axi_aresetn,
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
    .clk_i,
    .rst_ni,
    .quirks_i         (quirks),
    .link_o,
    .sample_edge_o,
    .position_ready_o,
    .interrupts_o,
    .dsl_out_o,
    .dsl_en_o,
    .dsl_in_i
  );

endmodule
