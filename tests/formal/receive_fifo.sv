// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The receive FIFO of biss_clb (clb_fifo) against counts, for any pushes and pops, a clock between
// two pushes.
//
// claim: the level is what was pushed and neither lost nor taken, never above 16; a word is lost if 16
//   wait, and only then; the overflow flag stays until it is cleared, the interrupt flag until it is
//   cleared below the level
// clocks: one
// depth: 12
// cover: 40
// unbounded: reachability
// look: stored = u_dut.stored_q
// mutation: clb/clb_fifo.sv | full   = level_q[4]; | full   = level_q == 5'd15;
// mutation: clb/clb_fifo.sv | pop    = pop_i && any; | pop    = pop_i;
// mutation: clb/clb_fifo.sv | (stored_q != pop) | (stored_q)
// mutation: clb/clb_fifo.sv | lost_o || (overflow_q && !overflow_clear_i) | lost_o || (overflow_q && !int_clear_i)
// mutation: clb/clb_fifo.sv | reached || (raised_q && !int_clear_i) | reached && !int_clear_i

module proof (
  input logic       clk_i,
  input logic       rst_ni,
  input logic       enable_i,
  input logic [4:0] level_i,
  input logic       push_i,
  input logic       pop_i,
  input logic       int_clear_i,
  input logic       overflow_clear_i
);

  logic        lost;
  logic [22:0] fifo;
  wire  [4:0]  level    = fifo[20:16];
  wire         raised   = fifo[21];
  wire         overflow = fifo[22];
  wire         stored;

  clb_fifo u_dut (
    .clk_i, .rst_ni, .enable_i, .level_i, .push_i, .word_i (16'd0), .pop_i, .int_clear_i,
    .overflow_clear_i, .lost_o (lost), .fifo_o (fifo)
  );

  logic started = 1'b0;
  logic pushed_q = 1'b0;
  always @(posedge clk_i) begin
    started  <= 1'b1;
    pushed_q <= push_i;
  end
  always @* begin
    if (!started) assume (!rst_ni);
    if (pushed_q) assume (!push_i);
  end

  // Words that wait, one that is on its way into the level included.
  logic [4:0] count_q;
  wire        takes = pop_i && level != 5'd0;
  logic       raised_q, overflow_q;
  always @(posedge clk_i) begin
    if (!rst_ni || !enable_i) count_q <= '0;
    else count_q <= count_q + 5'(push_i && count_q != 5'd16) - 5'(takes);
    raised_q   <= rst_ni && ((level >= level_i && level_i != 5'd0) || (raised && !int_clear_i));
    overflow_q <= rst_ni && (lost || (overflow && !overflow_clear_i));
  end

  always @* if (rst_ni && started) begin
    Level_A:    assert (level + 5'(stored) == count_q);
    Fits_A:     assert (level <= 5'd16 && count_q <= 5'd16);
    if (stored) Gap_A: assert (pushed_q);
    Lost_A:     assert (lost == (enable_i && push_i && level == 5'd16));
    Raised_A:   assert (raised == raised_q);
    Overflow_A: assert (overflow == overflow_q);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Full_C:  cover (level == 5'd16);
    Lost_C:  cover (lost);
    Level_C: cover (raised && level < level_i);
  end

endmodule
