// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of the BiSS C master with N channels: identity, features, interrupt, time, skipped
// starts, frames that were lost, the time of the sampling instant, and what configures extras.
//
// Clock domain: core. An access never waits. Words of other modules, and words of extras that
// Extras does not have, read 0 and ignore writes. Reading a low word copies the high word that
// belongs to it. The stamp is the time of the first clock in which MA is 1 again after start_i.
//
// Misuse: none.
// Source: regmap/axi.rdl; docs/axi.md.

module axi_page #(
  parameter int unsigned Channels = 1,
  parameter logic [axi_pkg::EXTRAS_W-1:0] Extras = '0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  axi_pkg::switch_t switches_i,
  input  logic        clear_i,      // soft reset
  input  axi_pkg::bus_t bus_i,
  output logic [31:0] data_o,
  output axi_pkg::page_t page_o,
  // events, each high for one clock
  input  logic        start_i,
  input  logic        skip_i,
  input  logic        done_i,
  input  logic        bad_i,        // with done_i: a word is bad
  input  logic        alarm_i,      // a line delay has moved, an eye is narrow
  input  logic        access_end_i,
  input  logic        sense_i,      // the external sample clock rose
  input  logic        overrun_i,    // a frame was lost
  // time base
  input  logic        tick_i,
  input  logic        half_next_i,
  output logic        irq_o
);

  logic [63:0] now;
  logic [31:0] high_q;
  logic [15:0] skips_q;
  logic        lost_q;
  logic [15:0] lost_frames_q;
  logic        wr_status, wr_enable, wr_lost;
  logic [4:0]  status, enable;
  logic [31:0] common, configuration, stamp;
  logic [31:0] features;
  logic        unused;

  assign features = {11'd0, 5'(Channels), 1'b0, Extras[axi_pkg::EXTRA_FRAME_SAMPLER],
                     Extras[axi_pkg::EXTRA_LAST], switches_i, Extras[axi_pkg::EXTRA_ALIGN:0]};

  enc_time u_time (
    .clk_i,
    .rst_ni,
    .time_o (now)
  );

  enc_irq u_irq (
    .clk_i,
    .rst_ni,
    .event_i     ({skip_i || overrun_i, sense_i, access_end_i, (done_i && bad_i) || alarm_i,
                   done_i}),
    .bus_clk_i   (clk_i),
    .bus_rst_ni  (rst_ni),
    .status_we_i (wr_status),
    .enable_we_i (wr_enable),
    .data_i      (bus_i.data[4:0]),
    .status_o    (status),
    .enable_o    (enable),
    .irq_o
  );

  assign wr_status = bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_IRQ_STATUS;
  assign wr_enable = bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_IRQ_ENABLE;
  assign wr_lost   = bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_STREAM_STATUS;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      high_q        <= '0;
      skips_q       <= '0;
      lost_q        <= 1'b0;
      lost_frames_q <= '0;
    end else begin
      if (bus_i.rd && bus_i.addr == axi_regs_pkg::ADDR_TIME_LOW) high_q <= now[63:32];
      skips_q <= clear_i ? 16'd0 : skips_q + 16'(skip_i);
      lost_q  <= !clear_i && (overrun_i || (lost_q && !(wr_lost && bus_i.data[0])));
      lost_frames_q <= clear_i ? 16'd0 : lost_frames_q + 16'(overrun_i);
    end
  end

  always_comb begin
    common = '0;
    unique case (bus_i.addr)
      axi_regs_pkg::ADDR_ID:            common       = axi_regs_pkg::RESET_ID;
      axi_regs_pkg::ADDR_VERSION:       common       = axi_regs_pkg::RESET_VERSION;
      axi_regs_pkg::ADDR_FEATURES:      common       = features;
      axi_regs_pkg::ADDR_IRQ_STATUS:    common[4:0]  = status;
      axi_regs_pkg::ADDR_IRQ_ENABLE:    common[4:0]  = enable;
      axi_regs_pkg::ADDR_TIME_LOW:      common       = now[31:0];
      axi_regs_pkg::ADDR_TIME_HIGH:     common       = high_q;
      axi_regs_pkg::ADDR_SKIP_COUNT:    common[15:0] = skips_q;
      axi_regs_pkg::ADDR_STREAM_STATUS: common       = {lost_frames_q, 15'd0, lost_q};
      default:                          common       = '0;
    endcase
  end

  // ---- configuration of extras --------------------------------------------------------------

  if (Extras[axi_pkg::EXTRA_CRC]) begin : gen_crc
    logic [16:0] polynomial_q;
    logic [15:0] start_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        polynomial_q <= '0;
        start_q      <= '0;
      end else if (bus_i.wr) begin
        if (bus_i.addr == axi_regs_pkg::ADDR_CRC_POLYNOMIAL) polynomial_q <= bus_i.data[16:0];
        if (bus_i.addr == axi_regs_pkg::ADDR_CRC_START)      start_q      <= bus_i.data[15:0];
      end
    end

    assign page_o.crc_polynomial = polynomial_q;
    assign page_o.crc_start      = start_q;
  end else begin : gen_no_crc
    assign page_o.crc_polynomial = '0;
    assign page_o.crc_start      = '0;
  end

  if (Extras[axi_pkg::EXTRA_TIMEOUT]) begin : gen_timeout
    logic [20:0] timeout_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) timeout_q <= '0;
      else if (bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_TIMEOUT)
        timeout_q <= {bus_i.data[31], bus_i.data[19:0]};
    end

    assign page_o.timeout_fixed = timeout_q[20];
    assign page_o.timeout_limit = timeout_q[19:0];
  end else begin : gen_no_timeout
    assign page_o.timeout_fixed = 1'b0;
    assign page_o.timeout_limit = '0;
  end

  always_comb begin
    configuration = '0;
    unique case (bus_i.addr)
      axi_regs_pkg::ADDR_CRC_POLYNOMIAL: configuration[16:0] = page_o.crc_polynomial;
      axi_regs_pkg::ADDR_CRC_START:      configuration[15:0] = page_o.crc_start;
      axi_regs_pkg::ADDR_TIMEOUT:
        configuration = {page_o.timeout_fixed, 11'd0, page_o.timeout_limit};
      default:                           configuration = '0;
    endcase
  end

  // ---- sampling instant ---------------------------------------------------------------------

  if (Extras[axi_pkg::EXTRA_STAMP]) begin : gen_stamp
    logic        wait_q;     // MA has not risen yet
    logic        rise_q;
    logic [63:0] stamp_q;
    logic [31:0] stamp_high_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        wait_q       <= 1'b0;
        rise_q       <= 1'b0;
        stamp_q      <= '0;
        stamp_high_q <= '0;
      end else begin
        wait_q <= start_i || (wait_q && !(tick_i && half_next_i));
        rise_q <= wait_q && tick_i && half_next_i;
        if (rise_q) stamp_q <= now;
        if (bus_i.rd && bus_i.addr == axi_regs_pkg::ADDR_SAMPLE_TIME_LOW)
          stamp_high_q <= stamp_q[63:32];
      end
    end

    assign stamp = bus_i.addr == axi_regs_pkg::ADDR_SAMPLE_TIME_LOW  ? stamp_q[31:0] :
                   bus_i.addr == axi_regs_pkg::ADDR_SAMPLE_TIME_HIGH ? stamp_high_q : '0;
    assign unused = 1'b0;
  end else begin : gen_no_stamp
    assign stamp  = '0;
    assign unused = start_i ^ tick_i ^ half_next_i;
  end

  assign data_o = common | configuration | stamp;

endmodule
