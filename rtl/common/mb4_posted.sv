// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Posted bytes from the host domain into the core domain: a queue in a dual-clock memory, the
// Gray-coded write count as the only crossing signal.
//
// Clock domains: wr_* in hclk_i, everything else in clk_i. A byte is offered 3..4 clk_i periods
// after it was written, if none waits before it, and is taken by ready_i; bytes that wait follow
// one a clock. While the core clock stands still, or the core does not take them, 2^AddrW bytes
// wait; they take effect when it goes on.
// Misuse: with more than that the queue has wrapped and bytes are lost.
// Constraint: false path to the first flops of the count, whose bits must arrive within one hclk_i
// period of each other; the memory's contents are older than the count that tells of them.

module mb4_posted #(
  parameter int unsigned Width = 16,
  parameter int unsigned AddrW = 7
) (
  // host domain
  input  logic             hclk_i,
  input  logic             hrst_ni,
  input  logic             wr_en_i,
  input  logic [Width-1:0] wr_data_i,
  // core domain
  input  logic             clk_i,
  input  logic             rst_ni,
  output logic             valid_o,
  output logic [Width-1:0] data_o,
  input  logic             ready_i
);

  logic [AddrW:0] wr_q;
  logic [AddrW:0] wr_d;
  logic [AddrW:0] wr_gray_q;
  logic [AddrW:0] wr_sync;
  logic [AddrW:0] rd_q;
  logic [AddrW:0] rd_gray;
  logic           valid_q;
  logic           fetch;

  assign wr_d = wr_q + (AddrW+1)'(1);

  always_ff @(posedge hclk_i or negedge hrst_ni) begin
    if (!hrst_ni) begin
      wr_q      <= '0;
      wr_gray_q <= '0;
    end else if (wr_en_i) begin
      wr_q      <= wr_d;
      wr_gray_q <= wr_d ^ {1'b0, wr_d[AddrW:1]};
    end
  end

  for (genvar i = 0; i <= AddrW; i++) begin : gen_sync
    mb4_sync_bit u_sync (
      .clk_i,
      .rst_ni,
      .data_i (wr_gray_q[i]),
      .data_o (wr_sync[i])
    );
  end

  assign rd_gray = rd_q ^ {1'b0, rd_q[AddrW:1]};
  assign fetch   = wr_sync != rd_gray && (!valid_q || ready_i);

  mb4_ram #(.Width(Width), .AddrW(AddrW)) u_ram (
    .wclk_i    (hclk_i),
    .wr_en_i,
    .wr_addr_i (wr_q[AddrW-1:0]),
    .wr_data_i,
    .rclk_i    (clk_i),
    .rd_en_i   (fetch),
    .rd_addr_i (rd_q[AddrW-1:0]),
    .rd_data_o (data_o)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rd_q    <= '0;
      valid_q <= 1'b0;
    end else begin
      if (fetch) rd_q <= rd_q + (AddrW+1)'(1);
      valid_q <= fetch || (valid_q && !ready_i);
    end
  end

  assign valid_o = valid_q;

endmodule
