// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Posted bytes from the host domain into the core domain: four slots used in turn, a Gray-coded
// count as the only crossing signal.
//
// Clock domains: wr_* in hclk_i, everything else in clk_i. A byte is offered 2..3 clk_i periods
// after it was written and is taken by ready_i.
// Misuse: a write while four bytes wait overwrites the oldest. A host byte lasts 160 ns or more
// (datasheet I203, I204: eight SCLK periods of 20 ns) and the core takes one byte a clock, so four
// slots are enough for every permitted clock. Writes while the core clock stands still, or while
// the core does not take them for longer than four bytes, are lost in whole or in part.
// Constraint: slot_q to the core is held for at least four host bytes; maximum delay one clk_i
// period; false path to the first flops of the count.

module mb4_posted #(
  parameter int unsigned Width = 16
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

  logic [Width-1:0] slot_q [0:3];
  logic [2:0]       wr_q;
  logic [2:0]       wr_d;
  logic [2:0]       wr_gray_q;
  logic [2:0]       wr_sync;
  logic [2:0]       rd_q;
  logic [2:0]       rd_gray;

  assign wr_d = wr_q + 3'd1;

  always_ff @(posedge hclk_i or negedge hrst_ni) begin
    if (!hrst_ni) begin
      wr_q      <= '0;
      wr_gray_q <= '0;
      for (int i = 0; i < 4; i++) slot_q[i] <= '0;
    end else if (wr_en_i) begin
      wr_q              <= wr_d;
      wr_gray_q         <= wr_d ^ {1'b0, wr_d[2:1]};
      slot_q[wr_q[1:0]] <= wr_data_i;
    end
  end

  for (genvar i = 0; i < 3; i++) begin : gen_sync
    mb4_sync_bit u_sync (
      .clk_i,
      .rst_ni,
      .data_i (wr_gray_q[i]),
      .data_o (wr_sync[i])
    );
  end

  assign rd_gray = rd_q ^ {1'b0, rd_q[2:1]};
  assign valid_o = wr_sync != rd_gray;
  assign data_o  = slot_q[rd_q[1:0]];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                 rd_q <= '0;
    else if (valid_o && ready_i) rd_q <= rd_q + 3'd1;
  end

endmodule
