// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// DSL master for one line on a bus of words. Its quirks are a port, so that a simulator can set
// them; dsl_axil ties them to parameters.
//
// Clock domain: clk_i, 75 MHz; the word bus and irq_o too. dsl_in_i is asynchronous. dsl_out_o is a
// flop; dsl_en_o is 1 while the driver is on, a flop and bit OEN behind it.
// link_o: as bit LINK. sample_edge_o is 1 in the clock with which the falling edge of SAMPLE is at
// the pin, position_ready_o in the clock after which the record of a running frame can be read.
// interrupts_o has a clock for each interrupt of the published master: bit 0 INT rises, 1 and 2 a
// good safe position 1 or 2 has come, 3 as position_ready_o, 4 SINT rises.
// Latency of an access: dsl_regs.
//
// Reset: rst_ni may fall and rise at any time; it is released here with clk_i.
// Misuse: quirks_i must not change while the link runs. An access: dsl_regs.
// Source: docs/dsl.md.

module dsl_core (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  dsl_pkg::quirks_t quirks_i,
  // word bus
  input  logic             word_req_i,
  input  logic             word_write_i,
  input  logic [11:2]      word_addr_i,
  input  logic [31:0]      word_data_i,
  input  logic [3:0]       word_be_i,
  output logic             word_ready_o,
  output logic [31:0]      word_data_o,
  output logic             irq_o,
  // state
  output logic             link_o,
  output logic             sample_edge_o,
  output logic             position_ready_o,
  output logic [4:0]       interrupts_o,
  // DSL
  output logic             dsl_out_o,
  output logic             dsl_en_o,
  input  logic             dsl_in_i
);

  localparam int unsigned SIGNED = 10;   // bit of the identity

  logic                  rst_n;
  dsl_pkg::answer_t      answer;
  dsl_pkg::verdict_t     verdict;
  dsl_pkg::told_t        told;
  dsl_pkg::line_status_t status;
  dsl_pkg::counts_t      counts;
  logic                  hold, driver_off, drive;
  logic [4:0]            limit;
  logic                  ended, lost, tell;
  logic                  record_write, record_read, record_hold, record_busy;
  logic [5:0]            record_to, record_from;
  logic [7:0]            record_byte, record_data;
  logic [2:0]            record_group;
  logic                  stale, mismatch;
  logic [7:0]            safe2_bits, tolerance;
  logic                  frame_begin;
  logic [4:0]            symbol;
  dsl_pkg::event_stores_t stores;
  logic [7:0]            host_byte;
  dsl_pkg::event_bytes_t events;
  dsl_pkg::causes_t      causes;
  dsl_pkg::orders_t      orders;
  dsl_pkg::messages_t    messages;
  dsl_pkg::message_events_t message_events;
  logic                  stored_busy, stored_clears, stored_read, stored_write;
  logic [5:0]            stored_address;
  logic [7:0]            stored_data;
  logic                  time_next, time_copy, time_copied;
  logic [2:0]            time_address;
  logic [7:0]            edge_time, host_time;

  enc_reset_sync u_rst (
    .clk_i,
    .rst_ni,
    .rst_sync_no (rst_n)
  );

  dsl_line u_line (
    .clk_i,
    .rst_ni    (rst_n),
    .quirks_i,
    .hold_i    (hold),
    .verdict_i (verdict),
    .symbol_i  (symbol),
    .begin_o   (frame_begin),
    .answer_o  (answer),
    .status_o  (status),
    .counts_o  (counts),
    .ended_o   (ended),
    .sampled_o (sample_edge_o),
    .line_o    (dsl_out_o),
    .drive_o   (drive),
    .line_i    (dsl_in_i)
  );

  dsl_vertical u_vertical (
    .clk_i,
    .rst_ni    (rst_n),
    .quirks_i,
    .limit_i   (limit),
    .width_i   (status.width),
    .signed_i  (status.identity[SIGNED]),
    .answer_i  (answer),
    .verdict_o (verdict),
    .told_o    (told)
  );

  dsl_position u_position (
    .clk_i,
    .rst_ni           (rst_n),
    .quirks_i,
    .answer_i         (answer),
    .told_i           (told),
    .status_i         (status),
    .safe2_bits_i     (safe2_bits),
    .tolerance_i      (tolerance),
    .time_i           (edge_time),
    .time_next_o      (time_next),
    .lost_o           (lost),
    .stale_o          (stale),
    .mismatch_o       (mismatch),
    .record_write_o   (record_write),
    .record_address_o (record_to),
    .record_data_o    (record_byte),
    .tell_o           (tell),
    .record_busy_i    (record_busy)
  );

  dsl_record u_record (
    .clk_i,
    .rst_ni          (rst_n),
    .write_i         (record_write),
    .write_address_i (record_to),
    .write_data_i    (record_byte),
    .tell_i          (tell),
    .busy_o          (record_busy),
    .read_i          (record_read),
    .hold_i          (record_hold),
    .group_i         (record_group),
    .address_i       (record_from),
    .data_o          (record_data)
  );

  dsl_time u_time (
    .clk_i,
    .rst_ni         (rst_n),
    .edge_i         (sample_edge_o),
    .edge_next_i    (time_next),
    .edge_data_o    (edge_time),
    .copy_i         (time_copy),
    .copied_o       (time_copied),
    .host_address_i (time_address),
    .host_data_o    (host_time)
  );

  dsl_message u_message (
    .clk_i,
    .rst_ni         (rst_n),
    .sdk_map_i      (quirks_i.sdk_map),
    .check_i        (quirks_i.check_answers),
    .begin_i        (frame_begin),
    .answer_i       (answer),
    .counts_i       (counts),
    .symbol_o       (symbol),
    .host_read_i    (stored_read),
    .host_write_i   (stored_write),
    .host_address_i (stored_address),
    .host_byte_i    (host_byte),
    .host_data_o    (stored_data),
    .busy_o         (stored_busy),
    .clears_o       (stored_clears),
    .orders_i       (orders),
    .messages_o     (messages),
    .events_o       (message_events)
  );

  dsl_events u_events (
    .clk_i,
    .rst_ni           (rst_n),
    .sdk_map_i        (quirks_i.sdk_map),
    .answer_i         (answer),
    .state_i          (status.state),
    .low_i            (status.low),
    .ended_i          (ended),
    .edge_i           (sample_edge_o),
    .told_i           (told),
    .lost_i           (lost),
    .tell_i           (tell),
    .record_write_i   (record_write),
    .record_address_i (record_to),
    .record_byte_i    (record_byte),
    .messages_i       (messages),
    .message_events_i (message_events),
    .orders_i         (orders),
    .stores_i         (stores),
    .byte_i           (host_byte),
    .bytes_o          (events),
    .causes_o         (causes),
    .irq_o
  );

  dsl_regs u_regs (
    .clk_i,
    .rst_ni           (rst_n),
    .quirks_i,
    .word_req_i,
    .word_write_i,
    .word_addr_i,
    .word_data_i,
    .word_be_i,
    .word_ready_o,
    .word_data_o,
    .hold_o           (hold),
    .driver_off_o     (driver_off),
    .limit_o          (limit),
    .safe2_bits_o     (safe2_bits),
    .tolerance_o      (tolerance),
    .orders_o         (orders),
    .answer_i         (answer),
    .status_i         (status),
    .ended_i          (ended),
    .told_i           (told),
    .lost_i           (lost),
    .tell_i           (tell),
    .stale_i          (stale),
    .mismatch_i       (mismatch),
    .stores_o         (stores),
    .byte_o           (host_byte),
    .events_i         (events),
    .messages_i       (messages),
    .stored_busy_i    (stored_busy),
    .stored_clears_i  (stored_clears),
    .stored_read_o    (stored_read),
    .stored_write_o   (stored_write),
    .stored_address_o (stored_address),
    .stored_data_i    (stored_data),
    .record_read_o    (record_read),
    .record_hold_o    (record_hold),
    .record_group_o   (record_group),
    .record_address_o (record_from),
    .record_data_i    (record_data),
    .time_copy_o      (time_copy),
    .time_copied_i    (time_copied),
    .time_address_o   (time_address),
    .time_data_i      (host_time)
  );

  assign position_ready_o = causes.frame;
  assign interrupts_o     = {causes.safe_event, causes.frame, causes.safe2, causes.safe1,
                             causes.main_event};

  assign link_o   = answer.linked;
  assign dsl_en_o = drive && !driver_off;

endmodule
