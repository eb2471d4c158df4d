// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C master with 1 to 4 channels behind SPI: the registers and extras of biss_axi, without its
// stream. The frames of SPI are those of enc_spi. The parameters are those of biss_axi.
//
// Clock domain: clk_i. slo_i, ext_sample_clk_i, sample_en_i and the pins of SPI are asynchronous.
// SCLK is at most clk_i / 8, or clk_i / 4 where the host can take MISO as enc_spi says.
//
// Reset: rst_ni may fall and rise at any time; it is released here with clk_i. It cuts a low pulse
// of MA short. After a reset each channel holds starts back for TIMEOUT_LIMIT clocks, because an
// encoder may still be in its frame.
//
// Misuse: an address without a register reads 0 and ignores writes. Others: enc_spi, axi_core,
// axi_channel, axi_start.
// Source: docs/axi.md.

module biss_spi #(
  parameter int unsigned BISS_CHANNEL_WIDTH  = 1,     // channels, 1 to 4
  parameter bit          ENABLE_ACTIVE_LOW   = 1'b0,  // 0x20: 0 = enabled
  parameter bit          CRC_BIT_IGNORES     = 1'b0,  // 0x1C: 1 = not checked
  parameter bit          VALID_UNTIL_REQUEST = 1'b1,  // an accepted request clears 0x34
  parameter int unsigned START_LIMIT         = 1024,  // MA periods up to the start bit
  parameter int unsigned TIMEOUT_LIMIT       = 4000,  // clocks of an encoder's timeout
  parameter bit          ALIGN_LATCH         = 1'b0,  // 0x28 acts
  parameter int unsigned EXTRAS              = 0      // bits as in axi_pkg and register FEATURES
) (
  input  logic clk_i,
  input  logic rst_ni,
  // SPI
  input  logic sclk_i,
  input  logic cs_ni,
  input  logic mosi_i,
  output logic miso_o,
  output logic miso_oe_o,
  // BiSS C
  output logic [BISS_CHANNEL_WIDTH-1:0] ma_o,
  input  logic [BISS_CHANNEL_WIDTH-1:0] slo_i,
  // sample clock
  input  logic ext_sample_clk_i,
  output logic sample_clk_o,
  input  logic sample_en_i,
  // others, active low
  output logic error_no,
  output logic warn_no,
  // page: active high, 0 without it
  output logic irq_o
);

  localparam logic [axi_pkg::EXTRAS_W-1:0] ALL_EXTRAS =
    axi_pkg::EXTRAS_W'(EXTRAS) | (axi_pkg::EXTRAS_W'(ALIGN_LATCH) << axi_pkg::EXTRA_ALIGN) |
    axi_pkg::EXTRAS_W'(EXTRAS != 0);
  localparam int unsigned LANE = ALL_EXTRAS[axi_pkg::EXTRA_WIDE] ? 64 : 32;

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (BISS_CHANNEL_WIDTH > 4) begin : gen_channels
    $error("BISS_CHANNEL_WIDTH is 1 to 4");
  end
  if (EXTRAS >= 1 << axi_pkg::EXTRAS_W) begin : gen_extras
    $error("EXTRAS has 11 bits");
  end
`endif

  axi_pkg::switch_t switches;
  logic        awready, wready, bvalid, arready, rvalid, tvalid, tlast, unused;
  logic [1:0]  bresp, rresp;
  logic [31:0] rdata;
  logic [LANE*BISS_CHANNEL_WIDTH-1:0] tdata;
  logic [BISS_CHANNEL_WIDTH-1:0]      tuser;

  assign switches.enable_active_low   = ENABLE_ACTIVE_LOW;
  assign switches.crc_bit_ignores     = CRC_BIT_IGNORES;
  assign switches.align_latch         = ALIGN_LATCH;
  assign switches.valid_until_request = VALID_UNTIL_REQUEST;

  axi_core #(
    .Channels     (BISS_CHANNEL_WIDTH),
    .Spi          (1'b1),
    .Extras       (ALL_EXTRAS),
    .StartLimit   (START_LIMIT),
    .TimeoutLimit (TIMEOUT_LIMIT)
  ) u_core (
    .clk_i,
    .rst_ni,
    .por_ni           (rst_ni),
    .switches_i       (switches),
    .s_axi_awvalid    (1'b0),
    .s_axi_awready    (awready),
    .s_axi_awaddr     (8'd0),
    .s_axi_wvalid     (1'b0),
    .s_axi_wready     (wready),
    .s_axi_wdata      (32'd0),
    .s_axi_wstrb      (4'd0),
    .s_axi_bvalid     (bvalid),
    .s_axi_bready     (1'b0),
    .s_axi_bresp      (bresp),
    .s_axi_arvalid    (1'b0),
    .s_axi_arready    (arready),
    .s_axi_araddr     (8'd0),
    .s_axi_rvalid     (rvalid),
    .s_axi_rready     (1'b0),
    .s_axi_rdata      (rdata),
    .s_axi_rresp      (rresp),
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o,
    .miso_oe_o,
    .s_axis_tvalid    (tvalid),
    .s_axis_tready    (1'b1),
    .s_axis_tdata     (tdata),
    .s_axis_tuser     (tuser),
    .s_axis_tlast     (tlast),
    .ma_o,
    .slo_i,
    .ext_sample_clk_i,
    .sample_clk_o,
    .sample_en_i,
    .error_no,
    .warn_no,
    .irq_o
  );

  // There is neither AXI nor a stream.
  assign unused = awready ^ wready ^ bvalid ^ (^bresp) ^ arready ^ rvalid ^ (^rresp) ^ (^rdata) ^
                  tvalid ^ (^tdata) ^ (^tuser) ^ tlast;

endmodule
