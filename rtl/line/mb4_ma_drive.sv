// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Drives MA of one line: clock of a frame, inverted CDM behind it, BiSS B register cells, force
// bits.
//
// Clock domain: core. MA changes at ticks (end of a half MA period) only, and with begin_i to 1, so
// that no pulse is shorter than half a period. clocking_o from begin_i until enough_i was seen at
// the end of a high level; rise_o in the clock of a tick that makes a rising edge. Forced, MA has
// the level force_level_i from the next tick on, whatever the frame does; released_o follows the
// end of it for one clock.
// Misuse: enough_i must not fall before the next begin_i.
// Only por_ni resets the flop of MA, so that a reset cuts no low pulse short.
// Datasheet: pages 12..16, 33, Figures 8..16, Tables 50..53.

module mb4_ma_drive (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic por_ni,         // power-on: MA itself
  input  logic tick_i,
  input  logic half_next_i,
  // frame engine
  input  logic begin_i,
  input  logic clocked_i,      // with begin_i: a frame with clock, not a register access
  input  logic stop_i,         // no clock any more
  input  logic enough_i,       // the slaves have had all edges that they need
  input  logic cdm_i,
  input  logic high_i,         // back to 1 with the next tick
  input  logic register_i,     // MA is that of the register access
  input  logic register_ma_i,
  // MA force bits
  input  logic force_i,
  input  logic force_level_i,
  output logic released_o,
  output logic rise_o,
  output logic clocking_o,
  output logic ma_o
);

  logic ma_d;
  logic ma_q;
  logic clocking_d;
  logic clocking_q;
  logic force_q;

  always_comb begin
    ma_d       = ma_q;
    clocking_d = clocking_q;
    if (begin_i) begin
      ma_d       = 1'b1;
      clocking_d = clocked_i;
    end else if (stop_i) begin
      clocking_d = 1'b0;
    end else if (tick_i && register_i) begin
      ma_d = register_ma_i;
    end else if (tick_i && clocking_q) begin
      if (!half_next_i) begin
        ma_d       = enough_i ? !cdm_i : 1'b0;
        clocking_d = !enough_i;
      end else if (enough_i && cdm_i) begin
        clocking_d = 1'b0;
      end else begin
        ma_d = 1'b1;
      end
    end else if (tick_i && high_i) begin
      ma_d = 1'b1;
    end
    if (force_i) ma_d = tick_i ? force_level_i : ma_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clocking_q <= 1'b0;
      force_q    <= 1'b0;
    end else begin
      clocking_q <= clocking_d;
      force_q    <= force_i;
    end
  end

  always_ff @(posedge clk_i or negedge por_ni) begin
    if (!por_ni) ma_q <= 1'b1;
    else         ma_q <= ma_d;
  end

  // Of the same cases; begin_i, which comes late, finds a line at rest.
  assign rise_o = tick_i && clocking_q && half_next_i && !register_i && !stop_i &&
                  !(enough_i && cdm_i);

  assign released_o = force_q && !force_i;
  assign clocking_o = clocking_q;
  assign ma_o       = ma_q;

endmodule
