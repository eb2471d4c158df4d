// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C master with N channels behind AXI4-Lite (instances, the common time base, the pins of
// error and warning). biss_axi is the top with the document's names; switches_i is what its
// parameters tie off.
//
// Clock domain: clk_i. slo_i, ext_sample_clk_i and sample_en_i are asynchronous.
// error_no and warn_no are 0 while the last good frame of an enabled channel had nE = 0 or nW = 0;
// they change one clock after the frame.
//
// Misuse: configuration that changes while a frame runs counts from the next frame on, except the
// channel enable: a channel that is disabled ends its frame at once.
// Source: hello-fpga BiSS-C master manual; docs/axi.md.

module axi_core #(
  parameter int unsigned Channels     = 1,     // 1 to 16
  parameter int unsigned StreamMode   = 0,
  parameter int unsigned StreamDataW  = 32 * Channels,
  parameter int unsigned StreamUserW  = Channels,
  parameter int unsigned StreamDepth  = 16,
  parameter int unsigned StartLimit   = 1024,
  parameter int unsigned TimeoutLimit = 4000
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  axi_pkg::switch_t switches_i,
  // AXI4-Lite
  input  logic             s_axi_awvalid,
  output logic             s_axi_awready,
  input  logic [7:0]       s_axi_awaddr,
  input  logic             s_axi_wvalid,
  output logic             s_axi_wready,
  input  logic [31:0]      s_axi_wdata,
  input  logic [3:0]       s_axi_wstrb,
  output logic             s_axi_bvalid,
  input  logic             s_axi_bready,
  output logic [1:0]       s_axi_bresp,
  input  logic             s_axi_arvalid,
  output logic             s_axi_arready,
  input  logic [7:0]       s_axi_araddr,
  output logic             s_axi_rvalid,
  input  logic             s_axi_rready,
  output logic [31:0]      s_axi_rdata,
  output logic [1:0]       s_axi_rresp,
  // AXI4-Stream
  output logic                   s_axis_tvalid,
  input  logic                   s_axis_tready,
  output logic [StreamDataW-1:0] s_axis_tdata,
  output logic [StreamUserW-1:0] s_axis_tuser,
  output logic                   s_axis_tlast,
  // lines
  output logic [Channels-1:0]    ma_o,
  input  logic [Channels-1:0]    slo_i,
  // pins
  input  logic             ext_sample_clk_i,
  output logic             sample_clk_o,
  input  logic             sample_en_i,
  output logic             error_no,
  output logic             warn_no
);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (Channels < 1 || Channels > 16) begin : gen_channels
    $error("Channels is 1 to 16");
  end
`endif

  logic        req, write;
  logic [7:2]  addr;
  logic [31:0] wdata, rdata;
  logic [3:0]  be;

  axi_pkg::cfg_t       cfg;
  axi_pkg::frame_t     frame;
  logic [Channels-1:0] enable;
  logic [Channels-1:0] enabled;
  logic [Channels-1:0] ma_shift;
  logic [Channels-1:0] busy;
  logic [Channels-1:0] in_frame;
  logic [Channels-1:0] single_valid;
  logic [Channels-1:0] nerr;
  logic [Channels-1:0] nwarn;
  logic [Channels*axi_pkg::RESULT_W-1:0] results;
  logic [Channels*axi_pkg::WORD_W-1:0]   words;
  logic start, done, skip;
  logic tick, half_next, unused_half;
  biss_pkg::sample_t unused_sample;
  logic sending, overrun;
  logic error_q, warn_q;
  logic unused;

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
    .word_req_o   (req),
    .word_write_o (write),
    .word_addr_o  (addr),
    .word_data_o  (wdata),
    .word_be_o    (be),
    .word_ready_i (1'b1),
    .word_data_i  (rdata),
    .word_error_i (1'b0)
  );

  axi_regs #(.Channels(Channels)) u_regs (
    .clk_i,
    .rst_ni,
    .word_req_i     (req),
    .word_write_i   (write),
    .word_addr_i    (addr),
    .word_data_i    (wdata),
    .word_be_i      (be),
    .word_data_o    (rdata),
    .cfg_o          (cfg),
    .enable_o       (enable),
    .ma_shift_o     (ma_shift),
    .single_valid_i (single_valid),
    .results_i      (results)
  );

  assign enabled = enable ^ {Channels{switches_i.enable_active_low}};

  axi_start u_start (
    .clk_i,
    .rst_ni,
    .cfg_i      (cfg),
    .check_i    (cfg.crc_check ^ switches_i.crc_bit_ignores),
    .any_i      (|enabled),
    .busy_i     (|(busy & enabled) || sending),
    .in_frame_i (|(in_frame & enabled)),
    .start_o    (start),
    .done_o     (done),
    .skip_o     (skip),
    .frame_o    (frame),
    .ext_sample_clk_i,
    .sample_en_i,
    .sample_clk_o
  );

  biss_timebase u_timebase (
    .clk_i,
    .rst_ni,
    .half_len_i    (frame.half_len),
    .run_i         (1'b1),
    .restart_i     (start),
    .tick_o        (tick),
    .half_next_o   (half_next),
    .sample_o      (unused_sample),
    .sample_half_o (unused_half)
  );

  for (genvar i = 0; i < Channels; i++) begin : gen_channel
    axi_channel #(.StartLimit(StartLimit), .TimeoutLimit(TimeoutLimit)) u_channel (
      .clk_i,
      .rst_ni,
      .frame_i        (frame),
      .clear_i        (cfg.soft_reset),
      .enabled_i      (enabled[i]),
      .start_i        (start),
      .request_i      (frame.single && switches_i.valid_until_request),
      .tick_i         (tick),
      .half_next_i    (half_next),
      .busy_o         (busy[i]),
      .frame_o        (in_frame[i]),
      .single_valid_o (single_valid[i]),
      .result_o       (results[i*axi_pkg::RESULT_W +: axi_pkg::RESULT_W]),
      .word_o         (words[i*axi_pkg::WORD_W +: axi_pkg::WORD_W]),
      .ma_o           (ma_o[i]),
      .slo_i          (slo_i[i])
    );
    assign nerr[i]  = words[i*axi_pkg::WORD_W + axi_pkg::WORD_NERR];
    assign nwarn[i] = words[i*axi_pkg::WORD_W + axi_pkg::WORD_NWARN];
  end

  axi_stream #(
    .Channels(Channels), .Mode(StreamMode), .DataW(StreamDataW), .UserW(StreamUserW),
    .Depth(StreamDepth)
  ) u_stream (
    .clk_i,
    .rst_ni,
    .clear_i   (cfg.soft_reset),
    .done_i    (done),
    .enabled_i (enabled),
    .words_i   (words),
    .busy_o    (sending),
    .overrun_o (overrun),
    .s_axis_tvalid,
    .s_axis_tready,
    .s_axis_tdata,
    .s_axis_tuser,
    .s_axis_tlast
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      error_q <= 1'b1;
      warn_q  <= 1'b1;
    end else begin
      error_q <= &(nerr | ~enabled);
      warn_q  <= &(nwarn | ~enabled);
    end
  end

  assign error_no = error_q;
  assign warn_no  = warn_q;
  assign unused   = skip ^ overrun ^ (^ma_shift) ^ switches_i.align_latch ^
                    (^{s_axi_awaddr[1:0], s_axi_araddr[1:0], unused_sample, unused_half});

endmodule
