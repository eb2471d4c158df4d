// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Receiver of a toggle crossing: each change of toggle_i gives one pulse_o in clk_i.
//
// Clock domain: clk_i; toggle_i comes from another domain and changes at most once in three clk_i
// periods. pulse_o comes 2..3 clocks after the change; data that the sender holds from the toggle
// on may be captured with it. level_o is the toggle as seen together with the pulse.
// Misuse: two changes within three clocks are seen as none.
// Constraint: data held by the sender needs a maximum delay of one clk_i period; false path to the
// first flop.

module mb4_toggle_rx (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic toggle_i,
  output logic pulse_o,
  output logic level_o
);

  logic sync;
  logic seen_q;

  mb4_sync_bit u_sync (
    .clk_i,
    .rst_ni,
    .data_i (toggle_i),
    .data_o (sync)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) seen_q <= 1'b0;
    else         seen_q <= sync;
  end

  assign pulse_o = sync ^ seen_q;
  assign level_o = sync;

endmodule
