// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Two-flop synchroniser for one bit.
//
// Clock domain: clk_i; data_i is asynchronous. Latency: 1..2 clocks.
// Misuse: bits that belong together must not cross through several of these modules; they may
// arrive in different clocks. A level shorter than one clock may be missed.
// Constraint: false path (or maximum delay of one clk_i period) to the first flop.

`include "enc_sync.svh"

module enc_sync_bit #(
  parameter logic ResetValue = 1'b0
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic data_i,
  output logic data_o
);

  `ENC_SYNC_FLOPS
  logic [1:0] sync_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) sync_q <= {2{ResetValue}};
    else         sync_q <= {sync_q[0], data_i};
  end

  assign data_o = sync_q[1];

endmodule
