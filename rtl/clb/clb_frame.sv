// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A frame: both tiles. It makes MA, finds the start bit, counts MA and SPI clocks.
//
// Clock domain: core; sl_i is asynchronous and has two flops here. ma_o is a flop. MA follows its
// counter in states 01 and 10, is 1 in state 00 and has the end level in state 11. If a frame
// begins while the counter's clock is low, MA waits at 1 for its next rise, so that its first low
// half period is whole.
// A bit is taken at match 1 of the receive counter, which the start bit sets to 0: bit k is the
// level that the synchroniser shows MATCH1 + 1 + k (MATCH2 + 1) clocks after it has shown the start
// bit. bit_o goes with take_o, which is high for one clock.
// In state 10 R0 rising edges of MA are sent. Instead of the next one state 11 begins.
// With watchdog_i not 0, state 11 with MA = 1 begins one clock after that many rising edges without
// a start bit.
//
// Misuse: while MATCH2 of MA is not above MATCH1, MA stays. A start in state 10 ends the frame at
// once, and GLOBAL_EN = 0 at any time sets MA to 1: both may make the last pulse of MA short. What
// changes during a frame counts at once. A frame that begins with SL = 0 takes the next rise of SL
// as its start bit.
// Source: TIDM-1010, 2.3.5; the constraint is that of enc_sync_bit.

