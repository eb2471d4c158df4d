// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One line: frame, sampler, word assembly and MO.
//
// Clock domain: core. Latency, misuse and datasheet sections: biss_frame, biss_sl_sampler,
// biss_rx_word and biss_mo_tx.
//
// Parameters make the line smaller; what is left out costs nothing. The default is all of it.
//
//   BissB, Ssi  0: the line does not know the protocol, which acts as UNUSED (decision 44)
//   Mo          0: no actuators, MO is 0
//   FreeCrc     0: only the CRCs 0x43 and 0x190D9; a word with another one is bad
//   Gray        0: no Gray code; a word with it is bad
//   Slaves, DataBits, DelayW  sizes of counters
//
// Misuse: more or longer words than Slaves and DataBits allow end the frame in a wrong place.
//
// data_o tells only of the words of sensors. rx_next_o tells of every word that has ended.

module biss_line #(
  parameter logic [1:0]  SlCells  = biss_pkg::SL_FLOPS,
  parameter bit          BissB    = 1'b1,
  parameter bit          Ssi      = 1'b1,
  parameter bit          Mo       = 1'b1,  // words on MO
  parameter bit          FreeCrc  = 1'b1,  // any CRC; 0: only 0x43 and 16 bits
  parameter bit          Gray     = 1'b1,  // decodes Gray coded data
  parameter int unsigned Slaves   = 8,     // most words of a frame, 1 to 8
  parameter int unsigned DataBits = 64,    // the longest word, 1 to 64
  parameter int unsigned DelayW   = 8      // bits of the line delay, 1 to 8
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,
  // frames
  input  biss_pkg::line_cmd_t    cmd_i,
  input  biss_pkg::line_go_t     go_i,
  input  biss_pkg::line_start_t  start_i,
  input  biss_pkg::register_ma_t register_ma_i,
  output biss_pkg::line_status_t status_o,
  output biss_pkg::line_event_t  event_o,
  output biss_pkg::line_data_t   data_o,
  // time base
  input  logic       tick_i,
  input  logic       half_next_i,
  input  biss_pkg::sample_t sample_i,
  input  logic       sample_half_i,
  // words on SL
  output logic       ssi_o,        // the frame is SSI
  input  logic       len_valid_i,
  input  logic [6:0] len_last_i,   // bits of the word minus 1
  input  biss_pkg::offer_t rx_offer_i,
  output logic       rx_next_o,
  // words on MO
  input  logic       mo_bus_i,     // MO has words for actuators
  input  biss_pkg::offer_t mo_offer_i,
  output logic       mo_next_o,
  output biss_pkg::mo_read_t mo_read_o,
  input  logic [7:0] mo_data_i,
  // pins
  output logic       ma_o,
  output logic       mo_o,
  input  logic       sl_i
);

  logic armed_a, armed_b, ack, late, sl, bit_valid, sl_bit;
  logic rise, final_rise, ma_clocks, biss_c;
  logic word_bit, word_load, word_run;
  logic [7:0] quarters;
  biss_pkg::rx_t rx;

  biss_frame #(
    .BissB(BissB), .Ssi(Ssi), .Mo(Mo), .Slaves(Slaves), .DataBits(DataBits)
  ) u_frame (
    .clk_i,
    .rst_ni,
    .por_ni,
    .cmd_i,
    .go_i,
    .start_i,
    .mo_bus_i,
    .register_ma_i,
    .tick_i,
    .half_next_i,
    .armed_a_o   (armed_a),
    .armed_b_o   (armed_b),
    .ack_i       (ack),
    .late_i      (late),
    .sl_i        (sl),
    .bit_valid_i (bit_valid),
    .bit_i       (sl_bit),
    .len_valid_i,
    .len_last_i,
    .offer_i     (rx_offer_i),
    .word_done_i (rx_next_o),
    .word_load_o (word_load),
    .word_bit_o  (word_bit),
    .word_run_o  (word_run),
    .ssi_o,
    .rise_o      (rise),
    .final_rise_o (final_rise),
    .ma_clocks_o (ma_clocks),
    .biss_c_o    (biss_c),
    .status_o,
    .event_o,
    .ma_o
  );

  biss_sl_sampler #(.SlCells(SlCells), .DelayW(DelayW)) u_sampler (
    .clk_i,
    .rst_ni,
    .sl_i,
    .sample_i,
    .sample_half_i,
    .clear_i     (go_i.start),
    .ssi_i       (ssi_o),
    .armed_a_i   (armed_a),
    .armed_b_i   (armed_b),
    .sl_o        (sl),
    .ack_o       (ack),
    .quarters_o  (quarters),
    .late_o      (late),
    .bit_valid_o (bit_valid),
    .bit_o       (sl_bit)
  );

  biss_rx_word #(.DataBits(DataBits), .FreeCrc(FreeCrc), .Gray(Gray)) u_word (
    .clk_i,
    .rst_ni,
    .offer_i     (rx_offer_i),
    .run_i       (word_run),
    .load_i      (word_load),
    .bit_valid_i (word_bit),
    .bit_i       (sl_bit),
    .next_o      (rx_next_o),
    .rx_o        (rx)
  );

  assign data_o.rx       = rx;
  assign data_o.cds      = status_o.cds;
  assign data_o.delay_en = event_o.init_done;
  assign data_o.delay    = quarters;

  if (Mo) begin : gen_mo
    biss_mo_tx #(.DataBits(DataBits), .FreeCrc(FreeCrc)) u_mo (
      .clk_i,
      .rst_ni,
      .cmd_i,
      .go_i,
      .begin_i     (go_i.start && start_i.takes_part && !go_i.register_access &&
                     cmd_i.protocol != biss_pkg::SSI),
      .rise_i      (rise),
      .final_rise_i (final_rise),
      .ma_clocks_i (ma_clocks),
      .biss_c_i    (biss_c),
      .line_idle_i (status_o.idle),
      .offer_i     (mo_offer_i),
      .next_o      (mo_next_o),
      .read_o      (mo_read_o),
      .data_i      (mo_data_i),
      .mo_o
    );
  end else begin : gen_no_mo
    logic unused;
    assign unused    = ^{mo_offer_i, mo_data_i, rise, final_rise, ma_clocks, biss_c};
    assign mo_next_o = 1'b0;
    assign mo_read_o = '0;
    assign mo_o      = 1'b0;
  end

endmodule
