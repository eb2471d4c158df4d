// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Banks of dsl_record: whatever the groups do, the record that is written has a bank of its own. The
// search for it begins behind tell_i. A group changes its bank only by its own hold_i, to the newest
// one.
//
// The bench names the first free bank at tell_i. It stays free, as groups only move to the newest
// bank, and the search goes toward it.
//
// claim: the record that is written shares its bank with no group and not with the newest record, and has it within 64
//   clocks; a group reads the newest record of its last hold, and that alone
// clocks: one
// depth: 24
// cover: 24
// unbounded: induction 1
// checks: there
// look: bank = u_dut.bank_q
// look: newest = u_dut.newest_q
// look: moves = u_dut.moves_q
// look: clears = u_dut.clears_q
// look: walk = u_dut.walk_q
// look: walked = u_dut.walked
// look: from = u_dut.bank
// keep: common/enc_ram.sv | logic [Width-1:0] mem [0:(1 << AddrW)-1];
//   | (* mem2reg *) logic [Width-1:0] mem [0:(1 << AddrW)-1];
// look: held0 = u_dut.u_held.mem[0]
// look: held1 = u_dut.u_held.mem[1]
// look: held2 = u_dut.u_held.mem[2]
// look: held3 = u_dut.u_held.mem[3]
// look: held4 = u_dut.u_held.mem[4]
// look: held5 = u_dut.u_held.mem[5]
// look: copy0 = u_dut.u_walked.mem[0]
// look: copy1 = u_dut.u_walked.mem[1]
// look: copy2 = u_dut.u_walked.mem[2]
// look: copy3 = u_dut.u_walked.mem[3]
// look: copy4 = u_dut.u_walked.mem[4]
// look: copy5 = u_dut.u_walked.mem[5]
// mutation: dsl/dsl_record.sv | walk_q > LAST_GROUP) begin | walk_q >= LAST_GROUP) begin
// mutation: dsl/dsl_record.sv | assign used = bank_q == newest_q || | assign used =
// mutation: dsl/dsl_record.sv | bank_q + 3'd1 | bank_q + 3'd2
// mutation: dsl/dsl_record.sv | newest_q <= bank_q; | newest_q <= bank_q + 3'd1;
// mutation: dsl/dsl_record.sv | assign holds   = hold_i || clears_q; | assign holds   = hold_i && !moves_q || clears_q;
// mutation: dsl/dsl_record.sv | fresh_q      <= hold_i || group_i > LAST_GROUP; | fresh_q      <= group_i > LAST_GROUP;
// mutation: dsl/dsl_record.sv | clears_q <= walk_q != 3'd7; | clears_q <= walk_q != 3'd4;

