// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The clock switch (enc_clk_mux): never both clocks at once, and none is cut or begun inside a pulse,
// whenever the choice changes, at any phase and ratio of the clocks. Left out: clock 0 given up.
//
// claim: one clock at most is let through, from and to its low level; any choice, any clocks
// clocks: many
// depth: 30
// cover: 24
// unbounded: reachability
// look: dut_sel0 = u_dut.sel0_q
// look: dut_sel1 = u_dut.sel1_q
// look: dut_claim0 = u_dut.claim0_q
// look: dut_claim1 = u_dut.claim1_q
// look: dut_ready0 = u_dut.ready0_q
// look: dut_ready1 = u_dut.ready1_q
// look: dut_en0 = u_dut.en0_q
// look: dut_en1 = u_dut.en1_q
// look: dut_dead = u_dut.dead_q
// mutation: common/enc_clk_mux.sv | sel0_q && claim0_q && !claim1_q | sel0_q && claim0_q
// mutation: common/enc_clk_mux.sv | sel1_q && claim1_q && !claim0_q | claim1_q && !claim0_q
// mutation: common/enc_clk_mux.sv | claim0_q <= sel0_q || en0_q | claim0_q <= sel0_q
// mutation: common/enc_clk_mux.sv | negedge clk1_i | posedge clk1_i

module proof (
  input logic clk0_i,
  input logic clk1_i,
  input logic rst_ni,
  input logic sel_i
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic clk0_q, clk1_q, rst_q, sel_q, en0_q, en1_q;
  wire dut_sel0, dut_sel1, dut_claim0, dut_claim1, dut_ready0, dut_ready1, dut_en0, dut_en1;
  wire dut_dead;

  always @(posedge gclk) begin
    started <= 1'b1;
    {clk0_q, clk1_q, rst_q, sel_q} <= {clk0_i, clk1_i, rst_ni, sel_i};
    {en0_q, en1_q} <= {dut_en0, dut_en1};
  end

  // One reset at the beginning; one input changes at a time.
  always @* begin
    if (!started) assume (!rst_ni && !clk0_i && !clk1_i);
    if (started && rst_q) assume (rst_ni);
    if (started) assume ({2'b0, clk0_i != clk0_q} + {2'b0, clk1_i != clk1_q} +
                         {2'b0, rst_ni != rst_q} + {2'b0, sel_i != sel_q} < 3'd2);
    assume (!dut_dead);
  end

  logic clk;
  enc_clk_mux u_dut (.clk0_i, .clk1_i, .rst_ni, .sel_i, .clk_o(clk));

  always @* if (started && rst_ni && rst_q) begin
    OneAtMost_A: assert (!(dut_en0 && dut_en1));
    if (dut_en0 != en0_q) Low0_A: assert (!clk0_i);
    if (dut_en1 != en1_q) Low1_A: assert (!clk1_i);
    Is0_A: assert (!dut_en0 || clk == clk0_i);
    Is1_A: assert (!dut_en1 || clk == clk1_i);
    Off_A: assert (dut_en0 || dut_en1 || !clk);
  end

  // Invariant: a clock that is ready has a claim, and has found no claim of the other clock.
  always @* if (started && rst_ni) begin
    Claim0_A: assert (dut_claim0 || !(dut_ready0 || dut_en0));
    Claim1_A: assert (dut_claim1 || !(dut_ready1 || dut_en1));
    Alone_A:  assert (!((dut_ready0 || dut_en0) && (dut_ready1 || dut_en1)));
    Stays0_A: assert (!dut_ready0 || dut_en0 || clk0_i);
    Stays1_A: assert (!dut_ready1 || dut_en1 || clk1_i);
    Goes0_A:  assert (!dut_en0 || dut_ready0 || clk0_i);
    Goes1_A:  assert (!dut_en1 || dut_ready1 || clk1_i);
  end

  // The choice changes and changes back; once before the switch has moved.
  logic been0_q = 1'b0, been1_q = 1'b0;
  always @(posedge gclk) begin
    been0_q <= been0_q || dut_en0;
    been1_q <= been1_q || (been0_q && dut_en1);
  end
  always @* Over_C: cover (been0_q && dut_en1 && clk);
  always @* Back_C: cover (been0_q && dut_sel1 && !sel_i && dut_en0);

endmodule
