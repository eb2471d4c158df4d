// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time as a count of clocks since the reset, 64 bits. It wraps.
//
// Clock domain: clk_i. Both halves of time_o change with the same edge. The carry into the upper
// half has a flop, so that the longest carry chain has 32 bits.

module enc_time (
  input  logic        clk_i,
  input  logic        rst_ni,
  output logic [63:0] time_o
);

  logic [31:0] low_q;
  logic [31:0] high_q;
  logic        carry_q;   // low_q has its highest value

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      low_q   <= '0;
      high_q  <= '0;
      carry_q <= 1'b0;
    end else begin
      low_q   <= low_q + 32'd1;
      carry_q <= low_q == 32'hFFFF_FFFE;
      if (carry_q) high_q <= high_q + 32'd1;
    end
  end

  assign time_o = {high_q, low_q};

endmodule
