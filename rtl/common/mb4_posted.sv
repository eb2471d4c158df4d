// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Posted bytes from the host domain into the core domain: two slots used in turn, a Gray-coded
// count as the only crossing signal.
//
// Clock domains: wr_* in hclk_i, everything else in clk_i. A byte is offered 2..3 clk_i periods
// after it was written and is taken by ready_i.
// Misuse: a third write before the first was taken overwrites it. A host byte lasts 160 ns or more
// (datasheet I203, I204: eight SCLK periods of 20 ns), so with the core taking one byte a clock two
// slots are enough down to 12.5 MHz. While the core clock stands still only the last two writes
// survive (docs/crossings.md).
// Constraint: slot_q to the core is held for at least two host bytes; maximum delay one clk_i
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

  logic [Width-1:0] slot0_q;
  logic [Width-1:0] slot1_q;
  logic [1:0]       wr_gray_q;
  logic [1:0]       wr_gray_d;
  logic [1:0]       wr_sync;
  logic [1:0]       rd_gray_q;
  logic [1:0]       rd_gray_d;

  // Gray sequence 00 01 11 10: the slot in turn is the XOR of both bits.
  assign wr_gray_d = {wr_gray_q[0], ~wr_gray_q[1]};
  assign rd_gray_d = {rd_gray_q[0], ~rd_gray_q[1]};

  always_ff @(posedge hclk_i or negedge hrst_ni) begin
    if (!hrst_ni) begin
      wr_gray_q <= 2'b00;
      slot0_q   <= '0;
      slot1_q   <= '0;
    end else if (wr_en_i) begin
      wr_gray_q <= wr_gray_d;
      if (wr_gray_q[1] ^ wr_gray_q[0]) slot1_q <= wr_data_i;
      else                             slot0_q <= wr_data_i;
    end
  end

  for (genvar i = 0; i < 2; i++) begin : gen_sync
    mb4_sync_bit u_sync (
      .clk_i,
      .rst_ni,
      .data_i (wr_gray_q[i]),
      .data_o (wr_sync[i])
    );
  end

  assign valid_o = wr_sync != rd_gray_q;
  assign data_o  = (rd_gray_q[1] ^ rd_gray_q[0]) ? slot1_q : slot0_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                 rd_gray_q <= 2'b00;
    else if (valid_o && ready_i) rd_gray_q <= rd_gray_d;
  end

endmodule
