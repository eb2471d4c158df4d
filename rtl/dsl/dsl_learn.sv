// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Looks for the test pattern in each START frame, for the two rules without tracking: which eighth
// of a slot is taken, and how many slots come before the answer.
//
// Clock domain: core. eighth_o is right from the clock with the last sample of the first slot that
// is not all ones; bit_valid_i and bit_i bring the bit of each slot, up to done_i. Behind it
// delay_o and eighth_o are those of the answer. With done_i found_o tells whether there was one.
//
// No window is kept: each of the eleven places is a candidate up to its first wrong bit. Not more
// than one is left at the end, because the pattern does not fit onto itself shifted by 1 to 10.
// The sample: published_i: four behind the number of ones in the slot, in slot 10 the last one at
// most; else four behind the first 0.
// Misuse: without an answer found eighth_o has no meaning up to forget_i.
// Source: docs/dsl.md, "How much it takes".

module dsl_learn (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             forget_i,
  input  logic             published_i,
  input  logic             start_i,      // the window is one of START
  input  dsl_pkg::stream_t stream_i,
  input  logic             bit_valid_i,
  input  logic             bit_i,
  input  logic             done_i,       // the window is over, one clock
  output logic             found_o,
  output logic [3:0]       delay_o,
  output logic [2:0]       eighth_o
);

  localparam logic [6:0] SLOT_10     = 7'd10;

  logic        last;            // sample of a slot
  logic        low_q;           // a 0 has been, in this slot and before it
  logic        lows;            // ... or is here
  logic        had_q, had;      // ... before this slot
  logic [2:0]  ones_q, ones;    // in front of the edge, or of the slot
  logic [2:0]  eighth;
  logic [2:0]  eighth_q;
  logic [5:0]  number_q;        // bits of the pattern that follow the next one
  logic        over_q;          // the pattern has been shown
  logic        next;            // bit of the pattern
  logic [11:1] pattern_q;       // its bit for each candidate
  logic [11:1] shown_q;         // the candidate has a bit of it
  logic [11:1] alive_q;
  logic [3:0]  delay, delay_q;
  logic        begins;

  assign begins = stream_i.valid && stream_i.number == 10'd0;
  assign last   = stream_i.valid && stream_i.number[2:0] == 3'd7;
  assign lows   = (low_q && !begins) || !stream_i.levels[0];
  assign had    = had_q && stream_i.number[9:3] != 7'd0;

  always_comb begin
    ones = stream_i.number[2:0] == 3'd0 ? 3'd0 : ones_q;
    if (stream_i.levels[0] && (published_i || !lows)) ones = ones + 3'd1;
  end
  always_comb begin
    eighth = ones + 3'd4;
    if (published_i && stream_i.number[9:3] == SLOT_10 && ones[2]) eighth = 3'd7;
  end

  assign found_o  = alive_q != '0;
  assign delay_o  = delay_q;
  assign eighth_o = start_i && last && lows && !had ? eighth : eighth_q;

  assign next = dsl_pkg::TEST_PATTERN[number_q];

  always_comb begin
    delay = 4'd0;
    for (int unsigned i = 1; i <= 11; i++) if (alive_q[i]) delay = delay | 4'(i);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      low_q     <= 1'b0;
      had_q     <= 1'b0;
      ones_q    <= '0;
      eighth_q  <= '0;
      number_q  <= dsl_pkg::LAST_BIT;
      over_q    <= 1'b0;
      pattern_q <= '0;
      shown_q   <= '0;
      alive_q   <= '0;
      delay_q   <= '0;
    end else begin
      if (stream_i.valid) begin
        low_q  <= lows;
        ones_q <= ones;
        if (last) had_q <= lows;
      end
      eighth_q <= eighth_o & {3{!forget_i}};
      if (begins) begin
        number_q  <= dsl_pkg::LAST_BIT;
        over_q    <= 1'b0;
        shown_q   <= '0;
        alive_q   <= '1;
      end else if (bit_valid_i) begin
        if (number_q != 6'd0) number_q <= number_q - 6'd1;
        else                  over_q   <= 1'b1;
        pattern_q <= {pattern_q[10:1], next};
        shown_q   <= {shown_q[10:1], !over_q};
        alive_q   <= alive_q & ~(shown_q & (pattern_q ^ {11{bit_i}}));
      end
      if (forget_i)                          delay_q <= '0;
      else if (done_i && start_i && found_o) delay_q <= delay;
    end
  end

endmodule
