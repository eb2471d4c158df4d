// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Decides which bank the host uses and which bank frames use.
//
// Clock domain: core.
//
// - The end of a frame swaps the banks, one clock later: the CDS bits are in the bank by then.
//   While HOLDBANK is set the swap stays pending; it happens when HOLDBANK is cleared.
// - A frame that runs while a swap is pending writes to the frames' bank again, and the swap is
//   lost (event_o.lost).
// - A change of SWBANK swaps the banks once, with HOLDBANK set or not.
// - With SINGLEBANK both sides use the host's bank, and the end of a frame swaps nothing.
// - HOLDBANK arrives here some clocks after the host has written it. With HOLDBANK = 1, and in the
//   clock in which it falls, the base is the one that the host keeps (mb4_instr_reg). So a swap by
//   a frame that ended between the host's write and its arrival is undone and stays pending. If the
//   host clears HOLDBANK and sets it again, the pending swap happens, even if the 0 never arrives.
//
// The base is the host's bank without the inversions of SWBANK.
// Without TwoBanks there is only bank 0, which both sides use; SWBANK and HOLDBANK change nothing.
// Misuse: if two frames end after the host has written HOLDBANK and before it arrives here, a swap
// may be lost.
// Datasheet: pages 26, 31, 33, Tables 38, 48, 49; decisions 15, 41.

module mb4_bank_ctrl #(
  parameter bit TwoBanks = 1'b1
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic singlebank_i,
  input  logic holdbank_i,
  input  logic kept_i,          // host domain: base that the host keeps
  input  mb4_pkg::bank_cmd_t bank_i,
  output logic pending_o,
  output mb4_pkg::bank_event_t event_o,
  output logic base_o,          // base of the host's bank
  output logic newest_o,        // base of the bank that it has when no swap is pending
  output mb4_pkg::banks_t banks_o
);

  logic host_q;
  logic base_q;
  logic base_d;
  logic newest_q;
  logic pending_q;
  logic pending_d;
  logic hold_q;
  logic end_q;
  logic kept;
  logic want;
  logic swap;
  logic follow;
  logic made_q;       // the base has followed to a pending swap

  enc_sync_bit u_kept (
    .clk_i,
    .rst_ni,
    .data_i (kept_i),
    .data_o (kept)
  );

  assign want   = ((pending_q && !bank_i.run) || end_q) && !singlebank_i;
  assign swap   = want && !holdbank_i;
  assign follow = (holdbank_i || hold_q) && base_q != kept;
  assign base_d = base_q ^ (swap || follow);
  assign pending_d = follow ? !hold_q : want && holdbank_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      host_q    <= 1'b0;
      base_q    <= 1'b0;
      newest_q  <= 1'b0;
      pending_q <= 1'b0;
      hold_q    <= 1'b0;
      end_q     <= 1'b0;
      made_q    <= 1'b0;
    end else begin
      host_q    <= host_q ^ (swap || follow) ^ bank_i.swap;
      base_q    <= base_d;
      newest_q  <= base_d ^ pending_d;
      pending_q <= pending_d;
      hold_q    <= holdbank_i;
      end_q     <= bank_i.data_end;
      made_q    <= follow && hold_q;
    end
  end

  assign pending_o   = TwoBanks && pending_q;
  assign event_o.swapped = TwoBanks && (swap || made_q);
  assign event_o.lost    = TwoBanks && pending_q && bank_i.run;
  assign base_o      = TwoBanks && base_q;
  assign newest_o    = TwoBanks && newest_q;
  assign banks_o.host = TwoBanks && host_q;
  assign banks_o.eng  = TwoBanks && (host_q ^ !singlebank_i);

endmodule
