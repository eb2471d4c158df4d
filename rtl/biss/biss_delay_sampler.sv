// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SL input of one line, sampled by delay: measures the line delay in clocks and takes every bit
// half an MA period after the edge that the delay predicts. It needs no time base, so it goes on
// after MA has stopped. biss_sl_sampler is the other sampler: it uses four points of the time base.
// The ports that both have mean the same.
//
// Clock domain: core; SL is asynchronous. Latency: a sample is used three clocks after it was
// taken, with Median = 1 later.
//
// - median_i = 1, with Median = 1: the level is what most of five samples in a row say, so a pulse
//   of one or two clocks is none. Level and bits come three clocks later, with median_i = 0 one;
//   delay_o is the same.
// - Delay: delay_o counts the whole clocks from the second rising MA edge (armed_i rises with it)
//   to the acknowledge, SL = 0. Without line delay it is 0. late_o: it has reached 1023.
// - Bits: the first bit is taken half an MA period after the clock that saw the acknowledge, the
//   others each a period later: delay + (k + 1/2) MA periods. The first one still lies
//   in the acknowledge. bit_valid_o is high for one clock for each bit.
//
// Misuse: half_last_i and median_i must not change while a frame runs. If SL is already low
// when armed_i rises, the delay is 0.
// Source: hello-fpga BiSS-C master manual, register 0x3C; docs/axi.md.

`include "enc_check.svh"

module biss_delay_sampler #(
  parameter bit Median = 1'b0
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       sl_i,         // pin
  input  logic [7:0] half_last_i,  // clocks of half an MA period minus 1
  input  logic       median_i,
  // frame
  input  logic       clear_i,      // a frame begins
  input  logic       armed_i,      // the second rising MA edge has come
  // results
  output logic       sl_o,         // synchronised level
  output logic       ack_o,        // the line delay is known
  output logic [9:0] delay_o,
  output logic       late_o,       // delay_o has reached its end
  output logic       bit_valid_o,
  output logic       bit_o
);

  localparam logic [9:0]  LONGEST = 10'h3FF;
  localparam int unsigned LATE    = Median ? 5 : 2;  // most clocks by which sl is late

  logic       level;     // synchronised
  logic       sl;
  logic       armed;     // as late as sl
  logic [LATE-1:0] armed_q;
  logic       look;
  logic       hit;
  logic       found_q;
  logic [9:0] delay_q;
  logic [7:0] left_q;    // clocks of a half bit so far, inverted
  logic       more;      // the half bit is longer
  logic [8:0] unused_sum;
  logic       half_q;    // the second half of a bit
  logic       bit_valid_q;
  logic       bit_q;

  enc_sync_bit #(.ResetValue(1'b1)) u_sync (
    .clk_i,
    .rst_ni,
    .data_i (sl_i),
    .data_o (level)
  );

  if (Median) begin : gen_median
    logic [3:0] before_q;
    logic       most_q;     // the median, or one clock later
    logic [2:0] ones;

    always_comb begin
      ones = 3'(level);
      for (int unsigned i = 0; i < 4; i++) ones = ones + 3'(before_q[i]);
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        before_q <= '1;
        most_q   <= 1'b1;
      end else begin
        before_q <= {before_q[2:0], level};
        most_q   <= median_i ? ones > 3'd2 : level;
      end
    end

    assign sl    = most_q;
    assign armed = median_i ? armed_q[4] : armed_q[2];
  end else begin : gen_plain
    logic unused;
    assign sl     = level;
    assign armed  = armed_q[1];
    assign unused = median_i;
  end

  // SL comes late; so does the edge from which the delay counts.
  assign look = armed && !found_q;
  assign hit  = look && !sl;

  // The carry of this sum compares: half_last_i >= clocks so far.
  assign {more, unused_sum} = {1'b0, half_last_i, 1'b1} + {1'b0, left_q, 1'b1};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_q     <= '0;
      found_q     <= 1'b0;
      delay_q     <= '0;
      left_q      <= '0;
      half_q      <= 1'b0;
      bit_valid_q <= 1'b0;
      bit_q       <= 1'b0;
    end else begin
      armed_q     <= clear_i ? '0 : {armed_q[LATE-2:0], armed_i};
      found_q     <= !clear_i && (found_q || hit);
      if (clear_i)                                  delay_q <= '0;
      else if (look && sl && delay_q != LONGEST)    delay_q <= delay_q + 10'd1;
      // The count begins with 1.
      left_q      <= (!found_q || !more) ? 8'hFE : left_q - 8'd1;
      half_q      <= found_q && (half_q ^ !more);
      bit_valid_q <= found_q && !more && !half_q && !clear_i;
      bit_q       <= sl;
    end
  end

  assign sl_o        = sl;
  assign ack_o       = found_q;
  assign delay_o     = delay_q;
  assign late_o      = delay_q == LONGEST;
  assign bit_valid_o = bit_valid_q;
  assign bit_o       = bit_q;

  `ENC_ASSERT_NEXT(AckIsKept_A, clk_i, rst_ni, found_q && !clear_i, found_q)
  `ENC_ASSERT_NEXT(BitIsOneClock_A, clk_i, rst_ni, bit_valid_q, !bit_valid_q)

endmodule
