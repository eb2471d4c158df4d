// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Single-cycle data of four data channels in two banks: 2 x 32 bytes (SCDATA1..4 or SCDATA5..8).
// Two copies have the same contents: the host reads one, MO reads the other (actuator data).
//
// Clock domains: the core clock for writes (mb4_write_port orders them) and for the reads of MO,
// rclk_i for the reads of the host. With Port2 there is one more copy for a second host reader with
// its own clock.
// Latency: data are valid one edge after their address. A host read gives the bytes of both banks,
// so that its address does not depend on the bank that the host owns.
// Datasheet: page 26, Table 20.

module mb4_scd_bank #(
  parameter bit Port2 = 1'b0
) (
  input  logic       clk_i,
  // clearing after reset
  input  logic       clear_i,
  input  logic [5:0] clear_addr_i,
  // line engine: the address is {bank, data channel within the half, byte}
  input  logic       eng_wr_en_i,
  input  logic [5:0] eng_wr_addr_i,
  input  logic [7:0] eng_wr_data_i,
  input  logic       eng_rd_en_i,
  input  logic [5:0] eng_rd_addr_i,
  output logic [7:0] eng_rd_data_o,
  // host, posted into the core domain
  input  logic       host_wr_en_i,
  input  logic [5:0] host_wr_addr_i,
  input  logic [7:0] host_wr_data_i,
  output logic       host_ready_o,
  // host read port
  input  logic        rclk_i,
  input  logic        rd_en_i,
  input  logic [4:0]  rd_addr_i,
  output logic [15:0] rd_data_o,     // bank 1 in the upper byte
  // second read port
  input  logic        rd2_clk_i,
  input  logic        rd2_en_i,
  input  logic [4:0]  rd2_addr_i,
  output logic [15:0] rd2_data_o
);

  logic       wr_en;
  logic [5:0] wr_addr;
  logic [7:0] wr_data;

  mb4_write_port u_port (
    .clear_i,
    .clear_addr_i,
    .eng_wr_en_i,
    .eng_wr_addr_i,
    .eng_wr_data_i,
    .host_wr_en_i,
    .host_wr_addr_i,
    .host_wr_data_i,
    .host_ready_o,
    .wr_en_o   (wr_en),
    .wr_addr_o (wr_addr),
    .wr_data_o (wr_data)
  );

  enc_ram_pair #(.AddrW(5)) u_ram (
    .wclk_i    (clk_i),
    .wr_en_i   (wr_en),
    .wr_side_i (wr_addr[5]),
    .wr_addr_i (wr_addr[4:0]),
    .wr_data_i (wr_data),
    .rclk_i,
    .rd_en_i,
    .rd_addr_i,
    .rd_data_o
  );

  enc_ram #(.Width(8), .AddrW(6)) u_mo (
    .wclk_i    (clk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i (wr_addr),
    .wr_data_i (wr_data),
    .rclk_i    (clk_i),
    .rd_en_i   (eng_rd_en_i),
    .rd_addr_i (eng_rd_addr_i),
    .rd_data_o (eng_rd_data_o)
  );

  if (Port2) begin : gen_port2
    enc_ram_pair #(.AddrW(5)) u_ram (
      .wclk_i    (clk_i),
      .wr_en_i   (wr_en),
      .wr_side_i (wr_addr[5]),
      .wr_addr_i (wr_addr[4:0]),
      .wr_data_i (wr_data),
      .rclk_i    (rd2_clk_i),
      .rd_en_i   (rd2_en_i),
      .rd_addr_i (rd2_addr_i),
      .rd_data_o (rd2_data_o)
    );
  end else begin : gen_no_port2
    logic unused;
    assign unused     = ^{rd2_clk_i, rd2_en_i, rd2_addr_i};
    assign rd2_data_o = '0;
  end

endmodule
