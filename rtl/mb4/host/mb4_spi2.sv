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
  output mb4_pkg::mem_rd_t read_o,
  input  logic [7:0] rd_data_i   // valid after that edge, until the next read
);

  // Data of slave 5.
  localparam logic [7:0] FIRST = mb4_regs_pkg::ADDR_SCDATA + mb4_regs_pkg::SCDATA_STRIDE * 8'd4;

  mb4_pkg::host_t host;
  logic       inside_q;          // the last read was within 0x20..0x3F

  mb4_spi #(.ReadOnly(1'b1), .Registers0(FIRST)) u_spi (
    .rst_ni,
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o,
    .miso_oe_o,
    .host_o    (host),
    .rd_data_i (inside_q ? rd_data_i : 8'h00)
  );

  always_ff @(posedge sclk_i or negedge rst_ni) begin
    if (!rst_ni)         inside_q <= 1'b0;
    else if (host.rd_en) inside_q <= host.rd_addr[7:5] == FIRST[7:5];
  end

  assign read_o.en   = host.rd_en;
  assign read_o.addr = host.rd_addr[5:0];

  // A read-only interface does not use the write signals.
  logic unused;
  assign unused = ^host;

endmodule
