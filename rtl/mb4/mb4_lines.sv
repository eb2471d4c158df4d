// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Both lines with their word lists, and the time base that they share: one frame start, and the
// same phase of MA on both. Each line has one list for the words on SL and one for the words on MO;
// the MO list also counts the bits of the frame.
//
// Clock domain: core. Latency, misuse and datasheet sections: biss_timebase, mb4_word_list and
// biss_line. With SLAVELOC5 = 1 line 2 has the data channels 5..8, otherwise line 1 has all eight.
// Reset: por_ni is asserted together with rst_ni at power-on. With rst_ni alone, an MA that is low
// stays low to the end of its half period.
// Vectors: bit i of a vector {2, 1} is for line i + 1; wider fields are slices.
// Datasheet: pages 15, 16, 23..26, Tables 10, 17.

module mb4_lines #(
  parameter logic [1:0] SlCells = biss_pkg::SL_FLOPS
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        por_ni,
  // configuration
  input  mb4_pkg::cfg_t cfg_i,
  input  logic [7:0]  enscd_i,
  output logic [3:0]  cfg_en_o,    // lists {MO 2, MO 1, SL 2, SL 1}
  output logic [11:0] cfg_slave_o,
  input  logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_i,
  // frames
  input  logic [2*biss_pkg::LINE_CMD_W-1:0] cmd_i,
  input  biss_pkg::line_go_t go_i,
  input  logic [2*biss_pkg::LINE_START_W-1:0] start_i,
  input  logic        register_ma_i,  // BiSS B register access: next level of MA
  input  logic        register_end_i, // ... it ends
  input  logic        time_run_i,     // the time base runs between frames too
  input  logic        time_restart_i, // ... and begins a half period, if no frame runs
  output logic        tick_o,
  output logic [1:0]  idle_o,         // no frame, and the slaves' timeout has ended
  output logic [2*biss_pkg::LINE_STATUS_W-1:0] status_o,
  output logic [2*biss_pkg::LINE_EVENT_W-1:0]  event_o,
  output logic [2*biss_pkg::LINE_DATA_W-1:0]   data_o,
  // data for MO
  output logic        mo_rd_en_o,
  output logic [11:0] mo_addr_o,
  input  logic [15:0] mo_data_i,
  // pins
  output logic [1:0]  ma_o,
  output logic [1:0]  mo_o,
  input  logic [1:0]  sl_i,
  output logic [1:0]  sl_o         // synchronised
);

  localparam int unsigned CFG_W    = mb4_pkg::SLAVE_CFG_W;
  localparam int unsigned OFFER_W  = biss_pkg::OFFER_W;
  localparam int unsigned START_W  = biss_pkg::LINE_START_W;
  localparam int unsigned CMD_W    = biss_pkg::LINE_CMD_W;
  localparam int unsigned STATUS_W = biss_pkg::LINE_STATUS_W;
  localparam int unsigned EVENT_W  = biss_pkg::LINE_EVENT_W;
  localparam int unsigned DATA_W   = biss_pkg::LINE_DATA_W;

  logic [7:0]  half_len;
  logic        half_next, smp_a, smp_b, smp_half, smp_b_neg, idle;
  logic [15:0] own;             // data channels of the lines
  logic [1:0]  ssi, mo_rd_en, rx_next, mo_next, len_valid, actuator;
  logic [13:0] len;
  logic [2*OFFER_W-1:0] rx_offer, mo_offer;
  logic [1:0]  rx_actuator, rx_len_valid;
  logic [13:0] rx_len;
  logic        unused;

  assign idle = idle_o == 2'b11;
  assign mo_rd_en_o = mo_rd_en != 2'b00;
  assign own  = cfg_i.slaveloc5 ? 16'hF00F : 16'h00FF;

  mb4_freqs_dec u_freqs (
    .freqs_i    (cfg_i.freqs),
    .half_len_o (half_len)
  );

  // The time base also runs between frames, for forced levels, which last whole half periods, and
  // for time limits. It restarts when they begin. Only por_ni resets it, so that after a reset a
  // low level of MA ends at its normal time.
  biss_timebase u_timebase (
    .clk_i,
    .rst_ni      (por_ni),
    .half_len_i  (half_len),
    .run_i       (!idle || time_run_i),
    .restart_i   (go_i.start || (idle && time_restart_i)),
    .tick_o,
    .half_next_o (half_next),
    .smp_a_o     (smp_a),
    .smp_b_o     (smp_b),
    .smp_half_o  (smp_half),
    .smp_b_neg_o (smp_b_neg)
  );

  for (genvar i = 0; i < 2; i++) begin : gen_line
    mb4_word_list #(.Sum(1'b0)) u_rx_list (
      .clk_i,
      .rst_ni,
      .enscd_i,
      .actnsens_i  (cfg_i.actnsens),
      .own_i       (own[i*8 +: 8]),
      .ssi_i       (ssi[i]),
      .nocrc_i     (cfg_i.nocrc),
      .start_i     (go_i.start),
      .next_i      (rx_next[i]),
      .cfg_en_o    (cfg_en_o[i]),
      .cfg_slave_o (cfg_slave_o[i*3 +: 3]),
      .cfg_i       (slave_cfg_i[i*CFG_W +: CFG_W]),
      .actuator_o  (rx_actuator[i]),
      .len_valid_o (rx_len_valid[i]),
      .len_o       (rx_len[i*7 +: 7]),
      .offer_o     (rx_offer[i*OFFER_W +: OFFER_W])
    );

    mb4_word_list u_mo_list (
      .clk_i,
      .rst_ni,
      .enscd_i,
      .actnsens_i  (cfg_i.actnsens),
      .own_i       (own[i*8 +: 8]),
      .ssi_i       (ssi[i]),
      .nocrc_i     (cfg_i.nocrc),
      .start_i     (go_i.start),
      .next_i      (mo_next[i]),
      .cfg_en_o    (cfg_en_o[2 + i]),
      .cfg_slave_o (cfg_slave_o[(2 + i)*3 +: 3]),
      .cfg_i       (slave_cfg_i[(2 + i)*CFG_W +: CFG_W]),
      .actuator_o  (actuator[i]),
      .len_valid_o (len_valid[i]),
      .len_o       (len[i*7 +: 7]),
      .offer_o     (mo_offer[i*OFFER_W +: OFFER_W])
    );

    biss_line #(.SlCells(SlCells)) u_line (
      .clk_i,
      .rst_ni,
      .por_ni,
      .cmd_i       (cmd_i[i*CMD_W +: CMD_W]),
      .go_i,
      .register_ma_i,
      .register_end_i,
      .start_i     (start_i[i*START_W +: START_W]),
      .idle_o      (idle_o[i]),
      .status_o    (status_o[i*STATUS_W +: STATUS_W]),
      .event_o     (event_o[i*EVENT_W +: EVENT_W]),
      .data_o      (data_o[i*DATA_W +: DATA_W]),
      .tick_i      (tick_o),
      .half_next_i (half_next),
      .smp_a_i     (smp_a),
      .smp_b_i     (smp_b),
      .smp_half_i  (smp_half),
      .smp_b_neg_i (smp_b_neg),
      .len_valid_i (len_valid[i]),
      .len_i       (len[i*7 +: 7]),
      .ssi_o       (ssi[i]),
      .rx_offer_i  (rx_offer[i*OFFER_W +: OFFER_W]),
      .rx_next_o   (rx_next[i]),
      .mo_bus_i    (actuator[i] && cfg_i.en_mo),
      .mo_offer_i  (mo_offer[i*OFFER_W +: OFFER_W]),
      .mo_next_o   (mo_next[i]),
      .mo_rd_en_o  (mo_rd_en[i]),
      .mo_addr_o   (mo_addr_o[i*6 +: 6]),
      .mo_data_i   (mo_data_i[i*8 +: 8]),
      .ma_o        (ma_o[i]),
      .mo_o        (mo_o[i]),
      .sl_i        (sl_i[i]),
      .sl_o        (sl_o[i])
    );
  end

  // Only the MO list counts the bits.
  assign unused = ^{rx_actuator, rx_len_valid, rx_len};

endmodule
