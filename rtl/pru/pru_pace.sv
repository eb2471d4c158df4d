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
// Misuse: a smaller value of period_i or overhead_i counts at once.
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

  // Counts are inverted: they begin with ones, and the carry of a sum compares.
  localparam logic [15:0] SETTLE_LAST = 16'(ClockHz / 25_000 - 1);
  localparam logic [15:0] NONE        = 16'hFFFF;
  localparam logic [15:0] FROM_START  = 16'hFFFE;  // clocks that have gone when the count begins
  localparam logic [15:0] FROM_SAMPLE = 16'hFFFB;
  localparam logic [23:0] FIRST       = 24'hFF_FFFE;

  typedef enum logic [2:0] {
    STOPPED,
    SETTLE,
    READY,
    FRAME,
    OVERHEAD
  } state_e;

  state_e      state_d, state_q;
  logic [15:0] count_q;         // clocks so far, inverted
  logic        count_more;      // overhead_i is larger
  logic        count_ends;
  logic [15:0] unused_count;
  logic        first_q;
  logic        absent_q;
  logic        pin, pin_q;
  logic [23:0] timer_q;         // clocks of the period so far, inverted
  logic        timer_more;      // the period is longer
  logic        timer_ends;
  logic [23:0] unused_timer;
  logic        trigger;
  logic        pending_q;
  logic        go;
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
  assign {count_more, unused_count} = {1'b0, overhead_i} + {1'b0, count_q};
  assign count_ends = state_q == OVERHEAD && !count_more;
  assign {timer_more, unused_timer} = {1'b0, period_i} + {1'b0, timer_q};
  assign timer_ends = accepts && !timer_more && period_i != 24'd0;
  assign trigger    = (pin && !pin_q) || timer_ends;
  assign settled    = state_q == SETTLE && (count_q & SETTLE_LAST) == 16'd0;
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
      state_q   <= STOPPED;
      count_q   <= NONE;
      first_q   <= 1'b0;
      absent_q  <= 1'b0;
      pin_q     <= 1'b0;
      timer_q   <= FIRST;
      pending_q <= 1'b0;
    end else begin
      state_q <= state_d;
      pin_q   <= pin;
      first_q <= settle_o || (first_q && !update_o);
      if (go) absent_q <= !sl_i;

      if (settle_o)    count_q <= NONE;
      else if (go)     count_q <= FROM_START;
      else if (over_i) count_q <= FROM_SAMPLE;
      else             count_q <= count_q - 16'd1;

      timer_q <= accepts && timer_more ? timer_q - 24'd1 : FIRST;

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
