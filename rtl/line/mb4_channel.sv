// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One line: frame engine, sampler, word assembly and MO.
//
// Clock domain: core. Latency, misuse and datasheet sections: mb4_frame, mb4_sl_sampler,
// mb4_rx_word and mb4_mo_tx.
//
// word_begin_o (first bit), word_open_o (bits have come, more follow) and word_done_o (last bit)
// tell only of the words of sensors. rx_next_o tells of every word that has ended.

module mb4_channel #(
  parameter logic [1:0] SlCells = mb4_pkg::SL_FLOPS
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,
  // configuration
  input  logic [1:0] protocol_i,
  input  logic       en_mo_i,
  input  logic [7:0] mo_busy_i,
  input  logic       bus_i,        // MO has words for actuators
  // control
  input  logic       start_i,
  input  logic       use_i,
  input  logic       init_i,
  input  logic       mo_return_i,
  input  logic       cdm0_i,
  input  logic       cdm1_i,
  input  logic       reduced_i,
  input  logic       hold_cdm_i,
  input  logic       abort_i,
  input  logic       register_i,
  input  logic       register_ma_i,
  input  logic       register_end_i,
  input  logic       register_mo_i,
  input  logic       force_i,
  input  logic       force_level_i,
  // time base
  input  logic       tick_i,
  input  logic       half_next_i,
  input  logic       smp_a_i,
  input  logic       smp_b_i,
  input  logic       smp_half_i,
  input  logic       smp_b_neg_i,
  // words on SL
  input  logic       len_valid_i,
  input  logic [6:0] len_i,
  input  logic       rx_any_i,
  input  logic       rx_last_i,
  input  mb4_pkg::word_cfg_t rx_word_i,
  output logic       rx_next_o,
  // words on MO
  input  logic       mo_any_i,
  input  logic       mo_last_i,
  input  logic [2:0] mo_slave_i,
  input  mb4_pkg::word_cfg_t mo_word_i,
  output logic       mo_next_o,
  output logic [5:0] mo_addr_o,
  input  logic [7:0] mo_data_i,
  // received bytes and words
  output logic       wr_en_o,
  output logic [2:0] wr_byte_o,
  output logic [7:0] wr_data_o,
  output logic       word_begin_o,
  output logic       word_open_o,
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
  output logic       mo_o,
  input  logic       sl_i
);

  logic armed_a;
  logic armed_b;
  logic ack;
  logic bit_valid;
  logic sl_bit;
  logic word_bit;
  logic word_load;
  logic word_begin;
  logic word_open;
  logic word_run;
  logic rise;
  logic final_rise;
  logic ma_clocks;
  logic biss_c;
  logic ssi;

  mb4_frame u_frame (
    .clk_i,
    .rst_ni,
    .por_ni,
    .protocol_i,
    .bus_i,
    .mo_busy_i,
    .start_i,
    .use_i,
    .init_i,
    .cdm0_i,
    .cdm1_i,
    .reduced_i,
    .hold_cdm_i,
    .abort_i,
    .register_i,
    .register_ma_i,
    .register_end_i,
    .force_i,
    .force_level_i,
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
    .any_word_i  (rx_any_i),
    .last_word_i (rx_last_i),
    .word_done_i (rx_next_o),
    .word_load_o (word_load),
    .word_bit_o  (word_bit),
    .word_run_o  (word_run),
    .biss_c_o    (biss_c),
    .ssi_o       (ssi),
    .rise_o      (rise),
    .final_o     (final_rise),
    .clocks_o    (ma_clocks),
    .cds_o,
    .cdm_o,
    .frame_end_o,
    .init_done_o,
    .init_fail_o,
    .idle_o,
    .timeout_o,
    .ma_o
  );

  mb4_sl_sampler #(.SlCells(SlCells)) u_sampler (
    .clk_i,
    .rst_ni,
    .sl_i,
    .smp_a_i,
    .smp_b_i,
    .smp_half_i,
    .smp_b_neg_i,
    .clear_i     (start_i),
    .ssi_i       (ssi),
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
    .word_i      (rx_word_i),
    .run_i       (word_run),
    .load_i      (word_load),
    .bit_valid_i (word_bit),
    .bit_i       (sl_bit),
    .wr_en_o,
    .wr_byte_o,
    .wr_data_o,
    .begin_o     (word_begin),
    .open_o      (word_open),
    .done_o      (rx_next_o),
    .ok_o        (word_ok_o)
  );

  assign word_begin_o = word_begin && !rx_word_i.actuator;
  assign word_open_o  = word_open && !rx_word_i.actuator;
  assign word_done_o  = rx_next_o && !rx_word_i.actuator;

  mb4_mo_tx u_mo (
    .clk_i,
    .rst_ni,
    .enable_i    (en_mo_i),
    .low_i       (register_mo_i),
    .begin_i     (start_i && use_i && !register_i && !ssi),
    .biss_c_i    (biss_c),
    .reduced_i,
    .busy_i      (mo_busy_i),
    .rise_i      (rise),
    .final_i     (final_rise),
    .clocks_i    (ma_clocks),
    .line_idle_i (idle_o),
    .return_i    (mo_return_i),
    .any_word_i  (mo_any_i),
    .last_word_i (mo_last_i),
    .slave_i     (mo_slave_i),
    .word_i      (mo_word_i),
    .next_o      (mo_next_o),
    .mem_addr_o  (mo_addr_o),
    .mem_data_i  (mo_data_i),
    .mo_o
  );

endmodule
