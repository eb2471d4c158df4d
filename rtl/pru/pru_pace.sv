// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// When frames start and when the memory changes: the 40 us behind the rise of RUN, the timer, the
// pin, the time between a frame's end and the update.
//
// Clock domain: core; trigger_i is asynchronous, an edge counts three clocks later.
// - run_i rises: settle_o for one clock, 40 us, then a frame as by a trigger; the timer starts
//   there.
// - A trigger starts a frame one clock later. One that comes before the update of the frame before
//   waits for it; more are lost: lost_o for one clock.
// - start_o begins a frame if SL is 1. With SL = 0 there is no MA: absent_o.
// - update_o is high for one clock: the memory changes with its end, overhead_i clocks behind the
//   edge that took the last sample, or behind the start of a frame without MA. The memory cannot
//   change earlier than 4 clocks behind the sample, or 1 behind the start.
// - run_i falls: stop_o for one clock; nothing is pending.
//
// Misuse: a value of period_i or overhead_i that becomes smaller than what has passed ends the
// count two clocks later. period_i = 1 acts as 2.
// Source: TIDEP0022, 3.2.4.1 and 3.2.4.2; docs/pru.md.

module pru_pace #(
  parameter int unsigned ClockHz = 200_000_000
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        run_i,
  input  logic [23:0] period_i,
  input  logic [15:0] overhead_i,
  input  logic        trigger_i,     // pin
  input  logic        sl_i,          // synchronised level
  // the frame
  input  logic        rests_i,
  input  logic        over_i,        // three clocks behind the last sample
  output logic        settle_o,
  output logic        first_o,       // the next frame is the one of RUN
  output logic        start_o,
  output logic        absent_o,      // of this frame: no MA
  output logic        update_o,
  output logic        stop_o,
  // events
  output logic        triggered_o,
  output logic        lost_o
);

  // Counts are inverted: they begin with ones, and the carry of a sum compares. What a clock needs
  // is compared in the clock before it.
  localparam logic [15:0] SETTLE_NEXT = 16'(ClockHz / 25_000 - 2);
  localparam logic [15:0] NONE        = 16'hFFFF;
  localparam logic [15:0] FROM_START  = 16'hFFFD;  // one clock goes before the count
  localparam logic [15:0] FROM_SAMPLE = 16'hFFFA;  // four
  localparam logic [23:0] FIRST       = 24'hFF_FFFD;

  typedef enum logic [2:0] {
    STOPPED,
    SETTLE,
    READY,
    FRAME,
    OVERHEAD
  } state_e;

  state_e      state_d, state_q;
  logic [15:0] count_q;         // clocks of the state so far, inverted
  logic        counts;          // count_q moves
  logic        more;            // overhead_i is larger than the clocks up to the next one
  logic        more_q;
  logic        count_ends;
  logic [16:0] unused_count;
  logic        first_q;
  logic        absent_q;
  logic        pin, pin_q;
  logic [23:0] timer_q;         // clocks of the period up to the next one, inverted
  logic        timer_goes;      // timer_q moves
  logic        timer_more;      // the period is longer than these
  logic        timer_more_q;
  logic        timed_q;         // the period is not 0
  logic        timer_ends;
  logic [23:0] unused_timer;
  logic        trigger;
  logic        pending_q;
  logic        go;
  logic        settled_q;
  logic        settled;         // the 40 us are over
  logic        accepts;         // triggers count

  enc_sync_bit u_trigger (
    .clk_i,
    .rst_ni,
    .data_i (trigger_i),
    .data_o (pin)
  );

  assign settle_o   = state_q == STOPPED && run_i;
  assign stop_o     = state_q != STOPPED && !run_i;
  // The lowest carry takes a clock away from a count that has not begun.
  assign {more, unused_count} = {1'b0, overhead_i, 1'b1} + {1'b0, count_q, state_q != OVERHEAD};
  assign count_ends = state_q == OVERHEAD && !more_q;
  assign counts     = (state_q == SETTLE && !settled_q) || state_q == OVERHEAD;
  assign {timer_more, unused_timer} = {1'b0, period_i} + {1'b0, timer_q};
  assign timer_ends = accepts && !timer_more_q && timed_q;
  assign timer_goes = accepts && timer_more_q && timed_q;
  assign trigger    = (pin && !pin_q) || timer_ends;
  assign settled    = state_q == SETTLE && settled_q;
  assign go         = run_i && state_q == READY && pending_q && rests_i;
  assign accepts    = state_q != STOPPED && state_q != SETTLE;

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      STOPPED:  if (run_i) state_d = SETTLE;
      SETTLE:   if (settled) state_d = READY;
      READY:    if (go) state_d = sl_i ? FRAME : OVERHEAD;
      FRAME:    if (over_i) state_d = OVERHEAD;
      OVERHEAD: if (count_ends) state_d = READY;
      default:  state_d = STOPPED;
    endcase
    if (!run_i) state_d = STOPPED;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q      <= STOPPED;
      count_q      <= NONE;
      more_q       <= 1'b0;
      settled_q    <= 1'b0;
      first_q      <= 1'b0;
      absent_q     <= 1'b0;
      pin_q        <= 1'b0;
      timer_q      <= FIRST;
      timer_more_q <= 1'b0;
      timed_q      <= 1'b0;
      pending_q    <= 1'b0;
    end else begin
      state_q <= state_d;
      pin_q   <= pin;
      first_q <= settle_o || (first_q && !update_o);
      if (go) absent_q <= !sl_i;

      if (counts)                  count_q <= count_q - 16'd1;
      else if (state_q == STOPPED) count_q <= NONE;
      else if (state_q == FRAME)   count_q <= FROM_SAMPLE;
      else                         count_q <= FROM_START;
      more_q    <= more;
      settled_q <= (count_q & SETTLE_NEXT) == 16'd0;

      timer_q      <= timer_goes ? timer_q - 24'd1 : FIRST;
      timer_more_q <= timer_more || !timer_goes;
      timed_q      <= period_i != 24'd0;

      pending_q <= run_i && (settled || (accepts && trigger) || (pending_q && !go));
    end
  end

  assign first_o     = first_q;
  assign start_o     = go && sl_i;
  assign absent_o    = absent_q;
  assign update_o    = count_ends;
  assign triggered_o = trigger && run_i && accepts;
  assign lost_o      = trigger && run_i && (state_q == SETTLE || (pending_q && !go));

endmodule