`include "enc_check.svh"

module clb_frame (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  clb_pkg::cfg_t cfg_i,
  input  clb_pkg::act_t act_i,
  input  logic [15:0] data_i,        // of the bus, with act_i
  input  logic [15:0] watchdog_i,
  output clb_pkg::frame_t frame_o,
  output logic        take_o,
  output logic        bit_o,
  output logic        start_seen_o,     // the start bit, for one clock
  output logic        watchdog_o,       // the watchdog ends the frame, for one clock
  // pins
  output logic        ma_o,
  input  logic        sl_i,
  output logic        spi_clk_o
);

  logic [1:0]  state;           // clb_pkg::state_e
  logic [1:0]  state_next;
  logic        sl;
  logic        sl_q;
  logic        sl_rise;
  logic        clear;           // reset of the FSM tile
  logic        run;
  logic        sends;           // MA follows its counter
  // MA
  logic        ma_match, ma_wrap;
  logic        ma_lost;
  logic        half_q;          // match 1 has come in this period
  logic        level_q, level;  // the counter's clock
  logic        hold_q;          // MA waits for its clock to be high
  logic        high;
  logic        rise;            // MA is about to rise
  logic        complete;        // R0 rising edges have been sent, and the next one is due
  logic        count_is_match;
  logic [15:0] count_q;
  logic [15:0] match_q;
  logic        begun_q;         // first clock of state 10
  logic        second_q;        // second clock of state 10
  logic        equal_q;         // the count was the match in the clock before
  logic        count_step;
  logic [15:0] count_next;
  logic [15:0] match_sum;
  logic [7:0]  spi_next;
  logic        expired;
  logic        watchdog_q;
  logic        ma_q;
  // receiver
  logic        receive_match, receive_wrap;
  logic        receives;
  logic [7:0]  spi_count_q;
  logic        spi_clk_q;
  logic        unused;

  enc_sync_bit #(.ResetValue(1'b1)) u_sl (
    .clk_i,
    .rst_ni,
    .data_i (sl_i),
    .data_o (sl)
  );

  assign clear   = !cfg_i.fsm_enable;
  assign run     = cfg_i.clock_enable && cfg_i.clock_run;
  assign sl_rise = sl && !sl_q;
  assign sends   = state == clb_pkg::TRANSMIT || state == clb_pkg::BOTH;

  clb_state u_state (
    .clk_i,
    .rst_ni,
    .clear_i      (clear),
    .end_i        (expired),
    .e1_i         (sl_rise),
    .e0_i         (act_i.start || complete),
    .state_o      (state),
    .state_next_o (state_next)
  );

  clb_counter u_ma (
    .clk_i,
    .rst_ni,
    .period_i     (cfg_i.ma),
    .run_i        (run),
    .clear_i      (!cfg_i.clock_enable),
    .load_i       (act_i.ma_load),
    .load_value_i (data_i[11:0]),
    .match_o      (ma_match),
    .wrap_o       (ma_wrap),
    .lost_o       (ma_lost)
  );

  clb_counter u_receive (
    .clk_i,
    .rst_ni,
    .period_i     (cfg_i.receive),
    .run_i        (run),
    .clear_i      (!cfg_i.clock_enable || state == clb_pkg::IDLE ||
                   (state == clb_pkg::TRANSMIT && sl)),
    .load_i       (act_i.receive_load),
    .load_value_i (data_i[11:0]),
    .match_o      (receive_match),
    .wrap_o       (receive_wrap),
    .lost_o       (unused)
  );

  // ---- MA -----------------------------------------------------------------------------------

  // Without a match 1 before its end a period changes nothing.
  assign level    = (level_q && !(ma_wrap && half_q)) || ma_match;
  assign high     = level || hold_q;
  assign rise     = sends && high && !ma_q;
  // MA rises in every second clock at most. So at a rise the count has been there for a clock, and
  // no edge of state 10 has been sent before its third clock if one is sent in its second.
  assign count_is_match = (begun_q || second_q) ? cfg_i.r0 == 8'd0 : equal_q;
  assign count_step = rise && !complete;
  assign count_next = count_q + 16'd1;
  assign match_sum  = count_q + 16'(cfg_i.r0);
  assign complete = state == clb_pkg::BOTH && rise && count_is_match;
  assign expired  = state == clb_pkg::TRANSMIT && !sl_rise && watchdog_i != 16'd0 &&
                    count_q == watchdog_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sl_q       <= 1'b1;
      half_q     <= 1'b0;
      level_q    <= 1'b1;
      hold_q     <= 1'b1;
      begun_q    <= 1'b0;
      second_q   <= 1'b0;
      watchdog_q <= 1'b0;
      ma_q       <= 1'b1;
    end else begin
      sl_q       <= sl;
      half_q     <= cfg_i.clock_enable && !ma_wrap && !ma_lost && (half_q || ma_match);
      level_q    <= level || !cfg_i.clock_enable;
      hold_q     <= !sends || (hold_q && !level);
      begun_q    <= !clear && state == clb_pkg::TRANSMIT && sl_rise;
      second_q   <= begun_q;
      watchdog_q <= !clear && (watchdog_q || expired);
      unique case (state_next)
        clb_pkg::IDLE:    ma_q <= 1'b1;
        clb_pkg::RECEIVE: ma_q <= cfg_i.end_level || watchdog_q || expired;
        default:          ma_q <= high;
      endcase
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q <= '0;
      match_q <= 16'(clb_regs_pkg::RESET_FSM_COUNTER_1_MATCH1);
      equal_q <= 1'b0;
    end else begin
      equal_q <= count_q == match_q;
      if (clear || count_step || act_i.count_load)
        count_q <= (count_next & {16{!clear && !act_i.count_load}}) |
                   (data_i & {16{!clear && act_i.count_load}});
      if (begun_q || act_i.count_match)
        match_q <= (match_sum & {16{begun_q}}) | (data_i & {16{!begun_q}});
    end
  end

  // ---- Receiver -----------------------------------------------------------------------------

  assign receives = state == clb_pkg::BOTH || (state == clb_pkg::RECEIVE && !watchdog_q);
  assign spi_next = spi_count_q + 8'd1;
  assign take_o   = receives && receive_match && spi_count_q != cfg_i.spi_match;
  assign bit_o    = sl_q;   // of the clock in which the count is match 1

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      spi_count_q <= '0;
      spi_clk_q   <= 1'b0;
    end else begin
      if (clear || take_o || act_i.spi_load)
        spi_count_q <= (spi_next & {8{!clear && !act_i.spi_load}}) |
                       (data_i[7:0] & {8{!clear && act_i.spi_load}});
      spi_clk_q <= !clear && (take_o || (spi_clk_q && !receive_wrap));
    end
  end

  always_comb begin
    frame_o.watchdog    = watchdog_q;
    frame_o.spi_count   = spi_count_q;
    frame_o.ma_count    = count_q;
    frame_o.count_match = match_q;
    frame_o.sl          = sl;
    frame_o.state       = state;
  end

  assign start_seen_o = begun_q;
  assign watchdog_o   = expired && !clear;
  assign ma_o         = ma_q;
  assign spi_clk_o    = spi_clk_q;

  `ENC_ASSERT_IF(RestsHigh_A, clk_i, rst_ni, state == clb_pkg::IDLE, ma_q)

endmodule
