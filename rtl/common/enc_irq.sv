// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Interrupts of a master on a word bus: events of the core set bits of a status register in the
// bus domain. The host clears them by writing 1. irq_o is high while a bit is set and enabled.
//
//   0 a frame ended      1 an error appeared      2 a register access ended
//   3 sample input rose  4 a frame was left out or overwritten, or a frame ended while bit 0 was
//                          still set
//
// Clock domains: clk_i for event_i; bus_clk_i for the rest. They may be one clock.
// Latency: an event is seen after at most 3 clocks of the core and 3 of the bus, or twice this if
// another event has come just before. No event is lost: events that come while others cross wait
// and cross together. If a frame ends while the end of another one waits, bit 4 is set too.
// A bit that is set and cleared with one edge stays set.
//
// Misuse: while the core clock stands still, no event comes; the registers work.
// Constraint: held_q is stable when the bus takes it: maximum delay of one bus_clk_i period.

module enc_irq (
  // core
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [4:0] event_i,       // each high for one clock
  // bus
  input  logic       bus_clk_i,
  input  logic       bus_rst_ni,
  input  logic       status_we_i,   // ones of data_i clear
  input  logic       enable_we_i,
  input  logic [4:0] data_i,
  output logic [4:0] status_o,
  output logic [4:0] enable_o,
  output logic       irq_o
);

  // core
  logic [4:0] wait_d;
  logic [4:0] wait_q;     // events that have not been sent
  logic [4:0] held_q;     // events on their way
  logic       req_q;
  logic       ack;
  logic       send;
  logic [4:0] left;       // events that go on waiting
  // bus
  logic [4:0] status_d;
  logic [4:0] status_q;
  logic [4:0] enable_q;
  logic       ack_q;
  logic       req;
  logic [4:0] kept;
  logic [4:0] set;

  enc_sync_bit u_ack (
    .clk_i,
    .rst_ni,
    .data_i (ack_q),
    .data_o (ack)
  );

  assign send   = req_q == ack && wait_q != 5'd0;
  assign left   = wait_q & {5{!send}};
  // A second frame that ends while the first one still waits is lost (bit 4).
  assign wait_d = left | event_i | {left[0] && event_i[0], 4'd0};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wait_q <= '0;
      held_q <= '0;
      req_q  <= 1'b0;
    end else begin
      wait_q <= wait_d;
      if (send) held_q <= wait_q;
      req_q  <= req_q ^ send;
    end
  end

  enc_sync_bit u_req (
    .clk_i  (bus_clk_i),
    .rst_ni (bus_rst_ni),
    .data_i (req_q),
    .data_o (req)
  );

  assign set  = held_q & {5{req != ack_q}};
  assign kept = status_q & ~(data_i & {5{status_we_i}});

  assign status_d = kept | set | {kept[0] && set[0], 4'd0};

  always_ff @(posedge bus_clk_i or negedge bus_rst_ni) begin
    if (!bus_rst_ni) begin
      status_q <= '0;
      enable_q <= '0;
      ack_q    <= 1'b0;
    end else begin
      status_q <= status_d;
      if (enable_we_i) enable_q <= data_i;
      ack_q    <= req;
    end
  end

  assign status_o = status_q;
  assign enable_o = enable_q;
  assign irq_o    = (status_q & enable_q) != 5'd0;

endmodule
