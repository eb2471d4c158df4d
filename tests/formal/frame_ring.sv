// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The ring of biss_frame_sampler: whatever SL does, a frame that has its start bit gives each of its bits, as
// SL was in the middle of the widest gap that the block tells (frame_gap proves that it is the widest). Any
// number of clocks may pass before the start bit, any frame may follow any other one, and clear_i may come in
// each clock. All of half_last_i and bit_last_i, 5 to 127 (a channel has 86 at most).
//
// The bench counts the clocks from the start bit on. It keeps one sample, behind any number of clocks, and
// compares the bit that is read from there. The memory of the proof keeps one row, any of its 256; it gives
// anything for each other one, and for a row that is written in the clock in which it is read.
//
// claim: a frame that has its start bit gives each of its bits, in their order, bit n (from 0) n + 4 to n + 18 clocks
//   behind the end of the last one; each is what SL was at its place in the middle of the gap that is told, or half a
//   clock before; its row of the ring is whole when it is read, and not written again
// clocks: one
// depth: 24
// cover: 90
// unbounded: induction 1 each
// keep: common/enc_ram.sv | (* no_rw_check *) logic [Width-1:0] mem [0:(1 << AddrW)-1];
//   | (* anyconst *) logic [AddrW-1:0] kept; (* anyseq *) logic [Width-1:0] other; logic [Width-1:0] mem;
// keep: common/enc_ram.sv | if (wr_en_i) mem[wr_addr_i] <= wr_data_i;
//   | if (wr_en_i && wr_addr_i == kept) mem <= wr_data_i;
// keep: common/enc_ram.sv | if (rd_en_i) rd_data_q <= mem[rd_addr_i];
//   | if (rd_en_i) rd_data_q <= rd_addr_i != kept || (wr_en_i && wr_addr_i == kept) ? other : mem;
// look: kept_row = u_dut.u_ring.kept
// look: kept_data = u_dut.u_ring.mem
// look: row = u_dut.row
// look: before = u_dut.before_q
// look: ones = u_dut.ones_q
// look: place = u_dut.place_q
// look: number = u_dut.bit_q
// look: data = u_dut.data_q
// look: marks = u_dut.marks_q
// look: gap = u_dut.gap_q
// look: eye_last = u_dut.last_q
// look: point_now = u_dut.point_q
// look: now = u_dut.now_q
// look: then_at = u_dut.time_q
// look: begun_row = u_dut.row_q
// look: column = u_dut.at_q
// look: fetch = u_dut.fetch
// look: fetched = u_dut.fetched_q
// mutation: biss/biss_frame_sampler.sv | assign fetch = read_q && time_q[TIME_W-1:ROW_W] != now_q[TIME_W-1:ROW_W];
//   | assign fetch = read_q;
// mutation: biss/biss_frame_sampler.sv | data_q    <= !clear_i && started_q && | data_q    <= started_q &&
// mutation: biss/biss_frame_sampler.sv | point_q <= !clear_i && scan && turn; | point_q <= scan && turn;
// mutation: biss/biss_frame_sampler.sv | last_q - {1'b0, width_q[4:1]} | last_q - {1'b0, width_q[4:1]} - 5'd1
// mutation: biss/biss_frame_sampler.sv | {sl_i, row_q}), | {row_q, sl_i}),
// mutation: biss/biss_frame_sampler.sv | !started_q && ones_q == 2'b11 && sl_i; | !started_q && ones_q[0] && sl_i;
// mutation: biss/biss_frame_sampler.sv | at_q        <= time_q[ROW_W-1:0]; | at_q        <= time_sum[ROW_W-1:0];

