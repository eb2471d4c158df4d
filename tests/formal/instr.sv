// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// 0xF4 on its way to the core (decision 41): the instruction register (mb4_instr_reg) and the
// receiver of its Gray count (enc_count_rx), at any phase and ratio of the clocks, edges at the
// same instant among them, and with writes however close. A byte that is taken at the very instant
// of a write may be any mix of the older and the later one. "Clocks" are the receiver's.
//
// claim: the last byte written is the last one taken, within 6 clocks, 3 for a single write; no
//   BREAK is lost or invented; one pulse for each step, ack two clocks after it; any clocks, any
//   writes
// clocks: many
// depth: 24
// cover: 24
// unbounded: reachability
// look: dut_sync0 = u_dut.gen_bit[0].u_sync.sync_q
// look: dut_sync1 = u_dut.gen_bit[1].u_sync.sync_q
// look: dut_taken = u_dut.taken_q
// look: dut_late = u_dut.late_q
// mutation: common/enc_count_rx.sv | sync != taken_q && ack_q == taken_q; | sync != taken_q;
// mutation: common/enc_count_rx.sv | ack_q  <= late_q; | ack_q  <= taken_q;
// mutation: common/enc_sync_bit.sv | {sync_q[0], data_i} | {2{data_i}}
// mutation: mb4/regs/mb4_instr_reg.sv | (byte_q & {8{pending_o}} & mb4_regs_pkg::BREAK_MASK) | 8'h00
// mutation: mb4/regs/mb4_instr_reg.sv | (byte_q & {8{pending_o}} & mb4_regs_pkg::BREAK_MASK)
//   | (byte_q & mb4_regs_pkg::BREAK_MASK)
// mutation: mb4/regs/mb4_instr_reg.sv | if (count_q != ~instr_i.ack) count_q | count_q
// mutation: mb4/regs/mb4_instr_reg.sv | if (count_q != ~instr_i.ack) count_q | if (count_q == instr_i.ack) count_q

