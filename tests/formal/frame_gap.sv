// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The gap of biss_frame_sampler: whatever SL does, the gap that is told is the widest one of the frame. The bench
// marks the places of all edges by itself. It counts places from clear_i on, from one that the search guesses,
// and claims nothing where the start bit then has another place than 0. frame_ring proves that the bits are taken
// in the middle of the gap. Frames of one bit behind CDS and of 10 clocks a bit.
//
// claim: in a frame of one bit behind CDS, of 10 clocks a bit: no edge came inside the gap that is told; no gap is wider,
//   and none before it is as wide; none goes over the begin of the start bit
// clocks: one
// depth: 46
// cover: 46
// unbounded: no: the guessed places would have to be tied to the marks that turn
// mutation: biss/biss_frame_sampler.sv | {1'b0, gap_q, 1'b1} + {1'b0, ~width_q, 1'b1} | {1'b0, gap_q, 1'b1} + {1'b0, ~width_q, 1'b0}
// mutation: biss/biss_frame_sampler.sv | : turn && least); | : 1'b0);
// mutation: biss/biss_frame_sampler.sv | assign open  = turn && !mark; | assign open  = turn;
// mutation: biss/biss_frame_sampler.sv | oldest = marks_q[9]; | oldest = marks_q[8];
// mutation: biss/biss_frame_sampler.sv | assign mark   = oldest | assign mark   = 1'b0
// mutation: biss/biss_frame_sampler.sv | wider_q && place_q != 5'd0 | wider_q
// mutation: biss/biss_frame_sampler.sv | open ? place_q : place_q - 5'd1; | place_q;

module proof (
  input logic       clk_i,
  input logic       rst_ni,
  input logic       sl_i,
  input logic       clear_i,
  input logic [3:0] guess_i,
  input logic       ack_i
);

  localparam logic [4:0] PERIOD = 5'd10;

  logic       usable, rose, bit_valid, frame_bit, eye_valid;
  logic [4:0] width, point, last;

  biss_frame_sampler u_dut (
    .clk_i, .rst_ni, .sl_i, .half_last_i (8'd4), .bit_last_i (7'd5), .run_i (1'b1), .clear_i, .ack_i,
    .usable_o (usable), .started_o (rose), .bit_valid_o (bit_valid), .bit_o (frame_bit),
    .eye_valid_o (eye_valid), .eye_width_o (width), .eye_point_o (point)
  );

  logic       started = 1'b0;
  logic       sl_q, ack_q, clear_q, rose_q;
  logic [3:0] place_q;
  logic       right_q;     // the guess
  logic [9:0] edges_q;     // by place
  logic [5:0] run_q;       // clocks since the start bit rose, once it has come

  always @* begin
    assume (rst_ni == started);
    assume (guess_i < 4'd10);
    if (started) begin
      if (clear_q)    assume (!ack_i);
      else if (ack_q) assume (ack_i);
      else if (sl_q)  assume (!ack_i);
    end
  end

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {sl_q, ack_q, clear_q, rose_q, right_q, edges_q, run_q} <= {1'b1, 1'b0, 1'b1, 1'b0, 1'b1, 10'd0, 6'd3};
      place_q <= guess_i;
    end else begin
      {sl_q, ack_q, clear_q, rose_q} <= {sl_i, ack_i, clear_i, rose};
      place_q <= clear_i ? guess_i : (place_q == 4'd9 ? 4'd0 : place_q + 4'd1);
      right_q <= clear_i || (right_q && !(rose && !rose_q && place_q != 4'd3));
      if (clear_i || !rose)    run_q <= 6'd3;
      else if (run_q != 6'd63) run_q <= run_q + 6'd1;
      if (clear_i) edges_q <= '0;
      // Up to the end of the last bit.
      else if (sl_i != sl_q && !(rose && run_q >= 6'd30)) edges_q <= edges_q | (10'd1 << place_q);
    end
  end
  always @(posedge clk_i) started <= 1'b1;

  // Gaps by their first place and their width: no edge between their places.
  logic [4:0] first;
  logic       inside, wider, before, clean;
  always @* begin
    last   = point + {1'b0, width[4:1]};
    first  = last + 5'd1 - width;
    inside = 1'b0;
    wider  = 1'b0;
    before = 1'b0;
    for (int a = 0; a < 10; a++) begin
      if (5'(a) > first && 5'(a) <= last && edges_q[a]) inside = 1'b1;
      clean = 1'b1;
      for (int w = 1; w <= 10 - a; w++) begin
        if (w > 1 && edges_q[a + w - 1]) clean = 1'b0;
        if (clean && 5'(w) > width) wider = 1'b1;
        if (clean && 5'(w) == width && 5'(a) < first) before = 1'b1;
      end
    end
  end

  always @* if (started && right_q && eye_valid && rose_q) begin
    Start_A:  assert (edges_q[0]);
    Range_A:  assert (width != 5'd0 && width <= PERIOD && last < PERIOD && first <= last);
    Inside_A: assert (!inside);
    Widest_A: assert (!wider);
    First_A:  assert (!before);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Wide_C:   cover (right_q && eye_valid && width == 5'd10);
    Middle_C: cover (right_q && eye_valid && width == 5'd4 && last == 5'd6);
    Narrow_C: cover (right_q && eye_valid && width == 5'd2);
    End_C:    cover (right_q && eye_valid && width == 5'd5 && last == 5'd9);
  end

endmodule
