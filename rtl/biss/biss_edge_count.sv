// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Counts the rising MA edges of a frame on one line: edges sent (up to two) and edges still needed.
//
// Clock domain: core.
//
//   begin_i      sets the need to that of the protocol (BiSS C 5, BiSS B 4, SSI 1), plus mo_busy on
//                a line with actuators
//   len_valid_i  adds the bits of a word, len_last_i + 1 (not in the clock of begin_i)
//   wait_i       adds a processing clock (not in the clock of begin_i): the next edge does not
//                count as needed
//   rise_i       takes one edge away
//
// Latency: a word counts from the second clock after len_valid_i; in between none_left_o and
// one_left_o are 0. A processing clock counts with the next edge; until then none_left_o and
// one_left_o leave it out, and the caller must not look (biss_frame looks after the start bit).
// The caller gives no second wait_i without a rise_i between. mo_busy_i counts from the second
// clock after begin_i. All outputs except two_edges_next_o are ready early in the clock, because
// they decide what MA does next.
//
// Misuse: ssi_i with bus_i counts one edge too many. MA may make one edge more than needed before a
// word is told. The count keeps this edge (need_q = -2) and subtracts it from the word. The count
// does not keep further surplus edges. Words that are told while the line rests are counted too;
// begin_i drops them.
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
  input  logic       len_valid_i,
  input  logic [6:0] len_last_i,   // bits of the word minus 1
  input  logic       wait_i,
  input  logic       rise_i,
  output logic       two_edges_o,      // two edges have been sent
  output logic       two_edges_next_o, // two edges with the one of this clock
  output logic       none_left_o,
  output logic       one_left_o    // at most one edge is left
);

  // The longest frame: 5 edges, mo_busy_i, and words with stop bit and CRC.
  localparam int unsigned MOST = 5 + (Mo ? 255 : 0) + Slaves * (DataBits + 17);
  localparam int unsigned W    = $clog2((MOST > 127 ? MOST : 127) + 1) + 1;  // a length has 7 bits

  logic [1:0]          rises_d;
  logic [1:0]          rises_q;
  logic signed [W-1:0] need_d;
  logic signed [W-1:0] need_q;     // edges needed minus 1; -2: one too many was sent
  logic signed [W-1:0] sum;        // need_q after this clock, without begin_i
  logic                word_d;
  logic                word_q;     // one clock after begin_i and len_valid_i: more_q is added
  logic [7:0]          more_d;
  logic [7:0]          more_q;     // mo_busy_i, or the bits of a word minus 1
  logic                free_d;
  logic                free_q;     // a processing clock: the next edge takes nothing away
  logic                take;
  logic                bus;
  logic [2:0]          base;       // edges of the protocol minus 1, with mo_busy_i minus 2
  logic                unused;

  assign take = rise_i && !free_q && !(need_q[W-1] && !need_q[0]);

  assign bus  = Mo && bus_i;
  assign base = biss_c_i ? {!bus, {2{bus}}} : ssi_i ? 3'd0 : {1'b0, 1'b1, !bus};

  // One adder: need_q + (more_q or -1) + 1, without 1 when an edge is taken away.
  assign {sum, unused} = {need_q, 1'b1} + {{(W-8){!word_q}}, more_q, !take};

  // begin_i also drops a word of a frame that was stopped.
  assign need_d = begin_i ? signed'(W'(base)) : sum;
  assign word_d = begin_i ? bus : len_valid_i;
  assign more_d = begin_i ? mo_busy_i | {8{!bus}} : {!len_valid_i, len_last_i | {7{!len_valid_i}}};
  assign free_d = !begin_i && (wait_i || (free_q && !rise_i));

  always_comb begin
    rises_d = rises_q;
    if (rise_i && rises_q != 2'd2) rises_d = rises_q + 2'd1;
    if (begin_i) rises_d = 2'd0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rises_q <= '0;
      need_q  <= '1;
      word_q  <= 1'b0;
      more_q  <= '1;
      free_q  <= 1'b0;
    end else begin
      rises_q <= rises_d;
      need_q  <= need_d;
      word_q  <= word_d;
      more_q  <= more_d;
      free_q  <= free_d;
    end
  end

  assign two_edges_o      = rises_q == 2'd2;
  assign two_edges_next_o = rises_d == 2'd2;
  assign none_left_o = need_q[W-1] && !word_q;
  assign one_left_o  = (need_q[W-1] || need_q == '0) && !word_q;

`ifdef ENC_CHECKED
  logic [7:0] told_q;   // words since begin_i; while the line rests there may be any number
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                             told_q <= '0;
    else if (begin_i)                        told_q <= '0;
    else if (len_valid_i && told_q != 8'hFF) told_q <= told_q + 8'd1;
  end
`endif
  `ENC_ASSERT_IF(NeedInRange_A, clk_i, rst_ni, 32'(told_q) <= Slaves,
                 32'(need_q) >= -2 && 32'(need_q) < signed'(MOST))

endmodule
