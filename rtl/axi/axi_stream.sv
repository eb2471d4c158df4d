// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Words of all channels as an AXI4-Stream.
//
// Clock domain: core. done_i says that all enabled channels have ended their frames.
//
// Mode 0: one beat for each read, in the next clock, Lane bits for each channel (channel 0 lowest).
//   s_axis_tready does not count: this is a strobe and no handshake. TLAST is 1.
//   TUSER has a bit for each channel: 1 = its word is of this frame and good. Bits of a disabled
//   channel are 0.
// Mode 1: one beat for each channel that is enabled at done_i, in ascending order, one channel a
//   clock into the FIFO; the first is at the output 3 clocks after done_i if none waits there.
//   busy_o is high while they go in, and the words must stay. A
//   channel that is disabled meanwhile sends position 0, not good.
//   TLAST comes with the last one. TUSER: 0 good, 1 nE, 2 nW, 3 CRC wrong, 15..8 channel.
//   Beats that the sink does not take wait in a FIFO. If the FIFO has no room at done_i for all
//   beats of a frame, none of them is sent, and overrun_o is high for one clock.
//   clear_i drops the frame that ends with it, and no beat of one that has ended.
//
// A word that is not good holds the position of the last good frame.
//
// Misuse: Depth below Channels, as biss_axi never has it, may lose all frames.
// Source: hello-fpga BiSS-C master manual 2.3.2; docs/axi.md.

module axi_stream #(
  parameter int unsigned Channels = 1,
  parameter int unsigned Mode     = 0,
  parameter int unsigned Lane     = 32,             // mode 0: 32 or 64
  parameter int unsigned DataW    = Lane * Channels,  // mode 0: Lane * Channels; mode 1: 32 or 64
  parameter int unsigned UserW    = Channels,  // mode 0: Channels; mode 1: 16
  parameter int unsigned Depth    = 16   // of the FIFO of mode 1
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                clear_i,
  input  logic                done_i,
  input  logic [Channels-1:0] enabled_i,
  input  logic [Channels*axi_pkg::WORD_W-1:0] words_i,
  input  logic [Channels*axi_pkg::MORE_W-1:0] mores_i,
  output logic                busy_o,
  output logic                overrun_o,
  // AXI4-Stream
  output logic                s_axis_tvalid,
  input  logic                s_axis_tready,
  output logic [DataW-1:0]    s_axis_tdata,
  output logic [UserW-1:0]    s_axis_tuser,
  output logic                s_axis_tlast
);

  if (Mode == 0) begin : gen_one_beat
    logic                valid_q;
    logic [Channels-1:0] user_q;
    logic [Channels-1:0] good;
    logic                unused;

    for (genvar i = 0; i < Channels; i++) begin : gen_channel
      localparam int unsigned AT = i * axi_pkg::WORD_W;
      localparam int unsigned MORE_AT = i * axi_pkg::MORE_W + axi_pkg::MORE_POSITION;
      assign s_axis_tdata[i*Lane +: 32] = words_i[AT + axi_pkg::WORD_POSITION +: 32];
      if (Lane == 64) begin : gen_high
        assign s_axis_tdata[i*Lane+32 +: 32] = mores_i[MORE_AT +: 32];
      end
      assign good[i]                  = words_i[AT + axi_pkg::WORD_GOOD];
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        valid_q <= 1'b0;
        user_q  <= '0;
      end else begin
        valid_q <= done_i && !clear_i;
        if (done_i) user_q <= good & enabled_i;
      end
    end

    assign unused        = s_axis_tready ^ (^words_i) ^ (^mores_i);
    assign busy_o        = 1'b0;
    assign overrun_o     = 1'b0;
    assign s_axis_tvalid = valid_q;
    assign s_axis_tuser  = user_q;
    assign s_axis_tlast  = 1'b1;
  end else begin : gen_beats
    localparam int unsigned INDEX_W = Channels > 1 ? $clog2(Channels) : 1;

    localparam int unsigned ROOM_W  = $clog2(Depth) + 1;
    localparam int unsigned USER_W  = Channels > 1 ? 4 + INDEX_W : 4;   // without bits that are 0

    logic                run_q;
    logic                overrun_q;
    logic [Channels-1:0] enabled_q;
    logic [4:0]          needed;    // beats of a frame
    logic [ROOM_W-1:0]   room;      // for beats
    logic                fits;
    logic [INDEX_W-1:0]  index_q;
    logic                last_index;
    logic                now;       // the channel is enabled
    logic                later;     // one of the channels behind it is
    logic [axi_pkg::WORD_W-1:0] word;
    logic [31:0]         high;
    logic [USER_W-1:0]   user, user_out;
    logic                unused;

    if (Channels > 1) begin : gen_numbers
      assign user         = {index_q, word[axi_pkg::WORD_POSITION-1:0]};
      assign s_axis_tuser = UserW'({8'(user_out[USER_W-1:4]), 4'd0, user_out[3:0]});
    end else begin : gen_number_0
      assign user         = word[axi_pkg::WORD_POSITION-1:0];
      assign s_axis_tuser = UserW'(user_out);
    end

    assign busy_o     = run_q;
    assign overrun_o  = overrun_q;
    assign fits       = 32'(needed) <= 32'(room);
    assign unused     = ^mores_i;
    assign last_index = index_q == INDEX_W'(Channels - 1);

    always_comb begin
      word   = '0;
      high   = '0;
      now    = 1'b0;
      later  = 1'b0;
      needed = '0;
      for (int unsigned i = 0; i < Channels; i++) begin
        if (index_q == INDEX_W'(i)) begin
          word = words_i[i*axi_pkg::WORD_W +: axi_pkg::WORD_W];
          high = mores_i[i*axi_pkg::MORE_W + axi_pkg::MORE_POSITION +: 32];
          now  = enabled_q[i];
        end
        if (index_q < INDEX_W'(i)) later = later || enabled_q[i];
        needed = needed + 5'(enabled_i[i]);
      end
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        run_q     <= 1'b0;
        overrun_q <= 1'b0;
        enabled_q <= '0;
        index_q   <= '0;
      end else begin
        run_q     <= (done_i && !clear_i && fits) || (run_q && !last_index);
        overrun_q <= done_i && !clear_i && !fits;
        if (done_i) enabled_q <= enabled_i;
        index_q   <= (run_q && !last_index) ? index_q + INDEX_W'(1) : '0;
      end
    end

    enc_axis_fifo #(.DataW(DataW), .UserW(USER_W), .Depth(Depth)) u_fifo (
      .clk_i,
      .rst_ni,
      .push_i    (run_q && now),
      .data_i    (DataW'({high, word[axi_pkg::WORD_POSITION +: 32]})),
      .user_i    (user),
      .last_i    (!later),
      .room_o    (room),
      .m_axis_tvalid (s_axis_tvalid),
      .m_axis_tready (s_axis_tready),
      .m_axis_tdata  (s_axis_tdata),
      .m_axis_tuser  (user_out),
      .m_axis_tlast  (s_axis_tlast)
    );
  end

endmodule
