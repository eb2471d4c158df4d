// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers of both tiles and of the SPI.
//
// Clock domain: core. An access never waits. What acts at once goes out in act_o one clock after
// the access; its data are those of the bus, which stay for this clock.
// A byte without its strobe keeps its value. A number of two bytes is written as a whole: with only
// one of their strobes it keeps its value.
//
// Misuse: addresses without a register read 0 and ignore writes.
// Source: regmap/clb.rdl; TIDM-1010 and the parts' manuals by docs/clb.md.

module clb_regs (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  clb_pkg::bus_t bus_i,
  output logic [31:0] data_o,
  output clb_pkg::cfg_t cfg_o,
  output clb_pkg::act_t act_o,
  input  clb_pkg::frame_t frame_i,
  input  clb_pkg::fifo_t fifo_i,
  input  logic        ma_i          // pin
);

  clb_pkg::cfg_t cfg_q;
  clb_pkg::act_t act;
  clb_pkg::act_t act_q;
  logic        start_q;     // START_OPERATION of the FSM tile
  logic        wr0, wr1;    // the write reaches bits 7..0, 15..8
  logic        whole;
  logic        unused;

  assign wr0 = bus_i.wr && bus_i.be[0];
  assign wr1 = bus_i.wr && bus_i.be[1];
  assign whole = wr0 && wr1;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      cfg_q.ma.match1      <= 12'(clb_regs_pkg::RESET_CLK_COUNTER_0_MATCH1);
      cfg_q.ma.match2      <= 12'(clb_regs_pkg::RESET_CLK_COUNTER_0_MATCH2);
      cfg_q.receive.match1 <= 12'(clb_regs_pkg::RESET_CLK_COUNTER_1_MATCH1);
      cfg_q.receive.match2 <= 12'(clb_regs_pkg::RESET_CLK_COUNTER_1_MATCH2);
      cfg_q.clock_run      <= 1'b0;
      cfg_q.clock_enable   <= 1'b0;
      cfg_q.end_level      <= 1'b0;
      cfg_q.fsm_enable     <= 1'b0;
      cfg_q.spi_match      <= 8'(clb_regs_pkg::RESET_FSM_COUNTER_2_MATCH1);
      cfg_q.r0             <= 8'(clb_regs_pkg::RESET_FSM_HLC_R0);
      cfg_q.char_last      <= 4'(clb_regs_pkg::RESET_SPICCR);
      cfg_q.spi_enable     <= 1'b0;
      cfg_q.fifo_enable    <= 1'b1;
      cfg_q.fifo_irq       <= 1'b0;
      cfg_q.fifo_level     <= '0;
      start_q              <= 1'b0;
    end else begin
      if (whole) begin
        unique case (bus_i.addr)
          clb_regs_pkg::ADDR_CLK_COUNTER_0_MATCH1: cfg_q.ma.match1      <= bus_i.data[11:0];
          clb_regs_pkg::ADDR_CLK_COUNTER_0_MATCH2: cfg_q.ma.match2      <= bus_i.data[11:0];
          clb_regs_pkg::ADDR_CLK_COUNTER_1_MATCH1: cfg_q.receive.match1 <= bus_i.data[11:0];
          clb_regs_pkg::ADDR_CLK_COUNTER_1_MATCH2: cfg_q.receive.match2 <= bus_i.data[11:0];
          default:;
        endcase
      end
      if (wr0) begin
        unique case (bus_i.addr)
          clb_regs_pkg::ADDR_CLK_GPREG:            cfg_q.clock_run      <= bus_i.data[0];
          clb_regs_pkg::ADDR_CLK_LOAD_EN:          cfg_q.clock_enable   <= bus_i.data[1];
          clb_regs_pkg::ADDR_FSM_COUNTER_2_MATCH1: cfg_q.spi_match      <= bus_i.data[7:0];
          clb_regs_pkg::ADDR_FSM_HLC_R0:           cfg_q.r0             <= bus_i.data[7:0];
          clb_regs_pkg::ADDR_FSM_GPREG: begin
            cfg_q.end_level <= bus_i.data[7];
            start_q         <= bus_i.data[0];
          end
          clb_regs_pkg::ADDR_FSM_LOAD_EN:          cfg_q.fsm_enable     <= bus_i.data[1];
          default:;
        endcase
      end
      if (wr1 && bus_i.addr == clb_regs_pkg::ADDR_SPIFFRX) cfg_q.fifo_enable <= bus_i.data[13];
      // The width of a word changes in the clock in which the part word is dropped.
      if (act_q.char_write) begin
        cfg_q.char_last  <= bus_i.data[3:0];
        cfg_q.spi_enable <= bus_i.data[7];
      end
      // The flag is cleared in the same clock, so that it does not interrupt.
      if (act_q.fifo_write) begin
        cfg_q.fifo_irq   <= bus_i.data[5];
        cfg_q.fifo_level <= bus_i.data[4:0];
      end
    end
  end

  always_comb begin
    act.ma_load        = whole && bus_i.addr == clb_regs_pkg::ADDR_CLK_COUNTER_0_LOAD;
    act.receive_load   = whole && bus_i.addr == clb_regs_pkg::ADDR_CLK_COUNTER_1_LOAD;
    act.start          = wr0 && bus_i.addr == clb_regs_pkg::ADDR_FSM_GPREG && bus_i.data[0] &&
                           !start_q;
    act.count_load     = whole && bus_i.addr == clb_regs_pkg::ADDR_FSM_COUNTER_1_LOAD;
    act.count_match    = whole && bus_i.addr == clb_regs_pkg::ADDR_FSM_COUNTER_1_MATCH1;
    act.spi_load       = wr0 && bus_i.addr == clb_regs_pkg::ADDR_FSM_COUNTER_2_LOAD;
    act.char_write     = wr0 && bus_i.addr == clb_regs_pkg::ADDR_SPICCR;
    act.fifo_write     = wr0 && bus_i.addr == clb_regs_pkg::ADDR_SPIFFRX;
    act.overflow_clear = wr1 && bus_i.addr == clb_regs_pkg::ADDR_SPIFFRX && bus_i.data[14];
    act.fifo_read      = bus_i.rd && bus_i.addr == clb_regs_pkg::ADDR_SPIRXBUF;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) act_q <= '0;
    else         act_q <= act;
  end

  always_comb begin
    data_o = '0;
    unique case (bus_i.addr)
      clb_regs_pkg::ADDR_CLK_COUNTER_0_MATCH1: data_o[11:0] = cfg_q.ma.match1;
      clb_regs_pkg::ADDR_CLK_COUNTER_0_MATCH2: data_o[11:0] = cfg_q.ma.match2;
      clb_regs_pkg::ADDR_CLK_COUNTER_1_MATCH1: data_o[11:0] = cfg_q.receive.match1;
      clb_regs_pkg::ADDR_CLK_COUNTER_1_MATCH2: data_o[11:0] = cfg_q.receive.match2;
      clb_regs_pkg::ADDR_CLK_GPREG:            data_o[0]    = cfg_q.clock_run;
      clb_regs_pkg::ADDR_CLK_LOAD_EN:          data_o[1]    = cfg_q.clock_enable;
      clb_regs_pkg::ADDR_FSM_COUNTER_1_MATCH1: data_o[15:0] = frame_i.count_match;
      clb_regs_pkg::ADDR_FSM_COUNTER_2_MATCH1: data_o[7:0]  = cfg_q.spi_match;
      clb_regs_pkg::ADDR_FSM_HLC_R0:           data_o[7:0]  = cfg_q.r0;
      clb_regs_pkg::ADDR_FSM_GPREG: begin
        data_o[7] = cfg_q.end_level;
        data_o[0] = start_q;
      end
      clb_regs_pkg::ADDR_FSM_LOAD_EN:          data_o[1]    = cfg_q.fsm_enable;
      clb_regs_pkg::ADDR_FSM_STATE: begin
        data_o[24]    = frame_i.watchdog;
        data_o[23:16] = frame_i.spi_count;
        data_o[15:8]  = frame_i.ma_count[7:0];
        data_o[3]     = ma_i;
        data_o[2]     = frame_i.sl;
        data_o[1:0]   = frame_i.state;
      end
      clb_regs_pkg::ADDR_SPICCR: begin
        data_o[7]   = cfg_q.spi_enable;
        data_o[3:0] = cfg_q.char_last;
      end
      clb_regs_pkg::ADDR_SPIFFRX: begin
        data_o[15]   = fifo_i.overflow;
        data_o[13]   = cfg_q.fifo_enable;
        data_o[12:8] = fifo_i.level;
        data_o[7]    = fifo_i.raised;
        data_o[5]    = cfg_q.fifo_irq;
        data_o[4:0]  = cfg_q.fifo_level;
      end
      clb_regs_pkg::ADDR_SPIRXBUF:             data_o[15:0] = fifo_i.word;
      default:                                 data_o       = '0;
    endcase
  end

  assign cfg_o  = cfg_q;
  assign act_o  = act_q;
  assign unused = (^bus_i.data[31:16]) ^ bus_i.data[15] ^ bus_i.data[12] ^ (^bus_i.be[3:2]) ^
                  (^frame_i.ma_count[15:8]);

endmodule
