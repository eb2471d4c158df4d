// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Brings the received bytes and words of both lines to the two halves of the data memory:
// SCDATA1..4 (lo) and SCDATA5..8 (hi). With SLAVELOC5 = 1 line 2 owns the upper half, otherwise
// line 1 fills both halves. The line delay that INIT measures goes to byte 0 of the half of its
// line, into the bank that the host reads (decision 16).
//
// Clock domain: core; combinational.
// Datasheet: pages 23, 26, 32, 33, Tables 10, 20.

module mb4_rx_router (
  input  logic       slaveloc5_i,
  input  logic       host_bank_i,
  input  logic       eng_bank_i,
  // line 1
  input  logic [2:0] ch1_slave_i,
  input  logic       ch1_wr_en_i,
  input  logic [2:0] ch1_wr_byte_i,
  input  logic [7:0] ch1_wr_data_i,
  input  logic       ch1_delay_en_i,
  input  logic [7:0] ch1_delay_i,
  // line 2
  input  logic [2:0] ch2_slave_i,
  input  logic       ch2_wr_en_i,
  input  logic [2:0] ch2_wr_byte_i,
  input  logic [7:0] ch2_wr_data_i,
  input  logic       ch2_delay_en_i,
  input  logic [7:0] ch2_delay_i,
  // memories: the address is {bank, data channel within the half, byte}
  output logic       lo_wr_en_o,
  output logic [5:0] lo_wr_addr_o,
  output logic [7:0] lo_wr_data_o,
  output logic       hi_wr_en_o,
  output logic [5:0] hi_wr_addr_o,
  output logic [7:0] hi_wr_data_o
);

  always_comb begin
    lo_wr_en_o   = ch1_wr_en_i && !ch1_slave_i[2];
    lo_wr_addr_o = {eng_bank_i, ch1_slave_i[1:0], ch1_wr_byte_i};
    lo_wr_data_o = ch1_wr_data_i;
    if (ch1_delay_en_i) begin
      lo_wr_en_o   = 1'b1;
      lo_wr_addr_o = {host_bank_i, 5'd0};
      lo_wr_data_o = ch1_delay_i;
    end
  end

  always_comb begin
    hi_wr_en_o   = ch1_wr_en_i && ch1_slave_i[2];
    hi_wr_addr_o = {eng_bank_i, ch1_slave_i[1:0], ch1_wr_byte_i};
    hi_wr_data_o = ch1_wr_data_i;
    if (ch2_delay_en_i) begin
      hi_wr_en_o   = 1'b1;
      hi_wr_addr_o = {host_bank_i, 5'd0};
      hi_wr_data_o = ch2_delay_i;
    end else if (slaveloc5_i) begin
      hi_wr_en_o   = ch2_wr_en_i && ch2_slave_i[2];
      hi_wr_addr_o = {eng_bank_i, ch2_slave_i[1:0], ch2_wr_byte_i};
      hi_wr_data_o = ch2_wr_data_i;
    end
  end

endmodule
