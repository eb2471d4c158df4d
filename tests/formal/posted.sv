// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The queue of posted bytes (mb4_posted): everything written comes out once, in order and whole, at
// any phase and ratio of the clocks. Contract: no more bytes wait than the queue holds. Here it
// holds four bytes of three bits; the count and its Gray code are what crosses.
//
// claim: all bytes once, in order, whole; any clocks
// clocks: many
// depth: 20
// cover: 18
// unbounded: induction 3
// look: dut_wr = u_dut.wr_q
// look: dut_gray = u_dut.wr_gray_q
// look: dut_rd = u_dut.rd_q
// look: dut_s0 = u_dut.gen_sync[0].u_sync.sync_q
// look: dut_s1 = u_dut.gen_sync[1].u_sync.sync_q
// look: dut_s2 = u_dut.gen_sync[2].u_sync.sync_q
// keep: common/mb4_ram.sv | logic [Width-1:0] mem [0:(1 << AddrW)-1];
//   | (* mem2reg *) logic [Width-1:0] mem [0:(1 << AddrW)-1];
// look: dut_mem0 = u_dut.u_ram.mem[0]
// look: dut_mem1 = u_dut.u_ram.mem[1]
// look: dut_mem2 = u_dut.u_ram.mem[2]
// look: dut_mem3 = u_dut.u_ram.mem[3]
// mutation: common/mb4_posted.sv | (!valid_q || ready_i); | 1'b1;
// mutation: common/mb4_posted.sv | wr_gray_q <= wr_d ^ {1'b0, wr_d[AddrW:1]};
//   | wr_gray_q <= wr_q ^ {1'b0, wr_d[AddrW:1]};
// mutation: common/mb4_posted.sv | if (fetch) rd_q <= | if (valid_q) rd_q <=

module proof (
  input logic       hclk_i,
  input logic       clk_i,
  input logic       rst_ni,
  input logic       write_i,
  input logic [2:0] data_i,
  input logic       ready_i
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic hclk_q, clk_q, rst_q, ready_q, write_q;
  logic [2:0] data_q;
  always @(posedge gclk) begin
    {started, hclk_q, clk_q, rst_q} <= {1'b1, hclk_i, clk_i, rst_ni};
    {ready_q, write_q, data_q} <= {ready_i, write_i, data_i};
  end
  always @* begin
    if (!started) assume (!rst_ni && !hclk_i && !clk_i);
    if (started && rst_q) assume (rst_ni);
    if (started) assume ({1'b0, hclk_i != hclk_q} + {1'b0, clk_i != clk_q} +
                         {1'b0, rst_ni != rst_q} < 2'd2);
  end

  // What has been written and what has been taken, modulo 8; at most four wait.
  logic [2:0] in_q, out_q, wait_n;
  logic [2:0] sent_q [0:3];
  logic       write, valid;
  logic [2:0] data;

  assign wait_n = in_q - out_q;
  assign write  = write_i && wait_n < 3'd4;

  always @(posedge hclk_i or negedge rst_ni) begin
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

  mb4_posted #(.Width(3), .AddrW(2)) u_dut (
    .hclk_i, .hrst_ni(rst_ni), .wr_en_i(write), .wr_data_i(data_i),
    .clk_i, .rst_ni, .valid_o(valid), .data_o(data), .ready_i
  );

  wire [2:0] dut_wr, dut_gray, dut_rd, dut_mem0, dut_mem1, dut_mem2, dut_mem3;
  wire [1:0] dut_s0, dut_s1, dut_s2;
  logic [2:0] first, second;   // counts on their way

  function [2:0] from_gray(input [2:0] g);
    from_gray = {g[2], g[2] ^ g[1], g[2] ^ g[1] ^ g[0]};
  endfunction

  assign first  = from_gray({dut_s2[0], dut_s1[0], dut_s0[0]});
  assign second = from_gray({dut_s2[1], dut_s1[1], dut_s0[1]});

  always @* if (started && rst_ni) begin
    if (valid) InOrder_A: assert (data == sent_q[out_q[1:0]] && wait_n != 3'd0);
    Room_A: assert (wait_n <= 3'd4);
    // Counts: taken <= fetched <= second flop <= first flop <= written.
    Count1_A: assert (dut_wr == in_q && from_gray(dut_gray) == in_q);
    Count2_A: assert (dut_rd == out_q + {2'd0, valid});
    Count3_A: assert ((dut_rd - out_q) <= (second - out_q));
    Count4_A: assert ((second - out_q) <= (first - out_q));
    Count5_A: assert ((first - out_q) <= wait_n);
    // What waits is in the memory.
    if ({1'b0, 2'd0 - out_q[1:0]} < wait_n) Memory0_A: assert (dut_mem0 == sent_q[0]);
    if ({1'b0, 2'd1 - out_q[1:0]} < wait_n) Memory1_A: assert (dut_mem1 == sent_q[1]);
    if ({1'b0, 2'd2 - out_q[1:0]} < wait_n) Memory2_A: assert (dut_mem2 == sent_q[2]);
    if ({1'b0, 2'd3 - out_q[1:0]} < wait_n) Memory3_A: assert (dut_mem3 == sent_q[3]);
  end
  always @(posedge clk_i) Second_C: cover (rst_ni && valid && ready_i && out_q == 3'd1 &&
                                           wait_n == 3'd1);

endmodule
