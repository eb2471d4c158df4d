// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Both lines with their word lists: takes what the lines need from the configuration and binds it
// to them.
//
// Clock domain: core. Timing and misuse: mb4_words and mb4_lines.
// Vectors: bit i of a vector {2, 1} is for line i + 1; wider fields are slices. slave_o is the data
// channel whose word is on SL.
// Datasheet: pages 15, 16, 23..26.

module mb4_channels #(
  parameter logic [1:0] SlCells = mb4_pkg::SL_FLOPS
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        por_ni,
  // configuration
  input  logic [7:0]  enscd_i,
  output logic [3:0]  cfg_en_o,    // lists {MO 2, MO 1, SL 2, SL 1}
  output logic [11:0] cfg_slave_o,
  input  logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_i,
  input  mb4_pkg::cfg_t cfg_i,
  input  logic [7:0]  half_len_i,
  input  logic [1:0]  ssi_i,
  // control
  input  logic        start_i,
  input  logic [1:0]  use_i,
  input  logic        init_i,
  input  logic        mo_return_i,
  input  logic        register_i,
  input  logic        register_ma_i,
  input  logic        register_end_i,
  input  logic [1:0]  register_mo_i,
  input  logic [1:0]  force_i,
  input  logic [1:0]  force_level_i,
  input  logic        force_change_i,
  input  logic [1:0]  cdm0_i,
  input  logic [1:0]  cdm1_i,
  input  logic        reduced_i,
  input  logic        abort_i,
  input  logic        time_i,
  output logic        tick_o,
  // data memories
  output logic [5:0]  slave_o,
  output logic [11:0] mo_addr_o,
  input  logic [15:0] mo_data_i,
  output logic [1:0]  wr_en_o,
  output logic [5:0]  wr_byte_o,
  output logic [15:0] wr_data_o,
  output logic [1:0]  word_begin_o,
  output logic [1:0]  word_open_o,
  output logic [1:0]  word_done_o,
  output logic [1:0]  word_ok_o,
  // results
  output logic [1:0]  cds_o,
  output logic [1:0]  cdm_o,
  output logic [1:0]  frame_end_o,
  output logic [1:0]  init_done_o,
  output logic [1:0]  init_fail_o,
  output logic [15:0] quarters_o,
  output logic [1:0]  idle_o,
  output logic [1:0]  timeout_o,
  output logic [1:0]  sl_o,
  // pins
  output logic [1:0]  ma_o,
  output logic [1:0]  mo_o,
  input  logic [1:0]  sl_i
);

  localparam int unsigned WORD_W = mb4_pkg::WORD_CFG_W;

  logic [1:0]          len_valid, actuator;
  logic [13:0]         len;
  logic [1:0]          rx_any, rx_last, rx_next, mo_any, mo_last, mo_next;
  logic [5:0]          mo_slave;
  logic [2*WORD_W-1:0] rx_word, mo_word;

  mb4_words u_words (
    .clk_i,
    .rst_ni,
    .enscd_i,
    .cfg_en_o,
    .cfg_slave_o,
    .slave_cfg_i,
    .actnsens_i  (cfg_i.actnsens),
    .slaveloc5_i (cfg_i.slaveloc5),
    .nocrc_i     (cfg_i.nocrc),
    .ssi_i,
    .start_i,
    .actuator_o  (actuator),
    .len_valid_o (len_valid),
    .len_o       (len),
    .rx_next_i   (rx_next),
    .rx_any_o    (rx_any),
    .rx_last_o   (rx_last),
    .rx_slave_o  (slave_o),
    .rx_word_o   (rx_word),
    .mo_next_i   (mo_next),
    .mo_any_o    (mo_any),
    .mo_last_o   (mo_last),
    .mo_slave_o  (mo_slave),
    .mo_word_o   (mo_word)
  );

  mb4_lines #(.SlCells(SlCells)) u_lines (
    .clk_i,
    .rst_ni,
    .por_ni,
    .half_len_i,
    .protocol_i   ({cfg_i.cfgch2 | {2{!cfg_i.slaveloc5}}, cfg_i.cfgch1}),
    .en_mo_i      (cfg_i.en_mo),
    .mo_busy_i    (cfg_i.mo_busy),
    .bus_i        (actuator & {2{cfg_i.en_mo}}),
    .start_i,
    .use_i,
    .init_i,
    .mo_return_i,
    .register_i,
    .register_ma_i,
    .register_end_i,
    .register_mo_i,
    .force_i,
    .force_level_i,
    .force_change_i,
    .cdm0_i,
    .cdm1_i,
    .reduced_i,
    .hold_cdm_i   (cfg_i.holdcdm),
    .abort_i,
    .time_i,
    .tick_o,
    .len_valid_i  (len_valid),
    .len_i        (len),
    .rx_any_i     (rx_any),
    .rx_last_i    (rx_last),
    .rx_word_i    (rx_word),
    .rx_next_o    (rx_next),
    .mo_any_i     (mo_any),
    .mo_last_i    (mo_last),
    .mo_slave_i   (mo_slave),
    .mo_word_i    (mo_word),
    .mo_next_o    (mo_next),
    .mo_addr_o,
    .mo_data_i,
    .wr_en_o,
    .wr_byte_o,
    .wr_data_o,
    .word_begin_o,
    .word_open_o,
    .word_done_o,
    .word_ok_o,
    .cds_o,
    .cdm_o,
    .frame_end_o,
    .init_done_o,
    .init_fail_o,
    .quarters_o,
    .idle_o,
    .timeout_o,
    .sl_o,
    .ma_o,
    .mo_o,
    .sl_i
  );

endmodule
