// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// HOLDBANK and SWBANK at any speed (docs/crossings.md). From the host's write of HOLDBANK = 1 on the
// host reads one and the same bank, whatever frames end meanwhile, until it writes 0xF4 again. It is
// the bank that it had before, or the other one if the write inverts SWBANK. The line engine's bank
// is the other one as soon as 0xF4 is answered. Host half and core half of 0xF4 with the bank
// control. Writes of 0xF4 may be closer than the core can answer.
//
// claim: no switch seen by the host from the write of HOLDBANK on, and SWBANK at its write, at any
//   phase of the clocks and however close the writes
// clocks: many
// depth: 36
// cover: 34
// unbounded: no: frames' ends, both halves and the crossing together are bounded only
// mutation: mb4/regs/mb4_bank_ctrl.sv | base_q != kept; | 1'b0 != 1'b0;
// mutation: mb4/regs/mb4_instr_reg.sv | (pending_o && hold_q) ? kept_q : base_i; | base_i;
// mutation: mb4/regs/mb4_instr_reg.sv | ? base : newest_i; | ? base_i : newest_i;
// mutation: mb4/regs/mb4_bank_ctrl.sv | assign swap   = want && !holdbank_i;
//   | assign swap   = want;

module proof (
  input logic       hclk_i,
  input logic       clk_i,
  input logic       rst_ni,
  input logic       write_i,
  input logic [7:0] data_i,
  input logic       frame_end_i,
  input logic       frame_run_i,
  input logic       late_i         // the base that the host keeps arrives a clock behind the count
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
  logic pending, bank, kept, base, newest, host_bank, eng_bank, swbank_pulse;
  mb4_pkg::bank_cmd_t bank_cmd;
  assign swbank_pulse = bank_cmd.swap;
  logic [7:0] rd_data;
  logic [2:0] end_q;     // core clocks since the last frame's end
  logic       frame_end;
  logic       late_q;

  assign frame_end = frame_end_i && end_q == 3'd7;

  mb4_instr_reg u_instr (
    .hclk_i, .rst_ni, .wr_en_i(write_i), .wr_addr_i(8'hF4), .wr_data_i(data_i), .rd_data_o(rd_data),
    .pending_o(pending), .written_o(written), .count_o(count), .ack_i(ack), .held_i(held),
    .base_i(base), .newest_i(newest), .bank_o(bank), .kept_o(kept)
  );
  mb4_sequencer u_sequencer (
    .clk_i, .rst_ni, .written_i(written), .count_i(count), .ack_o(ack), .held_o(held),
    .mem_busy_i(1'b0), .agsmin_i(1'b0), .infinite_i(1'b0), .regvers_i(1'b0), .kind_i('0), .agserr_on_hold_i(1'b0), .agserr_on_write_i(1'b0),
    .ags_clear_i(1'b0), .request_i(1'b0), .missed_i(1'b0), .tick_i(1'b0), .idle_i(2'b11),
    .timeout_i(2'b00), .sl_i(2'b11), .event_i('0), .word_ok_i(2'b00), .bank_pending_i(1'b0),
    .control_active_i(1'b0), .control_end_i(1'b0), .control_stalled_i(1'b0), .stale_i(1'b0),
    .bank_o(bank_cmd)
  );
  mb4_bank_ctrl u_bank (
    .clk_i, .rst_ni, .singlebank_i(1'b0), .holdbank_i(held.holdbank), .kept_i(late_i ? late_q : kept),
    .swbank_pulse_i(swbank_pulse), .frame_end_i(frame_end), .frame_run_i, .base_o(base),
    .newest_o(newest), .host_bank_o(host_bank), .eng_bank_o(eng_bank)
  );

  // The bank that the host has from its last write on.
  logic held_q, bank_q, swbank_q, alone_q, before_q;
  always @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni) {held_q, bank_q, swbank_q, alone_q, before_q} <= '0;
    else if (write_i) begin
      held_q   <= data_i[6];
      before_q <= held_q;
      bank_q   <= bank ^ data_i[5] ^ swbank_q;
      swbank_q <= data_i[5];
      alone_q  <= !pending;
    end
  end
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {late_q, end_q} <= 4'd7;
    else begin
      late_q <= kept;
      end_q  <= frame_end ? 3'd0 : end_q == 3'd7 ? 3'd7 : end_q + 3'd1;
    end
  end

  always @* if (started && rst_ni) begin
    if (held_q) Held_A: assert (bank == bank_q);
    if (!pending) Answered_A: assert (bank == host_bank);
    Apart_A: assert (eng_bank != host_bank);
  end
  always @(posedge clk_i) begin
    Held_C: cover (rst_ni && held_q && frame_end && !pending);
    Close_C: cover (rst_ni && held_q && !alone_q && frame_end && !pending);
    Again_C: cover (rst_ni && held_q && !before_q && !alone_q && held.holdbank && base != kept &&
                    newest == kept);
  end

endmodule
