// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Counts the rising MA edges of a frame on one line: edges sent (up to two) and edges still needed.
//
// Clock domain: core.
//
//   begin_i      sets the need to that of the protocol (BiSS C 5, BiSS B 4, SSI 1), plus mo_busy on
//                a line with actuators
//   len_valid_i  adds the length of a word (not in the clock of begin_i)
//   wait_i       adds a processing clock (not in the clock of begin_i)
//   rise_i       takes one edge away
//
// Latency: a word counts from the second clock after len_valid_i. Until then no edge is the last
// one. A processing clock counts from the second clock after wait_i; until then none_left_o and
// one_left_o leave it out, and the caller must not look (biss_frame looks after the start bit).
// mo_busy_i counts from the second clock after begin_i. All outputs except two_next_o are ready
// early in the clock, because they decide what MA does next.
//
// Misuse: MA may make one edge more than needed before a word is told. The count keeps this edge
// (-1) and subtracts it from the word. The count does not keep further surplus edges.
// Datasheet: pages 12..16, Figures 8..16.

`include "enc_check.svh"

module biss_edge_count #(
  parameter int unsigned Slaves   = 8,    // most words of a frame
  parameter int unsigned DataBits = 64,   // the longest word
  parameter bit          Mo       = 1'b1  // the line may have actuators: bus_i
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       biss_c_i,
  input  logic       ssi_i,
  input  logic       bus_i,
  input  logic [7:0] mo_busy_i,
  input  logic       begin_i,
  input  logic       run_i,        // a frame
  input  logic       len_valid_i,
  input  logic [6:0] len_i,
  input  logic       wait_i,
  input  logic       rise_i,
  output logic       two_o,        // two edges have been sent
  output logic       two_next_o,   // two edges with the one of this clock
  output logic       none_left_o,
  output logic       one_left_o    // one edge is left, or none
);

  // The longest frame: 5 edges, mo_busy_i, and words with stop bit and CRC.
  localparam int unsigned MOST = 5 + (Mo ? 255 : 0) + Slaves * (DataBits + 17);
  localparam int unsigned W    = $clog2((MOST > 127 ? MOST : 127) + 1) + 1;  // a length has 7 bits

  logic [1:0]          rises_d;
  logic [1:0]          rises_q;
  logic signed [W-1:0] more;       // edges needed, without rise_i
  logic signed [W-1:0] need_d;
  logic signed [W-1:0] need_q;     // edges needed; -1: one too many was sent
  logic               len_valid_q;
  logic               wait_q;
  logic [7:0]         len_q;       // one clock after begin_i: mo_busy_i
  logic               bus;
  logic [2:0]         base;        // edges of the protocol
  logic               take;
  logic               none_d;
  logic               none_q;
  logic               one_d;
  logic               one_q;
  logic               unused;

  // One adder: the bit below the sums carries wait_q into it.
  assign {more, unused} = {need_q, 1'b1} + {W'(len_q), wait_q};
  assign take = rise_i && (!need_q[W-1] || wait_q);

  assign bus  = Mo && bus_i;
  assign base = biss_c_i ? 3'd5 : ssi_i ? 3'd1 : 3'd4;

  // rise_i comes late, so the results for both of its values are prepared.
  always_comb begin
    rises_d = rises_q;
    need_d  = need_q;
    none_d  = none_q;
    one_d   = one_q;
    if (begin_i) begin
      rises_d = 2'd0;
      need_d  = signed'(W'(base));
      none_d  = 1'b0;
      one_d   = ssi_i && !biss_c_i;
    end else if (run_i) begin
      if (rise_i && rises_q != 2'd2) rises_d = rises_q + 2'd1;
      need_d = more - (take ? signed'(W'(1)) : signed'(W'(0)));
      none_d = more[W-1] || more[W-2:1] == '0 && (take || !more[0]);
      one_d  = more[W-1] || more[W-2:1] == '0 || (take && more[W-2:0] == (W-1)'(2));
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rises_q <= '0;
      need_q  <= '0;
      none_q  <= 1'b1;
      one_q   <= 1'b1;
      len_valid_q <= 1'b0;
      wait_q      <= 1'b0;
      len_q       <= '0;
    end else begin
      rises_q <= rises_d;
      need_q  <= need_d;
      none_q  <= none_d;
      one_q   <= one_d;
      wait_q      <= wait_i && !begin_i;
      len_valid_q <= len_valid_i && !begin_i;   // not a word of a frame that was stopped
      len_q       <= begin_i ? mo_busy_i & {8{bus}} : {1'b0, len_i & {7{len_valid_i}}};
    end
  end

  assign two_o       = rises_q == 2'd2;
  assign two_next_o  = rises_d == 2'd2;
  assign none_left_o = none_q && !len_valid_q;
  assign one_left_o  = one_q && !len_valid_q;

  `ENC_ASSERT(NeedInRange_A, clk_i, rst_ni,
              32'(need_q) >= -1 && 32'(need_q) <= signed'(MOST))
  `ENC_ASSERT(NoneLeft_A, clk_i, rst_ni, none_q == (32'(need_q) <= 0))
  `ENC_ASSERT(OneLeft_A, clk_i, rst_ni, one_q == (32'(need_q) <= 1))

endmodule
