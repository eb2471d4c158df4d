// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// FRAME_STATE (clb_state) against the two Karnaugh maps of TIDM-1010, tables 2-5 and 2-6, as the
// sums of products that are printed below them.
//
// claim: each of the 16 cells is that of the two tables; only a clear leaves state 11, and the watchdog
//   acts in state 01 only
// clocks: one
// depth: 8
// cover: 8
// unbounded: reachability
// mutation: clb/clb_state.sv | if (e1_i)       state_d | if (e1_i && !e0_i) state_d
// mutation: clb/clb_state.sv | if (e0_i) state_d = clb_pkg::RECEIVE; | if (e0_i && !e1_i) state_d = clb_pkg::RECEIVE;
// mutation: clb/clb_state.sv | if (clear_i) state_d | if (clear_i && !e0_i) state_d
// mutation: clb/clb_state.sv | if (e0_i) state_d = clb_pkg::TRANSMIT; | if (e0_i && !e1_i) state_d = clb_pkg::TRANSMIT;

module proof (
  input logic clk_i,
  input logic rst_ni,
  input logic clear_i,
  input logic end_i,
  input logic e1_i,
  input logic e0_i
);

  logic [1:0] state, state_next;

  clb_state u_dut (
    .clk_i, .rst_ni, .clear_i, .end_i, .e1_i, .e0_i,
    .state_o (state), .state_next_o (state_next)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  wire s1 = state[1];
  wire s0 = state[0];
  wire next_s0 = (!s1 && !s0 && e0_i) || (!s1 && s0 && !e1_i) || (s1 && s0) || (s1 && !s0 && e0_i);
  wire next_s1 = (!s1 && s0 && e1_i) || (s1 && s0) || (s1 && !s0);
  wire watchdog = state == 2'b01 && end_i && !e1_i;

  // The state of the clock before, and what should follow it.
  logic       known_q = 1'b0;
  logic [1:0] wanted_q;
  always @(posedge clk_i) begin
    known_q  <= 1'b1;
    wanted_q <= clear_i ? 2'b00 : watchdog ? 2'b11 : {next_s1, next_s0};
    if (!rst_ni) wanted_q <= 2'b00;
  end

  always @* if (rst_ni && started) begin
    Next_A: assert (state_next == (clear_i ? 2'b00 : watchdog ? 2'b11 : {next_s1, next_s0}));
    if (known_q) State_A: assert (state == wanted_q);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Receive_C:  cover (state == 2'b11 && !end_i);
    Both_C:     cover (state == 2'b10 && e1_i && e0_i);
    Watchdog_C: cover (watchdog && !clear_i);
    Unusual_C:  cover (state == 2'b01 && e1_i && e0_i);
  end

endmodule
