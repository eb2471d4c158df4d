// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The toggle crossing (mb4_toggle_rx): every change gives one pulse, two to three clocks later, and
// the byte that the sender holds is taken whole, at any phase and ratio of the clocks. Contract:
// three clocks of the receiver between two changes.
//
// claim: one pulse for each change, within 3 clocks, with the byte sent; any clocks
// clocks: many
// depth: 24
// cover: 22
// unbounded: induction 3
// look: dut_sync = u_dut.u_sync.sync_q
// look: dut_seen = u_dut.seen_q
// mutation: common/mb4_toggle_rx.sv | sync ^ seen_q | sync & !seen_q
// mutation: common/mb4_toggle_rx.sv | seen_q <= sync; | seen_q <= toggle_i;
// mutation: common/mb4_sync_bit.sv | {sync_q[0], data_i} | {2{data_i}}

module proof (
  input logic       hclk_i,
  input logic       clk_i,
  input logic       rst_ni,
  input logic       send_i,
  input logic [3:0] data_i
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic hclk_q, clk_q, rst_q;
  always @(posedge gclk) {started, hclk_q, clk_q, rst_q} <= {1'b1, hclk_i, clk_i, rst_ni};
  // One reset, in the beginning.
  always @* begin
    if (!started) assume (!rst_ni && !hclk_i && !clk_i);
    if (started && rst_q) assume (rst_ni);
    if (started) assume ({1'b0, hclk_i != hclk_q} + {1'b0, clk_i != clk_q} +
                         {1'b0, rst_ni != rst_q} < 2'd2);
  end

  // The sender.
  logic       toggle_q;
  logic [3:0] byte_q;
  logic       go;
  assign go = send_i && clocks_q == 2'd3 && toggle_q == last_q;
  always @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni)  {toggle_q, byte_q} <= '0;
    else if (go)  {toggle_q, byte_q} <= {!toggle_q, data_i};
  end

  // Receiver clocks since the last change.
  logic [1:0] clocks_q;
  logic       last_q;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {clocks_q, last_q} <= {2'd3, 1'b0};
    else begin
      last_q   <= toggle_q;
      clocks_q <= toggle_q != last_q ? 2'd1 : clocks_q == 2'd3 ? 2'd3 : clocks_q + 2'd1;
    end
  end

  logic pulse, level;
  mb4_toggle_rx u_dut (.clk_i, .rst_ni, .toggle_i(toggle_q), .pulse_o(pulse), .level_o(level));

  // The receiver.
  logic       turn_q;      // pulses so far, modulo 2
  logic [3:0] taken_q;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)    {turn_q, taken_q} <= '0;
    else if (pulse) {turn_q, taken_q} <= {!turn_q, byte_q};
  end

  wire [1:0] dut_sync;
  wire       dut_seen;

  always @* if (started && rst_ni) begin
    // Until the pulse the count is one behind, then equal, with the byte.
    OncePerChange_A: assert (turn_q == (toggle_q == last_q && clocks_q == 2'd3 ? toggle_q :
                                        turn_q));
    if (turn_q == toggle_q) Whole_A: assert (taken_q == byte_q);
    if (clocks_q == 2'd3 && toggle_q == last_q) InTime_A: assert (turn_q == toggle_q && !pulse);
    if (pulse) WithIt_A: assert (level == toggle_q && turn_q != toggle_q);
    Way1_A: assert (dut_sync[0] == last_q);
    Way2_A: assert (dut_seen == turn_q);
    if (clocks_q >= 2'd2) Way3_A: assert (dut_sync[1] == last_q);
    if (clocks_q == 2'd1) Way4_A: assert (dut_sync[1] == !last_q && dut_seen == !last_q);
    if (clocks_q == 2'd2) Way5_A: assert (dut_seen == !last_q);
    if (clocks_q == 2'd3) Way6_A: assert (dut_seen == last_q);
    if (toggle_q != last_q) Way7_A: assert (clocks_q == 2'd3);
    Way8_A: assert (clocks_q != 2'd0);
  end
  always @(posedge clk_i) Twice_C: cover (rst_ni && pulse && !toggle_q && byte_q == 4'd9);

endmodule
