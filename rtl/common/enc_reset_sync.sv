// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reset synchroniser: asserts at once, releases at the second rising clock edge.
//
// Clock domain: clk_i; rst_ni is asynchronous. While the clock stands still the reset stays
// asserted.
// Constraint: false path from rst_ni to the asynchronous clear of both flops.

`include "enc_sync.svh"

module enc_reset_sync (
  input  logic clk_i,
  input  logic rst_ni,
  output logic rst_sync_no
);

  `ENC_SYNC_FLOPS
  logic [1:0] sync_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) sync_q <= 2'b00;
    else         sync_q <= {sync_q[0], 1'b1};
  end

  assign rst_sync_no = sync_q[1];

endmodule
