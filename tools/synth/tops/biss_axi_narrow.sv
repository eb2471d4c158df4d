// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_axi with a sink of its stream that has two pins, to place it on devices with few pins: a beat
// is taken into a register, which then shifts out. Only for figures of speed.
//
// Clock domain: axi_aclk. Misuse: as biss_axi.

module biss_axi_narrow #(
  parameter int unsigned Channels   = 1,
  parameter int unsigned StreamMode = 0
) (
  input  logic        axi_aclk,
  input  logic        axi_aresetn,
  input  logic [7:0]  s_axi_awaddr,
  input  logic        s_axi_awvalid,
  output logic        s_axi_awready,
  input  logic [31:0] s_axi_wdata,
  input  logic [3:0]  s_axi_wstrb,
  input  logic        s_axi_wvalid,
  output logic        s_axi_wready,
  output logic [1:0]  s_axi_bresp,
  output logic        s_axi_bvalid,
  input  logic        s_axi_bready,
  input  logic [7:0]  s_axi_araddr,
  input  logic        s_axi_arvalid,
  output logic        s_axi_arready,
  output logic [31:0] s_axi_rdata,
  output logic [1:0]  s_axi_rresp,
  output logic        s_axi_rvalid,
  input  logic        s_axi_rready,
  input  logic        ready_i,
  output logic        stream_o,
  output logic [Channels-1:0] ma,
  input  logic [Channels-1:0] slo,
  input  logic        ext_sample_clk,
  output logic        sample_clk_output,
  input  logic        sample_en,
  output logic        error,
  output logic        warn,
  output logic        irq
);

  localparam int unsigned DATA_W = StreamMode == 1 ? 32 : 32 * Channels;
  localparam int unsigned USER_W = StreamMode == 1 ? 16 : Channels;

  logic [DATA_W-1:0]      data;
  logic [USER_W-1:0]      user;
  logic                   valid, last;
  logic [DATA_W+USER_W:0] beat_q;

  biss_axi #(.BISS_CHANNEL_WIDTH(Channels), .STREAM_MODE(StreamMode)) u_biss_axi (
    .axi_aclk,
    .axi_aresetn,
    .por_n         (1'b1),
    .S_AXI_AWADDR  (s_axi_awaddr),
    .S_AXI_AWVALID (s_axi_awvalid),
    .S_AXI_AWREADY (s_axi_awready),
    .S_AXI_WDATA   (s_axi_wdata),
    .S_AXI_WSTRB   (s_axi_wstrb),
    .S_AXI_WVALID  (s_axi_wvalid),
    .S_AXI_WREADY  (s_axi_wready),
    .S_AXI_BRESP   (s_axi_bresp),
    .S_AXI_BVALID  (s_axi_bvalid),
    .S_AXI_BREADY  (s_axi_bready),
    .S_AXI_ARADDR  (s_axi_araddr),
    .S_AXI_ARVALID (s_axi_arvalid),
    .S_AXI_ARREADY (s_axi_arready),
    .S_AXI_RDATA   (s_axi_rdata),
    .S_AXI_RRESP   (s_axi_rresp),
    .S_AXI_RVALID  (s_axi_rvalid),
    .S_AXI_RREADY  (s_axi_rready),
    .s_axis_tdata  (data),
    .s_axis_tvalid (valid),
    .s_axis_tready (ready_i),
    .s_axis_tlast  (last),
    .s_axis_tuser  (user),
    .ma,
    .slo,
    .ext_sample_clk,
    .sample_clk_output,
    .sample_en,
    .error,
    .warn,
    .irq
  );

  always_ff @(posedge axi_aclk or negedge axi_aresetn) begin
    if (!axi_aresetn) beat_q <= '0;
    else              beat_q <= valid ? {user, data, last} : {1'b0, beat_q[DATA_W+USER_W:1]};
  end

  assign stream_o = beat_q[0];

endmodule
