// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CDS bits of both lines, in two banks that switch with the banks of SCDATA.
//
// Clock domain: core.
// Latency: the end of a frame writes the frames' bank, one clock before the banks swap. The
// outputs are flops; mb4_host_read chooses the bank that the host sees.
//
// - A reduced frame switches only the CDS bits: it writes the bank that the host sees (decision
//   14). With HOLDBANK it writes the other bank, and the host sees the bits after the next frame.
// - With one bank the host sees the engine's value at once. The datasheet calls it valid only with
//   two banks.
//
// Features may leave out line 2 or bank 1; their bits are 0.
//
// Datasheet: page 35, Tables 65, 66 and the note below them.

module mb4_cds_bank #(
  parameter bit TwoLines = 1'b1,
  parameter bit TwoBanks = 1'b1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  mb4_pkg::banks_t    banks_i,
  input  mb4_pkg::bank_cmd_t bank_i,
  input  logic       holdbank_i,
  input  logic [1:0] cds_i,        // of lines {2, 1}
  output logic [3:0] cds_o         // bank 1 in the upper half
);

  logic [1:0] bank0_q;
  logic [1:0] bank1_q;
  logic       bank;

  assign bank = (bank_i.reduced && !holdbank_i) ? banks_i.host : banks_i.eng;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank0_q <= '0;
      bank1_q <= '0;
    end else begin
      if (bank_i.frame_end && !bank) bank0_q <= cds_i;
      if (bank_i.frame_end && bank)  bank1_q <= cds_i;
    end
  end

  assign cds_o = {bank1_q & {2{TwoBanks}}, bank0_q} & {2{TwoLines, 1'b1}};

endmodule
