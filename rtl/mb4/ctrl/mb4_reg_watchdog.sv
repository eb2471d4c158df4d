// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time limits of a control communication. expired_o: the start bit of the slave has not come within
// 4096 register clocks, each of 2^(FREQR+1) MA periods. stalled_o: an eighth of this time more has
// passed, for a frame that does not end.
//
// Clock domain: core. The module counts half MA periods while watch_i is high; clear_i starts
// again. Both outputs stay until watch_i falls or clear_i comes. While live_i is low (no frame runs
// or comes by itself) the count stops at the first limit: a frame that the host has not asked for
// is no stall. The start of a frame restarts the time base, so each frame may add half a period.
// Datasheet: page 34, Table 58; decision 24.

module mb4_reg_watchdog (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [2:0] freqr_i,
  input  logic       watch_i,
  input  logic       clear_i,
  input  logic       live_i,
  input  logic       tick_i,     // half an MA period
  output logic       expired_o,
  output logic       stalled_o
);

  localparam int unsigned BASE = 14;  // 4096 x 2 x 2 half periods at FREQR = 0

  logic [BASE+7:0] count_q;
  logic [7:0]      high;
  logic [7:0]      eighth;
  logic            zero_q;     // the count is 0, whatever count_q is

  assign high      = count_q[BASE+7:BASE];
  assign eighth    = count_q[BASE+4:BASE-3];
  assign expired_o = high[freqr_i] && !zero_q;
  assign stalled_o = expired_o && eighth[freqr_i];

  // watch_i and clear_i come late, and the count has many flops.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      zero_q  <= 1'b0;
      count_q <= '0;
    end else begin
      zero_q <= !watch_i || clear_i;
      if (zero_q)                                              count_q <= 22'(tick_i);
      else if (tick_i && !stalled_o && (live_i || !expired_o)) count_q <= count_q + 22'd1;
    end
  end

endmodule
