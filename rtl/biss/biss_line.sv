// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One line: frame engine, sampler, word assembly and MO.
//
// Clock domain: core. Latency, misuse and datasheet sections: biss_frame, biss_sl_sampler,
// biss_rx_word and biss_mo_tx.
//
// data_o tells only of the words of sensors. rx_next_o tells of every word that has ended.

module biss_line #(
  parameter logic [1:0] SlCells = biss_pkg::SL_FLOPS
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,
  // frames
  input  biss_pkg::line_cmd_t    cmd_i,
  input  biss_pkg::line_go_t     go_i,
  input  biss_pkg::line_start_t  start_i,
  input  logic                   register_ma_i,   // BiSS B register access: next level of MA
  input  logic                   register_end_i,  // ... it ends
  output logic                   idle_o,   // no frame, and the slaves' timeout has ended
  output biss_pkg::line_status_t status_o,
  output biss_pkg::line_event_t  event_o,
  output biss_pkg::line_data_t   data_o,
  // time base
  input  logic       tick_i,
  input  logic       half_next_i,
  input  logic       smp_a_i,
  input  logic       smp_b_i,
  input  logic       smp_half_i,
  input  logic       smp_b_neg_i,
  // words on SL
  output logic       ssi_o,        // the frame is SSI
  input  logic       len_valid_i,
  input  logic [6:0] len_i,
  input  biss_pkg::offer_t rx_offer_i,
  output logic       rx_next_o,
  // words on MO
  input  logic       mo_bus_i,     // MO has words for actuators
  input  biss_pkg::offer_t mo_offer_i,
  output logic       mo_next_o,
  output logic       mo_rd_en_o,
  output logic [5:0] mo_addr_o,
  input  logic [7:0] mo_data_i,
  // pins
  output logic       ma_o,
  output logic       mo_o,
  input  logic       sl_i,
  output logic       sl_o          // level at SL, synchronised
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
  logic timeout;
  logic cds;
  logic cdm;
  logic frame_end;
  logic init_done;
  logic init_fail;
  logic sensor;       // the word on SL is that of a sensor
  logic word_done;
  logic word_ok;
  logic wr_en;
  logic [2:0] wr_byte;
  logic [7:0] wr_data;
  logic [7:0] quarters;

  biss_frame u_frame (
    .clk_i,
    .rst_ni,
    .por_ni,
    .protocol_i  (cmd_i.protocol),
    .bus_i       (mo_bus_i),
    .mo_busy_i   (cmd_i.mo_busy),
    .start_i     (go_i.start),
    .use_i       (start_i.takes_part),
    .init_i      (go_i.init),
    .cdm0_i      (start_i.cdm0),
    .cdm1_i      (start_i.cdm1),
    .reduced_i   (go_i.reduced),
    .hold_cdm_i  (cmd_i.hold_cdm),
    .abort_i     (go_i.stop),
    .register_i  (go_i.register_access),
    .register_ma_i  (register_ma_i),
    .register_end_i (register_end_i),
    .force_i       (cmd_i.forced),
    .force_level_i (cmd_i.force_level),
    .tick_i,
    .half_next_i,
    .armed_a_o   (armed_a),
    .armed_b_o   (armed_b),
    .ack_i       (ack),
    .quarters_i  (quarters),
    .sl_i        (sl_o),
    .bit_valid_i (bit_valid),
    .bit_i       (sl_bit),
    .len_valid_i,
    .len_i,
    .any_word_i  (rx_offer_i.any),
    .last_word_i (rx_offer_i.last),
    .word_done_i (rx_next_o),
    .word_load_o (word_load),
    .word_bit_o  (word_bit),
    .word_run_o  (word_run),
    .biss_c_o    (biss_c),
    .ssi_o,
    .rise_o      (rise),
    .final_o     (final_rise),
    .clocks_o    (ma_clocks),
    .cds_o       (cds),
    .cdm_o       (cdm),
    .frame_end_o (frame_end),
    .init_done_o (init_done),
    .init_fail_o (init_fail),
    .idle_o,
    .timeout_o   (timeout),
    .ma_o
  );

  biss_sl_sampler #(.SlCells(SlCells)) u_sampler (
    .clk_i,
    .rst_ni,
    .sl_i,
    .smp_a_i,
    .smp_b_i,
    .smp_half_i,
    .smp_b_neg_i,
    .clear_i     (go_i.start),
    .ssi_i       (ssi_o),
    .armed_a_i   (armed_a),
    .armed_b_i   (armed_b),
    .sl_o,
    .ack_o       (ack),
    .quarters_o  (quarters),
    .bit_valid_o (bit_valid),
    .bit_o       (sl_bit)
  );

  biss_rx_word u_word (
    .clk_i,
    .rst_ni,
    .word_i      (rx_offer_i.word),
    .run_i       (word_run),
    .load_i      (word_load),
    .bit_valid_i (word_bit),
    .bit_i       (sl_bit),
    .wr_en_o     (wr_en),
    .wr_byte_o   (wr_byte),
    .wr_data_o   (wr_data),
    .begin_o     (word_begin),
    .open_o      (word_open),
    .done_o      (rx_next_o),
    .ok_o        (word_ok)
  );

  assign sensor    = !rx_offer_i.word.actuator;
  assign word_done = rx_next_o && sensor;
  assign status_o  = {timeout, cds, cdm};
  assign event_o   = {frame_end, init_done, init_fail, word_done};
  assign data_o    = {wr_en, rx_offer_i.slave, wr_byte, wr_data, word_begin && sensor,
                      word_open && sensor, word_done, word_ok, cds, init_done, quarters};

  biss_mo_tx u_mo (
    .clk_i,
    .rst_ni,
    .enable_i    (cmd_i.mo_en),
    .low_i       (cmd_i.mo_low),
    .begin_i     (go_i.start && start_i.takes_part && !go_i.register_access && !ssi_o),
    .biss_c_i    (biss_c),
    .reduced_i   (go_i.reduced),
    .busy_i      (cmd_i.mo_busy),
    .rise_i      (rise),
    .final_i     (final_rise),
    .clocks_i    (ma_clocks),
    .line_idle_i (idle_o),
    .return_i    (go_i.mo_return || go_i.stop),
    .any_word_i  (mo_offer_i.any),
    .last_word_i (mo_offer_i.last),
    .slave_i     (mo_offer_i.slave),
    .word_i      (mo_offer_i.word),
    .next_o      (mo_next_o),
    .mem_rd_en_o (mo_rd_en_o),
    .mem_addr_o  (mo_addr_o),
    .mem_data_i  (mo_data_i),
    .mo_o
  );

endmodule
