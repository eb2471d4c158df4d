// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Banks of dsl_record: whatever the groups do, the record that is written has a bank of its own. The
// search for it begins behind tell_i and ends within seven clocks. A group changes its bank only by
// its own hold_i, to the newest one.
//
// The bench names the first free bank at tell_i. It stays free, as groups only move to the newest
// bank, and the search goes toward it.
//
// claim: the record that is written shares its bank with no group and not with the newest record, and has it within seven
//   clocks; a group reads the newest record of its last hold, and that alone
// clocks: one
// depth: 12
// cover: 14
// unbounded: induction 1
// checks: there
// look: bank = u_dut.bank_q
// look: newest = u_dut.newest_q
// look: moves = u_dut.moves_q
// look: held = u_dut.held_q
// look: from = u_dut.bank
// mutation: dsl/dsl_record.sv | if (bank_q == held_q[i*W +: W]) used = 1'b1; | if (i != 5 && bank_q == held_q[i*W +: W]) used = 1'b1;
// mutation: dsl/dsl_record.sv | used = bank_q == newest_q; | used = 1'b0;
// mutation: dsl/dsl_record.sv | bank_q + 3'd1 | bank_q + 3'd2
// mutation: dsl/dsl_record.sv | newest_q <= bank_q; | newest_q <= bank_q + 3'd1;
// mutation: dsl/dsl_record.sv | held_q[i*W +: W] <= newest_q; | held_q[i*W +: W] <= bank_q;
// mutation: dsl/dsl_record.sv | if (group_i == 3'(i) && !hold_i) bank | if (group_i == 3'(i)) bank

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
  dsl_record u_dut (
    .clk_i, .rst_ni, .write_i, .write_address_i, .write_data_i, .tell_i, .read_i, .hold_i, .group_i, .address_i,
    .data_o (data)
  );

  wire [2:0]  bank, newest, from;
  wire [17:0] held;
  wire        moves;

  logic        started = 1'b0;
  logic [17:0] held_q;
  logic [2:0]  newest_q;
  logic       told_q;           // the first record is whole
  logic [3:0] since_q;          // clocks since tell_i, up to 8
  logic [2:0] free_q;           // the first free bank at tell_i
  logic [2:0] free;
  logic       shared, taken;    // the bank of the writer is another's; the free one is
  logic [2:0] candidate;

  always @* begin
    assume (rst_ni == started);
    if (since_q < 4'd8) assume (!write_i && !tell_i);
  end

  // The groups' banks after this clock, and the first one behind that of the writer that is none of them.
  logic [17:0] held_d;
  always @* begin
    held_d = held_q;
    for (int g = 0; g < GROUPS; g++) begin
      if (read_i && hold_i && group_i == 3'(g)) held_d[g*3 +: 3] = newest_q;
    end
    free = bank;
    for (int i = 7; i >= 1; i--) begin
      candidate = bank + 3'(i);
      taken = 1'b0;
      for (int g = 0; g < GROUPS; g++) if (held_d[g*3 +: 3] == candidate) taken = 1'b1;
      if (!taken) free = candidate;
    end
  end

  logic free_used;
  always @* begin
    shared    = bank == newest;
    free_used = free_q == newest;
    for (int g = 0; g < GROUPS; g++) begin
      if (held[g*3 +: 3] == bank)   shared    = 1'b1;
      if (held[g*3 +: 3] == free_q) free_used = 1'b1;
    end
  end

  // The groups' banks, and the newest one, as the rules say.
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {told_q, since_q, free_q, newest_q, held_q} <= {1'b0, 4'd8, 3'd0, 3'd0, 18'd0};
    end else begin
      if (tell_i) {told_q, since_q, free_q, newest_q} <= {1'b1, 4'd0, free, bank};
      else if (since_q != 4'd8) since_q <= since_q + 4'd1;
      held_q <= held_d;
    end
  end
  always @(posedge clk_i) started <= 1'b1;

  always @* if (started) begin
    Held_A:   assert (held == held_q && newest == newest_q);
    Alone_A:  assert (!(write_i && told_q) || !shared);
    Found_A:  assert (moves || !told_q || !shared);
    Search_A: assert (!moves || (!free_used && since_q < 4'd8
                      && {1'b0, 3'(free_q - bank)} + since_q <= 4'd7));
    Ended_A:  assert (since_q != 4'd8 || !moves);
    First_A:  assert (told_q || (since_q == 4'd8 && !moves && bank == 3'd0 && newest == 3'd0));
    From_A:   assert (from == (hold_i || group_i >= 3'd6 ? newest : held_q[group_i*3 +: 3]));
  end

  always @(posedge clk_i) if (rst_ni) begin
    Long_C:  cover (moves && since_q == 4'd1);
    Write_C: cover (write_i && told_q && bank == 3'd1);
  end

endmodule
