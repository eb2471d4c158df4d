// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Events and interrupts (enc_irq) between any two clocks. One of the five events is watched; the
// host clears at any time.
//
// claim: an event is on its way to the status until it is there, and the status shows none that did
//   not happen; a second end of a frame before the host has cleared the first sets bit 4; the
//   interrupt is the enabled status; any clocks
// clocks: many
// depth: 24
// cover: 24
// unbounded: reachability
// look: dut_wait = u_dut.wait_q
// look: dut_held = u_dut.held_q
// look: dut_req = u_dut.req_q
// look: dut_ack = u_dut.ack_q
// mutation: common/enc_irq.sv | wait_q & {5{!send}}; | 5'd0;
// mutation: common/enc_irq.sv | req_q == ack && wait_q != 5'd0; | wait_q != 5'd0;
// mutation: common/enc_irq.sv | {kept[0] && set[0], 4'd0}; | 5'd0;
// mutation: common/enc_irq.sv | data_i & {5{status_we_i}} | data_i
// mutation: common/enc_irq.sv | (status_q & enable_q) != 5'd0; | status_q != 5'd0;

module proof (
  input logic       clk_i,
  input logic       bus_clk_i,
  input logic       rst_ni,
  input logic [4:0] event_i,
  input logic       we_i,
  input logic       enable_we_i,
  input logic [4:0] data_i
);

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic clk_q, bus_clk_q, rst_q, we_q, enable_we_q;
  logic [4:0] event_q, data_q;
  always @(posedge gclk) begin
    started <= 1'b1;
    {clk_q, bus_clk_q, rst_q} <= {clk_i, bus_clk_i, rst_ni};
    {event_q, we_q, enable_we_q, data_q} <= {event_i, we_i, enable_we_i, data_i};
  end
  wire core_edge = started && clk_i && !clk_q;
  wire bus_edge  = started && bus_clk_i && !bus_clk_q;
  // Inputs change with the falling edge of their clock; the reset is released once.
  always @* begin
    if (!started) assume (!rst_ni && !clk_i && !bus_clk_i);
    if (started && rst_q) assume (rst_ni);
    if (started && !(clk_q && !clk_i)) assume (event_i == event_q);
    if (started && !(bus_clk_q && !bus_clk_i))
      assume (we_i == we_q && enable_we_i == enable_we_q && data_i == data_q);
    if (!rst_ni) assume (event_i == 5'd0 && !clk_i && !bus_clk_i);
  end

  logic [4:0] status, enable;
  logic       irq;
  wire  [4:0] dut_wait, dut_held;
  wire        dut_req, dut_ack;
  enc_irq u_dut (
    .clk_i, .rst_ni, .event_i,
    .bus_clk_i, .bus_rst_ni(rst_ni), .status_we_i(we_i), .enable_we_i, .data_i,
    .status_o(status), .enable_o(enable), .irq_o(irq)
  );

  // Events that have happened and have not been seen, and those that have ever happened.
  (* anyconst *) logic [2:0] which;
  always @* assume (which < 3'd4);
  logic due = 1'b0, ever = 1'b0, twice = 1'b0, shown = 1'b0, cleared_q = 1'b0;
  logic ack_was = 1'b0;
  wire  cleared = cleared_q || (bus_edge && we_q);
  always @(posedge gclk) begin
    ack_was <= dut_ack;
    if (core_edge && rst_q && event_q[which[1:0]]) {due, ever} <= 2'b11;
    else if (dut_ack != ack_was && !dut_wait[which[1:0]]) due <= 1'b0;
    cleared_q <= cleared;
    // Two ends of frames, and the host has never cleared.
    if (core_edge && rst_q && event_q[0]) {twice, shown} <= {shown, 1'b1};
  end

  always @* if (started && rst_ni) begin
    Kept_A: assert (!due || dut_wait[which[1:0]] || status[which[1:0]] ||
                    (dut_held[which[1:0]] && dut_req != dut_ack));
    True_A: assert (!status[which[1:0]] || ever);
    // Nothing is on its way: then the status shows it, if the host has not cleared.
    if (ever && !cleared && dut_wait == 5'd0 && dut_req == dut_ack)
      Shown_A: assert (status[which[1:0]]);
    if (twice && !cleared && dut_wait == 5'd0 && dut_req == dut_ack) Lost_A: assert (status[4]);
    Irq_A:  assert (irq == ((status & enable) != 5'd0));
  end

  always @(posedge gclk) if (started && rst_ni) begin
    Both_C:  cover (status[0] && status[3] && irq);
    Lost_C:  cover (status[4] && twice);
    Clear_C: cover (cleared && ever && status == 5'd0);
  end

endmodule
