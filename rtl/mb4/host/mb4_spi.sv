// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SPI host interface: connects the pins with the host byte bus.
//
// Clock domain: SCLK. mb4_spi_shift and mb4_spi_cmd describe timing and misuse.
// Reset: after a reset the first falling edge of NCS opens the interface. An SPI frame that runs
// while NRES rises is ignored.
// Datasheet: pages 11, 17..19.

module mb4_spi #(
  parameter bit         ReadOnly   = 1'b0,                       // only opcodes 0x03 and 0x09
  parameter logic [7:0] Registers0 = mb4_regs_pkg::ADDR_SCDATA   // first address of 0x09 and 0x0B
) (
  input  logic       rst_ni,
  // pins
  input  logic       sclk_i,
  input  logic       cs_ni,
  input  logic       mosi_i,
  output logic       miso_o,
  output logic       miso_oe_o,  // 0 = high impedance
  // host byte bus, sampled at the rising edge of sclk_i
  output mb4_pkg::host_t host_o,
  input  logic [7:0] rd_data_i   // valid after that edge, until the next read
);

  logic       frame_rst_n;
  logic       byte_valid;
  logic [7:0] rx_byte;
  logic       tx_en;
  logic       open_q;  // an SPI frame has begun since the reset

  always_ff @(negedge cs_ni or negedge rst_ni) begin
    if (!rst_ni) open_q <= 1'b0;
    else         open_q <= 1'b1;
  end

  assign frame_rst_n = open_q && !cs_ni;

  mb4_spi_shift u_shift (
    .sclk_i,
    .frame_rst_ni (frame_rst_n),
    .mosi_i,
    .miso_o,
    .byte_valid_o (byte_valid),
    .byte_o       (rx_byte),
    .tx_en_i      (tx_en),
    .tx_byte_i    (rd_data_i)
  );

  mb4_spi_cmd #(.ReadOnly(ReadOnly), .Registers0(Registers0)) u_cmd (
    .sclk_i,
    .frame_rst_ni (frame_rst_n),
    .byte_valid_i (byte_valid),
    .byte_i       (rx_byte),
    .tx_en_o      (tx_en),
    .host_o
  );

  assign miso_oe_o = !cs_ni;

endmodule
