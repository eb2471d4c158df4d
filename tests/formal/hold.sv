// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// HOLDBANK at any speed (docs/crossings.md): from the host's write of HOLDBANK = 1 on the host
// reads one and the same bank, whatever frames end meanwhile, until it writes 0xF4 again; when the
// write leaves SWBANK as it was, and no change of it is on its way, that is the bank it had before.
// Host half and core half of 0xF4 with the bank control. Writes of 0xF4 may be closer than the core
// can answer; only which bank SWBANK selects is claimed for a write that finds 0xF4 answered.
//
// claim: no switch seen by the host from the write of HOLDBANK on, at any phase of the clocks
// clocks: many
// depth: 36
// cover: 34
// unbounded: no: frames' ends, both halves and the crossing together are bounded only
// mutation: regs/mb4_bank_ctrl.sv | host_q != (kept_i ^ swbank_q) | 1'b0 != 1'b0
// mutation: regs/mb4_instr_reg.sv | (pending_o && byte_q[mb4_regs_pkg::HOLDBANK_LSB]) ? bank_q : host_bank_i
//   | host_bank_i
// mutation: regs/mb4_bank_ctrl.sv | assign swap = want && !holdbank_i;
//   | assign swap = want && !undo;

module proof (
  input logic       hclk_i,
  input logic       clk_i,
  input logic       rst_ni,
  input logic       write_i,
  input logic [7:0] data_i,
  input logic       frame_end_i,
  input logic       frame_run_i
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic hclk_q, clk_q, rst_q;
  always @(posedge gclk) {started, hclk_q, clk_q, rst_q} <= {1'b1, hclk_i, clk_i, rst_ni};
  always @* begin
    if (!started) assume (!rst_ni && !hclk_i && !clk_i);
    if (started) assume (rst_ni);
    // The core's clock moves at every instant at which the host's does not.
    if (started) assume ((hclk_i != hclk_q) ^ (clk_i != clk_q));
    // INSTR = 0, no BREAK, INIT, AGS: the subject is the banks.
    assume ((data_i & 8'h9F) == 8'h00);
  end

  mb4_pkg::instr_t written, held;
  logic [1:0] count, ack;
  logic pending, bank, kept, host_bank, eng_bank, swbank_pulse;
  mb4_pkg::bank_cmd_t bank_cmd;
  assign swbank_pulse = bank_cmd.swap;
  logic [7:0] rd_data;
  logic [2:0] end_q;     // core clocks since the last frame's end
  logic       frame_end;

  assign frame_end = frame_end_i && end_q == 3'd7;

  mb4_instr_reg u_instr (
    .hclk_i, .rst_ni, .wr_en_i(write_i), .wr_addr_i(8'hF4), .wr_data_i(data_i), .rd_data_o(rd_data),
    .pending_o(pending), .written_o(written), .count_o(count), .ack_i(ack), .held_i(held),
    .host_bank_i(host_bank), .bank_o(bank), .bank_kept_o(kept)
  );
  mb4_sequencer u_sequencer (
    .clk_i, .rst_ni, .written_i(written), .count_i(count), .ack_o(ack), .held_o(held),
    .mem_busy_i(1'b0), .agsmin_i(1'b0), .infinite_i(1'b0), .regvers_i(1'b0), .kind_i('0), .agserr_on_hold_i(1'b0), .agserr_on_write_i(1'b0),
    .ags_clear_i(1'b0), .request_i(1'b0), .missed_i(1'b0), .tick_i(1'b0), .idle_i(2'b11),
    .timeout_i(2'b00), .sl_i(2'b11), .event_i('0), .word_ok_i(2'b00), .bank_pending_i(1'b0),
    .control_active_i(1'b0), .control_end_i(1'b0), .control_stalled_i(1'b0), .bank_o(bank_cmd)
  );
  mb4_bank_ctrl u_bank (
    .clk_i, .rst_ni, .singlebank_i(1'b0), .holdbank_i(held.holdbank), .kept_i(kept),
    .swbank_pulse_i(swbank_pulse), .frame_end_i(frame_end), .frame_run_i, .host_bank_o(host_bank),
    .eng_bank_o(eng_bank)
  );

  // What the host sees: its bank at the write and from then on.
  logic held_q, bank_q, swbank_q, moved_q, alone_q;
  always @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni) {held_q, bank_q, swbank_q, moved_q, alone_q} <= '0;
    else if (write_i) begin
      held_q   <= data_i[6];
      bank_q   <= bank;
      swbank_q <= data_i[5];
      moved_q  <= data_i[5] != swbank_q || (moved_q && pending);
      alone_q  <= !pending;
    end
  end
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) end_q <= 3'd7;
    else         end_q <= frame_end ? 3'd0 : end_q == 3'd7 ? 3'd7 : end_q + 3'd1;
  end

  always @* if (started && rst_ni) begin
    if (held_q && !moved_q) Held_A: assert (bank == bank_q);
    if (held_q && moved_q && alone_q && !pending) Moved_A: assert (bank != bank_q);
    Apart_A: assert (eng_bank != host_bank);
  end
  always @(posedge clk_i) begin
    Held_C: cover (rst_ni && held_q && frame_end && !pending);
    Close_C: cover (rst_ni && held_q && !alone_q && frame_end && !pending);
  end

endmodule
