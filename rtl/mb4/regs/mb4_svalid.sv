// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Validity flags SVALIDx of four data channels (1..4 or 5..8) in both banks.
//
// Clock domain: core. The outputs are flops; mb4_host_read chooses the bank that the host sees.
//
// - A frame writes the flag in the bank of frames. The flag falls with the first bit of a new
//   word, so a half-written word is never called valid.
// - The host clears flags in its own bank: writing 0 clears, writing 1 has no effect (decision 18).
// - A word that SWBANK splits loses its flag in both banks (decision 34).
// - INIT of BiSS C clears all flags (decision 35).
// - With one bank both sides act on the same flags. If they do so in one clock, the line wins.
//
// Flags that are not in Channels are 0, and so is bank 1 without TwoBanks.
// Datasheet: page 35, Table 61.

module mb4_svalid #(
  parameter logic [3:0] Channels = 4'hF,
  parameter bit         TwoBanks = 1'b1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       eng_bank_i,
  // the lines
  input  logic       begin_i,      // a word begins
  input  logic       set_en_i,     // a word is complete
  input  logic [1:0] set_slave_i,  // data channel within the four
  input  logic       set_valid_i,
  input  logic       split_i,      // SWBANK moves the rest of this word to the other bank
  input  logic       clear_i,
  // host: a 0 clears the flag
  input  logic       keep_en_i,
  input  logic [3:0] keep_i,
  input  logic       keep_bank_i,  // bank that the host had at its write
  output logic [7:0] svalid_o    // bank 1 in the upper half
);

  logic [3:0] bank0_q;
  logic [3:0] bank1_q;
  logic [3:0] bank0_d;
  logic [3:0] bank1_d;

  always_comb begin
    bank0_d = bank0_q;
    bank1_d = bank1_q;
    if (keep_en_i) begin
      if (keep_bank_i) bank1_d = bank1_q & keep_i;
      else             bank0_d = bank0_q & keep_i;
    end
    if (set_en_i || begin_i) begin
      if (eng_bank_i) bank1_d[set_slave_i] = set_en_i && set_valid_i;
      else            bank0_d[set_slave_i] = set_en_i && set_valid_i;
    end
    if (split_i) begin
      bank0_d[set_slave_i] = 1'b0;
      bank1_d[set_slave_i] = 1'b0;
    end
    if (clear_i) begin
      bank0_d = '0;
      bank1_d = '0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank0_q <= '0;
      bank1_q <= '0;
    end else begin
      bank0_q <= bank0_d;
      bank1_q <= bank1_d;
    end
  end

  assign svalid_o = {bank1_q & {4{TwoBanks}}, bank0_q} & {2{Channels}};

endmodule
