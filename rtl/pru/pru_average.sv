// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Sample point of a frame: its own one, or that with the mean of the four frames before.
//
// Clock domain: core. point_o and average_o follow place_i in the same clock. push_i adds place_i
// to the four; clear_i forgets all. The average is on when four points are known and off_i is 0.
//
// Points are numbers of samples from the beginning of the byte with the acknowledge. Of the frames
// before three bits are kept: their distance to this frame's point, -4 to 3, is what counts, so a
// line delay that is another by whole periods changes nothing. The mean is rounded to the nearest
// sample, half to the later one.
// With wrap_i the mean is that of the bit numbers, 7 to 0, rounded down, in the byte of this
// frame's point: as published. It reads wrong bits when points lie on both sides of a byte's end.
//
// Misuse: place_i is 4 to 11.
// Source: TIDEP0022, 3.2.4.2.6 and 3.2.4.2.14; docs/pru.md.

module pru_average (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       clear_i,
  input  logic       push_i,
  input  logic       off_i,
  input  logic       wrap_i,
  input  logic [3:0] place_i,
  output logic       valid_o,     // the average would be on
  output logic [3:0] point_o
);

  localparam logic [2:0] FOUR = 3'd4;

  logic [11:0] points_q;   // of four frames, the newest one lowest
  logic [2:0]  known_q;
  logic [2:0]  term0, term1, term2, term3;
  logic [4:0]  sum;
  logic [2:0]  mean;
  logic [1:0]  unused;

  assign term0 = wrap_i ? ~points_q[2:0]  : points_q[2:0]  - place_i[2:0] + FOUR;
  assign term1 = wrap_i ? ~points_q[5:3]  : points_q[5:3]  - place_i[2:0] + FOUR;
  assign term2 = wrap_i ? ~points_q[8:6]  : points_q[8:6]  - place_i[2:0] + FOUR;
  assign term3 = wrap_i ? ~points_q[11:9] : points_q[11:9] - place_i[2:0] + FOUR;

  assign sum            = 5'(term0) + 5'(term1) + 5'(term2) + 5'(term3) + {3'd0, !wrap_i, 1'b0};
  assign {mean, unused} = sum;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      points_q <= '0;
      known_q  <= '0;
    end else begin
      if (push_i) points_q <= {points_q[8:0], place_i[2:0]};
      if (clear_i)                        known_q <= '0;
      else if (push_i && known_q != FOUR) known_q <= known_q + 3'd1;
    end
  end

  assign valid_o = known_q == FOUR && !off_i;

  always_comb begin
    point_o = place_i;
    if (valid_o) point_o = wrap_i ? {place_i[3], ~mean} : place_i - 4'd4 + {1'b0, mean};
  end

endmodule
