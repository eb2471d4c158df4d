// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Sensor data of all eight data channels with their validity flags. The lower half holds
// SCDATA1..4, the upper half SCDATA5..8; each half has two banks. The file connects the halves and
// decodes addresses; it has no flops of its own.
//
// Clock domains: core; rclk_i for the reads of the host; rd2_clk_i for the second read port
// (SCDATA5..8, only with Port2).
// Latency: read data are valid after the edge with the enable. A read gives the bytes and flags of
// both banks, bank 1 above bank 0.
// Vectors: bit i of a vector {2, 1} is for line i + 1. Host writes and clears act on the bank that
// the host had at the write; it comes with them (mb4_reg_file).
// Datasheet: pages 26, 35, Tables 20, 61.

module mb4_scd_store #(
  parameter bit Port2 = 1'b0
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       slaveloc5_i,
  input  logic       host_bank_i,
  input  logic       eng_bank_i,
  // clearing after reset
  input  logic       clear_i,
  input  logic [5:0] clear_addr_i,
  // host, posted into the core domain: {kind, bank, address, data} as in mb4_reg_file
  input  logic       post_valid_i,
  input  logic [15:0] post_i,
  output logic       post_ready_o,    // also 1 if the byte is not for this module
  // host read port
  input  logic        rclk_i,
  input  logic        rd_en_i,
  input  logic [4:0]  rd_addr_i,
  output logic [15:0] rd_lo_data_o,
  output logic [15:0] rd_hi_data_o,
  output logic [15:0] svalid_o,
  // second host read port
  input  logic        rd2_clk_i,
  input  logic        rd2_en_i,
  input  logic [4:0]  rd2_addr_i,
  output logic [15:0] rd2_data_o,
  // actuator data for MO of lines {2, 1}: address is {data channel, byte}; data one clock later
  input  logic        mo_rd_en_i,
  input  logic [11:0] mo_addr_i,
  output logic [15:0] mo_data_o,
  // received bytes and words of lines {2, 1}
  input  logic [1:0]  wr_line_i,
  input  logic [5:0]  wr_byte_i,
  input  logic [15:0] wr_line_data_i,
  input  logic [5:0]  slave_i,
  input  logic [1:0]  word_begin_i,
  input  logic [1:0]  word_done_i,
  input  logic [1:0]  word_ok_i,
  input  logic [1:0]  word_split_i,
  input  logic        svalid_clear_i,  // INIT of BiSS C begins
  input  logic [1:0]  delay_en_i,
  input  logic [15:0] delay_i
);

  logic       post_lo, post_hi, post_svalid_lo, post_svalid_hi;
  logic [3:0] keep;
  logic       ready_lo, ready_hi;
  logic       lo_wr_en, hi_wr_en;
  logic [5:0] lo_wr_addr, hi_wr_addr;
  logic [7:0] lo_wr_data, hi_wr_data;
  logic [4:0] hi_mo_addr;
  logic [7:0] lo_mo_data, hi_mo_data;
  logic [7:0] svalid_lo, svalid_hi;
  logic [15:0] rd2_lo_data;

  assign post_lo        = post_valid_i && !post_i[15] && !post_i[13];
  assign post_hi        = post_valid_i && !post_i[15] && post_i[13];
  assign post_svalid_lo = post_valid_i && post_i[15:14] == 2'b11 && post_i[8];
  assign post_svalid_hi = post_valid_i && post_i[15:14] == 2'b11 && post_i[9];
  assign post_ready_o   = (ready_lo || !post_lo) && (ready_hi || !post_hi);

  for (genvar i = 0; i < 4; i++) begin : gen_keep
    assign keep[i] = post_i[mb4_regs_pkg::SVALID_LSB + mb4_regs_pkg::SVALID_LSB_STEP * i];
  end

  mb4_rx_router u_router (
    .slaveloc5_i,
    .host_bank_i,
    .eng_bank_i,
    .ch1_slave_i    (slave_i[2:0]),
    .ch1_wr_en_i    (wr_line_i[0]),
    .ch1_wr_byte_i  (wr_byte_i[2:0]),
    .ch1_wr_data_i  (wr_line_data_i[7:0]),
    .ch1_delay_en_i (delay_en_i[0]),
    .ch1_delay_i    (delay_i[7:0]),
    .ch2_slave_i    (slave_i[5:3]),
    .ch2_wr_en_i    (wr_line_i[1]),
    .ch2_wr_byte_i  (wr_byte_i[5:3]),
    .ch2_wr_data_i  (wr_line_data_i[15:8]),
    .ch2_delay_en_i (delay_en_i[1]),
    .ch2_delay_i    (delay_i[15:8]),
    .lo_wr_en_o     (lo_wr_en),
    .lo_wr_addr_o   (lo_wr_addr),
    .lo_wr_data_o   (lo_wr_data),
    .hi_wr_en_o     (hi_wr_en),
    .hi_wr_addr_o   (hi_wr_addr),
    .hi_wr_data_o   (hi_wr_data)
  );

  mb4_scd_bank u_scd_lo (
    .clk_i,
    .clear_i,
    .clear_addr_i,
    .eng_wr_en_i    (lo_wr_en),
    .eng_wr_addr_i  (lo_wr_addr),
    .eng_wr_data_i  (lo_wr_data),
    .eng_rd_en_i    (mo_rd_en_i),
    .eng_rd_addr_i  ({eng_bank_i, mo_addr_i[4:0]}),
    .eng_rd_data_o  (lo_mo_data),
    .host_wr_en_i   (post_lo),
    .host_wr_addr_i ({post_i[14], post_i[12:8]}),
    .host_wr_data_i (post_i[7:0]),
    .host_ready_o   (ready_lo),
    .rclk_i,
    .rd_en_i,
    .rd_addr_i,
    .rd_data_o      (rd_lo_data_o),
    .rd2_clk_i      (1'b0),
    .rd2_en_i       (1'b0),
    .rd2_addr_i     ('0),
    .rd2_data_o     (rd2_lo_data)
  );

  mb4_scd_bank #(.Port2(Port2)) u_scd_hi (
    .clk_i,
    .clear_i,
    .clear_addr_i,
    .eng_wr_en_i    (hi_wr_en),
    .eng_wr_addr_i  (hi_wr_addr),
    .eng_wr_data_i  (hi_wr_data),
    .eng_rd_en_i    (mo_rd_en_i),
    .eng_rd_addr_i  ({eng_bank_i, hi_mo_addr}),
    .eng_rd_data_o  (hi_mo_data),
    .host_wr_en_i   (post_hi),
    .host_wr_addr_i ({post_i[14], post_i[12:8]}),
    .host_wr_data_i (post_i[7:0]),
    .host_ready_o   (ready_hi),
    .rclk_i,
    .rd_en_i,
    .rd_addr_i,
    .rd_data_o      (rd_hi_data_o),
    .rd2_clk_i,
    .rd2_en_i,
    .rd2_addr_i,
    .rd2_data_o
  );

  // One line at a time uses the upper half: line 2 if its word is there, else line 1.
  assign hi_mo_addr = mo_addr_i[11] ? mo_addr_i[10:6] : mo_addr_i[4:0];
  assign mo_data_o  = {hi_mo_data, mo_addr_i[5] ? hi_mo_data : lo_mo_data};

  // Validity flags of the lower and the upper four data channels.
  mb4_svalid u_svalid_lo (
    .clk_i,
    .rst_ni,
    .eng_bank_i,
    .begin_i     (word_begin_i[0] && !slave_i[2]),
    .set_en_i    (word_done_i[0] && !slave_i[2]),
    .set_slave_i (slave_i[1:0]),
    .set_valid_i (word_ok_i[0]),
    .split_i     (word_split_i[0] && !slave_i[2]),
    .clear_i     (svalid_clear_i),
    .keep_en_i   (post_svalid_lo),
    .keep_i      (keep),
    .keep_bank_i (post_i[13]),
    .svalid_o    (svalid_lo)
  );

  mb4_svalid u_svalid_hi (
    .clk_i,
    .rst_ni,
    .eng_bank_i,
    .begin_i     (slaveloc5_i ? word_begin_i[1] && slave_i[5] : word_begin_i[0] && slave_i[2]),
    .set_en_i    (slaveloc5_i ? word_done_i[1] && slave_i[5] : word_done_i[0] && slave_i[2]),
    .set_slave_i (slaveloc5_i ? slave_i[4:3] : slave_i[1:0]),
    .set_valid_i (slaveloc5_i ? word_ok_i[1] : word_ok_i[0]),
    .split_i     (slaveloc5_i ? word_split_i[1] && slave_i[5] : word_split_i[0] && slave_i[2]),
    .clear_i     (svalid_clear_i),
    .keep_en_i   (post_svalid_hi),
    .keep_i      (keep),
    .keep_bank_i (post_i[13]),
    .svalid_o    (svalid_hi)
  );

  assign svalid_o = {svalid_hi[7:4], svalid_lo[7:4], svalid_hi[3:0], svalid_lo[3:0]};

  // The lower half has no second read port.
  logic unused;
  assign unused = ^rd2_lo_data;

endmodule
