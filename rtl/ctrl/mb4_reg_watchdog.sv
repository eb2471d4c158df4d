// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Limit for the slave's start bit in a register access: 4096 register clocks, each 2^(FREQR+1) MA
// periods.
//
// Clock domain: core. Counts half MA periods while wait_i is high; expired_o then stays until
// wait_i falls. A frame's start restarts the time base, so each frame may add half a period.
// Datasheet: page 34, Table 58; decision 24.

module mb4_reg_watchdog (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [2:0] freqr_i,
  input  logic       wait_i,
  input  logic       tick_i,     // half an MA period
  output logic       expired_o
);

  localparam int unsigned BASE = 14;  // 4096 x 2 x 2 half periods at FREQR = 0

  logic [BASE+7:0] count_q;
  logic [7:0]      high;

  assign high      = count_q[BASE+7:BASE];
  assign expired_o = high[freqr_i];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                    count_q <= '0;
    else if (!wait_i)               count_q <= '0;
    else if (tick_i && !expired_o)  count_q <= count_q + 22'd1;
  end

endmodule
