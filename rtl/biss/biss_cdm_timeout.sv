// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CDMTIMEOUT: at least 14 frames with CDM = 0 have been sent in a row.
//
// Clock domain: core. The end of each frame counts. The output is 1 from 14 frames on; a frame with
// CDM = 1 or INIT sets it back to 0.
// Datasheet: page 35, Table 64; decision 20.

module biss_cdm_timeout (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic frame_done_i,
  input  logic cdm_i,       // sent by the frame that ends
  input  logic clear_i,     // INIT
  output logic timeout_o
);

  localparam logic [3:0] ZEROS = 4'd14;

  logic [3:0] zeros_d;
  logic [3:0] zeros_q;

  always_comb begin
    zeros_d = zeros_q;
    if (clear_i)                               zeros_d = 4'd0;
    else if (frame_done_i && cdm_i)            zeros_d = 4'd0;
    else if (frame_done_i && zeros_q != ZEROS) zeros_d = zeros_q + 4'd1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) zeros_q <= '0;
    else         zeros_q <= zeros_d;
  end

  assign timeout_o = zeros_q == ZEROS;

endmodule
