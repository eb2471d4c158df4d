// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The stream of the BiSS C master on AXI in mode 1 (axi_stream) up to its FIFO, for three channels with
// any words, any enables, any sink, any reads and any soft reset. What the FIFO does with a beat is proof
// `axis`. The words stay while busy_o is high, as the module asks; the enables may change.
//
// claim: each read puts one beat of each channel that is enabled with done_i into the FIFO, in ascending
//   order, one channel a clock from the clock after next on, with the channel's word, flags and number, tlast
//   at the last, or, if the FIFO has no room for all of them, none, and overrun_o tells; nothing else puts a
//   beat in, and the FIFO takes each
// clocks: one
// depth: 12
// cover: 12
// unbounded: reachability
// look: dut_push = u_dut.gen_beats.u_fifo.push_i
// look: dut_data = u_dut.gen_beats.u_fifo.data_i
// look: dut_user = u_dut.gen_beats.u_fifo.user_i
// look: dut_last = u_dut.gen_beats.u_fifo.last_i
// look: dut_index = u_dut.gen_beats.index_q
// mutation: axi/axi_stream.sv | .push_i    (run_q && now), | .push_i    (run_q),
// look: dut_room = u_dut.gen_beats.u_fifo.room_o
// mutation: axi/axi_stream.sv | now  = enabled_q[i]; | now  = enabled_i[i];
// mutation: axi/axi_stream.sv | if (index_q < INDEX_W'(i)) later | if (index_q != INDEX_W'(i)) later
// mutation: axi/axi_stream.sv | 32'(needed) <= 32'(room) | 32'(needed) <= 32'(room) + 32'd1
// mutation: axi/axi_stream.sv | needed = needed + 5'(enabled_i[i]); | needed = 5'(enabled_i[i]);
// mutation: axi/axi_stream.sv | overrun_q <= done_i && !clear_i && !fits; | overrun_q <= done_i && !fits;
// mutation: axi/axi_stream.sv | index_q + INDEX_W'(1) : '0; | index_q + INDEX_W'(1) : index_q;
// mutation: axi/axi_stream.sv | user         = {index_q, word | user         = {INDEX_W'(last_index), word
// mutation: axi/axi_stream.sv | user_out[USER_W-1:4]), 4'd0, | user_out[USER_W-1:4]), 4'd1,
// mutation: axi/axi_stream.sv | fits) || (run_q && !last_index); | fits) || (run_q && !clear_i && !last_index);
// mutation: axi/axi_stream.sv | word = words_i[i*axi_pkg::WORD_W +: axi_pkg::WORD_W];
//   | word = words_i[axi_pkg::WORD_W +: axi_pkg::WORD_W];

module proof (
  input logic         clk_i,
  input logic         rst_ni,
  input logic         clear_i,
  input logic         done_i,
  input logic [2:0]   enabled_i,
  input logic [107:0] words_i,
  input logic         ready_i
);

  logic        busy, overrun, valid, last;
  logic [31:0] data;
  logic [15:0] user;
  wire         dut_push, dut_last;
  wire  [31:0] dut_data;
  wire  [5:0]  dut_user;   // without bits that are 0
  wire  [1:0]  dut_index;
  wire  [2:0]  dut_room;

  axi_stream #(.Channels(3), .Mode(1), .DataW(32), .UserW(16), .Depth(4)) u_dut (
    .clk_i, .rst_ni, .clear_i, .done_i, .enabled_i, .words_i,
    .mores_i (252'd0),
    .busy_o (busy), .overrun_o (overrun),
    .s_axis_tvalid (valid), .s_axis_tready (ready_i), .s_axis_tdata (data),
    .s_axis_tuser (user), .s_axis_tlast (last)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  // No read while the beats of the last one are made; words stay.
  logic         busy_q;
  logic [107:0] words_q;
  always @(posedge clk_i) begin
    busy_q  <= busy && rst_ni;
    words_q <= words_i;
  end
  always @* begin
    if (busy) assume (!done_i);
    if (busy_q) assume (words_i == words_q);
  end

  // The channels that a read has, and whether the FIFO has room for them.
  wire [2:0] beats = {2'd0, enabled_i[0]} + {2'd0, enabled_i[1]} + {2'd0, enabled_i[2]};
  wire       fits  = beats <= dut_room;
  logic [2:0] enabled_q;
  logic       lost_q;
  always @(posedge clk_i) begin
    if (done_i) enabled_q <= enabled_i;
    lost_q <= done_i && !clear_i && !fits && rst_ni;
  end

  // Clocks since done_i: 1 to 3 are those of channel 0 to 2; 0: no read.
  logic [1:0] place_q;
  always @(posedge clk_i) begin
    if (!rst_ni)                         place_q <= 2'd0;
    else if (done_i && !clear_i && fits) place_q <= 2'd1;
    else if (place_q != 2'd0) place_q <= place_q + 2'd1;   // 3 + 1 = 0
  end

  wire [1:0]  channel = place_q - 2'd1;
  wire        reads   = place_q != 2'd0;
  wire [35:0] word    = channel == 2'd0 ? words_i[35:0] :
                        channel == 2'd1 ? words_i[71:36] : words_i[107:72];
  wire        sends   = reads && (channel == 2'd0 ? enabled_q[0] :
                                  channel == 2'd1 ? enabled_q[1] : enabled_q[2]);
  wire        more    = (channel == 2'd0 && enabled_q[2:1] != 2'd0) ||
                        (channel == 2'd1 && enabled_q[2]);
  // Beats of the read that are still to come.
  wire [2:0]  left    = (channel == 2'd0 ? {2'd0, enabled_q[0]} : 3'd0) +
                        (channel <= 2'd1 ? {2'd0, enabled_q[1]} : 3'd0) + {2'd0, enabled_q[2]};

  always @* if (rst_ni && started) begin
    Busy_A: assert (busy == reads);
    Lost_A: assert (overrun == lost_q);
    Most_A: assert (dut_room <= 3'd4);
    if (reads) Room_A: assert (left <= dut_room);
    if (reads) Index_A: assert (dut_index == channel);
    Push_A: assert (dut_push == sends);
    Zeros_A: assert (user[15:10] == 6'd0 && user[7:4] == 4'd0);
    if (dut_push) begin
      Word_A: assert (dut_data == word[35:4] && dut_user == {channel, word[3:0]});
      Last_A: assert (dut_last == !more);
    end
  end

  always @(posedge clk_i) if (rst_ni) begin
    Three_C: cover (dut_push && dut_last && channel == 2'd2 && enabled_q == 3'd7);
    First_C: cover (dut_push && dut_last && channel == 2'd0);
    None_C:  cover (busy_q && !busy && enabled_q == 3'd0);
    Lost_C:  cover (overrun);
  end

endmodule
