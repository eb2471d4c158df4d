// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C master with the registers of TIDM-1010 on AXI4-Lite: MA and receive counters, the state of
// the frame, an SPI receiver with its FIFO. The host makes each frame and reads its words.
//
// Clock domain: clk_i. sl_i is asynchronous. ma_o, spi_clk_o and irq_o come from flops; irq_o has a
// gate behind them.
//
// Reset: rst_ni may fall and rise at any time; it is released here with clk_i. It cuts a low pulse
// of MA short. Both tiles then are in reset until the host enables them.
//
// Misuse: an address without a register reads 0 and ignores writes. Others: clb_frame, clb_fifo.
// Source: TIDM-1010; docs/clb.md.

module biss_clb #(
  parameter int unsigned Watchdog = 4096   // reset value of register WATCHDOG, 0 to 65535
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // AXI4-Lite
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
  // BiSS C
  output logic        ma_o,
  input  logic        sl_i,
  output logic        txen_o,      // direction of the transceiver: always 0
  output logic        spi_clk_o    // receive clock, for test
);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (Watchdog > 65535) begin : gen_watchdog
    $error("Watchdog is 0 to 65535");
  end
`endif

  logic        rst_n;
  logic        word_req, word_write;
  logic [11:2] word_addr;
  logic [31:0] word_wdata;
  logic [3:0]  word_be;
  clb_pkg::bus_t   bus;
  clb_pkg::cfg_t   cfg;
  clb_pkg::act_t   act;
  clb_pkg::frame_t frame;
  clb_pkg::fifo_t  fifo;
  logic [31:0] regs_data, page_data;
  logic [15:0] watchdog;
  logic        take, sl_bit, push, lost;
  logic [15:0] word;
  logic        start_seen, expired;
  logic        flag_q;            // RXFFINT that may interrupt
  logic        received;
  logic        unused;

  enc_reset_sync u_rst (
    .clk_i,
    .rst_ni,
    .rst_sync_no (rst_n)
  );

  enc_axil #(.AddrW(12)) u_axil (
    .clk_i,
    .rst_ni        (rst_n),
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
    .word_ready_i  (1'b1),
    .word_data_i   (regs_data | page_data),
    .word_error_i  (1'b0)
  );

  always_comb begin
    bus.rd   = word_req && !word_write;
    bus.wr   = word_req && word_write;
    bus.be   = word_be;
    bus.addr = {word_addr, 2'b00};
    bus.data = word_wdata;
  end

  clb_regs u_regs (
    .clk_i,
    .rst_ni  (rst_n),
    .bus_i   (bus),
    .data_o  (regs_data),
    .cfg_o   (cfg),
    .act_o   (act),
    .frame_i (frame),
    .fifo_i  (fifo),
    .ma_i    (ma_o)
  );

  clb_page #(.Watchdog(Watchdog)) u_page (
    .clk_i,
    .rst_ni       (rst_n),
    .bus_i        (bus),
    .read_addr_i  ({s_axi_araddr[11:2], 2'b00}),
    .data_o       (page_data),
    .watchdog_o   (watchdog),
    .received_i   (received),
    .error_i      (lost || expired),
    .start_seen_i (start_seen),
    .irq_o
  );

  clb_frame u_frame (
    .clk_i,
    .rst_ni       (rst_n),
    .cfg_i        (cfg),
    .act_i        (act),
    .data_i       (bus.data[15:0]),
    .watchdog_i   (watchdog),
    .frame_o      (frame),
    .take_o       (take),
    .bit_o        (sl_bit),
    .start_seen_o (start_seen),
    .watchdog_o   (expired),
    .ma_o,
    .sl_i,
    .spi_clk_o
  );

  clb_receive u_receive (
    .clk_i,
    .rst_ni  (rst_n),
    .clear_i (!cfg.spi_enable || !cfg.fifo_enable || act.char_write),
    .last_i  (cfg.char_last),
    .take_i  (take),
    .bit_i   (sl_bit),
    .push_o  (push),
    .word_o  (word)
  );

  clb_fifo u_fifo (
    .clk_i,
    .rst_ni           (rst_n),
    .enable_i         (cfg.fifo_enable),
    .level_i          (cfg.fifo_level),
    .push_i           (push),
    .word_i           (word),
    .pop_i            (act.fifo_read),
    .int_clear_i      (act.fifo_write && bus.data[6]),
    .overflow_clear_i (act.overflow_clear),
    .lost_o           (lost),
    .fifo_o           (fifo)
  );

  always_ff @(posedge clk_i or negedge rst_n) begin
    if (!rst_n) flag_q <= 1'b0;
    else        flag_q <= fifo.raised && cfg.fifo_irq;
  end

  assign received = fifo.raised && cfg.fifo_irq && !flag_q;
  assign txen_o   = 1'b0;
  assign unused   = (^s_axi_awaddr[1:0]) ^ (^s_axi_araddr[1:0]);

endmodule