module proof (
  input logic       wr_clk_i,
  input logic       clk_i,
  input logic       rst_ni,
  input logic       write_i,
  input logic [7:0] data_i,
  input logic       chosen_i,   // this write is the one that is watched
  input logic [7:0] later_i     // bits that are taken from the write at the same instant
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic wr_clk_q, clk_q, rst_q, write_q, pulse_q, mixed_q;
  always @(posedge gclk) begin
    {started, wr_clk_q, clk_q, rst_q} <= {1'b1, wr_clk_i, clk_i, rst_ni};
    {write_q, pulse_q, mixed_q} <= {write_i, pulse, later_i != 8'h00};
  end
  logic wrote, ticked;   // at this instant
  assign wrote  = wr_clk_i && !wr_clk_q && write_q;
  assign ticked = clk_i && !clk_q;
  // One reset, in the beginning.
  always @* begin
    if (!started) assume (!rst_ni && !wr_clk_i && !clk_i);
    if (started && rst_q) assume (rst_ni);
    if (started && rst_ni != rst_q) assume (wr_clk_i == wr_clk_q && clk_i == clk_q);
    if (started && mixed_q && ticked) assume (wrote);
  end

  logic [7:0]      taken_d;
  logic [1:0]      count, ack;
  logic            pulse, pending;
  mb4_pkg::instr_t written;

  mb4_instr_reg u_instr (
    .wr_clk_i, .rst_ni, .host_i({write_i, 8'hF4, data_i, 9'd0}),
    .pending_o(pending), .instr_o({count, written}), .instr_i({ack, 8'h00}),
    .base_i(1'b0), .newest_i(1'b0)
  );
  enc_count_rx u_dut (.clk_i, .rst_ni, .count_i(count), .pulse_o(pulse), .ack_o(ack));

  // The host: the last byte, whether it found 0xF4 at rest, whether a BREAK has come since the last
  // rest; one BREAK out of all.
  logic [6:0] last_q;
  logic       alone_q, break_q, watched_q;
  always @(posedge wr_clk_i or negedge rst_ni) begin
    if (!rst_ni) {last_q, alone_q, break_q, watched_q} <= '0;
    else if (write_i) begin
      last_q    <= data_i[6:0];
      alone_q   <= !pending;
      break_q   <= data_i[7] || (break_q && pending);
      watched_q <= watched_q || (chosen_i && data_i[7]);
    end
  end

  // The core: the byte taken, the pulses so far and as they were one and two clocks before.
  logic [7:0] taken_q;
  logic [1:0] pulses_q, late1_q, late2_q;
  logic       found_q;
  assign taken_d = (written & ~later_i) |
                   ({data_i[7] || (written.brk && pending), data_i[6:0]} & later_i);
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {taken_q, pulses_q, late1_q, late2_q, found_q} <= '0;
    else begin
      {late1_q, late2_q} <= {pulses_q, late1_q};
      if (pulse) begin
        taken_q  <= taken_d;
        pulses_q <= pulses_q + 2'd1;
        found_q  <= found_q || (watched_q && taken_d[7]);
      end
    end
  end

  // Clocks since the last write, 8 at most.
  logic [3:0] since, since_q;
  assign since = wrote ? 4'd0 : since_q + {3'd0, ticked && since_q != 4'd8};
  always @(posedge gclk) since_q <= !rst_ni ? 4'd8 : since;

  function [1:0] number(input [1:0] gray);
    number = {gray[1], gray[1] ^ gray[0]};
  endfunction

  wire  [1:0] dut_sync0, dut_sync1, dut_taken, dut_late;
  logic [1:0] steps, first, second, owed, lag;
  logic [3:0] way, need;
  assign steps  = number(count);
  assign first  = number({dut_sync1[0], dut_sync0[0]});
  assign second = number({dut_sync1[1], dut_sync0[1]});
  assign owed   = steps - pulses_q;
  // Clocks until ack is that of the pulses; until a step has crossed; until 0xF4 is at rest.
  assign lag  = pulses_q != late1_q ? 2'd2 : {1'b0, late1_q != late2_q};
  assign way  = second != pulses_q ? 4'd0 : first != pulses_q ? 4'd1 : 4'd2;
  assign need = owed == 2'd0 ? {2'd0, lag} :
                (way > {2'd0, lag} ? way : {2'd0, lag}) + (owed == 2'd1 ? 4'd3 : 4'd6);

  always @* if (started && rst_ni) begin
    // At rest the core has taken the last byte and every BREAK.
    if (!pending) Last_A: assert (taken_q[6:0] == last_q && owed == 2'd0);
    if (!pending && watched_q) Break_A: assert (found_q);
    if (since >= 4'd8) Rest_A: assert (!pending && !pulse);
    if (since >= 4'd6) InTime_A: assert (owed == 2'd0 && taken_q[6:0] == last_q);
    if (alone_q && since >= 4'd3) Alone_A: assert (owed == 2'd0 && taken_q[6:0] == last_q);
    if (alone_q && since >= 4'd5) AloneRest_A: assert (!pending);
    if (alone_q && pulse) NotSooner_A: assert (since >= 4'd2);
    if (ticked && pulse_q && taken_q[7]) NotMadeUp_A: assert (break_q);
    if (pulse) Needed_A: assert (owed != 2'd0);
    Ack_A: assert (number(ack) == late2_q);
    // Counts: ack <= a clock before <= pulses <= second flop <= first flop <= steps <= ack + 2.
    Count1_A: assert ((steps - late2_q) <= 2'd2);
    Count2_A: assert ((first - late2_q) <= (steps - late2_q));
    Count3_A: assert ((second - late2_q) <= (first - late2_q));
    Count4_A: assert ((pulses_q - late2_q) <= (second - late2_q) && (pulses_q - late2_q) <= 2'd1);
    Count5_A: assert ((late1_q - late2_q) <= (pulses_q - late2_q));
    // The way.
    Way1_A: assert (written == {written.brk, last_q});
    if (written.brk && pending) Way2_A: assert (break_q);
    if (owed == 2'd0) Way3_A: assert (taken_q[6:0] == last_q);
    if (watched_q && !found_q) Way4_A: assert (owed != 2'd0 && written.brk);
    Way5_A: assert (since <= 4'd8 && since + need <= 4'd8);
    if (alone_q) Way6_A: assert (owed <= 2'd1 && (need == 4'd0 || since + need <= 4'd5));
    if (alone_q && owed == 2'd1) Way7_A: assert (since + way >= 4'd2);
    Way8_A: assert (number(dut_taken) == pulses_q && number(dut_late) == late1_q);
  end
  always @(posedge clk_i) begin
    Twice_C: cover (rst_ni && pulse && owed == 2'd2 && written.brk && !last_q[0]);
    Last_C: cover (rst_ni && !pending && !alone_q && watched_q && last_q == 7'h09);
  end

endmodule
