// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Validity flags SVALIDx of four data channels (1..4 or 5..8) in both banks.
//
// Clock domain: core. The line engine writes the flag of its bank, the host clears flags of its
// own bank: writing 0 clears, 1 has no effect (decision 18). A flag falls when the first bit of a
// new word arrives, so that half-written data are never called valid. With one bank both act on
// the same flags; the engine wins if both meet in one clock. The outputs are flops; which bank the
// host sees is decided where it reads.
// Datasheet: page 35, Table 61.

module mb4_svalid (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       host_bank_i,
  input  logic       eng_bank_i,
  // line engine
  input  logic       begin_i,      // a word begins
  input  logic       set_en_i,     // a word is complete
  input  logic [1:0] set_slave_i,  // within the four
  input  logic       set_valid_i,
  // host: bits that are 0 clear
  input  logic       keep_en_i,
  input  logic [3:0] keep_i,
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
      if (host_bank_i) bank1_d = bank1_q & keep_i;
      else             bank0_d = bank0_q & keep_i;
    end
    if (set_en_i || begin_i) begin
      if (eng_bank_i) bank1_d[set_slave_i] = set_en_i && set_valid_i;
      else            bank0_d[set_slave_i] = set_en_i && set_valid_i;
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

  assign svalid_o = {bank1_q, bank0_q};

endmodule
