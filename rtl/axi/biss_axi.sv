// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C master with N channels: AXI4-Lite registers, words of all channels as an AXI4-Stream.
// Parameters and ports have the names of the document (hello-fpga BiSS-C master manual, 2.2 and
// 2.3); STREAM_MODE and the parameters after it are this project's.
//
// Clock domain: axi_aclk. slo, ext_sample_clk and sample_en are asynchronous.
//
// Reset: axi_aresetn and por_n may fall and rise at any time; they are released here with axi_aclk.
// After a reset each channel holds starts back for TIMEOUT_LIMIT clocks, because an encoder may
// still be in its frame.
//   POR_PIN = 0: por_n does not count (tie it to 1). axi_aresetn cuts a low pulse of MA short.
//   POR_PIN = 1: por_n resets everything. axi_aresetn alone leaves MA and its time base: MA returns
//     to 1 at the end of its half period, so no pulse of MA is cut.
//
// The stream is a source although its names begin with s_axis. In stream mode 0 it is a strobe:
// s_axis_tvalid is 1 for one clock, and s_axis_tready does not count (tie it to 1). Mode 1 is an
// AXI4-Stream.
//
// Misuse: an address without a register reads 0 and ignores writes. Others: axi_core, axi_channel,
// axi_start.

module biss_axi #(
  parameter int unsigned BISS_CHANNEL_WIDTH  = 1,     // channels, 1 to 16
  parameter int unsigned STREAM_MODE         = 0,     // 0: one beat; 1: one beat for each channel
  parameter int unsigned STREAM_WIDTH        = 32,    // mode 1: 32 or 64
  parameter int unsigned STREAM_DEPTH        = 16,    // mode 1: beats in the FIFO, a power of 2
  parameter bit          ENABLE_ACTIVE_LOW   = 1'b0,  // 0x20: 0 = enabled
  parameter bit          CRC_BIT_IGNORES     = 1'b0,  // 0x1C: 1 = not checked
  parameter bit          VALID_UNTIL_REQUEST = 1'b1,  // an accepted request clears 0x34
  parameter int unsigned START_LIMIT         = 1024,  // MA periods up to the start bit
  parameter int unsigned TIMEOUT_LIMIT       = 4000,  // clocks of an encoder's timeout
  parameter bit          ALIGN_LATCH         = 1'b0,  // 0x28 acts
  parameter int unsigned EXTRAS              = 0,     // bits as in axi_pkg and register FEATURES
  parameter bit          POR_PIN             = 1'b0,  // 1: por_n alone resets MA
  parameter int unsigned S_AXIS_TDATA_WIDTH  =
    STREAM_MODE == 1 ? STREAM_WIDTH : ((EXTRAS & 2) != 0 ? 64 : 32) * BISS_CHANNEL_WIDTH,
  parameter int unsigned S_AXIS_TUSER_WIDTH  = STREAM_MODE == 0 ? BISS_CHANNEL_WIDTH : 16
) (
  input  logic        axi_aclk,
  input  logic        axi_aresetn,
  input  logic        por_n,       // power-on reset; counts with POR_PIN = 1
  // AXI4-Lite
  input  logic [7:0]  S_AXI_AWADDR,
  input  logic        S_AXI_AWVALID,
  output logic        S_AXI_AWREADY,
  input  logic [31:0] S_AXI_WDATA,
  input  logic [3:0]  S_AXI_WSTRB,
  input  logic        S_AXI_WVALID,
  output logic        S_AXI_WREADY,
  output logic [1:0]  S_AXI_BRESP,
  output logic        S_AXI_BVALID,
  input  logic        S_AXI_BREADY,
  input  logic [7:0]  S_AXI_ARADDR,
  input  logic        S_AXI_ARVALID,
  output logic        S_AXI_ARREADY,
  output logic [31:0] S_AXI_RDATA,
  output logic [1:0]  S_AXI_RRESP,
  output logic        S_AXI_RVALID,
  input  logic        S_AXI_RREADY,
  // AXI4-Stream; in mode 0 a strobe without a handshake
  output logic [S_AXIS_TDATA_WIDTH-1:0] s_axis_tdata,
  output logic        s_axis_tvalid,
  input  logic        s_axis_tready,  // mode 1 only
  output logic        s_axis_tlast,
  output logic [S_AXIS_TUSER_WIDTH-1:0] s_axis_tuser,
  // BiSS C
  output logic [BISS_CHANNEL_WIDTH-1:0] ma,
  input  logic [BISS_CHANNEL_WIDTH-1:0] slo,
  // sample clock
  input  logic        ext_sample_clk,
  output logic        sample_clk_output,
  input  logic        sample_en,
  // others, active low
  output logic        error,
  output logic        warn,
  // page: active high, 0 without it
  output logic        irq
);

  localparam int unsigned LANE = (EXTRAS & 2) != 0 ? 64 : 32;  // bits of a channel, mode 0
  localparam logic [axi_pkg::EXTRAS_W-1:0] ALL_EXTRAS =
    axi_pkg::EXTRAS_W'(EXTRAS) | (axi_pkg::EXTRAS_W'(ALIGN_LATCH) << axi_pkg::EXTRA_ALIGN) |
    axi_pkg::EXTRAS_W'(EXTRAS != 0);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (STREAM_MODE > 1 || (STREAM_WIDTH != 32 && STREAM_WIDTH != 64)) begin : gen_stream
    $error("STREAM_MODE is 0 or 1, STREAM_WIDTH is 32 or 64");
  end
  if (STREAM_MODE == 1 && STREAM_WIDTH == 32 && ALL_EXTRAS[axi_pkg::EXTRA_WIDE]) begin : gen_wide
    $error("STREAM_WIDTH must be 64 here: EXTRAS has WIDE, and a beat is a position of 64 bits");
  end
  if (STREAM_MODE == 1 && STREAM_DEPTH < BISS_CHANNEL_WIDTH) begin : gen_depth
    $error("STREAM_DEPTH must be at least BISS_CHANNEL_WIDTH: a frame goes into the FIFO whole");
  end
  if (EXTRAS >= 1 << axi_pkg::EXTRAS_W) begin : gen_extras
    $error("EXTRAS has 11 bits");
  end
