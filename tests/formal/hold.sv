// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// HOLDBANK and SWBANK at any speed (docs/crossings.md). From the host's write of HOLDBANK = 1 on the
// host reads one and the same bank, whatever frames end meanwhile, until it writes 0xF4 again. It is
// the bank that it had before, or the other one if the write inverts SWBANK. The bank of frames
// is the other one as soon as 0xF4 is answered. Host half and core half of 0xF4 with the bank
// control. Writes of 0xF4 may be closer than the core can answer.
//
// claim: the host sees no switch from its write of HOLDBANK on, and sees SWBANK at its write; at
//   any phase of the clocks, with writes as close as can be
// clocks: many
// depth: 24
// cover: 34
// unbounded: reachability
// mutation: mb4/regs/mb4_bank_ctrl.sv | base_q != kept; | 1'b0 != 1'b0;
// mutation: mb4/regs/mb4_instr_reg.sv | (pending_o && hold_q) ? kept_q : base_i; | base_i;
// mutation: mb4/regs/mb4_instr_reg.sv | ? base : newest_i; | ? base_i : newest_i;
// mutation: mb4/regs/mb4_bank_ctrl.sv | assign swap   = want && !holdbank_i;
//   | assign swap   = want;

module proof (
  input logic       wr_clk_i,
  input logic       clk_i,
  input logic       rst_ni,
  input logic       write_i,
  input logic [7:0] data_i,
  input logic       frame_end_i,
  input logic       frame_run_i,
  input logic       late_i         // the base that the host keeps arrives a clock after the count
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic wr_clk_q, clk_q, rst_q;
  always @(posedge gclk) {started, wr_clk_q, clk_q, rst_q} <= {1'b1, wr_clk_i, clk_i, rst_ni};
  always @* begin
    if (!started) assume (!rst_ni && !wr_clk_i && !clk_i);
    if (started) assume (rst_ni);
    // The core's clock moves at every instant at which the host's does not.
    if (started) assume ((wr_clk_i != wr_clk_q) ^ (clk_i != clk_q));
    // INSTR = 0, no BREAK, INIT, AGS: the subject is the banks.
    assume ((data_i & 8'h9F) == 8'h00);
  end

  mb4_pkg::instr_host_t asked;
  mb4_pkg::instr_core_t answer;
  mb4_pkg::instr_t held;
  assign held = answer.held;
  logic pending, bank, kept, base, newest, host_bank, eng_bank;
  mb4_pkg::bank_cmd_t bank_cmd;
  mb4_pkg::banks_t banks;
  assign {host_bank, eng_bank} = banks;
  logic [7:0] rd_data;
  logic [2:0] end_q;     // core clocks since the last frame's end
  logic       frame_end;
  logic       late_q;

  assign frame_end = frame_end_i && end_q == 3'd7;

  mb4_instr_reg u_instr (
    .wr_clk_i, .rst_ni, .host_i({write_i, 8'hF4, data_i, 9'd0}), .rd_data_o(rd_data),
    .pending_o(pending), .instr_o(asked), .instr_i(answer),
    .base_i(base), .newest_i(newest), .bank_o(bank), .kept_o(kept)
  );
  mb4_sequencer u_sequencer (
    .clk_i, .rst_ni, .instr_i(asked), .instr_o(answer), .regvers_i(1'b0), .kind_i('0),
    .quirks_i('0), .request_i('0), .missed_i(1'b0), .tick_i(1'b0),
    .status_i({2{5'b10001}}), .event_i('0), .word_bad_i(2'b00), .mem_i('0),
    .control_active_i(1'b0), .control_start_i(1'b0), .control_end_i(1'b0),
    .control_stalled_i(1'b0), .stale_i(1'b0),
    .bank_o(bank_cmd)
  );
  mb4_bank_ctrl u_bank (
    .clk_i, .rst_ni, .singlebank_i(1'b0), .holdbank_i(held.holdbank), .kept_i(late_i ? late_q : kept),
    .bank_i({frame_run_i, 1'b0, frame_end, 1'b0, bank_cmd.swap, 1'b0}), .base_o(base),
    .newest_o(newest), .banks_o(banks)
  );

  // The bank that the host has from its last write on.
  logic held_q, bank_q, swbank_q, alone_q, before_q;
  always @(posedge wr_clk_i or negedge rst_ni) begin
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
