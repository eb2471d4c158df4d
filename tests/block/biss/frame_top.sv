// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Test bench top: one line with its time base and word list, without registers and sequencer. The
// parameters are those of biss_line.

module frame_top #(
  parameter bit          BissB    = 1'b1,
  parameter bit          Ssi      = 1'b1,
  parameter bit          Mo       = 1'b1,
  parameter bit          FreeCrc  = 1'b1,
  parameter int unsigned Slaves   = 8,
  parameter int unsigned DataBits = 64,
  parameter int unsigned DelayW   = 8
) (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic [4:0]   freqs_i,
  input  logic [255:0] slave_cfg_i,
  input  logic         nocrc_i,
  input  logic         start_i,
  input  logic         init_i,
  input  logic [1:0]   protocol_i,
  input  logic         cdm_i,
  input  logic         hold_cdm_i,
  input  logic         abort_i,
  output logic         wr_en_o,
  output logic [2:0]   wr_byte_o,
  output logic [7:0]   wr_data_o,
  output logic [2:0]   slave_o,
  output logic         word_done_o,
  output logic         word_ok_o,
  output logic         cds_o,
  output logic         line_end_o,
  output logic         init_done_o,
  output logic         init_fail_o,
  output logic [7:0]   quarters_o,
  output logic         idle_o,
  output logic         timeout_o,
  output logic         ma_o,
  input  logic         sl_i
);

  logic       tick;
  logic       half_next;
  biss_pkg::sample_t sample;
  logic       sample_half;
  logic       len_valid;
  logic [6:0] len_last;
  logic       next;
  logic       mo_next, mo, ssi;
  biss_pkg::mo_read_t mo_read;
  logic       rx_len_valid, rx_actuator, mo_actuator;
  logic [6:0] rx_len_last;
  biss_pkg::offer_t     rx_offer, mo_offer;
  biss_pkg::line_cmd_t  cmd;
  biss_pkg::line_status_t status;
  biss_pkg::line_event_t  ends;
  biss_pkg::line_data_t   data;
  logic [7:0]  enscd;
  logic        rx_cfg_en, mo_cfg_en;
  logic [2:0]  rx_cfg_slave, mo_cfg_slave;
  logic [31:0] rx_cfg_q, mo_cfg_q;
  logic [7:0]  rx_poly, mo_poly;
  logic [11:0] rx_crc, mo_crc;
  logic        unused_rx, unused_mo;

  biss_timebase u_timebase (
    .clk_i,
    .rst_ni,
    .last_i      (freqs_i[3:0]),
    .tens_i      (freqs_i[4]),
    .run_i       (!idle_o),
    .restart_i   (start_i),
    .tick_o      (tick),
    .half_next_o (half_next),
    .sample_o    (sample),
    .sample_half_o (sample_half)
  );

  // The configuration store of the chip: a clock from the data channel's number to its bytes.
  always_comb begin
    for (int i = 0; i < 8; i++) enscd[i] = slave_cfg_i[32*i + 6];
  end

  mb4_crc_code u_rx_code (
    .selcrc_i (rx_cfg_q[15]),
    .code_i   (rx_cfg_q[14:8]),
    .poly_o   (rx_poly)
  );

  mb4_crc_code u_mo_code (
    .selcrc_i (mo_cfg_q[15]),
    .code_i   (mo_cfg_q[14:8]),
    .poly_o   (mo_poly)
  );

  mb4_crc_decode u_rx_decode (
    .poly_i     (rx_poly),
    .crc_on_o   (rx_crc[11]),
    .crc_last_o (rx_crc[10:7]),
    .crc_poly_o ({rx_crc[6:0], unused_rx})
  );

  mb4_crc_decode u_mo_decode (
    .poly_i     (mo_poly),
    .crc_on_o   (mo_crc[11]),
    .crc_last_o (mo_crc[10:7]),
    .crc_poly_o ({mo_crc[6:0], unused_mo})
  );

  always_ff @(posedge clk_i) begin
    if (rx_cfg_en) rx_cfg_q <= slave_cfg_i[32*rx_cfg_slave +: 32];
    if (mo_cfg_en) mo_cfg_q <= slave_cfg_i[32*mo_cfg_slave +: 32];
  end

  mb4_word_list #(.Sum(1'b0)) u_words (
    .clk_i,
    .rst_ni,
    .enscd_i     (enscd),
    .actnsens_i  (8'h00),
    .ssi_i       (ssi),
    .nocrc_i,
    .idle_i      (idle_o),
    .start_i,
    .next_i      (next),
    .cfg_en_o    (rx_cfg_en),
    .cfg_slave_o (rx_cfg_slave),
    .cfg_i       ({rx_cfg_q[31:16], rx_crc, rx_cfg_q[7:0]}),
    .actuator_o  (rx_actuator),
    .len_valid_o (rx_len_valid),
    .len_last_o  (rx_len_last),
    .offer_o     (rx_offer)
  );

  mb4_word_list u_mo_words (
    .clk_i,
    .rst_ni,
    .enscd_i     (enscd),
    .actnsens_i  (8'h00),
    .ssi_i       (ssi),
    .nocrc_i,
    .idle_i      (idle_o),
    .start_i,
    .next_i      (mo_next),
    .cfg_en_o    (mo_cfg_en),
    .cfg_slave_o (mo_cfg_slave),
    .cfg_i       ({mo_cfg_q[31:16], mo_crc, mo_cfg_q[7:0]}),
    .actuator_o  (mo_actuator),
    .len_valid_o (len_valid),
    .len_last_o  (len_last),
    .offer_o     (mo_offer)
  );

  // Without MO, force bits and register access.
  assign cmd = {protocol_i, 1'b0, 8'h00, hold_cdm_i, 3'b000};

  biss_line #(
    .BissB(BissB), .Ssi(Ssi), .Mo(Mo), .FreeCrc(FreeCrc), .Slaves(Slaves), .DataBits(DataBits),
    .DelayW(DelayW)
  ) u_line (
    .clk_i,
    .rst_ni,
    .por_ni      (rst_ni),
    .cmd_i       (cmd),
    .go_i        ({start_i, init_i, 3'b000, abort_i}),
    .start_i     ({1'b1, cdm_i, cdm_i}),
    .register_ma_i (2'b10),
    .status_o    (status),
    .event_o     (ends),
    .data_o      (data),
    .tick_i      (tick),
    .half_next_i (half_next),
    .sample_i    (sample),
    .sample_half_i (sample_half),
    .len_valid_i (len_valid),
    .len_last_i  (len_last),
    .ssi_o       (ssi),
    .rx_offer_i  (rx_offer),
    .rx_next_o   (next),
    .mo_bus_i    (1'b0),
    .mo_offer_i  (mo_offer),
    .mo_next_o   (mo_next),
    .mo_read_o   (mo_read),
    .mo_data_i   (8'h00),
    .ma_o,
    .mo_o        (mo),
    .sl_i
  );

  assign wr_en_o     = data.rx.wr_en;
  assign wr_byte_o   = data.rx.wr_byte;
  assign wr_data_o   = data.rx.wr_data;
  assign slave_o     = data.rx.slave;
  assign word_done_o = data.rx.done;
  assign word_ok_o   = data.rx.ok;
  assign idle_o      = status.idle;
  assign quarters_o  = data.delay;
  assign cds_o       = status.cds;
  assign timeout_o   = status.timeout;
  assign line_end_o = ends.line_end;
  assign init_done_o = ends.init_done;
  assign init_fail_o = ends.init_fail;

  logic unused;
  assign unused = ^{unused_rx, unused_mo, status, ends, data, mo, mo_read, rx_len_valid,
                    rx_len_last, rx_actuator, mo_actuator};

endmodule
