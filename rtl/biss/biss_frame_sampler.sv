// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SL input of one line, sampled by frame: records the whole frame, then takes its bits in the
// middle of the widest gap between the places at which edges came. biss_delay_sampler goes on
// beside it: it finds the acknowledge and ends MA.
//
// Clock domain: core. sl_i is synchronised and has no pulses of one or two clocks
// (biss_delay_sampler with Median = 1). A bit is longer: a stray pulse leaves no mark.
//
// - Ring: each clock from clear_i on writes one sample, 16 to a row of a block RAM of 4,096.
// - Start bit: the first three samples of 1 in a row after the acknowledge; started_o stays 1 from
//   then on. A bit has P = 2 (half_last_i + 1) clocks. Its places count from 0, the clock in which
//   the start bit rose.
// - Marks: marks_q has one bit for each of the last P clocks: in this frame an edge came at this
//   place. It turns by one place a clock.
// - Gap: during the last bit of the frame all marks go by, with the edges of this time. The widest
//   gap between two of them counts, of several the first one. Place 0 has a mark: no gap goes
//   over it. Point: the middle of the gap, or half a clock before it.
// - Bits: one a clock from the third bit on (behind start bit and CDS), until clear_i. The first
//   one is valid four clocks after the last bit has ended in sl_i. A bit whose row is not written
//   yet is waited for, 16 clocks at most.
// - eye_valid_o: the eye is that of this frame. It is 1 from two clocks before the first bit on.
//
// run_i = 0: nothing changes.
// usable_o: P is 10 to 20. Outside of it started_o, bit_valid_o and eye_valid_o stay 0.
//
// Misuse: half_last_i and bit_last_i must not change while a frame runs. Bits behind the last one
// mean nothing.
// Source: docs/samplers.md.

