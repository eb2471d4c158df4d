// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A line of DSL: its pins, its frames, its link. What the answers say goes out word by word;
// the position and the safe channels are others' work (dsl_position, dsl_vertical).
//
// Clock domain: core, 75 MHz. line_i is asynchronous. answer_o.ends is two clocks behind the done_o
// of dsl_receiver, at tick 847 of the frame at the latest; three clocks later the frame is judged,
// and with ended_o, one more later, status_o is that of the frame. sampled_o is 1 in the clock with
// which the falling edge of SAMPLE is at the pin.
//
// hold_i keeps the driver off and the link at its begin. quirks_i must not change while the link
// runs: a frame would be a mixture.
// symbol_i may change in the clock behind begin_o alone.
// Misuse: sampled_o does not know eighths of a bit; the free run has none.
// Source: docs/dsl.md.

module dsl_line (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  input  dsl_pkg::quirks_t      quirks_i,
  input  logic                  hold_i,
  input  dsl_pkg::verdict_t     verdict_i,
  input  logic [4:0]            symbol_i,     // of M_PAR in a running frame
  output logic                  begin_o,      // a frame or a gap does with the next clock
  output dsl_pkg::answer_t      answer_o,
  output dsl_pkg::line_status_t status_o,
  output dsl_pkg::counts_t      counts_o,
  output logic                  ended_o,
  output logic                  sampled_o,
  // pins
  output logic                  line_o,
  output logic                  drive_o,
  input  logic                  line_i
);

  logic             slot;
  dsl_pkg::bit_t    line_bit;
  dsl_pkg::stream_t stream;
  dsl_pkg::plan_t   plan;
  logic             frame_begin, gap;
  logic             forget;
  logic [1:0]       purpose;
  logic             word_valid, done, match;
  logic [2:0]       number;
  logic [9:0]       line_word;
  logic [11:0]      place;
  logic [7:0]       edges;
  logic [3:0]       rssi;
  logic             valid, ends, judged, good, low;
  logic [2:0]       word_number;
  dsl_pkg::word_t   word;
  logic [3:0]       quality;
  logic             start, linked, begins, running;
  logic [2:0]       vertical_place;
  logic [3:0]       state;
  logic [2:0]       reason;
  logic [19:0]      identity;
  logic [5:0]       width;
  logic             ended_q, sampled_q;

  dsl_phy u_phy (
    .clk_i,
    .rst_ni,
    .rx_start_i (quirks_i.rx_start),
    .bit_i      (line_bit),
    .slot_o     (slot),
    .stream_o   (stream),
    .line_o,
    .drive_o,
    .line_i
  );

  dsl_tx #(.DisparityW(3)) u_tx (
    .clk_i,
    .rst_ni,
    .slot_i  (slot),
    .gap_i   (gap),
    .plan_i  (plan),
    .begin_o (frame_begin),
    .bit_o   (line_bit)
  );

  dsl_receiver u_receiver (
    .clk_i,
    .rst_ni,
    .sample_i     (quirks_i.sample),
    .table_i      (quirks_i.rssi_table),
    .forget_i     (forget),
    .purpose_i    (purpose),
    .stream_i     (stream),
    .word_valid_o (word_valid),
    .number_o     (number),
    .line_o       (line_word),
    .done_o       (done),
    .good_o       (match),
    .place_o      (place),
    .edges_o      (edges),
    .rssi_o       (rssi)
  );

  dsl_judge u_judge (
    .clk_i,
    .rst_ni,
    .quirks_i,
    .start_i      (start),
    .words_i      (purpose == dsl_pkg::FOR_WORDS || purpose == dsl_pkg::FOR_IDENTITY),
    .running_i    (running),
    .place_i      (vertical_place),
    .word_valid_i (word_valid),
    .number_i     (number),
    .line_i       (line_word),
    .done_i       (done),
    .rssi_i       (rssi),
    .verdict_i,
    .valid_o      (valid),
    .number_o     (word_number),
    .word_o       (word),
    .ends_o       (ends),
    .judged_o     (judged),
    .good_o       (good),
    .quality_o    (quality),
    .low_o        (low),
    .illegal_o    (counts_o.illegal)
  );

  dsl_link u_link (
    .clk_i,
    .rst_ni,
    .quirks_i,
    .hold_i,
    .begin_i    (frame_begin),
    .symbol_i,
    .plan_o     (plan),
    .gap_o      (gap),
    .forget_o   (forget),
    .purpose_o  (purpose),
    .done_i     (done),
    .match_i    (match),
    .valid_i    (valid),
    .number_i   (word_number),
    .word_i     (word),
    .judged_i   (judged),
    .good_i     (good),
    .missing_i  (verdict_i.missing),
    .misfit_i   (verdict_i.misfit),
    .start_o    (start),
    .linked_o   (linked),
    .begins_o   (begins),
    .running_o  (running),
    .place_o    (vertical_place),
    .state_o    (state),
    .reason_o   (reason),
    .restart_o  (counts_o.restart),
    .identity_o (identity),
    .width_o    (width)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ended_q   <= 1'b0;
      sampled_q <= 1'b0;
    end else begin
      ended_q   <= judged;
      sampled_q <= slot && line_bit.edge_here;
    end
  end

  assign begin_o   = frame_begin;
  assign ended_o   = ended_q;
  assign sampled_o = sampled_q;

  assign answer_o.linked  = linked;
  assign answer_o.begins  = begins;
  assign answer_o.running = running;
  assign answer_o.place   = vertical_place;
  assign answer_o.valid   = valid;
  assign answer_o.number  = word_number;
  assign answer_o.word    = word;
  assign answer_o.ends    = ends;

  assign status_o.state    = state;
  assign status_o.reason   = reason;
  assign status_o.identity = identity;
  assign status_o.width    = width;
  assign status_o.quality  = quality;
  assign status_o.low      = low;
  assign status_o.rssi     = rssi;
  assign status_o.edges    = edges;
  assign status_o.place    = place;

endmodule
