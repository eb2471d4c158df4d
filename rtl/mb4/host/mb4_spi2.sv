// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Second serial interface (SPI2). It reads SCDATA5..8 (0x20..0x3F) beside the first interface and
// does nothing else.
//
// Clock domain: its own SCLK. It knows the opcodes 0x03 and 0x09 (from 0x20); it ignores all others
// until NCS rises. mb4_spi contains the shifter, the address counter and the timing.
// Misuse: other addresses read 0.
// Datasheet: page 19, Tables 4, 5.

module mb4_spi2 (
  input  logic       rst_ni,
  // pins
  input  logic       sclk_i,
  input  logic       cs_ni,
  input  logic       mosi_i,
  output logic       miso_o,
  output logic       miso_oe_o,  // 0 = high impedance
  // read port, sampled at the rising edge of sclk_i
  output logic       rd_en_o,
  output logic [4:0] rd_addr_o,
  input  logic [7:0] rd_data_i   // valid after that edge, until the next read
);

  // Data of slave 5.
  localparam logic [7:0] FIRST = mb4_regs_pkg::ADDR_SCDATA + mb4_regs_pkg::SCDATA_STRIDE * 8'd4;

  logic       rd_en;
  logic [7:0] rd_addr;
  logic       inside_q;          // the last read was within 0x20..0x3F
  logic       wr_en;
  logic [7:0] wr_addr, wr_data;

  mb4_spi #(.ReadOnly(1'b1), .Registers0(FIRST)) u_spi (
    .rst_ni,
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o,
    .miso_oe_o,
    .wr_en_o   (wr_en),
    .wr_addr_o (wr_addr),
    .wr_data_o (wr_data),
    .rd_en_o   (rd_en),
    .rd_addr_o (rd_addr),
    .rd_data_i (inside_q ? rd_data_i : 8'h00)
  );

  always_ff @(posedge sclk_i or negedge rst_ni) begin
    if (!rst_ni)    inside_q <= 1'b0;
    else if (rd_en) inside_q <= rd_addr[7:5] == FIRST[7:5];
  end

  assign rd_en_o   = rd_en;
  assign rd_addr_o = rd_addr[4:0];

  // A read-only interface does not use the write signals.
  logic unused;
  assign unused = ^{wr_en, wr_addr, wr_data};

endmodule
