// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Two byte memories side by side: a write changes one byte, a read gives both. It maps to block RAM
// with byte enables.
//
// Clock domains: wr_clk_i writes, rd_clk_i reads.
// Latency: read data are valid after the rd_clk_i edge that samples rd_en_i and rd_addr_i.
// Misuse: the contents are undefined until they are written; the owner clears them. A read of a
// byte at the edge that writes it gives an undefined byte.

module enc_ram_pair #(
  parameter int unsigned AddrW = 5
) (
  input  logic             wr_clk_i,
  input  logic             wr_en_i,
  input  logic             wr_side_i,
  input  logic [AddrW-1:0] wr_addr_i,
  input  logic [7:0]       wr_data_i,
  input  logic             rd_clk_i,
  input  logic             rd_en_i,
  input  logic [AddrW-1:0] rd_addr_i,
  output logic [15:0]      rd_data_o   // side 1 in the upper byte
);

  (* no_rw_check *) logic [15:0] mem [0:(1 << AddrW)-1];
  logic [15:0] rd_data_q;

  always_ff @(posedge wr_clk_i) begin
    if (wr_en_i && !wr_side_i) mem[wr_addr_i][7:0]  <= wr_data_i;
    if (wr_en_i && wr_side_i)  mem[wr_addr_i][15:8] <= wr_data_i;
  end

  always_ff @(posedge rd_clk_i) begin
    if (rd_en_i) rd_data_q <= mem[rd_addr_i];
  end

  assign rd_data_o = rd_data_q;

endmodule
