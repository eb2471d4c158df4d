// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C master with N channels behind AXI4-Lite, or with Spi = 1 behind SPI (instances, the common
// time base, the pins of error and warning). biss_axi and biss_spi are the tops; switches_i is what
// their parameters tie off. The pins of the other host do not count; outputs to it are 0. Extras
// says what there is beyond the document (axi_pkg::EXTRA_*); any of them but EXTRA_ALIGN needs
// EXTRA_PAGE too.
//
// Clock domain: clk_i. slo_i, ext_sample_clk_i, sample_en_i and the pins of SPI are asynchronous.
// Reset: rst_ni and por_ni may fall and rise at any time; both are released here with clk_i. por_ni
// resets MA and its time base, rst_ni all the rest; while por_ni is 0 rst_ni must be 0. After a
// reset each channel holds starts back for TimeoutLimit clocks.
// error_no and warn_no are 0 while the last good frame of an enabled channel had nE = 0 or nW = 0;
// they change one clock after the frame.
//
// Misuse: configuration that changes while a frame runs counts from the next frame on, except the
// channel enable: a channel that is disabled ends its frame at once.
// Source: hello-fpga BiSS-C master manual; docs/axi.md.

module axi_core #(
  parameter int unsigned Channels     = 1,     // 1 to 16
  parameter bit          Spi          = 1'b0,  // the host: AXI4-Lite or SPI
  parameter int unsigned StreamMode   = 0,
  parameter logic [axi_pkg::EXTRAS_W-1:0] Extras = '0,
  parameter int unsigned StreamLane   = Extras[axi_pkg::EXTRA_WIDE] ? 64 : 32,  // mode 0
  parameter int unsigned StreamDataW  = StreamLane * Channels,
  parameter int unsigned StreamUserW  = Channels,
  parameter int unsigned StreamDepth  = 16,
  parameter int unsigned StartLimit   = 1024,
  parameter int unsigned TimeoutLimit = 4000
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             por_ni,      // MA and its time base
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
  // SPI
  input  logic             sclk_i,
  input  logic             cs_ni,
  input  logic             mosi_i,
  output logic             miso_o,
  output logic             miso_oe_o,
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
  output logic             warn_no,
  output logic             irq_o
);

  localparam bit WIDE    = Extras[axi_pkg::EXTRA_WIDE];
  localparam bit CRC     = Extras[axi_pkg::EXTRA_CRC];
  localparam bit TIMEOUT = Extras[axi_pkg::EXTRA_TIMEOUT];
  localparam bit ACCESS  = Extras[axi_pkg::EXTRA_ACCESS];
  localparam bit FRAMES  = Extras[axi_pkg::EXTRA_FRAME_SAMPLER];
  localparam bit ALIGN   = Extras[axi_pkg::EXTRA_ALIGN] && Channels > 1;
  localparam int unsigned LONGEST = StartLimit > TimeoutLimit ? StartLimit : TimeoutLimit;
  localparam int unsigned COUNT_W = TIMEOUT ? 20 : LONGEST > 128 ? $clog2(LONGEST) : 7;

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (TimeoutLimit < 1 || TimeoutLimit > 1_048_575) begin : gen_timeout_limit
    $error("TimeoutLimit is 1 to 1048575");
  end
  if (Channels < 1 || Channels > 16) begin : gen_channels
    $error("Channels is 1 to 16");
  end
