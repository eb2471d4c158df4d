// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MA force bits: brings them from the configuration registers to the lines. Bit i of a vector {2,
// 1} is for line i + 1.
//
// Clock domain: core. The host may write the bits at any time. They pass two flops, and they are
// taken together when they have been equal for two clocks, at most 4 clocks after the write. The
// lines take them one clock later (biss_ma_drive): change_o is high and any_o follows then. MA
// follows with the next tick. If the bits change for one clock and change back, change_o is high
// too, without a change.
// Without Force no line is ever forced.
// Misuse: none.
// Datasheet: page 33, Tables 50..53; CHSEL: page 27, Table 23.

`include "enc_sync.svh"

module mb4_ma_force #(
  parameter bit Force = 1'b1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  // configuration, host domain
  input  logic       mafs_i,     // the selected line is forced
  input  logic       mavs_i,     // ... to this level
  input  logic       mafo_i,     // the other line is forced
  input  logic       mavo_i,
  input  logic [1:0] chsel_i,
  output logic [1:0] force_o,
  output logic [1:0] level_o,
  output logic       change_o,
  output logic       any_o       // force_o, one clock later: a line is forced
);

  `ENC_SYNC_FLOPS
  logic [5:0] meta_q;
  `ENC_SYNC_FLOPS
  logic [5:0] sync_q;
  logic [5:0] last_q;
  logic [5:0] held_q;
  logic [1:0] selected;
  logic       change_q, any_q;
  logic       stable, moved_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      meta_q   <= '0;
      sync_q   <= '0;
      last_q   <= '0;
      held_q   <= '0;
      change_q <= 1'b0;
      any_q    <= 1'b0;
      moved_q  <= 1'b0;
    end else begin
      meta_q   <= {mafs_i, mavs_i, mafo_i, mavo_i, chsel_i};
      sync_q   <= meta_q;
      last_q   <= sync_q;
      if (stable) held_q <= sync_q;
      change_q <= stable && moved_q;
      moved_q  <= !stable;
      any_q    <= force_o != 2'b00;
    end
  end

  assign stable   = sync_q == last_q;
  assign selected = held_q[1:0] == 2'b00 ? 2'b01 : held_q[1:0];
  assign force_o  = (({2{held_q[5]}} & selected) | ({2{held_q[3]}} & ~selected)) & {2{Force}};
  assign level_o  = ({2{held_q[4]}} & selected) | ({2{held_q[2]}} & ~selected);
  assign change_o = Force && change_q;
  assign any_o    = Force && any_q;

endmodule
