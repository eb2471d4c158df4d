// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host's half of dsl_core: registers, events and messages, as dsl_core connects them.
//
// Clock domain: clk_i. Ports: dsl_regs, dsl_events and dsl_message.

module dsl_host_top (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  input  dsl_pkg::quirks_t      quirks_i,
  // word bus
  input  logic                  word_req_i,
  input  logic                  word_write_i,
  input  logic [11:2]           word_addr_i,
  input  logic [31:0]           word_data_i,
  input  logic [3:0]            word_be_i,
  output logic                  word_ready_o,
  output logic [31:0]           word_data_o,
  output logic                  irq_o,
  output logic [4:0]            interrupts_o,
  // what the host sets
  output logic                  hold_o,
  output logic                  driver_off_o,
  output logic [4:0]            limit_o,
  output logic [7:0]            safe2_bits_o,
  output logic [7:0]            tolerance_o,
  // line and position
  input  logic                  begin_i,
  output logic [4:0]            symbol_o,
  input  dsl_pkg::answer_t      answer_i,
  input  dsl_pkg::line_status_t status_i,
  input  dsl_pkg::counts_t      counts_i,
  input  logic                  ended_i,
  input  logic                  edge_i,
  input  dsl_pkg::told_t        told_i,
  input  logic                  lost_i,
  input  logic                  tell_i,
  input  logic                  stale_i,
  input  logic                  mismatch_i,
  // records
  input  logic                  record_write_i,
  input  logic [5:0]            record_address_i,
  input  logic [7:0]            record_byte_i,
  output logic                  record_read_o,
  output logic                  record_hold_o,
  output logic [2:0]            record_group_o,
  output logic [5:0]            record_address_o,
  input  logic [7:0]            record_data_i,
  // time
  output logic                  time_copy_o,
  input  logic                  time_copied_i,
  output logic [2:0]            time_address_o,
  input  logic [7:0]            time_data_i
);

  dsl_pkg::event_stores_t   stores;
  logic [7:0]               host_byte;
  dsl_pkg::event_bytes_t    events;
  dsl_pkg::causes_t         causes;
  dsl_pkg::orders_t         orders;
  dsl_pkg::messages_t       messages;
  dsl_pkg::message_events_t message_events;
  logic                     stored_busy, stored_clears, stored_read, stored_write;
  logic [5:0]               stored_address;
  logic [7:0]               stored_data;

  dsl_message u_message (
    .clk_i,
    .rst_ni,
    .sdk_map_i      (quirks_i.sdk_map),
    .check_i        (quirks_i.check_answers),
    .begin_i,
    .answer_i,
    .counts_i,
    .symbol_o,
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
    .rst_ni,
    .sdk_map_i        (quirks_i.sdk_map),
    .answer_i,
    .state_i          (status_i.state),
    .low_i            (status_i.low),
    .ended_i,
    .edge_i,
    .told_i,
    .lost_i,
    .tell_i,
    .record_write_i,
    .record_address_i,
    .record_byte_i,
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
    .rst_ni,
    .quirks_i,
    .word_req_i,
    .word_write_i,
    .word_addr_i,
    .word_data_i,
    .word_be_i,
    .word_ready_o,
    .word_data_o,
    .hold_o,
    .driver_off_o,
    .limit_o,
    .safe2_bits_o,
    .tolerance_o,
    .orders_o         (orders),
    .answer_i,
    .status_i,
    .ended_i,
    .told_i,
    .lost_i,
    .tell_i,
    .stale_i,
    .mismatch_i,
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
    .record_read_o,
    .record_hold_o,
    .record_group_o,
    .record_address_o,
    .record_data_i,
    .time_copy_o,
    .time_copied_i,
    .time_address_o,
    .time_data_i
  );

  assign interrupts_o = {causes.safe_event, causes.frame, causes.safe2, causes.safe1,
                         causes.main_event};

endmodule
