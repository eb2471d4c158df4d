// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Receive FIFO of 16 words with the SPI's level interrupt.
//
// Clock domain: core. A word is in the level and can be read two clocks after push_i. fifo_o.word
// is the oldest word; pop_i takes it out, and the next one is there two clocks later. While the
// FIFO is empty it is the word that was read last, 0 before the first one.
// fifo_o.raised rises with the level and stays until int_clear_i while the level is lower again.
// enable_i = 0 holds the FIFO empty.
//
// Misuse: a word that comes while 16 words wait is lost and sets overflow. A pop while the FIFO is
// empty changes nothing. A clock must lie between two pushes, and two between two pops.
// Source: the SPI of the C2000 parts.

`include "enc_check.svh"

module clb_fifo (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        enable_i,
  input  logic [4:0]  level_i,        // of the interrupt, 0: none
  input  logic        push_i,
  input  logic [15:0] word_i,
  input  logic        pop_i,
  input  logic        int_clear_i,
  input  logic        overflow_clear_i,
  output logic        lost_o,         // a word is lost, for one clock
  output clb_pkg::fifo_t fifo_o
);

  logic [3:0]  wr_q;
  logic [3:0]  rd_q;
  logic        stored_q;     // the memory has a word that the level does not count yet
  logic [4:0]  level_q;
  logic        any;          // the level is not 0
  logic        full;
  logic        store;
  logic        pop;
  logic        reached;
  logic        raised_q;
  logic        overflow_q;
  logic        any_q;        // the memory has a word, or has had one
  logic [15:0] word;

  assign any    = level_q != 5'd0;
  assign full   = level_q[4];
  assign store  = enable_i && push_i && !full;
  assign lost_o = enable_i && push_i && full;
  assign pop    = pop_i && any;

  enc_ram #(.Width(16), .AddrW(4)) u_ram (
    .wr_clk_i  (clk_i),
    .wr_en_i   (store),
    .wr_addr_i (wr_q),
    .wr_data_i (word_i),
    .rd_clk_i  (clk_i),
    .rd_en_i   (any || stored_q),
    .rd_addr_i (rd_q),
    .rd_data_o (word)
  );

  assign reached = level_q >= level_i && level_i != 5'd0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wr_q       <= '0;
      rd_q       <= '0;
      stored_q   <= 1'b0;
      level_q    <= '0;
      raised_q   <= 1'b0;
      overflow_q <= 1'b0;
      any_q      <= 1'b0;
    end else begin
      // While no word waits, what has been read stays at the output of the memory.
      stored_q <= store;
      if (!enable_i) begin
        wr_q    <= '0;
        rd_q    <= '0;
        level_q <= '0;
      end else begin
        if (store) wr_q <= wr_q + 4'd1;
        if (pop)   rd_q <= rd_q + 4'd1;
        // A word comes or goes; both together change nothing.
        if (stored_q != pop) level_q <= level_q + {{4{pop}}, 1'b1};
      end
      raised_q   <= reached || (raised_q && !int_clear_i);
      overflow_q <= lost_o || (overflow_q && !overflow_clear_i);
      any_q      <= any_q || stored_q;
    end
  end

  always_comb begin
    fifo_o.overflow  = overflow_q;
    fifo_o.raised    = raised_q;
    fifo_o.level     = level_q;
    fifo_o.word      = word & {16{any_q}};
  end

  `ENC_ASSERT(LevelFits_A, clk_i, rst_ni, level_q <= 5'd16)

endmodule
