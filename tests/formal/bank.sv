// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Bank switch: once for each frame's end, never while HOLDBANK is set, then once when it is
// released, unless the next frame has run meanwhile: then it is told as lost, once, and never
// happens; host and line engine never share a bank unless SINGLEBANK says so (datasheet pages 26,
// 31, 33, Tables 38, 48, 49; decision 15).
//
// claim: one switch a frame, none under HOLDBANK, lost (told, and never made) only while the next
//   frame runs; never the same bank for both sides
// clocks: one
// depth: 12
// cover: 10
// unbounded: induction 2
// look: dut_hold = u_dut.hold_q
// look: dut_swbank = u_dut.swbank_q
// mutation: regs/mb4_bank_ctrl.sv | assign swap = want && !holdbank_i; | assign swap = want;
// mutation: regs/mb4_bank_ctrl.sv | (want && holdbank_i) || undo | undo
// mutation: regs/mb4_bank_ctrl.sv | host_q ^ !singlebank_i | host_q ^ !holdbank_i
// mutation: regs/mb4_bank_ctrl.sv | (pending_q && !frame_run_i) | pending_q
// mutation: regs/mb4_bank_ctrl.sv | lost_o      = pending_q && frame_run_i;
//   | lost_o      = pending_q && holdbank_i && frame_run_i;

module proof (
  input logic clk_i,
  input logic rst_ni,
  input logic holdbank_i,
  input logic kept_i,
  input logic swbank_pulse_i,
  input logic frame_end_i,
  input logic frame_run_i
);

  (* anyconst *) logic single;
  logic pending, swapped, lost, host_bank, eng_bank;

  mb4_bank_ctrl u_dut (
    .clk_i,
    .rst_ni,
    .singlebank_i (single),
    .holdbank_i,
    .kept_i,
    .swbank_pulse_i,
    .frame_end_i,
    .frame_run_i,
    .pending_o    (pending),
    .swapped_o    (swapped),
    .lost_o       (lost),
    .host_bank_o  (host_bank),
    .eng_bank_o   (eng_bank)
  );

  logic started = 1'b0;
  logic live_q, hold_q, pulse_q, end_q, host_q, pending_q, first_q, kept_q, pulse2_q, run_q;
  always @(posedge clk_i) begin
    started   <= 1'b1;
    live_q    <= rst_ni;
    hold_q    <= holdbank_i;
    first_q   <= holdbank_i && !(live_q && hold_q);
    pulse_q   <= swbank_pulse_i;
    pulse2_q  <= live_q && pulse_q;
    end_q     <= frame_end_i;
    host_q    <= host_bank;
    pending_q <= pending;
    kept_q    <= kept_i;
    run_q     <= frame_run_i;
  end
  always @* if (!started) assume (!rst_ni);

  // In the first clock of HOLDBANK the host may take a switch back that it has not seen: the bank
  // it had (kept) is then right. In all others the bank moves by SWBANK alone.
  wire dut_hold, dut_swbank;
  logic undone;
  assign undone = first_q && (host_q ^ pulse2_q) != kept_q;

  // Switches owed: one for each frame's end and for each one taken back, until it is made or told
  // as lost. Two that come together are one; a frame that has run before its end, with no switch
  // taken back then, never brings this about.
  logic [1:0] owed_q;
  logic       undo, merged;
  logic       dead_q;        // what was pending is lost, nothing has come after it
  assign undo   = holdbank_i && !(live_q && hold_q) &&
                  (host_bank ^ (live_q && pulse_q)) != kept_i;
  assign merged = frame_end_i && ((pending && !frame_run_i) || undo);
  always @(posedge clk_i) begin
    if (!rst_ni) {owed_q, dead_q} <= '0;
    else begin
      owed_q <= owed_q + {1'b0, frame_end_i} + {1'b0, undo} - {1'b0, swapped} - {1'b0, lost} -
                {1'b0, merged};
      dead_q <= (lost || dead_q) && !frame_end_i && !undo;
    end
  end

  always @* if (started && live_q && rst_ni) begin
    SameHistory_A: assert (dut_hold == hold_q && dut_swbank == pulse_q);
    if (hold_q && !undone) Held_A: assert (host_bank == (host_q ^ pulse_q));
    if (hold_q && undone) TakenBack_A: assert (host_bank == (host_q ^ !pulse_q) && pending);
    if (hold_q && end_q && !single) Remembered_A: assert (pending);
    if (hold_q && pending_q && !run_q && !single) Kept_A: assert (pending);
    if (!hold_q && !single)
      OneSwitch_A: assert (host_bank == (host_q ^ pulse_q ^ (end_q || (pending_q && !run_q))) &&
                           !pending);
    if (!hold_q && single) NoSwitch_A: assert (host_bank == (host_q ^ pulse_q) && !pending);
    Sides_A: assert ((eng_bank == host_bank) == single);
    if (!single) Owed_A: assert (owed_q == {1'b0, pending});
    if (lost) LostWhileRunning_A: assert (frame_run_i && pending);
    if (dead_q) LostForEver_A: assert (!pending && !lost && (!swapped || frame_end_i));
    if (merged && run_q && !end_q) Merged_A: assert (undone || undo);
    if (swapped) NotUnderHold_A: assert (!holdbank_i && !single);
  end
  always @(posedge clk_i) begin
    Release_C: cover (rst_ni && swapped && hold_q && !frame_end_i);
    TakenBack_C: cover (rst_ni && live_q && hold_q && undone);
    Lost_C: cover (rst_ni && live_q && dead_q && !hold_q && swapped);
  end

endmodule
