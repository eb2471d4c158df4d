// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The queue of posted bytes (enc_posted): each byte comes out once, in order and whole, at any
// phase and ratio of the clocks. The queue is empty exactly when all bytes have been taken. The
// mark's copy follows a change when all bytes written before it, or with it, have been taken.
// Contract: no more bytes wait than the queue holds; the mark changes with the host's clock, and
// only after the copy has followed. Here the queue holds four bytes of three bits; the counts
// cross in Gray code.
//
// claim: all bytes once, in order, whole; empty and the mark come only after all bytes (up to
//   the mark) are taken; any clocks
// clocks: many
// depth: 16
// cover: 20
// unbounded: reachability
// look: dut_wr = u_dut.wr_q
// look: dut_gray = u_dut.wr_gray_q
// look: dut_rd = u_dut.rd_q
// look: dut_s0 = u_dut.gen_sync[0].u_sync.sync_q
// look: dut_s1 = u_dut.gen_sync[1].u_sync.sync_q
// look: dut_s2 = u_dut.gen_sync[2].u_sync.sync_q
// look: dut_taken = u_dut.taken_q
// look: dut_target = u_dut.target_q
// look: dut_mark = u_dut.u_mark.sync_q
// look: dut_late = u_dut.mark_q
// look: dut_seek = u_dut.seek_q
// keep: common/enc_ram.sv | logic [Width-1:0] mem [0:(1 << AddrW)-1];
//   | (* mem2reg *) logic [Width-1:0] mem [0:(1 << AddrW)-1];
// look: dut_mem0 = u_dut.u_ram.mem[0]
// look: dut_mem1 = u_dut.u_ram.mem[1]
// look: dut_mem2 = u_dut.u_ram.mem[2]
// look: dut_mem3 = u_dut.u_ram.mem[3]
// mutation: common/enc_posted.sv | wr_sync != rd_gray && free; | wr_sync != rd_gray;
// mutation: common/enc_posted.sv | wr_gray_q <= wr_d ^ {1'b0, wr_d[AddrW:1]};
//   | wr_gray_q <= wr_q ^ {1'b0, wr_d[AddrW:1]};
// mutation: common/enc_posted.sv | (AddrW+1)'(fetch); | (AddrW+1)'(valid_q);
// mutation: common/enc_posted.sv | free ? rd_gray : taken_q; | rd_gray;
// mutation: common/enc_posted.sv | mark_q   <= mark; | mark_q   <= mark_i;
// mutation: common/enc_posted.sv | ? wr_sync : target_q; | ? rd_gray : target_q;
// mutation: common/enc_posted.sv | (seek_q && taken_q == target_q) ? mark_q | seek_q ? mark_q
// mutation: common/enc_posted.sv | empty_o = wr_gray_q == taken_q; | empty_o = wr_sync == taken_q;

