// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers of biss_pru: what the host configures, the memory of TIDEP0022, the page.
//
// Clock domain: core. An access never waits. A byte without its strobe keeps its value. Reading
// POS_HI copies POS_LO for the next read of POS_LO; reading TIME_LOW copies TIME_HIGH.
//
// Misuse: addresses without a register read 0 and ignore writes, so do result bytes.
// Source: regmap/pru.rdl; TIDEP0022, Table 1; docs/pru.md.

module pru_regs #(
  parameter int unsigned ClockHz = 200_000_000
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  pru_pkg::quirks_t quirks_i,
  input  pru_pkg::bus_t bus_i,
  output logic [31:0] data_o,
  output pru_pkg::cfg_t cfg_o,
  // control frame
  output logic [3:0]  ctrl_write_o,
  input  logic [31:0] ctrl_word_i,
  input  pru_pkg::control_t control_i,
  // results
  input  pru_pkg::memory_t memory_i,
  input  logic        latch_i,       // the clock that ends with the first rising edge of MA
  // events, each high for one clock; what belongs to one frame comes in one clock
  input  logic        update_i,
  input  logic        error_i,
  input  logic        ctrl_end_i,
  input  logic        triggered_i,
  input  logic        lost_i,
  output logic        irq_o
);

  localparam logic [23:0] PERIOD   = 24'(ClockHz / 10_000);           // 100 us
  localparam logic [15:0] OVERHEAD = 16'(ClockHz / 1_000_000 * 27);   // 27 us
  localparam bit          SLOW     = ClockHz == 80_000_000;

  pru_pkg::cfg_t cfg_q;
  logic        wr0;
  logic [3:0]  wr;          // strobes of a write
  logic [3:0]  wr_lengths, wr_period, wr_overhead, wr_max;
  logic [63:0] now;
  logic [31:0] high_q;        // TIME_HIGH
  logic [31:0] low_q;         // POS_LO as of the read of POS_HI
  logic        copied_q;
  logic [31:0] latch_q;
  logic [4:0]  status, enable;
  logic        unused;

  assign wr0        = bus_i.wr && bus_i.be[0];
  assign wr         = bus_i.be & {4{bus_i.wr}};
  assign wr_lengths = wr & {4{bus_i.addr == pru_regs_pkg::ADDR_LENGTHS}};
  assign wr_period   = wr & {4{bus_i.addr == pru_regs_pkg::ADDR_TRIGGER_PERIOD}};
  assign wr_overhead = wr & {4{bus_i.addr == pru_regs_pkg::ADDR_OVERHEAD}};
  assign wr_max      = wr & {4{bus_i.addr == pru_regs_pkg::ADDR_PROC_TIME_MAX}};

  enc_time u_time (
    .clk_i,
    .rst_ni,
    .time_o (now)
  );

  enc_irq u_irq (
    .clk_i,
    .rst_ni,
    .event_i     ({lost_i, triggered_i, ctrl_end_i, error_i, update_i}),
    .bus_clk_i   (clk_i),
    .bus_rst_ni  (rst_ni),
    .status_we_i (wr0 && bus_i.addr == pru_regs_pkg::ADDR_IRQ_STATUS),
    .enable_we_i (wr0 && bus_i.addr == pru_regs_pkg::ADDR_IRQ_ENABLE),
    .data_i      (bus_i.data[4:0]),
    .status_o    (status),
    .enable_o    (enable),
    .irq_o
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      cfg_q          <= '0;
      cfg_q.period   <= PERIOD;
      cfg_q.overhead <= OVERHEAD;
    end else begin
      if (wr_lengths[0]) cfg_q.data_length <= bus_i.data[7:0];
      if (wr_lengths[1]) cfg_q.crc_err_war <= bus_i.data[15:8];
      if (wr_lengths[2]) cfg_q.frequency   <= bus_i.data[23:16];
      if (wr0 && bus_i.addr == pru_regs_pkg::ADDR_RUN) cfg_q.run <= bus_i.data[0];
      if (wr_period[0])   cfg_q.period[7:0]    <= bus_i.data[7:0];
      if (wr_period[1])   cfg_q.period[15:8]   <= bus_i.data[15:8];
      if (wr_period[2])   cfg_q.period[23:16]  <= bus_i.data[23:16];
      if (wr_overhead[0]) cfg_q.overhead[7:0]  <= bus_i.data[7:0];
      if (wr_overhead[1]) cfg_q.overhead[15:8] <= bus_i.data[15:8];
      if (wr_max[0])      cfg_q.proc_max[7:0]  <= bus_i.data[7:0];
      if (wr_max[1])      cfg_q.proc_max[9:8]  <= bus_i.data[9:8];
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      high_q   <= '0;
      low_q    <= '0;
      copied_q <= 1'b0;
      latch_q  <= '0;
    end else begin
      if (bus_i.rd && bus_i.addr == pru_regs_pkg::ADDR_TIME_LOW) high_q <= now[63:32];
      if (bus_i.rd && bus_i.addr == pru_regs_pkg::ADDR_POS_HI) begin
        low_q    <= memory_i.position[31:0];
        copied_q <= 1'b1;
      end else if (bus_i.rd && bus_i.addr == pru_regs_pkg::ADDR_POS_LO) begin
        copied_q <= 1'b0;
      end
      if (latch_i) latch_q <= now[31:0];
    end
  end

  always_comb begin
    data_o = '0;
    unique case (bus_i.addr)
      pru_regs_pkg::ADDR_LENGTHS: begin
        data_o[23:16] = cfg_q.frequency;
        data_o[15:8]  = cfg_q.crc_err_war;
        data_o[7:0]   = cfg_q.data_length;
      end
      pru_regs_pkg::ADDR_CTRL:        data_o       = ctrl_word_i;
      pru_regs_pkg::ADDR_POS_HI:      data_o[30:0] = memory_i.position[62:32];
      pru_regs_pkg::ADDR_POS_LO:      data_o       = copied_q ? low_q : memory_i.position[31:0];
      pru_regs_pkg::ADDR_CTRL_RESULT: data_o[7:0]  = control_i.result;
      pru_regs_pkg::ADDR_STATUS: begin
        data_o[21]    = memory_i.no_slave;
        data_o[20]    = control_i.crc_bad;
        data_o[19]    = memory_i.pos_crc_bad;
        data_o[18]    = control_i.sending;
        data_o[17]    = memory_i.late;
        data_o[16]    = memory_i.averaged;
        data_o[15:0]  = memory_i.crc_errors;
      end
      pru_regs_pkg::ADDR_RECEIVED: begin
        data_o[23:16] = memory_i.raw;
        data_o[11:8]  = control_i.crc;
        data_o[5:0]   = memory_i.crc;
      end
      pru_regs_pkg::ADDR_TIMES: begin
        data_o[22:16] = memory_i.line;
        data_o[10:0]  = memory_i.processing;
      end
      pru_regs_pkg::ADDR_ID:          data_o       = pru_regs_pkg::RESET_ID;
      pru_regs_pkg::ADDR_VERSION:     data_o       = pru_regs_pkg::RESET_VERSION;
      pru_regs_pkg::ADDR_FEATURES: begin
        data_o[4]     = quirks_i.extra_10;
        data_o[3]     = quirks_i.first_low;
        data_o[2]     = quirks_i.sma_wrap;
        data_o[1]     = SLOW;
      end
      pru_regs_pkg::ADDR_IRQ_STATUS:  data_o[4:0]  = status;
      pru_regs_pkg::ADDR_IRQ_ENABLE:  data_o[4:0]  = enable;
      pru_regs_pkg::ADDR_TIME_LOW:    data_o       = now[31:0];
      pru_regs_pkg::ADDR_TIME_HIGH:   data_o       = high_q;
      pru_regs_pkg::ADDR_RUN:         data_o[0]    = cfg_q.run;
      pru_regs_pkg::ADDR_TRIGGER_PERIOD: data_o[23:0] = cfg_q.period;
      pru_regs_pkg::ADDR_OVERHEAD:    data_o[15:0] = cfg_q.overhead;
      pru_regs_pkg::ADDR_PROC_TIME_MAX: data_o[9:0] = cfg_q.proc_max;
      pru_regs_pkg::ADDR_SIGNALS: begin
        data_o[16]    = memory_i.after;
        data_o[14:12] = memory_i.used;
        data_o[10:8]  = memory_i.measured;
        data_o[1]     = memory_i.nwarn;
        data_o[0]     = memory_i.nerr;
      end
      pru_regs_pkg::ADDR_FRAME_COUNT: data_o[15:0] = memory_i.frames;
      pru_regs_pkg::ADDR_LATCH_TIME:  data_o       = latch_q;
      default:                        data_o       = '0;
    endcase
  end

  assign ctrl_write_o = wr & {4{bus_i.addr == pru_regs_pkg::ADDR_CTRL}};
  assign cfg_o        = cfg_q;
  assign unused       = wr_lengths[3] ^ wr_period[3] ^ (^wr_overhead[3:2]) ^ (^wr_max[3:2]);

endmodule