`endif

  logic        rst_n, por_n;
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
  logic [Channels*axi_pkg::MORE_W-1:0]   mores;
  logic [Channels*axi_pkg::EVENT_W-1:0]  events;
  logic [Channels*axi_pkg::EYE_W-1:0]    eyes;
  logic [Channels*2-1:0]                 cdm;
  logic [Channels-1:0] channel_start;
  logic [Channels-1:0] pending;          // a shifted start is to come
  logic [Channels-1:0] good;
  logic [3:0]          index;
  axi_pkg::bus_t       bus;
  axi_pkg::page_t      page;
  axi_pkg::rule_t      rule;
  logic [4:0]          crc_bits;
  logic [31:0]         page_data;
  logic take, start, done, skip, sense;
  logic tick, half_next;
  logic sending, measuring, overrun;
  biss_pkg::sample_t unused_sample;
  logic unused_half, unused_host;
  logic [3*Channels-1:0] unused_samples;
  logic [Channels-1:0]   unused_halves;
  logic error_q, warn_q, unused;

  enc_reset_sync u_reset (
    .clk_i,
    .rst_ni,
    .rst_sync_no (rst_n)
  );

  enc_reset_sync u_power_on (
    .clk_i,
    .rst_ni      (por_ni),
    .rst_sync_no (por_n)
  );

  axi_regs #(.Channels(Channels)) u_regs (
    .clk_i,
    .rst_ni         (rst_n),
    .word_req_i     (req),
    .word_write_i   (write),
    .word_addr_i    (addr),
    .word_data_i    (wdata),
    .word_be_i      (be),
    .word_data_o    (rdata),
    .cfg_o          (cfg),
    .enable_o       (enable),
    .ma_shift_o     (ma_shift),
    .index_o        (index),
    .page_data_i    (page_data),
    .single_valid_i (single_valid),
    .results_i      (results),
    .mores_i        (mores)
  );

  assign enabled  = enable ^ {Channels{switches_i.enable_active_low}};
  assign bus.rd   = req && !write;
  assign bus.wr   = req && write && be == 4'hF;
  assign bus.addr = {addr, 2'b00};
  assign bus.data = wdata;

  axi_start #(.Wide(WIDE)) u_start (
    .clk_i,
    .rst_ni     (rst_n),
    .cfg_i      (cfg),
    .check_i    (cfg.crc_check ^ switches_i.crc_bit_ignores),
    .crc_bits_i (crc_bits),
    .any_i      (|enabled),
    .busy_i     (|((busy | pending) & enabled) || sending || measuring),
    .in_frame_i (|((in_frame | pending) & enabled)),
    .take_o     (take),
    .start_o    (start),
    .done_o     (done),
    .skip_o     (skip),
    .sense_o    (sense),
    .frame_o    (frame),
    .ext_sample_clk_i,
    .sample_en_i,
    .sample_clk_o
  );

  axi_rule #(.TimeoutLimit(TimeoutLimit), .AnyCrc(CRC), .Timeout(TIMEOUT)) u_rule (
    .clk_i,
    .rst_ni     (rst_n),
    .page_i     (page),
    .take_i     (take),
    .rule_o     (rule),
    .crc_bits_o (crc_bits)
  );

  biss_timebase #(.LastW(8), .Tens(1'b0)) u_timebase (
    .clk_i,
    .rst_ni        (por_n),
    .last_i        (frame.half_last),
    .tens_i        (1'b0),
    .run_i         (1'b1),
    .restart_i     (start),
    .tick_o        (tick),
    .half_next_o   (half_next),
    .sample_o      (unused_sample),
    .sample_half_o (unused_half)
  );

  for (genvar i = 0; i < Channels; i++) begin : gen_channel
    logic ma_tick, ma_half_next;

    // A channel whose start is shifted has a time base of its own.
    if (ALIGN) begin : gen_own_timebase
      biss_timebase #(.LastW(8), .Tens(1'b0)) u_own_timebase (
        .clk_i,
        .rst_ni        (por_n),
        .last_i        (frame.half_last),
        .tens_i        (1'b0),
        .run_i         (1'b1),
        .restart_i     (channel_start[i]),
        .tick_o        (ma_tick),
        .half_next_o   (ma_half_next),
        .sample_o      (unused_samples[3*i +: 3]),
        .sample_half_o (unused_halves[i])
      );
    end else begin : gen_common_timebase
      assign ma_tick      = tick;
      assign ma_half_next = half_next;
      assign unused_samples[3*i +: 3] = 3'd0;
      assign unused_halves[i]         = 1'b0;
    end

    axi_channel #(
      .StartLimit(StartLimit), .CountW(COUNT_W), .Wide(WIDE), .AnyCrc(CRC), .Access(ACCESS),
      .FrameSampler(FRAMES)
    ) u_channel (
      .clk_i,
      .rst_ni         (rst_n),
      .por_ni         (por_n),
      .frame_i        (frame),
      .rule_i         (rule),
      .cdm_i          (cdm[2*i +: 2]),
      .clear_i        (cfg.soft_reset),
      .enabled_i      (enabled[i]),
      .start_i        (channel_start[i]),
      .request_i      (frame.single && switches_i.valid_until_request),
      .tick_i         (ma_tick),
      .half_next_i    (ma_half_next),
      .busy_o         (busy[i]),
      .frame_o        (in_frame[i]),
      .single_valid_o (single_valid[i]),
      .result_o       (results[i*axi_pkg::RESULT_W +: axi_pkg::RESULT_W]),
      .word_o         (words[i*axi_pkg::WORD_W +: axi_pkg::WORD_W]),
      .more_o         (mores[i*axi_pkg::MORE_W +: axi_pkg::MORE_W]),
      .event_o        (events[i*axi_pkg::EVENT_W +: axi_pkg::EVENT_W]),
      .eye_o          (eyes[i*axi_pkg::EYE_W +: axi_pkg::EYE_W]),
      .ma_o           (ma_o[i]),
      .slo_i          (slo_i[i])
    );
    assign good[i]  = words[i*axi_pkg::WORD_W + axi_pkg::WORD_GOOD];
    assign nerr[i]  = words[i*axi_pkg::WORD_W + axi_pkg::WORD_NERR];
    assign nwarn[i] = words[i*axi_pkg::WORD_W + axi_pkg::WORD_NWARN];
  end

  if (Spi) begin : gen_spi
    enc_spi #(.AddrW(8)) u_spi (
      .clk_i,
      .rst_ni       (rst_n),
      .sclk_i,
      .cs_ni,
      .mosi_i,
      .miso_o,
      .miso_oe_o,
      .word_req_o   (req),
      .word_write_o (write),
      .word_addr_o  (addr),
      .word_data_o  (wdata),
      .word_be_o    (be),
      .word_ready_i (1'b1),
      .word_data_i  (rdata),
      .word_error_i (1'b0)
    );

    // Nobody answers on AXI4-Lite.
    assign s_axi_awready = 1'b0;
    assign s_axi_wready  = 1'b0;
    assign s_axi_bvalid  = 1'b0;
    assign s_axi_bresp   = 2'b00;
    assign s_axi_arready = 1'b0;
    assign s_axi_rvalid  = 1'b0;
    assign s_axi_rdata   = '0;
    assign s_axi_rresp   = 2'b00;
    assign unused_host   = s_axi_awvalid ^ (^s_axi_awaddr) ^ s_axi_wvalid ^ (^s_axi_wdata) ^
                           (^s_axi_wstrb) ^ s_axi_bready ^ s_axi_arvalid ^ (^s_axi_araddr) ^
                           s_axi_rready;
  end else begin : gen_axil
    enc_axil #(.AddrW(8)) u_axil (
      .clk_i,
      .rst_ni       (rst_n),
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

    assign miso_o      = 1'b0;
    assign miso_oe_o   = 1'b0;
    assign unused_host = sclk_i ^ cs_ni ^ mosi_i ^ (^{s_axi_awaddr[1:0], s_axi_araddr[1:0]});
  end

  axi_extras #(.Channels(Channels), .Extras(Extras)) u_extras (
    .clk_i,
    .rst_ni      (rst_n),
    .switches_i,
    .clear_i     (cfg.soft_reset),
    .bus_i       (bus),
    .index_i     (index),
    .data_o      (page_data),
    .page_o      (page),
    .start_i     (start),
    .skip_i      (skip),
    .done_i      (done),
    .sense_i     (sense),
    .overrun_i   (overrun),
    .check_i     (frame.check),
    .enabled_i   (enabled),
    .good_i      (good),
    .events_i    (events),
    .results_i   (results),
    .words_i     (words),
    .mores_i     (mores),
    .eyes_i      (eyes),
    .ma_shift_i  (ma_shift),
    .start_o     (channel_start),
    .pending_o   (pending),
    .measuring_o (measuring),
    .cdm_o       (cdm),
    .tick_i      (tick),
    .half_next_i (half_next),
    .irq_o
  );

  axi_stream #(
    .Channels(Channels), .Mode(StreamMode), .Lane(StreamLane), .DataW(StreamDataW),
    .UserW(StreamUserW), .Depth(StreamDepth)
  ) u_stream (
    .clk_i,
    .rst_ni    (rst_n),
    .clear_i   (cfg.soft_reset),
    .done_i    (done),
    .enabled_i (enabled),
    .words_i   (words),
    .mores_i   (mores),
    .busy_o    (sending),
    .overrun_o (overrun),
    .s_axis_tvalid,
    .s_axis_tready,
    .s_axis_tdata,
    .s_axis_tuser,
    .s_axis_tlast
  );

  always_ff @(posedge clk_i or negedge rst_n) begin
    if (!rst_n) begin
      error_q <= 1'b1;
      warn_q  <= 1'b1;
    end else begin
      error_q <= &(nerr | ~enabled);
      warn_q  <= &(nwarn | ~enabled);
    end
  end

  assign error_no = error_q;
  assign warn_no  = warn_q;
  assign unused   = (^{unused_host, unused_sample, unused_half, unused_samples, unused_halves});

endmodule
