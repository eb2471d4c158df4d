// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Decides which bank the host uses and which bank the line engine uses.
//
// Clock domain: core.
//
// - The end of a frame swaps the banks. While HOLDBANK is set the swap stays pending; it happens
//   when HOLDBANK is cleared.
// - A frame that runs while a swap is pending writes to the engine's bank again, and the swap is
//   lost (lost_o).
// - A change of SWBANK swaps the banks once, with HOLDBANK set or not.
// - With SINGLEBANK both sides use the host's bank, and the end of a frame swaps nothing.
// - HOLDBANK arrives here some clocks after the host has written it. If the end of a frame has
//   swapped the banks in between, that swap is undone and stays pending, because the host still
//   uses its old bank (mb4_instr_reg).
//
// Datasheet: pages 26, 31, 33, Tables 38, 48, 49; decision 15.

module mb4_bank_ctrl (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic singlebank_i,
  input  logic holdbank_i,
  input  logic kept_i,          // bank that the host had when it wrote 0xF4
  input  logic swbank_pulse_i,  // SWBANK has changed its value
  input  logic frame_end_i,
  input  logic frame_run_i,     // a frame runs that writes to the engine's bank
  output logic pending_o,
  output logic swapped_o,       // the swap of a frame's end happens
  output logic lost_o,          // the pending swap will not happen
  output logic host_bank_o,
  output logic eng_bank_o
);

  logic host_q;
  logic pending_q;
  logic hold_q;
  logic swbank_q;
  logic want;
  logic swap;
  logic undo;

  assign want = ((pending_q && !frame_run_i) || frame_end_i) && !singlebank_i;
  assign swap = want && !holdbank_i;
  assign undo = holdbank_i && !hold_q && host_q != (kept_i ^ swbank_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      host_q    <= 1'b0;
      pending_q <= 1'b0;
      hold_q    <= 1'b0;
      swbank_q  <= 1'b0;
    end else begin
      host_q    <= host_q ^ swap ^ swbank_pulse_i ^ undo;
      pending_q <= (want && holdbank_i) || undo;
      hold_q    <= holdbank_i;
      swbank_q  <= swbank_pulse_i;
    end
  end

  assign pending_o   = pending_q;
  assign swapped_o   = swap;
  assign lost_o      = pending_q && frame_run_i;
  assign host_bank_o = host_q;
  assign eng_bank_o  = host_q ^ !singlebank_i;

endmodule
