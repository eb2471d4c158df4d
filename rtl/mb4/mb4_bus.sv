// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip behind a word bus of 32 bits: bridge, page, interrupts and mb4_engine. mb4_axil and
// mb4_wb put their bus in front of it.
//
// Clock domains: bus_clk_i and clk_i (core); they may be one clock. The host clocks of mb4_engine
// are bus_clk_i.
// Reset: bus_rst_ni may be asserted at any time; it is released here with bus_clk_i, and then with
// clk_i for the core. por_ni is the power-on reset and is asserted together with it.
// Latency and misuse: mb4_bridge, mb4_engine.
// Source: decision 45.

module mb4_bus #(
  parameter logic [1:0]  SlCells   = biss_pkg::SL_FLOPS,
  parameter int unsigned WaitLimit = 1024,
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  // bus
  input  logic        bus_clk_i,
  input  logic        bus_rst_ni,
  output logic        bus_rst_sync_no,  // for what stands before the word bus
  input  logic        word_req_i,
  input  logic        word_write_i,
  input  logic [11:2] word_addr_i,
  input  logic [31:0] word_data_i,
  input  logic [3:0]  word_be_i,
  output logic        word_ready_o,
  output logic [31:0] word_data_o,
  output logic        word_error_o,
  output logic        irq_o,
  // core
  input  logic        clk_i,
  input  logic        por_ni,
  output logic        eot_o,
  output logic        ner_low_o,
  input  logic        ner_i,
  output logic        clkeni_o,
  output logic        paired_o,
  input  logic        getsens_i,
  // lines
  output logic        ma1_o,
  input  logic        sl1_i,
  output logic        mo1_o,
  output logic        ma2_o,
  input  logic        sl2_i,
  output logic        mo2_o,
  // constants
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i
);

  mb4_pkg::host_t     host;
  mb4_pkg::page_req_t page;
  mb4_pkg::tap_t      tap;
  logic        rst_core_n;
  logic [7:0]  rd_data, rd2_data;
  logic        rd2_en;
  logic [4:0]  rd2_addr;
  logic        page_ack, beat;
  logic        shadow_en;
  logic [5:0]  shadow_addr;
  logic [31:0] shadow_data;
  logic [4:0]  page_event;
  logic        status_we, enable_we;
  logic [4:0]  irq_data, irq_status, irq_enable;
  logic        unused;

  enc_reset_sync u_bus_reset (
    .clk_i       (bus_clk_i),
    .rst_ni      (bus_rst_ni),
    .rst_sync_no (bus_rst_sync_no)
  );

  enc_reset_sync u_core_reset (
    .clk_i,
    .rst_ni      (bus_rst_sync_no),
    .rst_sync_no (rst_core_n)
  );

  mb4_bridge #(.WaitLimit(WaitLimit)) u_bridge (
    .clk_i         (bus_clk_i),
    .rst_ni        (bus_rst_sync_no),
    .word_req_i,
    .word_write_i,
    .word_addr_i,
    .word_data_i,
    .word_be_i,
    .word_ready_o,
    .word_data_o,
    .word_error_o,
    .host_o        (host),
    .rd_data_i     (rd_data),
    .empty_i       (tap.regs.empty),
    .page_o        (page),
    .ack_i         (page_ack),
    .beat_i        (beat),
    .shadow_en_o   (shadow_en),
    .shadow_addr_o (shadow_addr),
    .shadow_data_i (shadow_data),
    .status_we_o   (status_we),
    .enable_we_o   (enable_we),
    .irq_data_o    (irq_data),
    .status_i      (irq_status),
    .enable_i      (irq_enable),
    .features_i    (Features)
  );

  mb4_page #(.Features(Features)) u_page (
    .clk_i,
    .rst_ni        (rst_core_n),
    .tap_i         (tap),
    .getsens_i,
    .ner_i,
    .rd_en_o       (rd2_en),
    .rd_addr_o     (rd2_addr),
    .page_i        (page),
    .ack_o         (page_ack),
    .beat_o        (beat),
    .event_o       (page_event),
    .shadow_clk_i  (bus_clk_i),
    .shadow_en_i   (shadow_en),
    .shadow_addr_i (shadow_addr),
    .shadow_data_o (shadow_data)
  );

  enc_irq u_irq (
    .clk_i,
    .rst_ni      (rst_core_n),
    .event_i     (page_event),
    .bus_clk_i,
    .bus_rst_ni  (bus_rst_sync_no),
    .status_we_i (status_we),
    .enable_we_i (enable_we),
    .data_i      (irq_data),
    .status_o    (irq_status),
    .enable_o    (irq_enable),
    .irq_o
  );

  mb4_engine #(
    .Port2(1'b1),
    .Tap(1'b1),
    .SlCells(SlCells),
    .Features(Features)
  ) u_engine (
    .clk_i,
    .rst_ni     (bus_rst_sync_no),
    .por_ni,
    .wr_clk_i   (bus_clk_i),
    .wr_en_i    (host.wr_en),
    .wr_addr_i  (host.wr_addr),
    .wr_data_i  (host.wr_data),
    .rd_clk_i   (bus_clk_i),
    .rd_en_i    (host.rd_en),
    .rd_addr_i  (host.rd_addr),
    .rd_data_o  (rd_data),
    .rd2_clk_i  (clk_i),
    .rd2_en_i   (rd2_en),
    .rd2_addr_i (rd2_addr),
    .rd2_data_o (rd2_data),
    .eot_o,
    .ner_low_o,
    .ner_i,
    .clkeni_o,
    .paired_o,
    .getsens_i,
    .ma1_o,
    .sl1_i,
    .mo1_o,
    .ma2_o,
    .sl2_i,
    .mo2_o,
    .tap_o      (tap),
    .quirks_i
  );

  // The page takes both banks of the second read port from tap.
  assign unused = ^rd2_data;

endmodule
