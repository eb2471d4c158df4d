// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// RDATA1..64: data of register communication, one bank. Two copies have the same contents: the host
// reads one, the control communication reads the other.
//
// Clock domains: the core clock for writes and for the reads of the control communication, rclk_i
// for the reads of the host. mb4_write_port orders the writes.
// Latency: data are valid one edge after their address.
// Misuse: the host may use RDATA only while no control communication runs (page 28).
// Datasheet: page 28, Table 27.

module mb4_rdata_buf (
  input  logic       clk_i,
  input  logic       clear_i,
  input  logic [5:0] clear_addr_i,
  // control communication
  input  logic       eng_wr_en_i,
  input  logic [5:0] eng_addr_i,
  input  logic [7:0] eng_wr_data_i,
  input  logic       eng_rd_en_i,
  output logic [7:0] eng_rd_data_o,
  // host, posted into the core domain
  input  logic       host_wr_en_i,
  input  logic [5:0] host_wr_addr_i,
  input  logic [7:0] host_wr_data_i,
  output logic       host_ready_o,
  // host read port
  input  logic       rclk_i,
  input  logic       rd_en_i,
  input  logic [5:0] rd_addr_i,
  output logic [7:0] rd_data_o
);

  logic       wr_en;
  logic [5:0] wr_addr;
  logic [7:0] wr_data;

  mb4_write_port u_port (
    .clear_i,
    .clear_addr_i,
    .eng_wr_en_i,
    .eng_wr_addr_i (eng_addr_i),
    .eng_wr_data_i,
    .host_wr_en_i,
    .host_wr_addr_i,
    .host_wr_data_i,
    .host_ready_o,
    .wr_en_o   (wr_en),
    .wr_addr_o (wr_addr),
    .wr_data_o (wr_data)
  );

  enc_ram #(.Width(8), .AddrW(6)) u_host (
    .wclk_i    (clk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i (wr_addr),
    .wr_data_i (wr_data),
    .rclk_i,
    .rd_en_i,
    .rd_addr_i,
    .rd_data_o
  );

  enc_ram #(.Width(8), .AddrW(6)) u_engine (
    .wclk_i    (clk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i (wr_addr),
    .wr_data_i (wr_data),
    .rclk_i    (clk_i),
    .rd_en_i   (eng_rd_en_i),
    .rd_addr_i (eng_addr_i),
    .rd_data_o (eng_rd_data_o)
  );

endmodule