`include "enc_check.svh"

module biss_frame_sampler (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       sl_i,         // level
  input  logic [7:0] half_last_i,  // clocks of half an MA period minus 1
  input  logic [6:0] bit_last_i,   // number of the last CRC bit; the start bit has 3
  // frame
  input  logic       run_i,        // the line is not at rest
  input  logic       clear_i,      // with run_i: a frame begins
  input  logic       ack_i,        // the acknowledge has come
  // results
  output logic       usable_o,
  output logic       started_o,    // the start bit has come
  output logic       bit_valid_o,
  output logic       bit_o,
  output logic       eye_valid_o,
  output logic [4:0] eye_width_o,  // the widest gap, in clocks
  output logic [4:0] eye_point_o   // place of the point
);

  localparam int unsigned MOST   = 20;  // clocks of a bit
  localparam int unsigned TIME_W = 12;  // samples in the ring
  localparam int unsigned ROW_W  = 4;   // samples in a row
  localparam logic [6:0]  START  = 7'd3;
  localparam logic [6:0]  CDS    = 7'd4;

  logic       usable;
  logic [4:0] last;              // P - 1
  logic       before_q;          // sl_i
  logic [1:0] ones_q;            // the last two samples were 1
  logic       start;
  logic       started_q;
  logic [4:0] place_q;           // of this clock
  logic       turn;              // the last place
  logic [6:0] bit_q;             // number of the bit
  logic       data_q;            // start bit and CDS are over
  logic [MOST-1:0] marks_q;
  logic       oldest;            // mark of P clocks ago
  logic       mark;              // this place has one
  logic       scan;              // the last bit
  logic       open;              // at the end of the last bit, without a mark
  logic [4:0] gap_q;             // clocks since the last mark
  logic [4:0] width_q;           // the widest gap so far
  logic [4:0] last_q;            // its last place
  logic       least;             // a gap of one clock more is wider
  logic       wider_q;           // gap_q is wider than width_q
  logic       found;             // the widest gap so far ends
  logic [5:0] unused_sum;
  logic       point_q;
  logic       read_q;
  logic [TIME_W-1:0] now_q;      // of this sample
  logic [TIME_W-1:0] time_q;     // of the bit to read
  logic [TIME_W-1:0] time_sum;
  logic       unused_carry;
  logic [4:0] point;
  logic [4:0] step;
  logic       move;
  logic       write;
  logic [14:0] row_q;            // samples of the row so far
  logic [15:0] row;              // as read
  logic       fetch;
  logic       fetched_q;
  logic [ROW_W-1:0] at_q;
  logic       bit_valid_q;
  logic       level_q;

  // ---- places and marks ---------------------------------------------------------------------

  assign usable = half_last_i >= 8'd4 && half_last_i <= 8'd9;
  assign last   = {half_last_i[3:0], 1'b1};
  assign start  = ack_i && usable && !started_q && ones_q == 2'b11 && sl_i;
  assign turn   = place_q == last;
  assign mark   = oldest || sl_i != before_q;

  always_comb begin
    unique case (half_last_i[3:0])
      4'd4:    oldest = marks_q[9];
      4'd5:    oldest = marks_q[11];
      4'd6:    oldest = marks_q[13];
      4'd7:    oldest = marks_q[15];
      4'd8:    oldest = marks_q[17];
      default: oldest = marks_q[19];
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      before_q  <= 1'b1;
      ones_q    <= '0;
      started_q <= 1'b0;
      place_q   <= '0;
      bit_q     <= '0;
      data_q    <= 1'b0;
      marks_q   <= '0;
    end else if (run_i) begin
      before_q  <= sl_i;
      ones_q    <= {ones_q[0] && sl_i, ack_i && sl_i};
      started_q <= !clear_i && (started_q || start);
      // The start bit rose two clocks before start.
      if (!started_q && !start) place_q <= 5'd2;
      else                      place_q <= turn ? 5'd0 : place_q + 5'd1;
      if (!started_q)           bit_q   <= START;
      else if (turn)            bit_q   <= bit_q + 7'd1;
      data_q    <= !clear_i && started_q && (data_q || (turn && bit_q == CDS));
      marks_q   <= clear_i ? '0 : {marks_q[MOST-2:0], mark};
    end
  end

  // ---- the widest gap -----------------------------------------------------------------------

  assign scan  = started_q && !point_q && !read_q && bit_q == bit_last_i;
  assign open  = turn && !mark;
  assign found = scan && (mark ? wider_q && place_q != 5'd0 : turn && least);

  // The carry of this sum compares: gap_q + 1 > width_q.
  assign {least, unused_sum} = {1'b0, gap_q, 1'b1} + {1'b0, ~width_q, 1'b1};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      gap_q   <= '0;
      wider_q <= 1'b0;
      width_q <= '0;
      last_q  <= '0;
      point_q <= 1'b0;
      read_q  <= 1'b0;
    end else if (run_i) begin
      gap_q   <= mark ? 5'd1 : gap_q + 5'd1;
      // Behind a mark no gap has been found before only at place 0.
      wider_q <= mark ? place_q == 5'd0 : least;
      if (!started_q) begin
        width_q <= '0;
        last_q  <= '0;
      end else if (found) begin
        width_q <= gap_q + 5'(open);
        last_q  <= open ? place_q : place_q - 5'd1;
      end
      point_q <= !clear_i && scan && turn;
      read_q  <= !clear_i && (read_q || point_q);
    end
  end

  // ---- ring ---------------------------------------------------------------------------------

  // From the mark behind the gap back by half of it and one more; last_q is one before it. It means
  // something when the last bit is over.
  assign point = last_q - {1'b0, width_q[4:1]};

  // time_q follows the samples to place 0 of the third bit, then goes to the point, then from bit
  // to bit.
  assign step = (point & {5{point_q}}) | (last & {5{read_q}});
  assign {time_sum, unused_carry} = {time_q, 1'b1} + {7'd0, step, !point_q};
  assign fetch = read_q && time_q[TIME_W-1:ROW_W] != now_q[TIME_W-1:ROW_W];
  assign move  = !data_q || point_q || fetch;
  assign write = run_i && &now_q[ROW_W-1:0];

  enc_ram #(.Width(1 << ROW_W), .AddrW(TIME_W - ROW_W)) u_ring (
    .wr_clk_i  (clk_i),
    .wr_en_i   (write),
    .wr_addr_i (now_q[TIME_W-1:ROW_W]),
    .wr_data_i ({sl_i, row_q}),
    .rd_clk_i  (clk_i),
    .rd_en_i   (1'b1),
    .rd_addr_i (time_q[TIME_W-1:ROW_W]),
    .rd_data_o (row)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      now_q       <= '0;
      time_q      <= '0;
      row_q       <= '0;
      at_q        <= '0;
      fetched_q   <= 1'b0;
      bit_valid_q <= 1'b0;
      level_q     <= 1'b0;
    end else if (run_i) begin
      now_q       <= clear_i ? '0 : now_q + 12'd1;
      if (clear_i)   time_q <= '0;
      else if (move) time_q <= time_sum;
      row_q       <= {sl_i, row_q[14:1]};
      at_q        <= time_q[ROW_W-1:0];
      fetched_q   <= fetch && !clear_i;
      bit_valid_q <= fetched_q && !clear_i;
      level_q     <= row[at_q];
    end
  end

  assign usable_o    = usable;
  assign started_o   = started_q;
  assign bit_valid_o = bit_valid_q;
  assign bit_o       = level_q;
  assign eye_valid_o = read_q;
  assign eye_width_o = width_q;
  assign eye_point_o = point;

  `ENC_ASSERT_IF(OnlyWhereUsable_A, clk_i, rst_ni, read_q, started_q)

endmodule