`endif

  axi_pkg::switch_t switches;
  logic unused_miso, unused_miso_oe;

  axi_widths #(
    .DataW    (S_AXIS_TDATA_WIDTH),
    .UserW    (S_AXIS_TUSER_WIDTH),
    .NeedData (STREAM_MODE == 1 ? STREAM_WIDTH : LANE * BISS_CHANNEL_WIDTH),
    .NeedUser (STREAM_MODE == 1 ? 16 : BISS_CHANNEL_WIDTH)
  ) u_widths ();

  assign switches.enable_active_low   = ENABLE_ACTIVE_LOW;
  assign switches.crc_bit_ignores     = CRC_BIT_IGNORES;
  assign switches.align_latch         = ALIGN_LATCH;
  assign switches.valid_until_request = VALID_UNTIL_REQUEST;

  axi_core #(
    .Channels     (BISS_CHANNEL_WIDTH),
    .StreamMode   (STREAM_MODE),
    .Extras       (ALL_EXTRAS),
    .StreamDataW  (S_AXIS_TDATA_WIDTH),
    .StreamUserW  (S_AXIS_TUSER_WIDTH),
    .StreamDepth  (STREAM_DEPTH),
    .StartLimit   (START_LIMIT),
    .TimeoutLimit (TIMEOUT_LIMIT)
  ) u_core (
    .clk_i            (axi_aclk),
    .rst_ni           (axi_aresetn && (por_n || !POR_PIN)),
    .por_ni           (POR_PIN ? por_n : axi_aresetn),
    .switches_i       (switches),
    .s_axi_awvalid    (S_AXI_AWVALID),
    .s_axi_awready    (S_AXI_AWREADY),
    .s_axi_awaddr     (S_AXI_AWADDR),
    .s_axi_wvalid     (S_AXI_WVALID),
    .s_axi_wready     (S_AXI_WREADY),
    .s_axi_wdata      (S_AXI_WDATA),
    .s_axi_wstrb      (S_AXI_WSTRB),
    .s_axi_bvalid     (S_AXI_BVALID),
    .s_axi_bready     (S_AXI_BREADY),
    .s_axi_bresp      (S_AXI_BRESP),
    .s_axi_arvalid    (S_AXI_ARVALID),
    .s_axi_arready    (S_AXI_ARREADY),
    .s_axi_araddr     (S_AXI_ARADDR),
    .s_axi_rvalid     (S_AXI_RVALID),
    .s_axi_rready     (S_AXI_RREADY),
    .s_axi_rdata      (S_AXI_RDATA),
    .s_axi_rresp      (S_AXI_RRESP),
    .sclk_i           (1'b0),
    .cs_ni            (1'b1),
    .mosi_i           (1'b0),
    .miso_o           (unused_miso),
    .miso_oe_o        (unused_miso_oe),
    .s_axis_tvalid,
    .s_axis_tready,
    .s_axis_tdata,
    .s_axis_tuser,
    .s_axis_tlast,
    .ma_o             (ma),
    .slo_i            (slo),
    .ext_sample_clk_i (ext_sample_clk),
    .sample_clk_o     (sample_clk_output),
    .sample_en_i      (sample_en),
    .error_no         (error),
    .warn_no          (warn),
    .irq_o            (irq)
  );

endmodule
