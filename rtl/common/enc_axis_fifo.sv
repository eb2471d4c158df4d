// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// AXI4-Stream source with a FIFO.
//
// Clock domain: clk_i. push_i puts one beat into the FIFO: data, user and last. Every output of the
// stream is a flop, the beat that of the memory's read port, so the memory can be block RAM
// (IHI0022 and IHI0051: TVALID does not wait for TREADY, and the beat stays until TREADY).
// Latency: 2 clocks from push_i to TVALID if the FIFO is empty. One beat a clock can leave.
// room_o says how many beats surely fit; without push_i it never gets less.
//
// Misuse: a beat that is pushed while Depth beats wait is lost; the others keep their order.
// Source: AMBA AXI-Stream protocol specification (IHI0051), 2.2 and 2.7.

`include "enc_check.svh"

module enc_axis_fifo #(
  parameter int unsigned DataW = 32,
  parameter int unsigned UserW = 1,
  parameter int unsigned Depth = 16     // beats that wait behind the output: a power of 2
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             push_i,
  input  logic [DataW-1:0] data_i,
  input  logic [UserW-1:0] user_i,
  input  logic             last_i,
  output logic [$clog2(Depth):0] room_o,
  // AXI4-Stream
  output logic             m_axis_tvalid,
  input  logic             m_axis_tready,
  output logic [DataW-1:0] m_axis_tdata,
  output logic [UserW-1:0] m_axis_tuser,
  output logic             m_axis_tlast
);

  localparam int unsigned BEAT_W = DataW + UserW + 1;
  localparam int unsigned ADDR_W = $clog2(Depth);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (Depth < 2 || (32'd1 << ADDR_W) != Depth) begin : gen_depth
    $error("Depth is a power of 2 from 2 on");
  end
`endif

  logic [ADDR_W:0]   wr_q;
  logic [ADDR_W:0]   rd_q;
  logic              waits;      // a beat is in the memory
  logic              full;
  logic              take;       // the output is free for the next beat
  logic              valid_q;
  logic [BEAT_W-1:0] beat;
  logic              store;

  assign waits = wr_q != rd_q;
  assign full  = wr_q == {!rd_q[ADDR_W], rd_q[ADDR_W-1:0]};
  assign take  = !valid_q || m_axis_tready;
  assign store = push_i && !full;

  enc_ram #(.Width(BEAT_W), .AddrW(ADDR_W)) u_beats (
    .wr_clk_i  (clk_i),
    .wr_en_i   (store),
    .wr_addr_i (wr_q[ADDR_W-1:0]),
    .wr_data_i ({data_i, user_i, last_i}),
    .rd_clk_i  (clk_i),
    .rd_en_i   (take && waits),
    .rd_addr_i (rd_q[ADDR_W-1:0]),
    .rd_data_o (beat)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wr_q    <= '0;
      rd_q    <= '0;
      valid_q <= 1'b0;
    end else begin
      if (store)         wr_q <= wr_q + (ADDR_W+1)'(1);
      if (take && waits) rd_q <= rd_q + (ADDR_W+1)'(1);
      if (take)          valid_q <= waits;
    end
  end

  assign room_o        = (ADDR_W+1)'(Depth) - (wr_q - rd_q);
  assign m_axis_tvalid = valid_q;
  assign {m_axis_tdata, m_axis_tuser, m_axis_tlast} = beat;

  `ENC_ASSERT_NEXT(BeatStays_A, clk_i, rst_ni, m_axis_tvalid && !m_axis_tready, m_axis_tvalid)

endmodule
