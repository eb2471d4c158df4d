// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A window from its samples to its words: where the answer is, and what it says.
//
// Clock domain: core. done_o comes 11 to 44 clocks behind the last sample, and with it good_o: in
// START, LEARN and CHECK frames the window is as it has to be. From the next clock on place_o is
// that of the next window, and edges_o and rssi_o are those of this one.
//
// forget_i: the line is trained anew. purpose_i says what the window is for, from its first sample
// to done_o.
// Misuse: as dsl_sample.
// Source: docs/dsl.md.

module dsl_receiver (
  input  logic              clk_i,
  input  logic              rst_ni,
  input  logic [1:0]        sample_i,     // dsl_pkg::sample_e
  input  logic              table_i,
  input  logic              forget_i,
  input  logic [1:0]        purpose_i,    // dsl_pkg::purpose_e
  input  dsl_pkg::stream_t  stream_i,
  output logic              word_valid_o,
  output logic [2:0]        number_o,
  output logic [9:0]        line_o,
  output logic              done_o,
  output logic              good_o,
  output logic [11:0]       place_o,      // sample of the first bit, five bits behind the point;
                                          // bits 11 to 8 are the whole bits that it comes late
  output logic [7:0]        edges_o,
  output logic [3:0]        rssi_o
);

  logic        tracks;
  logic        start;
  logic        first, found;     // dsl_sample
  logic [11:0] place;
  logic        fits;
  logic        learned;          // dsl_learn
  logic [3:0]  learned_delay;
  logic [2:0]  learned_eighth;
  logic        bit_valid, level;
  logic        same;
  logic [3:0]  delay;
  logic [2:0]  eighth;
  logic [6:0]  tracked;          // four samples behind the place

  assign tracks  = sample_i == dsl_pkg::TRACKING;
  assign start   = purpose_i == dsl_pkg::FOR_START;
  assign tracked = place[11:5] + 7'd4;
  assign delay   = tracks ? tracked[6:3] : learned_delay;
  assign eighth  = tracks ? tracked[2:0] : learned_eighth;

  dsl_sample u_sample (
    .clk_i,
    .rst_ni,
    .forget_i,
    .start_i   (start),
    .linked_i  (purpose_i == dsl_pkg::FOR_WORDS),
    .words_i   (purpose_i == dsl_pkg::FOR_WORDS || purpose_i == dsl_pkg::FOR_IDENTITY),
    .stream_i,
    .first_o   (first),
    .found_o   (found),
    .place_o   (place),
    .fits_o    (fits),
    .done_o
  );

  dsl_learn u_learn (
    .clk_i,
    .rst_ni,
    .forget_i,
    .published_i (sample_i == dsl_pkg::PUBLISHED),
    .start_i     (start),
    .stream_i,
    .bit_valid_i (bit_valid),
    .bit_i       (level),
    .done_i      (done_o),
    .found_o     (learned),
    .delay_o     (learned_delay),
    .eighth_o    (learned_eighth)
  );

  dsl_rx u_rx (
    .clk_i,
    .rst_ni,
    .forget_i,
    .collect_i    (purpose_i == dsl_pkg::FOR_MATCH),
    .table_i,
    .delay_i      (delay),
    .eighth_i     (eighth),
    .stream_i,
    .bit_valid_o  (bit_valid),
    .bit_o        (level),
    .word_valid_o,
    .number_o,
    .line_o,
    .same_o       (same),
    .edges_o,
    .rssi_o
  );

  always_comb begin
    good_o = same;
    if (tracks) good_o = fits && (first ? found : same);
    else if (start) good_o = learned;
  end

  assign place_o  = {delay, eighth, tracks ? place[4:0] : 5'd0};

endmodule
