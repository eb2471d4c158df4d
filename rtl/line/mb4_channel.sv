// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One physical channel: frame engine, sampler and word assembly (instances only).
//
// Clock domain: core. See mb4_frame_biss, mb4_sl_sampler and mb4_rx_word.

module mb4_channel (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,
  // control
  input  logic       start_i,
  input  logic       use_i,
  input  logic       init_i,
  input  logic       cdm0_i,
  input  logic       cdm1_i,
  input  logic       reduced_i,
  input  logic       hold_cdm_i,
  input  logic       abort_i,
  // time base
  input  logic       tick_i,
  input  logic       half_next_i,
  input  logic       smp_a_i,
  input  logic       smp_b_i,
  input  logic       smp_half_i,
  input  logic       smp_b_neg_i,
  // words
  input  logic       len_valid_i,
  input  logic [6:0] len_i,
  input  logic       any_word_i,
  input  logic       last_word_i,
  input  mb4_pkg::word_cfg_t word_i,
  // received bytes and words
  output logic       wr_en_o,
  output logic [2:0] wr_byte_o,
  output logic [7:0] wr_data_o,
  output logic       word_begin_o,
  output logic       word_done_o,
  output logic       word_ok_o,
  // results
  output logic       cds_o,
  output logic       cdm_o,
  output logic       frame_end_o,
  output logic       init_done_o,
  output logic       init_fail_o,
  output logic [7:0] quarters_o,
  output logic       idle_o,
  output logic       timeout_o,
  output logic       sl_o,
  // pins
  output logic       ma_o,
  input  logic       sl_i
);

  logic armed_a;
  logic armed_b;
  logic ack;
  logic bit_valid;
  logic sl_bit;
  logic word_bit;

  mb4_frame_biss u_frame (
    .clk_i,
    .rst_ni,
    .por_ni,
    .start_i,
    .use_i,
    .init_i,
    .cdm0_i,
    .cdm1_i,
    .reduced_i,
    .hold_cdm_i,
    .abort_i,
    .tick_i,
    .half_next_i,
    .armed_a_o   (armed_a),
    .armed_b_o   (armed_b),
    .ack_i       (ack),
    .quarters_i  (quarters_o),
    .sl_i        (sl_o),
    .bit_valid_i (bit_valid),
    .bit_i       (sl_bit),
    .len_valid_i,
    .len_i,
    .any_word_i,
    .last_word_i,
    .word_done_i (word_done_o),
    .word_load_o (word_begin_o),
    .word_bit_o  (word_bit),
    .cds_o,
    .cdm_o,
    .frame_end_o,
    .init_done_o,
    .init_fail_o,
    .idle_o,
    .timeout_o,
    .ma_o
  );

  mb4_sl_sampler u_sampler (
    .clk_i,
    .rst_ni,
    .sl_i,
    .smp_a_i,
    .smp_b_i,
    .smp_half_i,
    .smp_b_neg_i,
    .clear_i     (start_i),
    .armed_a_i   (armed_a),
    .armed_b_i   (armed_b),
    .sl_o,
    .ack_o       (ack),
    .quarters_o,
    .bit_valid_o (bit_valid),
    .bit_o       (sl_bit)
  );

  mb4_rx_word u_word (
    .clk_i,
    .rst_ni,
    .word_i,
    .load_i      (word_begin_o),
    .bit_valid_i (word_bit),
    .bit_i       (sl_bit),
    .wr_en_o,
    .wr_byte_o,
    .wr_data_o,
    .done_o      (word_done_o),
    .ok_o        (word_ok_o)
  );

endmodule
