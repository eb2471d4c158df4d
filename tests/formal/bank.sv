// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Each end of a frame switches the banks once. While HOLDBANK is set there is no switch; its
// release makes the switch that was held back, once. If the next frame has run meanwhile, this
// switch is reported as lost, once, and is never made. Host and frames never share a bank unless
// SINGLEBANK is set (datasheet pages 26, 31, 33, Tables 38, 48, 49; decision 15). The bank that the
// host keeps has priority: while HOLDBANK is set, and in the clock of its release, the bank follows
// it.
//
// claim: one switch for each frame; none under HOLDBANK, except to the bank that the host keeps;
//   a switch is lost (reported, never made) only while the next frame runs; host and frames
//   never have the same bank
// clocks: one
// depth: 12
// cover: 10
// unbounded: reachability
// look: dut_hold = u_dut.hold_q
// look: dut_end = u_dut.end_q
// look: dut_swap = u_dut.swap
// look: dut_made = u_dut.made_q
// look: dut_kept = u_dut.u_kept.sync_q
// mutation: mb4/regs/mb4_bank_ctrl.sv | assign swap   = want && !holdbank_i; | assign swap   = want;
// mutation: mb4/regs/mb4_bank_ctrl.sv | ? !hold_q : want && holdbank_i; | ? !hold_q : 1'b0;
// mutation: mb4/regs/mb4_bank_ctrl.sv | ? !hold_q : want && holdbank_i; | ? 1'b1 : want && holdbank_i;
// mutation: mb4/regs/mb4_bank_ctrl.sv | (holdbank_i || hold_q) && base_q | holdbank_i && base_q
// mutation: mb4/regs/mb4_bank_ctrl.sv | newest_q  <= base_d ^ pending_d; | newest_q  <= base_d;
// mutation: mb4/regs/mb4_bank_ctrl.sv | host_q ^ !singlebank_i | host_q ^ !holdbank_i
// mutation: mb4/regs/mb4_bank_ctrl.sv | (pending_q && !bank_i.run) | pending_q
// mutation: mb4/regs/mb4_bank_ctrl.sv | TwoBanks && pending_q && bank_i.run;
//   | TwoBanks && pending_q && holdbank_i && bank_i.run;

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
  logic pending, swapped, lost, base, newest, host_bank, eng_bank;
  mb4_pkg::bank_event_t told;
  mb4_pkg::banks_t      banks;
  assign {swapped, lost}       = told;
  assign {host_bank, eng_bank} = banks;

  mb4_bank_ctrl u_dut (
    .clk_i,
    .rst_ni,
    .singlebank_i (single),
    .holdbank_i,
    .kept_i,
    .bank_i       ({frame_run_i, 1'b0, frame_end_i, 1'b0, swbank_pulse_i, 1'b0}),
    .pending_o    (pending),
    .event_o      (told),
    .base_o       (base),
    .newest_o     (newest),
    .banks_o      (banks)
  );

  wire       dut_hold, dut_end, dut_swap, dut_made;
  wire [1:0] dut_kept;
  logic      follow;   // the bank follows the host
  logic      undo;     // ... which takes a switch back that it has not seen
  logic      regain;   // ... which has seen a switch that is not pending any more
  logic      made;     // a switch is made
  assign follow = (holdbank_i || dut_hold) && base != dut_kept[1];
  assign undo   = follow && !dut_hold;
  assign made   = dut_swap || (follow && dut_hold);
  assign regain = follow && dut_hold && !((pending && !frame_run_i) || dut_end);

  logic started = 1'b0;
  logic live_q, hold_q, hold2_q, pulse_q, end_q, end2_q, host_q, pending_q, kept_q, run_q;
  logic follow_q, parity_q;
  always @(posedge clk_i) begin
    started   <= 1'b1;
    live_q    <= rst_ni;
    hold_q    <= holdbank_i;
    hold2_q   <= live_q && hold_q;
    pulse_q   <= swbank_pulse_i;
    end_q     <= frame_end_i;
    end2_q    <= live_q && end_q;
    host_q    <= host_bank;
    pending_q <= pending;
    kept_q    <= dut_kept[1];
    run_q     <= frame_run_i;
    follow_q  <= follow;
    parity_q  <= rst_ni && (parity_q ^ swbank_pulse_i);
  end
  always @* if (!started) assume (!rst_ni);

  // Switches owed: one for each frame's end, for each one taken back, and for each one that the host
  // has seen, until it is made or told as lost. Two that come together are one; a frame that has run
  // before its end, with no switch taken back then, never brings this about.
  logic [1:0] owed_q;
  logic       merged;
  logic       dead_q;        // what was pending is lost, nothing has come after it
  assign merged = dut_end && ((pending && !frame_run_i) || undo);
  always @(posedge clk_i) begin
    if (!rst_ni) {owed_q, dead_q} <= '0;
    else begin
      owed_q <= owed_q + {1'b0, dut_end} + {1'b0, undo} + {1'b0, regain} - {1'b0, made} -
                {1'b0, lost} - {1'b0, merged};
      dead_q <= (lost || dead_q) && !dut_end && !undo;
    end
  end

  always @* if (started && live_q && rst_ni) begin
    SameHistory_A: assert (dut_hold == hold_q && dut_end == end_q);
    Base_A: assert (host_bank == (base ^ parity_q) && newest == (base ^ pending));
    if (follow_q) Follows_A: assert (base == kept_q && host_bank == (host_q ^ !pulse_q));
    if (hold_q && !follow_q) Held_A: assert (host_bank == (host_q ^ pulse_q));
    if (hold_q && follow_q) TakenBack_A: assert (pending == !hold2_q);
    if (hold_q && end2_q && !single && !follow_q) Remembered_A: assert (pending);
    if (hold_q && pending_q && !run_q && !single && !follow_q) Kept_A: assert (pending);
    if (!hold_q) AtRest_A: assert (!pending);
    if (!hold_q && !single && !follow_q)
      OneSwitch_A: assert (host_bank == (host_q ^ pulse_q ^ (end2_q || (pending_q && !run_q))));
    if (single && !follow_q) NoSwitch_A: assert (host_bank == (host_q ^ pulse_q));
    Sides_A: assert ((eng_bank == host_bank) == single);
    if (!single) Owed_A: assert (owed_q == {1'b0, pending});
    if (lost) LostWhileRunning_A: assert (frame_run_i && pending);
    if (dead_q) LostForEver_A: assert (!pending && !lost && (!made || dut_end || regain));
    if (merged && run_q && !end2_q) Merged_A: assert (follow_q || undo);
    if (made && !follow) NotUnderHold_A: assert (!holdbank_i && !single);
    Told_A: assert (swapped == (dut_swap || dut_made) && dut_made == (follow_q && hold2_q));
  end
  always @(posedge clk_i) begin
    Release_C: cover (rst_ni && made && hold_q && !dut_end && !follow);
    TakenBack_C: cover (rst_ni && live_q && hold_q && follow_q && !hold2_q);
    Again_C: cover (rst_ni && live_q && holdbank_i && hold_q && follow && pending);
    Lost_C: cover (rst_ni && live_q && dead_q && !hold_q && made);
  end

endmodule
