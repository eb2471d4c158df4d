// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bits of an answer out of the samples of a window, its words, whether it is the test pattern,
// the edges and the strength of the line.
//
// Clock domain: core. The bit of a slot shows one clock behind the slot's last sample; bit_valid_o
// tells so for each of the 72 slots. A word of ten bits shows with word_valid_o, a clock later.
// From ten clocks behind the last sample on same_o and rssi_o are those of the window.
//
// An answer begins in slot delay_i. Bit 50, between the acceleration and the second safe channel,
// is passed over. EDGES collects the edges of the answers with collect_i, up to forget_i.
// Strength: the edges of a slot stand in a ring of eight samples. The largest gap between two of
// them makes 2 x (gap - 2), with one edge or none 12. The smallest of an answer counts. With
// table_i a gap of one or two counts as 12.
//
// Misuse: delay_i and eighth_i that change within a window mix two places.
// Source: docs/dsl.md, "The protocol".

module dsl_rx (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             forget_i,
  input  logic             collect_i,
  input  logic             table_i,
  input  logic [3:0]       delay_i,
  input  logic [2:0]       eighth_i,
  input  dsl_pkg::stream_t stream_i,
  // bits of the window
  output logic             bit_valid_o,
  output logic             bit_o,
  // words of the answer
  output logic             word_valid_o,
  output logic [2:0]       number_o,       // vertical, S_PAR, pipeline, acceleration, secondary
  output logic [9:0]       line_o,         // the first bit is bit 9
  // the whole answer
  output logic             same_o,         // it was the test pattern
  output logic [7:0]       edges_o,        // the first eighth is bit 0
  output logic [3:0]       rssi_o
);

  localparam logic [3:0] WORD_LAST = 4'd9;
  localparam logic [2:0] LOW_WORD  = 3'd4;   // of the acceleration; bit 50 follows
  localparam logic [3:0] SKIP      = 4'd15;
  localparam logic [2:0] BEST      = 3'd7;   // samples without an edge

  logic       begins;
  logic       last;           // sample of a slot
  logic       first;          // slot of the answer
  logic       inside_q;       // the answer goes on
  logic       valid_q;        // a bit of the window
  logic       answer_q;       // ... of the answer
  logic       bit_q;
  logic [5:0] count_q;        // bits of the answer that follow this one
  logic [3:0] in_word_q;
  logic [2:0] number_q;
  logic       word_q;
  logic [9:0] line_q;
  logic       same_q;
  logic [7:0] changes;        // edges of a slot, the first eighth is bit 7
  logic [7:0] edges_q;
  logic [7:0] gaps_q;         // begins of so many samples without an edge
  logic [2:0] run_q;          // how many
  logic [2:0] least_q;        // of the answer
  logic       worse;

  assign begins  = stream_i.valid && stream_i.number == 10'd0;
  assign last    = stream_i.valid && stream_i.number[2:0] == 3'd7;
  assign first   = stream_i.number[9:3] == {3'd0, delay_i};
  assign changes = stream_i.levels[7:0] ^ stream_i.levels[8:1];
  assign worse   = gaps_q == 8'd0 && run_q < least_q && !(table_i && run_q[2:1] == 2'd0);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      inside_q  <= 1'b0;
      valid_q   <= 1'b0;
      answer_q  <= 1'b0;
      bit_q     <= 1'b0;
      count_q   <= dsl_pkg::LAST_BIT;
      in_word_q <= '0;
      number_q  <= '0;
      word_q    <= 1'b0;
      line_q    <= '0;
      same_q    <= 1'b0;
      edges_q   <= '0;
      gaps_q    <= '1;
      run_q     <= BEST;
      least_q   <= BEST;
    end else begin
      valid_q  <= last;
      answer_q <= last && (first || inside_q);
      word_q   <= answer_q && in_word_q == WORD_LAST;
      if (last) bit_q <= stream_i.levels[{1'b0, ~eighth_i}];
      if (begins) begin
        inside_q  <= 1'b0;
        count_q   <= dsl_pkg::LAST_BIT;
        in_word_q <= '0;
        number_q  <= '0;
        same_q    <= 1'b1;
        least_q   <= BEST;
      end else begin
        if (last && first)                                   inside_q <= 1'b1;
        else if (answer_q && count_q == 6'd0)                inside_q <= 1'b0;
        if (answer_q) begin
          count_q   <= count_q - 6'd1;
          line_q    <= {line_q[8:0], bit_q};
          in_word_q <= in_word_q + 4'd1;
          if (in_word_q == WORD_LAST) in_word_q <= number_q == LOW_WORD ? SKIP : 4'd0;
          if (bit_q != dsl_pkg::TEST_PATTERN[count_q]) same_q <= 1'b0;
        end
        if (word_q) number_q <= number_q + 3'd1;
        if (worse)  least_q  <= run_q;
      end
      // A ring of seven clocks: what is left after n clocks begins n + 1 samples without an edge.
      if (last && (first || inside_q)) begin
        gaps_q <= ~changes;
        run_q  <= 3'd0;
      end else if (begins || forget_i) begin
        run_q  <= BEST;
      end else if (gaps_q != 8'd0 && run_q != BEST) begin
        gaps_q <= gaps_q & {gaps_q[6:0], gaps_q[7]};
        run_q  <= run_q + 3'd1;
      end
      if (forget_i) begin
        edges_q <= '0;
        least_q <= BEST;
      end else if (collect_i && last && (first || inside_q)) begin
        for (int unsigned i = 0; i < 8; i++) edges_q[i] <= edges_q[i] | changes[7 - i];
      end
    end
  end

  assign bit_valid_o  = valid_q;
  assign bit_o        = bit_q;
  assign word_valid_o = word_q;
  assign number_o     = number_q;
  assign line_o       = line_q;
  assign same_o       = same_q;
  assign edges_o      = edges_q;
  // Fewer than two samples without an edge are a gap of two at most.
  assign rssi_o       = least_q[2:1] == 2'd0 ? 4'd0 : {least_q - 3'd1, 1'b0};

endmodule
