// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory of rows of four fields: each field has its own write enable, a read gives the whole row. A
// field is a byte; field 1 may be wider. It maps to block RAM with write enables.
//
// Clock domains: wr_clk_i writes, rd_clk_i reads.
// Latency: read data are valid after the rd_clk_i edge that samples rd_en_i and rd_addr_i.
// Misuse: the contents are undefined until they are written; the owner clears them. A read of a
// field at the edge that writes it gives an undefined field.

module enc_ram_row #(
  parameter int unsigned AddrW  = 3,
  parameter int unsigned Field1 = 8   // bits of field 1
) (
  input  logic             wr_clk_i,
  input  logic [3:0]       wr_en_i,    // one bit for each field
  input  logic [AddrW-1:0] wr_addr_i,
  input  logic [24+Field1-1:0] wr_data_i,
  input  logic             rd_clk_i,
  input  logic             rd_en_i,
  input  logic [AddrW-1:0] rd_addr_i,
  output logic [24+Field1-1:0] rd_data_o
);

  localparam int unsigned W = 24 + Field1;

  (* no_rw_check *) logic [W-1:0] mem [0:(1 << AddrW)-1];
  logic [W-1:0] rd_data_q;

  always_ff @(posedge wr_clk_i) begin
    if (wr_en_i[0]) mem[wr_addr_i][7:0]   <= wr_data_i[7:0];
    if (wr_en_i[1]) mem[wr_addr_i][W-17:8] <= wr_data_i[W-17:8];
    if (wr_en_i[2]) mem[wr_addr_i][W-9:W-16] <= wr_data_i[W-9:W-16];
    if (wr_en_i[3]) mem[wr_addr_i][W-1:W-8] <= wr_data_i[W-1:W-8];
  end

  always_ff @(posedge rd_clk_i) begin
    if (rd_en_i) rd_data_q <= mem[rd_addr_i];
  end

  assign rd_data_o = rd_data_q;

endmodule