module proof (
  input logic       clk_i,
  input logic       rst_ni,
  input logic       write_i,
  input logic [5:0] write_address_i,
  input logic [7:0] write_data_i,
  input logic       tell_i,
  input logic       read_i,
  input logic       hold_i,
  input logic [2:0] group_i,
  input logic [5:0] address_i
);

  localparam int unsigned GROUPS = 6;

  logic [7:0] data;
  logic       busy;
  dsl_record u_dut (
    .clk_i, .rst_ni, .write_i, .write_address_i, .write_data_i, .tell_i,
    .busy_o (busy),
    .read_i, .hold_i, .group_i, .address_i,
    .data_o (data)
  );

  wire [2:0]  bank, newest, from, walk, walked;
  wire [2:0]  held0, held1, held2, held3, held4, held5;
  wire [2:0]  copy0, copy1, copy2, copy3, copy4, copy5;
  wire        moves, clears;
  wire [17:0] held   = {held5, held4, held3, held2, held1, held0};
  wire [17:0] copies = {copy5, copy4, copy3, copy2, copy1, copy0};

  logic        started = 1'b0;
  logic [17:0] held_q;          // what the groups have to have
  logic [2:0]  newest_q;
  logic        told_q;          // the first record is whole
  logic [6:0]  since_q;         // clocks since tell_i, up to 64
  logic [2:0]  free_q;          // the first free bank at tell_i
  logic [2:0]  free;
  logic        taken;           // the free one is another's
  logic [2:0]  candidate;
  logic [2:0]  want_q;          // bank of a read in this clock
  logic        asked_q;         // ... if it is one

  always @* begin
    assume (rst_ni == started);
    if (busy) assume (!write_i && !tell_i);
    if (hold_i) assume (!clears && group_i < 3'd6);
  end

  // The groups' banks after this clock, and the first one behind that of the writer that is none of them.
  logic [17:0] held_d;
  always @* begin
    held_d = held_q;
    for (int g = 0; g < GROUPS; g++) if (hold_i && group_i == 3'(g)) held_d[g*3 +: 3] = newest_q;
    free = bank;
    for (int i = 7; i >= 1; i--) begin
      candidate = bank + 3'(i);
      taken = 1'b0;
      for (int g = 0; g < GROUPS; g++) if (held_d[g*3 +: 3] == candidate) taken = 1'b1;
      if (!taken) free = candidate;
    end
  end

  // What the bank of the writer and the free one share, and what the search has seen.
  logic       shared, free_used, walked_right, passed, cleared;
  logic [2:0] last;             // group whose bank has been read
  always @* begin
    shared       = bank == newest;
    free_used    = free_q == newest;
    passed       = 1'b1;
    walked_right = 1'b0;
    last         = walk - 3'd1;
    cleared      = 1'b1;
    for (int g = 0; g < GROUPS; g++) begin
      if (held_q[g*3 +: 3] == bank)   shared    = 1'b1;
      if (held_q[g*3 +: 3] == free_q) free_used = 1'b1;
      if (3'(g) < walk && {held[g*3 +: 3], copies[g*3 +: 3]} != 6'd0) cleared = 1'b0;
      // In front of that group no bank is the writer's.
      if (3'(g) < last && walk != 3'd0 && held_q[g*3 +: 3] == bank) passed = 1'b0;
      // A group that has moved since is at the newest bank.
      if (3'(g) == last && (walked == held_q[g*3 +: 3] || held_q[g*3 +: 3] == newest)) walked_right = 1'b1;
    end
  end

  // The groups' banks, and the newest one, as the rules say.
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {told_q, since_q, free_q, newest_q, held_q} <= {1'b0, 7'd64, 3'd0, 3'd0, 18'd0};
      {want_q, asked_q} <= '0;
    end else begin
      if (tell_i) {told_q, since_q, free_q, newest_q} <= {1'b1, 7'd0, free, bank};
      else if (since_q != 7'd64) since_q <= since_q + 7'd1;
      held_q  <= held_d;
      asked_q <= !clears;
      want_q  <= newest_q;
      for (int g = 0; g < GROUPS; g++) if (!hold_i && group_i == 3'(g)) want_q <= held_q[g*3 +: 3];
    end
  end
  always @(posedge clk_i) started <= 1'b1;

  always @* if (started) begin
    if (!clears) Held_A: assert (held == held_q && copies == held_q);
    Newest_A: assert (newest == newest_q);
    if (clears) Cleared_A: assert (cleared);
    if (clears) Clears_A: assert (!told_q && !moves && bank == 3'd0 && newest == 3'd0 && held_q == 18'd0);
    Alone_A:  assert (!(write_i && told_q) || !shared);
    Found_A:  assert (moves || !told_q || !shared);
    if (moves) begin
      Search_A: assert (told_q && !free_used && walk <= 3'd6
                        && since_q <= {1'b0, 3'd7 - 3'(free_q - bank), walk});
      if (walk != 3'd0) Seen_A: assert (bank != newest && passed && walked_right && walked != free_q);
    end
    Ended_A:  assert (since_q != 7'd64 || !moves);
    First_A:  assert (told_q || (since_q == 7'd64 && !moves && bank == 3'd0 && newest == 3'd0));
    if (asked_q) From_A: assert (from == want_q);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Long_C:  cover (moves && since_q == 7'd7);
    Write_C: cover (write_i && told_q && bank == 3'd1);
  end

endmodule
