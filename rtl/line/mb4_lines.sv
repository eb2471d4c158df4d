// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Both lines and the time base that they share: one frame start, and the same phase of MA on both.
//
// Clock domain: core. Latency, misuse and datasheet sections: mb4_timebase and mb4_channel.
// Reset: por_ni is asserted together with rst_ni at power-on. With rst_ni alone, an MA that is low
// stays low to the end of its half period.
// Vectors: bit i of a vector {2, 1} is for line i + 1; wider fields are slices.

module mb4_lines #(
  parameter logic [1:0] SlCells = mb4_pkg::SL_FLOPS
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,
  // configuration
  input  logic [7:0] half_len_i,
  input  logic [3:0] protocol_i,
  input  logic       en_mo_i,
  input  logic [7:0] mo_busy_i,
  input  logic [1:0] bus_i,
  // control
  input  logic       start_i,
  input  logic [1:0] use_i,
  input  logic       init_i,
  input  logic       mo_return_i,
  input  logic [1:0] cdm0_i,
  input  logic [1:0] cdm1_i,
  input  logic       reduced_i,
  input  logic       hold_cdm_i,
  input  logic       abort_i,
  input  logic       time_i,         // the time base runs between frames too
  output logic       tick_o,
  // BiSS B register access; MA force bits
  input  logic       register_i,     // with start_i
  input  logic       register_ma_i,
  input  logic       register_end_i,
  input  logic [1:0] register_mo_i,
  input  logic [1:0] force_i,
  input  logic [1:0] force_level_i,
  input  logic       force_change_i,
  // words on SL
  input  logic [1:0]  len_valid_i,
  input  logic [13:0] len_i,
  input  logic [1:0]  rx_any_i,
  input  logic [1:0]  rx_last_i,
  input  logic [2*mb4_pkg::WORD_CFG_W-1:0] rx_word_i,
  output logic [1:0]  rx_next_o,
  // words on MO
  input  logic [1:0]  mo_any_i,
  input  logic [1:0]  mo_last_i,
  input  logic [5:0]  mo_slave_i,
  input  logic [2*mb4_pkg::WORD_CFG_W-1:0] mo_word_i,
  output logic [1:0]  mo_next_o,
  output logic [11:0] mo_addr_o,
  input  logic [15:0] mo_data_i,
  // received bytes and words
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

  logic half_next;
  logic smp_a;
  logic smp_b;
  logic smp_half;
  logic smp_b_neg;

  logic idle;
  logic time_q;

  assign idle = idle_o == 2'b11;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) time_q <= 1'b0;
    else         time_q <= time_i;
  end

  // The time base also runs between frames, for forced levels, which last whole half periods, and
  // for time limits. It restarts when they begin. Only por_ni resets it, so that after a reset a
  // low level of MA ends at its normal time.
  mb4_timebase u_timebase (
    .clk_i,
    .rst_ni      (por_ni),
    .half_len_i,
    .run_i       (!idle || time_i || force_i != 2'b00),
    .restart_i   (start_i || (idle && force_i == 2'b00 && (force_change_i || (time_i && !time_q)))),
    .tick_o,
    .half_next_o (half_next),
    .smp_a_o     (smp_a),
    .smp_b_o     (smp_b),
    .smp_half_o  (smp_half),
    .smp_b_neg_o (smp_b_neg)
  );

  for (genvar i = 0; i < 2; i++) begin : gen_line
    mb4_channel #(.SlCells(SlCells)) u_channel (
      .clk_i,
      .rst_ni,
      .por_ni,
      .protocol_i    (protocol_i[i*2 +: 2]),
      .en_mo_i,
      .mo_busy_i,
      .bus_i        (bus_i[i]),
      .start_i,
      .use_i        (use_i[i]),
      .init_i,
      .mo_return_i,
      .cdm0_i       (cdm0_i[i]),
      .cdm1_i       (cdm1_i[i]),
      .reduced_i,
      .hold_cdm_i,
      .abort_i,
      .register_i,
      .register_ma_i,
      .register_end_i,
      .register_mo_i (register_mo_i[i]),
      .force_i       (force_i[i]),
      .force_level_i (force_level_i[i]),
      .tick_i       (tick_o),
      .half_next_i  (half_next),
      .smp_a_i      (smp_a),
      .smp_b_i      (smp_b),
      .smp_half_i   (smp_half),
      .smp_b_neg_i  (smp_b_neg),
      .len_valid_i  (len_valid_i[i]),
      .len_i        (len_i[i*7 +: 7]),
      .rx_any_i     (rx_any_i[i]),
      .rx_last_i    (rx_last_i[i]),
      .rx_word_i    (rx_word_i[i*WORD_W +: WORD_W]),
      .rx_next_o    (rx_next_o[i]),
      .mo_any_i     (mo_any_i[i]),
      .mo_last_i    (mo_last_i[i]),
      .mo_slave_i   (mo_slave_i[i*3 +: 3]),
      .mo_word_i    (mo_word_i[i*WORD_W +: WORD_W]),
      .mo_next_o    (mo_next_o[i]),
      .mo_addr_o    (mo_addr_o[i*6 +: 6]),
      .mo_data_i    (mo_data_i[i*8 +: 8]),
      .wr_en_o      (wr_en_o[i]),
      .wr_byte_o    (wr_byte_o[i*3 +: 3]),
      .wr_data_o    (wr_data_o[i*8 +: 8]),
      .word_begin_o (word_begin_o[i]),
      .word_open_o  (word_open_o[i]),
      .word_done_o  (word_done_o[i]),
      .word_ok_o    (word_ok_o[i]),
      .cds_o        (cds_o[i]),
      .cdm_o        (cdm_o[i]),
      .frame_end_o  (frame_end_o[i]),
      .init_done_o  (init_done_o[i]),
      .init_fail_o  (init_fail_o[i]),
      .quarters_o   (quarters_o[i*8 +: 8]),
      .idle_o       (idle_o[i]),
      .timeout_o    (timeout_o[i]),
      .sl_o         (sl_o[i]),
      .ma_o         (ma_o[i]),
      .mo_o         (mo_o[i]),
      .sl_i         (sl_i[i])
    );
  end

endmodule
