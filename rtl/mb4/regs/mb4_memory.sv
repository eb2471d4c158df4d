// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A data memory of 64 bytes. Two copies have the same contents: the host reads one, the core reads
// the other. Three of them exist: SCDATA1..4, SCDATA5..8 (two banks each; the core reads data for
// MO) and RDATA (the core is the control communication).
//
// Clock domains: the core clock for writes and for the reads of the core, rd_clk_i for the reads of
// the host. With Port2 there is one more copy for a second host reader with its own clock.
// Latency: data are valid one edge after their address. With Banks the highest address bit is the
// bank, and a host read gives the bytes of both banks, so that it does not depend on the bank that
// the host owns.
//
// The memory has a single write port. The core goes first, then clearing after a reset, then the
// posted byte of the host. host_ready_o is high in the clock in which this byte is taken. The core
// writes at most every second clock, so the host waits at most one clock for it.
// Misuse: a byte that the core writes while clear_i.en is high keeps one address from being
// cleared; no frame runs then. The host may use RDATA only while no control communication runs
// (page 28).
// Datasheet: pages 26, 28, Tables 20, 27.

module mb4_memory #(
  parameter bit Banks = 1'b1,
  parameter bit Port2 = 1'b0
) (
  input  logic       clk_i,
  input  mb4_pkg::mem_wr_t clear_i,
  // core
  input  mb4_pkg::mem_wr_t eng_wr_i,
  input  mb4_pkg::mem_rd_t eng_rd_i,
  output logic [7:0] eng_data_o,
  // host, posted into the core domain
  input  mb4_pkg::mem_wr_t host_wr_i,
  output logic       host_ready_o,
  // host read port
  input  logic        rd_clk_i,
  input  mb4_pkg::mem_rd_t rd_i,
  output logic [15:0] rd_data_o,     // bank 1 in the upper byte
  // second read port
  input  logic        rd2_clk_i,
  input  mb4_pkg::mem_rd_t rd2_i,
  output logic [15:0] rd2_data_o
);

  logic       wr_en;
  logic [5:0] wr_addr;
  logic [7:0] wr_data;
  logic       unused;

  assign host_ready_o = !clear_i.en && !eng_wr_i.en;
  assign wr_en   = clear_i.en || eng_wr_i.en || host_wr_i.en;
  // The inner choice is the same in all memories, so synthesis makes it once.
  assign wr_addr = eng_wr_i.en ? eng_wr_i.addr : clear_i.en ? clear_i.addr : host_wr_i.addr;
  assign wr_data = eng_wr_i.en ? eng_wr_i.data : clear_i.en ? clear_i.data : host_wr_i.data;

  if (Banks) begin : gen_banks
    enc_ram_pair #(.AddrW(5)) u_host (
      .wr_clk_i  (clk_i),
      .wr_en_i   (wr_en),
      .wr_side_i (wr_addr[5]),
      .wr_addr_i (wr_addr[4:0]),
      .wr_data_i (wr_data),
      .rd_clk_i,
      .rd_en_i   (rd_i.en),
      .rd_addr_i (rd_i.addr[4:0]),
      .rd_data_o
    );
  end else begin : gen_no_banks
    enc_ram #(.Width(8), .AddrW(6)) u_host (
      .wr_clk_i  (clk_i),
      .wr_en_i   (wr_en),
      .wr_addr_i (wr_addr),
      .wr_data_i (wr_data),
      .rd_clk_i,
      .rd_en_i   (rd_i.en),
      .rd_addr_i (rd_i.addr),
      .rd_data_o (rd_data_o[7:0])
    );
    assign rd_data_o[15:8] = 8'h00;
  end

  enc_ram #(.Width(8), .AddrW(6)) u_engine (
    .wr_clk_i  (clk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i (wr_addr),
    .wr_data_i (wr_data),
    .rd_clk_i  (clk_i),
    .rd_en_i   (eng_rd_i.en),
    .rd_addr_i (eng_rd_i.addr),
    .rd_data_o (eng_data_o)
  );

  if (Port2) begin : gen_port2
    enc_ram_pair #(.AddrW(5)) u_ram (
      .wr_clk_i  (clk_i),
      .wr_en_i   (wr_en),
      .wr_side_i (wr_addr[5]),
      .wr_addr_i (wr_addr[4:0]),
      .wr_data_i (wr_data),
      .rd_clk_i  (rd2_clk_i),
      .rd_en_i   (rd2_i.en),
      .rd_addr_i (rd2_i.addr[4:0]),
      .rd_data_o (rd2_data_o)
    );
  end else begin : gen_no_port2
    assign rd2_data_o = '0;
  end

  assign unused = ^{rd_i, rd2_clk_i, rd2_i};

endmodule