module proof (
  input logic       clk_i,
  input logic       rst_ni,
  input logic       sl_i,
  input logic [7:0] half_last_i,
  input logic [6:0] bit_last_i,
  input logic       clear_i,
  input logic       ack_i
);

  localparam logic [11:0] FOREVER = 12'hFFF;  // clocks from the start bit on, or more
  localparam logic [11:0] WAIT    = 12'd14;   // clocks that the reading waits for a row, at most

  (* anyconst *) logic [11:0] when;           // the sample that the bench keeps: clocks behind the start bit

  logic        usable, rose, bit_valid, frame_bit, eye_valid;
  logic [4:0]  eye_width, eye_point;

  biss_frame_sampler u_dut (
    .clk_i, .rst_ni, .sl_i, .half_last_i, .bit_last_i, .run_i (1'b1), .clear_i, .ack_i,
    .usable_o (usable), .started_o (rose), .bit_valid_o (bit_valid), .bit_o (frame_bit),
    .eye_valid_o (eye_valid), .eye_width_o (eye_width), .eye_point_o (eye_point)
  );

  wire [7:0]  kept_row;
  wire [15:0] kept_data, row;
  wire        before;
  wire [1:0]  ones;
  wire [4:0]  place, gap, eye_last;
  wire [6:0]  number;
  wire [19:0] marks;
  wire        data, point_now, fetch, fetched;
  wire [11:0] now, then_at;
  wire [14:0] begun_row;
  wire [3:0]  column;

  // ---- what comes to the block ----------------------------------------------------------------

  logic       started = 1'b0;
  logic [1:0] sl_q;        // one and two clocks ago
  logic [1:0] ack_q;
  logic       clear_q;
  logic [7:0] half_last_q;
  logic [6:0] bit_last_q;
  logic       same_q;      // half_last_i and bit_last_i are as in the clock behind clear_i
  logic       same;

  always @* begin
    assume (rst_ni == started);
    // The acknowledge ends with clear_i. It comes one clock behind a 0, and stays.
    if (started) begin
      if (clear_q)       assume (!ack_i);
      else if (ack_q[0]) assume (ack_i);
      else if (sl_q[0])  assume (!ack_i);
    end
    same = (clear_q || (same_q && half_last_i == half_last_q && bit_last_i == bit_last_q)) && bit_last_i >= 7'd5;
  end

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {sl_q, ack_q, clear_q, same_q} <= {2'b11, 2'b00, 1'b1, 1'b1};
    else         {sl_q, ack_q, clear_q, same_q} <= {sl_q[0], sl_i, ack_q[0], ack_i, clear_i, same};
  end
  always @(posedge clk_i) begin
    started     <= 1'b1;
    half_last_q <= half_last_i;
    bit_last_q  <= bit_last_i;
  end

  // ---- the frame ------------------------------------------------------------------------------

  logic        begins, runs_q;
  logic [11:0] run_q;      // clocks since the start bit rose
  logic [6:0]  got_q;      // bits that have come
  logic [6:0]  bits;       // of the frame
  logic [2:0]  half;       // half_last_i, which is 4 to 9
  logic [4:0]  period;
  logic [11:0] first, over;
  logic [4:0]  middle;     // rounded down
  logic        unused_half;

  // As clocks, for 10 to 20 clocks a bit.
  function automatic logic [11:0] times(logic [6:0] count, logic [2:0] half);
    case (half)
      3'd4:    times = {2'd0, count, 3'd0} + {4'd0, count, 1'd0};
      3'd5:    times = {2'd0, count, 3'd0} + {3'd0, count, 2'd0};
      3'd6:    times = {1'd0, count, 4'd0} - {4'd0, count, 1'd0};
      3'd7:    times = {1'd0, count, 4'd0};
      3'd0:    times = {1'd0, count, 4'd0} + {4'd0, count, 1'd0};
      default: times = {1'd0, count, 4'd0} + {3'd0, count, 2'd0};
    endcase
  endfunction

  always @* begin
    begins = !runs_q && half_last_i >= 8'd4 && half_last_i <= 8'd9 && ack_i && ack_q == 2'b11 && sl_i && sl_q == 2'b11;
    half   = half_last_i[2:0];
    period = {half_last_i[3:0], 1'b1} + 5'd1;
    bits   = bit_last_i - 7'd4;
    first  = times(7'd2, half);                 // begin of the bit behind start bit and CDS
    over   = times(bit_last_i - 7'd2, half);    // the first clock behind the last bit
    // Between the first place and the last one of the gap.
    {middle, unused_half} = 6'(eye_last) + 6'(eye_last) + 6'd1 - 6'(eye_width);
  end

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {runs_q, run_q, got_q} <= {1'b0, 12'd2, 7'd0};
    else begin
      runs_q <= !clear_i && (runs_q || begins);
      if (clear_i || !(runs_q || begins)) run_q <= 12'd2;
      else if (run_q != FOREVER)          run_q <= run_q + 12'd1;
      if (clear_i)                        got_q <= '0;
      else if (bit_valid && got_q < bits) got_q <= got_q + 7'd1;
    end
  end

  // ---- one sample -----------------------------------------------------------------------------

  logic       seen_q, sample_q;
  logic [3:0] column_q;    // of the sample

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) seen_q <= 1'b0;
    else         seen_q <= !clear_i && (seen_q || (runs_q && run_q == when && now[11:4] == kept_row));
  end
  always @(posedge clk_i) if (runs_q && run_q == when) begin
    sample_q <= sl_i;
    column_q <= now[3:0];
  end

  // ---- claims ---------------------------------------------------------------------------------

  always @* if (started && same) begin
    Usable_A:  assert (usable == (half_last_i >= 8'd4 && half_last_i <= 8'd9));
    if (!usable) Unusable_A: assert (!rose && !bit_valid && !eye_valid);
    Started_A: assert (rose == runs_q);
    Eye_A:     assert (eye_valid == (runs_q && run_q > over));
    Point_A:   assert (eye_point == middle);
    if (bit_valid) Early_A: assert (runs_q && run_q >= over + 12'd3 + 12'(got_q));
    if (runs_q && got_q < bits) Late_A: assert (run_q <= over + 12'd3 + 12'(got_q) + WAIT);
    if (bit_valid && got_q < bits && seen_q && when == first + 12'(middle) + times(got_q, half))
      Bit_A: assert (frame_bit == sample_q);
  end

  // The bit that is read now, and its age.
  logic [6:0]  asked;
  logic [11:0] age;
  logic [11:0] place_asked_q, place_fetched_q, place_valid_q;   // clocks behind the start bit
  always @(posedge clk_i) begin
    if (point_now)  place_asked_q <= first + 12'(middle);
    else if (fetch) place_asked_q <= place_asked_q + 12'(period);
    place_fetched_q <= place_asked_q;
    place_valid_q   <= place_fetched_q;
  end
  always @* begin
    asked = got_q + 7'(bit_valid) + 7'(fetched);
    age   = run_q - place_asked_q;
  end

  always @* if (started && same && eye_valid && asked < bits) begin
    Whole_A: assert (age != 12'd0 && 13'(age) + 13'(then_at[3:0]) < 13'd4096);
    Time_A:  assert (then_at + age == now);
  end

  // ---- steps of the induction -----------------------------------------------------------------

  logic [11:0] age_kept;
  logic [4:0]  shift;
  logic [6:0]  came;       // bits up to this clock
  always @* begin
    came     = got_q + 7'(bit_valid);
    age_kept = run_q - when;
    shift    = 5'd15 - age_kept[4:0];
  end

  always @* if (started) begin
    if (clear_q) Cleared_A: assert (!rose && !data && !point_now && !eye_valid && !fetched && !bit_valid && marks == 20'd0
                                    && now == 12'd0 && then_at == 12'd0);
    // What one bit more adds: the steps that follow need it of the clock before.
    if (usable) begin
      if (asked != 7'd127) MoreAsked_A: assert (times(asked + 7'd1, half) == times(asked, half) + 12'(period));
      if (came != 7'd127)  MoreCame_A:  assert (times(came + 7'd1, half) == times(came, half) + 12'(period));
      if (number >= 7'd3)  MoreRun_A:
        assert (times(number - 7'd2, half) == times(number - 7'd3, half) + 12'(period));
    end
    Before_A: assert (before == sl_q[0]);
    if (!rose) Only_A: assert (!data && !point_now && !eye_valid);
    Got_A: assert (!same || got_q <= bits);
    Ack_A: assert (!clear_q || got_q == 7'd0 && !runs_q && !seen_q && run_q == 12'd2);
    if (!runs_q && same) Rests_A: assert (run_q == 12'd2 && !seen_q && (clear_q || (place == 5'd2 && number == 7'd3)));
    if (!rose && same) Idle_A: assert (!data && !point_now && !eye_valid && !fetched && !bit_valid && got_q == 7'd0);
    if (rose != runs_q) Same_A: assert (!same);
    if (same && usable && ack_i && !rose) begin
      Ones_A: assert (ones == {ack_q == 2'b11 && sl_q == 2'b11, ack_q[0] && sl_q[0]});
      if (ones[0] && !ones[1]) Edge_A:  assert (marks[0]);
      if (ones[1])             Edges_A: assert (marks[1]);
    end
    if (marks[0])      Last_A:   assert (gap == 5'd1);
    else if (marks[1]) Second_A: assert (gap == 5'd2);
    if (!data && same) Follows_A: assert (then_at == now);
    if (same && rose) begin
      Begin_A: assert (usable && run_q > 12'd2);
      Place_A: assert (place < period && marks[place == 5'd0 ? period - 5'd1 : place - 5'd1]);
      Gap_A:   assert (gap != 5'd0 && gap <= (place == 5'd0 ? period : place));
      Told_A:  assert (eye_last < period && eye_width <= eye_last + 5'd1);
      if (run_q < over) begin
        Number_A: assert (number >= 7'd3 && number <= bit_last_i && run_q == times(number - 7'd3, half) + 12'(place)
                          && data == (number >= 7'd5) && !point_now && !eye_valid && !fetched && !bit_valid
                          && got_q == 7'd0);
      end else After_A: assert (data && point_now == (run_q == over));
      if (run_q <= over) Waits_A: assert (!fetched && !bit_valid && got_q == 7'd0
                                          && (!data || then_at + run_q - first == now));
      if (run_q > over) Asked_A: assert (run_q >= over + 12'd1 + 12'(asked));
      if (run_q > over && asked < bits) Bound_A: assert (run_q <= over + 12'd1 + 12'(asked) + WAIT);
    end
    if (same && seen_q && run_q != FOREVER) begin
      Kept_A: assert (rose && run_q > when && {kept_row, column_q} + age_kept == now);
      if (13'(age_kept) + 13'(column_q) < 13'd16) Row_A: assert (begun_row[shift[3:0]] == sample_q);
      else                                        Ring_A: assert (kept_data[column_q] == sample_q);
    end
    if (same && fetched && came < bits) begin
      Fetch_A: assert (run_q <= over + 12'd2 + 12'(came) + WAIT);
      FetchPlace_A: assert (place_fetched_q == first + 12'(middle) + times(came, half));
      if (seen_q && when == place_fetched_q) Fetched_A: assert (row[column] == sample_q);
    end
    if (same && bit_valid && got_q < bits) begin
      ValidPlace_A: assert (place_valid_q == first + 12'(middle) + times(got_q, half));
      if (seen_q && when == place_valid_q) Valid_A: assert (frame_bit == sample_q);
    end
    if (same && eye_valid && asked < bits) begin
      AskedPlace_A: assert (place_asked_q == first + 12'(middle) + times(asked, half));
      Room_A:   assert (place_asked_q < over && times(asked, half) + 12'(period) + first <= over);
    end
  end

  // ---- what can be reached --------------------------------------------------------------------

  logic second_q;          // a frame before this one has begun
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                second_q <= 1'b0;
    else if (clear_i && runs_q) second_q <= 1'b1;
  end

  always @(posedge clk_i) if (rst_ni) begin
    All_C:    cover (same && bit_valid && got_q == bits - 7'd1 && bits == 7'd2);
    Waits_C:  cover (same && runs_q && got_q < bits && run_q == over + 12'd15 + 12'(got_q));
    Second_C: cover (same && bit_valid && second_q);
    Sample_C: cover (same && bit_valid && got_q < bits && seen_q && !sample_q
                     && when == first + 12'(middle) + times(got_q, half));
  end

endmodule
