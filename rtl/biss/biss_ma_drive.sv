// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Drives MA of one line: clock of a frame, inverted CDM after it, BiSS B register cells, force
// bits.
//
// Clock domain: core. MA changes only at ticks (ends of half MA periods). begin_i also sets it to
// 1. So no pulse is shorter than half a period.
//
//   clocking_o  high from begin_i until enough_i was seen at the end of a high level
//   rise_o      high in the clock of a tick that makes a rising edge in the frame, whatever the
//               force bits do; it has no meaning with stop_i, which comes late
//   force_i     from the first tick after the next clock on MA has the level force_level_i,
//               whatever the frame does
//   released_o  high for one clock, when the force has ended or has made MA fall. MA may change
//               with the next tick; until then no frame may begin on the line
//
// Misuse: enough_i must not fall before the next begin_i.
// Reset: only por_ni resets the flop of MA, so a reset does not cut a low pulse short.
// Datasheet: pages 12..16, 33, Figures 8..16, Tables 50..53.

module biss_ma_drive (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic por_ni,         // power-on reset of MA
  input  logic tick_i,
  input  logic half_next_i,
  input  logic start_i,        // the time base restarts
  // biss_frame
  input  logic begin_i,
  input  logic clocked_i,      // with begin_i: MA clocks (no register access)
  input  logic stop_i,         // MA stops clocking
  input  logic enough_i,       // the slaves have had all edges they need
  input  logic cdm_i,
  input  logic high_i,         // MA returns to 1 with the next tick
  input  logic register_i,     // MA belongs to the register access
  input  logic register_ma_i,
  // MA force bits
  input  logic force_i,
  input  logic force_level_i,
  output logic released_o,
  output logic release_next_o, // released_o of the next clock
  output logic rise_o,
  output logic clocking_o,
  output logic ma_o
);

  logic ma_d;
  logic ma_q;
  logic clocking_d;
  logic clocking_q;
  logic force_q;
  logic level_q;
  logic released_q;

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
    if (force_q) ma_d = (tick_i && !start_i) ? level_q : ma_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clocking_q <= 1'b0;
      force_q    <= 1'b0;
      level_q    <= 1'b0;
      released_q <= 1'b0;
    end else begin
      clocking_q <= clocking_d;
      force_q    <= force_i;
      level_q    <= force_level_i;
      released_q <= release_next_o;
    end
  end

  always_ff @(posedge clk_i or negedge por_ni) begin
    if (!por_ni) ma_q <= 1'b1;
    else         ma_q <= ma_d;
  end

  // rise_o follows the cases above, without begin_i. begin_i comes late, and clocking_q is 0 then,
  // so rise_o is 0 in any case.
  assign rise_o = tick_i && clocking_q && half_next_i && !(enough_i && cdm_i);

  assign release_next_o = force_q && (!force_i || (tick_i && ma_q && !level_q));
  assign released_o = released_q;
  assign clocking_o = clocking_q;
  assign ma_o       = ma_q;

endmodule
