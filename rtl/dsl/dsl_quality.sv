// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The quality monitor: a number of 0 to 15 by what happens in the frames, one event a clock.
//
// Clock domain: core. add_i adds the step of event_i. end_i ends a frame: value_o is that of the
// frame from the next clock on, 15 at most, 0 if it is negative. good_o goes with end_i: 0 says
// that the link has to begin again. start_i: the value is 8.
//
// Three documents have different steps: rules_i is 0 for the document, 1 for sick, 2 for firmware.
// The firmware's link ends below 0, that of the others at 0.
// Misuse: add_i together with end_i loses the event. A frame that takes more than 64 wraps.
// Source: docs/dsl.md.

module dsl_quality (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [1:0] rules_i,     // dsl_pkg::rules_e
  input  logic       start_i,
  input  logic       add_i,
  input  logic [3:0] event_i,     // dsl_pkg::event_e
  input  logic       end_i,
  output logic       good_o,
  output logic [3:0] value_o,
  output logic       low_o        // below 14
);

  localparam logic [6:0] FIRST_VALUE = 7'd8;
  localparam logic [6:0] HIGHEST     = 7'd15;
  localparam logic [3:0] LOW         = 4'd14;

  logic [6:0] step;               // of the event, signed
  logic [6:0] sum_q;              // of the frame so far, signed
  logic [3:0] value_q;
  logic       negative;
  logic       document, firmware;

  assign document = rules_i == dsl_pkg::DOCUMENT;
  assign firmware = rules_i == dsl_pkg::FIRMWARE;
  assign negative = sum_q[6];

  always_comb begin
    unique case (event_i)
      dsl_pkg::VSYNC_EARLY:   step = document || firmware ? -7'd4 : -7'd6;
      dsl_pkg::VSYNC_MISSING: step = document ? -7'd8 : firmware ? -7'd6 : -7'd4;
      dsl_pkg::RSSI_LOW:      step = document ? -7'd8 : -7'd4;
      dsl_pkg::CODE_ERROR:    step = -7'd1;
      dsl_pkg::ACCELERATION:  step = document ? -7'd1 : -7'd2;
      dsl_pkg::SPECIAL:       step = -7'd2;
      dsl_pkg::SAFE1_ERROR:   step = document ? -7'd8 : -7'd6;
      dsl_pkg::SAFE2_ERROR:   step = -7'd8;
      default:                step = 7'd1;      // GOOD
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sum_q   <= '0;
      value_q <= '0;
    end else if (start_i) begin
      sum_q   <= FIRST_VALUE;
      value_q <= FIRST_VALUE[3:0];
    end else if (end_i) begin
      if (!negative && sum_q[5:4] != 2'd0) sum_q <= HIGHEST;
      value_q <= negative ? 4'd0 : sum_q[5:4] != 2'd0 ? HIGHEST[3:0] : sum_q[3:0];
    end else if (add_i) begin
      sum_q <= sum_q + step;
    end
  end

  assign good_o  = !negative && (firmware || sum_q != 7'd0);
  assign value_o = value_q;
  assign low_o   = value_q < LOW;

endmodule
