// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The AXI4-Stream source with its FIFO (enc_axis_fifo) against a queue, for any pushes and any sink.
// The FIFO of the proof holds 4 beats behind the output; a beat has 3 bits of data.
//
// claim: what leaves is what was pushed, in that order, once; a beat at the output stays unchanged
//   until it is taken; one is lost only if 4 wait behind the output, and room_o says how many more fit
// clocks: one
// depth: 9
// cover: 9
// unbounded: reachability
// mutation: common/enc_axis_fifo.sv | take  = !valid_q || m_axis_tready; | take  = m_axis_tready;
// mutation: common/enc_axis_fifo.sv | store = push_i && !full; | store = push_i;
// mutation: common/enc_axis_fifo.sv | .rd_en_i   (take && waits), | .rd_en_i   (waits),
// mutation: common/enc_axis_fifo.sv | if (take && waits) rd_q | if (take) rd_q
// mutation: common/enc_axis_fifo.sv | valid_q <= waits; | valid_q <= waits || push_i;
// mutation: common/enc_axis_fifo.sv | - (wr_q - rd_q); | - (rd_q - wr_q);

module proof (
  input logic       clk_i,
  input logic       rst_ni,
  input logic       push_i,
  input logic [2:0] beat_i,   // data, last
  input logic       ready_i
);

  logic       valid, last, user;
  logic [1:0] data;
  logic [2:0] room;

  enc_axis_fifo #(.DataW(1), .UserW(1), .Depth(4)) u_dut (
    .clk_i, .rst_ni, .push_i,
    .data_i (beat_i[2]), .user_i (beat_i[1]), .last_i (beat_i[0]),
    .room_o (room),
    .m_axis_tvalid (valid), .m_axis_tready (ready_i),
    .m_axis_tdata (data[0]), .m_axis_tuser (user), .m_axis_tlast (last)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  // The queue: the oldest beat lowest. It has room for the output and 4 more.
  logic [14:0] queue_q;
  logic [2:0]  count_q;
  logic        fresh_q;   // one of them has come in the clock before: the output cannot have it
  wire         pop    = count_q > {2'd0, fresh_q} && ready_i;
  wire         accept = push_i && count_q != 3'd5;
  wire [14:0]  rest   = pop ? {3'd0, queue_q[14:3]} : queue_q;
  wire [2:0]   left   = pop ? count_q - 3'd1 : count_q;
  always @(posedge clk_i) begin
    queue_q <= rest;
    count_q <= left;
    fresh_q <= accept;
    if (accept) begin
      queue_q <= (rest & ~(15'd7 << 3 * left)) | ({12'd0, beat_i} << 3 * left);
      count_q <= left + 3'd1;
    end
    if (!rst_ni) {count_q, fresh_q} <= '0;
  end

  // The output before this clock, if it was not taken.
  logic       held_q;
  logic [2:0] was_q;
  always @(posedge clk_i) begin
    held_q <= valid && !ready_i && rst_ni;
    was_q  <= {data[0], user, last};
  end

  always @* if (rst_ni && started) begin
    Valid_A:   assert (valid == (count_q > {2'd0, fresh_q}));
    if (valid) Beat_A: assert ({data[0], user, last} == queue_q[2:0]);
    if (held_q) Stays_A: assert (valid && {data[0], user, last} == was_q);
    Room_A: assert (room == 3'd4 + {2'd0, valid} - count_q);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Full_C:    cover (count_q == 3'd5 && ready_i);
    Lost_C:    cover (push_i && count_q == 3'd5);
    Past_C:    cover (push_i && count_q == 3'd1 && ready_i);
  end

endmodule
