// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of biss_clb: identity, interrupt, time, watchdog.
//
// Clock domain: core. An access never waits. Words of other modules read 0. Reading TIME_LOW copies
// the high word. An event is in IRQ_STATUS at most 6 clocks later. The copy takes its address from
// the clock before the access, so that it is no long path.
//
// Misuse: a read whose address was another one in the clock before copies by that one. A write of
// WATCHDOG without the strobes of both of its bytes has no effect.
// Source: regmap/clb.rdl; docs/clb.md.

module clb_page #(
  parameter int unsigned Watchdog = 4096   // reset value of the register
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  clb_pkg::bus_t bus_i,
  input  logic [11:0] read_addr_i,     // of the read channel; it is there a clock before bus_i.rd
  output logic [31:0] data_o,
  output logic [15:0] watchdog_o,
  // events, each high for one clock
  input  logic        received_i,
  input  logic        error_i,
  input  logic        start_seen_i,
  output logic        irq_o
);

  logic [63:0] now;
  logic [31:0] high_q;
  logic        at_low_q;        // a read in this clock is one of TIME_LOW
  logic [15:0] watchdog_q;
  logic        wr_watchdog;
  logic        irq_byte;
  logic [4:0]  status, enable;
  logic        unused;

  enc_time u_time (
    .clk_i,
    .rst_ni,
    .time_o (now)
  );

  assign irq_byte = bus_i.wr && bus_i.be[0];

  // Bit 4 of enc_irq, a frame while the one before has not been taken, is not shown here.
  enc_irq u_irq (
    .clk_i,
    .rst_ni,
    .event_i     ({1'b0, start_seen_i, 1'b0, error_i, received_i}),
    .bus_clk_i   (clk_i),
    .bus_rst_ni  (rst_ni),
    .status_we_i (irq_byte && bus_i.addr == clb_regs_pkg::ADDR_IRQ_STATUS),
    .enable_we_i (irq_byte && bus_i.addr == clb_regs_pkg::ADDR_IRQ_ENABLE),
    .data_i      ({1'b0, bus_i.data[3], 1'b0, bus_i.data[1:0]}),
    .status_o    (status),
    .enable_o    (enable),
    .irq_o
  );

  assign wr_watchdog = bus_i.wr && bus_i.be[1:0] == 2'b11 &&
                       bus_i.addr == clb_regs_pkg::ADDR_WATCHDOG;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      high_q     <= '0;
      at_low_q   <= 1'b0;
      watchdog_q <= 16'(Watchdog);
    end else begin
      at_low_q <= read_addr_i == clb_regs_pkg::ADDR_TIME_LOW;
      if (bus_i.rd && at_low_q) high_q <= now[63:32];
      if (wr_watchdog) watchdog_q <= bus_i.data[15:0];
    end
  end

  always_comb begin
    data_o = '0;
    unique case (bus_i.addr)
      clb_regs_pkg::ADDR_ID:         data_o       = clb_regs_pkg::RESET_ID;
      clb_regs_pkg::ADDR_VERSION:    data_o       = clb_regs_pkg::RESET_VERSION;
      clb_regs_pkg::ADDR_FEATURES:   data_o       = clb_regs_pkg::RESET_FEATURES;
      clb_regs_pkg::ADDR_IRQ_STATUS: data_o[3:0]  = {status[3], 1'b0, status[1:0]};
      clb_regs_pkg::ADDR_IRQ_ENABLE: data_o[3:0]  = {enable[3], 1'b0, enable[1:0]};
      clb_regs_pkg::ADDR_TIME_LOW:   data_o       = now[31:0];
      clb_regs_pkg::ADDR_TIME_HIGH:  data_o       = high_q;
      clb_regs_pkg::ADDR_WATCHDOG:   data_o[15:0] = watchdog_q;
      default:                       data_o       = '0;
    endcase
  end

  assign watchdog_o = watchdog_q;
  assign unused     = (^bus_i.data[31:16]) ^ (^bus_i.be[3:2]) ^ status[4] ^ status[2] ^ enable[4] ^
                      enable[2];

endmodule
