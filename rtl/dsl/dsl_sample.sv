// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Tracks where the bits of an answer begin: the place of an edge between two bits, as the number of
// a sample with five bits behind the point, by the mean distance of all edges from it.
//
// Clock domain: core. From the last sample of a window to done_o are 11 to 44 clocks; place_o
// changes only in between, but for the first window, whose first low level sets it.
//
// The first window of START (after forget_i) only measures: its first 0 is the place, and its edges
// then move the place twice. In each other window they move it once, with linked_i by
// 2 eighths at most; with words_i the answer stays where it fits. An edge belongs to the nearest
// begin of a bit.
// The first 64 edges count; less than 8 move nothing. Edges count from three samples before the
// place to the end of 61 bits.
//
// How: a small memory counts the edges of each eighth of a bit. At the window's end the counts are
// added up by their distance; sum and count are divided. Seven distances above the lowest one, with
// five bits behind the point, are the quotient. In the first window the edges near the end of the
// answer are kept apart, one bit an eighth: which of them count depends on the place.
//
// Misuse: a window that begins before done_o spoils both.
// Source: docs/dsl.md, "How much it takes".

module dsl_sample (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             forget_i,
  input  logic             start_i,     // the window is one of START
  input  logic             linked_i,    // ... of a link
  input  logic             words_i,     // ... that brings words
  input  dsl_pkg::stream_t stream_i,
  output logic             first_o,     // the window only measures
  output logic             found_o,     // ... and had a 0
  output logic [11:0]      place_o,
  output logic             fits_o,      // a whole answer fits into the window
  output logic             done_o
);

  // Samples from the one behind the place on.
  localparam logic [6:0]  NEAR_END  = 7'd60;   // eighths: the place moves by less than half of one
  localparam logic [6:0]  TOO_LATE  = 7'h70;   // no answer fits here, nor eight samples earlier
  localparam logic [6:0]  FIRST_FIT = 7'd4;
  localparam logic [6:0]  LAST_FIT  = 7'd91;
  localparam logic [3:0]  SUM_LAST  = 4'd8;
  localparam logic [3:0]  DIV_LAST  = 4'd7;

  typedef enum logic [2:0] {
    COUNT,
    SUM,
    DIVIDE,
    MOVE,
    BOUND,
    ADD,
    LIMIT
  } state_e;

  state_e      state_d, state_q;
  logic [3:0]  step_d, step_q;
  logic [12:0] place_d, place_q;     // the highest bit is a sign, between ADD and LIMIT
  logic [2:0]  before_q;             // the first window's place, lowest bits
  logic        measured_q;           // the first window has been
  logic        found_d, found_q;
  logic        again_d, again_q;     // the second move of the first window
  logic [6:0]  count_d, count_q;     // edges
  logic [5:0]  rest_d, rest_q;       // sum of the distances above the point; remainder
  logic [8:0]  quot_d, quot_q;       // ... below it; quotient; the move, signed

  // Edges.
  logic        zero_now;             // the first 0 of the first window
  logic        late;                 // ... too late
  logic [9:0]  away;                 // of the next sample from the one behind the place
  logic        near_end_q, inside_q; // of this sample; of the next one: it follows the first 0
  logic        near_end;
  logic        ranged;
  logic        counts;
  logic        wr_en;
  logic [2:0]  wr_addr, rd_addr;
  logic [7:0]  wr_data, rd_data;     // an edge near the end; the count

  assign first_o  = start_i && !measured_q;
  assign zero_now = stream_i.valid && first_o && !found_q && !stream_i.levels[0];
  assign late     = stream_i.number[9:7] != 3'd0 || stream_i.number[6:4] == TOO_LATE[6:4];
  assign away     = stream_i.number - {3'd0, place_q[11:5]};
  assign near_end = first_o && found_q && near_end_q;
  assign ranged   = first_o ? zero_now || (found_q && inside_q) : inside_q;
  assign counts   = stream_i.valid && ranged && stream_i.levels[0] != stream_i.levels[1]
                 && stream_i.number != 10'd0 && !count_q[6];

  assign wr_en    = state_q == COUNT;
  assign wr_addr  = stream_i.number[2:0];
  assign wr_data  = stream_i.valid ? {rd_data[7] || (counts && near_end),
                                      rd_data[6:0] + 7'(counts && !near_end)} : 8'd0;

  // 64 words, eight of which are used: a block RAM.
  enc_ram #(.Width(8), .AddrW(6)) u_counts (
    .wr_clk_i  (clk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i ({3'd0, wr_addr}),
    .wr_data_i (wr_data),
    .rd_clk_i  (clk_i),
    .rd_en_i   (1'b1),
    .rd_addr_i ({3'd0, rd_addr}),
    .rd_data_o (rd_data)
  );

  // Eighths in the order of their distance, the highest one first: 3 or, if the place is no whole
  // sample, 4 samples away, down to seven less.
  logic       part;
  logic [2:0] summed;                // the eighth whose count is there
  logic [2:0] behind;                // of its edge near the end, from NEAR_END on
  logic [2:0] limit;                 // the end is there
  logic       at_end;                // that edge counts
  assign part    = place_q[4:0] != 5'd0;
  assign summed  = 3'd4 + 3'(part) + place_q[7:5] - step_q[2:0];
  assign rd_addr = state_q == COUNT ? wr_addr + 3'd1 : summed - 3'd1;
  assign behind  = summed - before_q - 3'd1;
  assign limit   = place_q[7:5] - before_q + 3'd4;
  assign at_end  = rd_data[7] && behind < limit;

  // One adder for the sum and for the remainder.
  logic [6:0] counted;
  logic       low, high;             // the place is where no answer fits
  logic [8:0] sum;
  logic [5:0] reduced;
  logic       less, unused;
  logic [7:0] offset;                // of the lowest distance and the place's part
  logic [8:0] move;
  logic       unused0, unused1;      // one chain each: a bit below the lowest one brings the carry
  logic       unused2;
  logic [12:0] added;
  logic       rounds;                // towards 0
  assign {counted, unused0} = {count_q, 1'b1}
                          + {state_q == COUNT ? 7'd0 : rd_data[6:0],
                             state_q == COUNT ? counts : at_end};
  // A comparison is a chain of carries, so those with a constant stand here as what they are: the
  // place is below FIRST_FIT, above LAST_FIT.
  assign low     = place_q[12] || place_q[11:7] == 5'd0;
  assign high    = place_q[11] && (place_q[10] || place_q[9:7] == 3'b111);
  assign sum     = {rest_q, quot_q[7:5]} + {2'd0, count_q};
  assign {less, unused, reduced} = {1'b0, rest_q, quot_q[7]} - {1'b0, count_q};
  assign offset  = {!part, part, part, place_q[4:0]};
  assign move    = quot_q;
  assign unused2 = ^away[1:0];
  assign rounds  = move[8] && rest_q != 6'd0;
  assign {added, unused1} = {place_q, 1'b1} + {{4{move[8]}}, move, rounds};

  always_comb begin
    state_d = state_q;
    step_d  = step_q + 4'd1;
    place_d = place_q;
    found_d = found_q;
    again_d = again_q;
    count_d = count_q;
    rest_d  = rest_q;
    quot_d  = quot_q;
    unique case (state_q)
      COUNT: begin
        // The window runs, or the memory is cleared.
        step_d  = 4'd0;
        again_d = 1'b0;
        count_d = stream_i.valid ? counted : 7'd0;
        if (zero_now) begin
          found_d = 1'b1;
          place_d = {1'b0, stream_i.number[6:0] | (TOO_LATE & {7{late}}), 5'd0};
        end
        if (stream_i.valid && stream_i.number == dsl_pkg::LAST_SAMPLE) state_d = SUM;
      end
      SUM: begin
        // Each count is added to the count of all, and this one to the sum.
        count_d               = counted;
        {rest_d, quot_d[7:5]} = sum;
        if (step_q == 4'd0) begin
          count_d = 7'd0;
          rest_d  = 6'd0;
          quot_d  = 9'd0;
        end
        if (step_q == SUM_LAST) begin
          state_d = DIVIDE;
          step_d  = 4'd0;
        end
      end
      DIVIDE: begin
        rest_d = less ? {rest_q[4:0], quot_q[7]} : reduced;
        quot_d = {1'b0, quot_q[6:0], !less};
        if (step_q == DIV_LAST) state_d = MOVE;
        if (count_q[6:3] == 4'd0) state_d = LIMIT;    // fewer than 8
      end
      MOVE: begin
        quot_d  = quot_q - {1'b0, offset};
        state_d = BOUND;
      end
      BOUND: begin
        // Two eighths are 64.
        if (linked_i && move[7:6] != {2{move[8]}}) begin
          quot_d = move[8] ? -9'd64 : 9'd64;
          rest_d = 6'd0;
        end
        state_d = ADD;
      end
      ADD: begin
        place_d = added;
        state_d = LIMIT;
      end
      default: begin
        // The place is where it has to be, or is brought there.
        if (words_i && low)         place_d = {1'b0, FIRST_FIT, 5'd0};
        else if (words_i && high)   place_d = {1'b0, LAST_FIT, 5'd31};
        else if (place_q[12])       place_d = 13'd0;
        again_d = first_o;
        step_d  = 4'd0;
        state_d = first_o && !again_q ? SUM : COUNT;
      end
    endcase
    if (forget_i) begin
      place_d = 13'd0;
      found_d = 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q    <= COUNT;
      step_q     <= '0;
      place_q    <= '0;
      before_q   <= '0;
      measured_q <= 1'b0;
      found_q    <= 1'b0;
      again_q    <= 1'b0;
      near_end_q <= 1'b0;
      inside_q   <= 1'b0;
      count_q    <= '0;
      rest_q     <= '0;
      quot_q     <= '0;
    end else begin
      state_q    <= state_d;
      step_q     <= step_d;
      place_q    <= place_d;
      if (zero_now) before_q <= place_d[7:5];
      measured_q <= (measured_q || (done_o && start_i)) && !forget_i;
      found_q    <= found_d;
      again_q    <= again_d;
      near_end_q <= !zero_now && away[9:3] == NEAR_END;
      // Up to NEAR_END, all of its eighth or half of it; in front of the place three samples more.
      inside_q   <= zero_now || (!first_o && away[9:2] == 8'hFF)
                 || (!away[9] && !(away[8:5] == NEAR_END[5:2]
                                   && (away[4:3] != 2'd0 || (away[2] && !first_o))));
      count_q    <= count_d;
      rest_q     <= rest_d;
      quot_q     <= quot_d;
    end
  end

  assign found_o = found_q;
  assign place_o = place_q[11:0];
  assign fits_o  = !low && !high;
  assign done_o  = state_q == LIMIT && state_d == COUNT;

endmodule