module proof (
  input logic       wr_clk_i,
  input logic       clk_i,
  input logic       rst_ni,
  input logic       write_i,
  input logic [2:0] data_i,
  input logic       ready_i,
  input logic       chosen_i,   // this byte is the one that is watched
  input logic       flip_i      // the host changes the mark
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic wr_clk_q, clk_q, rst_q, ready_q, write_q;
  logic [2:0] data_q;
  always @(posedge gclk) begin
    {started, wr_clk_q, clk_q, rst_q} <= {1'b1, wr_clk_i, clk_i, rst_ni};
    {ready_q, write_q, data_q} <= {ready_i, write_i, data_i};
  end
  always @* begin
    if (!started) assume (!rst_ni && !wr_clk_i && !clk_i);
    if (started && rst_q) assume (rst_ni);
    if (started) assume ({1'b0, wr_clk_i != wr_clk_q} + {1'b0, clk_i != clk_q} +
                         {1'b0, rst_ni != rst_q} < 2'd2);
  end

  // Numbers of bytes written and bytes taken, modulo 8; at most four wait.
  logic [2:0] in_q, out_q, wait_n;
  logic [2:0] sent_q [0:3];
  logic       write, valid, empty, marked;
  logic [2:0] data;

  assign wait_n = in_q - out_q;
  assign write  = write_i && wait_n < 3'd4;

  always @(posedge wr_clk_i or negedge rst_ni) begin
    if (!rst_ni) in_q <= '0;
    else if (write) begin
      in_q            <= in_q + 3'd1;
      sent_q[in_q[1:0]] <= data_i;
    end
  end
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)               out_q <= '0;
    else if (valid && ready_i) out_q <= out_q + 3'd1;
  end

  // One byte out of all: its place, whether it has been taken, whether the mark has changed with
  // it or after it.
  logic       mark_q, watched_q, before_q, got_q;
  logic [2:0] place_q;
  logic       watch;
  assign watch = write && chosen_i && !watched_q;
  always @(posedge wr_clk_i or negedge rst_ni) begin
    if (!rst_ni) {mark_q, watched_q, before_q, place_q} <= '0;
    else begin
      if (watch) {watched_q, place_q} <= {1'b1, in_q};
      if (flip_i && mark_q == marked) begin
        mark_q   <= !mark_q;
        before_q <= watch || watched_q;
      end
    end
  end
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                                                got_q <= 1'b0;
    else if (watched_q && valid && ready_i && out_q == place_q) got_q <= 1'b1;
  end

  enc_posted #(.Width(3), .AddrW(2)) u_dut (
    .wr_clk_i, .wr_rst_ni(rst_ni), .wr_en_i(write), .wr_data_i(data_i),
    .empty_o(empty), .mark_i(mark_q), .mark_o(marked), .clk_i, .rst_ni,
    .valid_o(valid), .data_o(data), .ready_i
  );

  wire [2:0] dut_wr, dut_gray, dut_rd, dut_mem0, dut_mem1, dut_mem2, dut_mem3;
  wire [2:0] dut_taken, dut_target;
  wire [1:0] dut_s0, dut_s1, dut_s2, dut_mark;
  wire       dut_late, dut_seek;
  logic [2:0] first, second;   // counts on their way
  logic [2:0] ahead_n;         // bytes to be taken before the watched one
  logic       open;            // it waits

  function [2:0] from_gray(input [2:0] g);
    from_gray = {g[2], g[2] ^ g[1], g[2] ^ g[1] ^ g[0]};
  endfunction

  assign first  = from_gray({dut_s2[0], dut_s1[0], dut_s0[0]});
  assign second = from_gray({dut_s2[1], dut_s1[1], dut_s0[1]});

  assign ahead_n = place_q - out_q;
  assign open    = watched_q && !got_q;

  always @* if (started && rst_ni) begin
    Empty_A: assert (empty == (wait_n == 3'd0));
    if (before_q && marked == mark_q) Marked_A: assert (got_q);
    if (valid) InOrder_A: assert (data == sent_q[out_q[1:0]] && wait_n != 3'd0);
    Room_A: assert (wait_n <= 3'd4);
    // Counts: taken <= fetched <= second flop <= first flop <= written.
    Count1_A: assert (dut_wr == in_q && from_gray(dut_gray) == in_q);
    Count2_A: assert (dut_rd == out_q + {2'd0, valid});
    Count3_A: assert ((dut_rd - out_q) <= (second - out_q));
    Count4_A: assert ((second - out_q) <= (first - out_q));
    Count5_A: assert ((first - out_q) <= wait_n);
    Count6_A: assert (from_gray(dut_taken) == out_q);
    // The watched byte waits until it is taken.
    if (open) Watched1_A: assert (ahead_n < wait_n);
    if (!watched_q) Watched2_A: assert (!got_q && !before_q);
    // The mark is on its way behind the count, once.
    Mark1_A: assert ((dut_mark[0] == mark_q || dut_mark[0] == dut_mark[1]) &&
                     (dut_mark[1] == mark_q || dut_mark[1] == dut_late) &&
                     (dut_late == mark_q || dut_late == marked));
    if (dut_seek) Mark2_A: assert (dut_late != marked);
    if (open && before_q) begin
      if (dut_mark[0] == mark_q) Mark3_A: assert (ahead_n < (first - out_q));
      if (dut_mark[1] == mark_q) Mark4_A: assert (ahead_n < (second - out_q));
      if (dut_late == mark_q) Mark5_A: assert (ahead_n < (second - out_q));
      if (dut_seek) Mark6_A: assert (ahead_n < (from_gray(dut_target) - out_q) &&
                                     (from_gray(dut_target) - out_q) <= (second - out_q));
    end
    // Each byte that waits is in the memory.
    if ({1'b0, 2'd0 - out_q[1:0]} < wait_n) Memory0_A: assert (dut_mem0 == sent_q[0]);
    if ({1'b0, 2'd1 - out_q[1:0]} < wait_n) Memory1_A: assert (dut_mem1 == sent_q[1]);
    if ({1'b0, 2'd2 - out_q[1:0]} < wait_n) Memory2_A: assert (dut_mem2 == sent_q[2]);
    if ({1'b0, 2'd3 - out_q[1:0]} < wait_n) Memory3_A: assert (dut_mem3 == sent_q[3]);
  end
  always @(posedge clk_i) begin
    Second_C: cover (rst_ni && valid && ready_i && out_q == 3'd1 && wait_n == 3'd1);
    Marked_C: cover (rst_ni && marked && mark_q && before_q);
  end

endmodule
