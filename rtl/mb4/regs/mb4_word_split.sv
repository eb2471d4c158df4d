// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds words that SWBANK splits: the bank changes while a word is being received, so each bank
// gets a part of it. Such a word is not valid. Bit i of a vector {2, 1} is for line i + 1.
//
// Clock domain: core. split_o is combinational and comes in the clock of swap_i; bytes of that
// clock still go to the old bank. word_ok_o is the CRC result, and 0 for a split word. A word that
// ends in the clock of swap_i is complete and not split.
// Misuse: none; an aborted word ends without a result.
// Datasheet: pages 26, 33, Table 49; decision 34.

module mb4_word_split (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       swap_i,       // SWBANK has changed its value
  input  logic [1:0] word_open_i,  // bits of a word have come and more follow
  input  logic [1:0] word_ok_i,
  output logic [1:0] split_o,
  output logic [1:0] word_ok_o
);

  logic [1:0] split_q;  // the word being received is split

  assign split_o   = word_open_i & {2{swap_i}};
  assign word_ok_o = word_ok_i & ~split_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) split_q <= '0;
    else         split_q <= (split_q | split_o) & word_open_i;
  end

endmodule
