// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bits of events and of the interrupt status (dsl_events), with any causes and any writes of the
// host. The bench says by itself what sets the bits of messages, of PRST, POS and QMLW.
//
// claim: no event is lost: the bits of messages, PRST, POS and QMLW are 1 behind each clock that sets them, also if the host
//   clears them in it; each event bit falls only with a 0 that the host writes to it, FREL and FRES also with the start of their
//   message; INT and SINT are 1 if and only if an event and its mask are; a bit of the interrupt status falls only with a 1
//   that is written to it
// clocks: one
// depth: 12
// cover: 8
// unbounded: induction 2
// look: h = u_dut.h_q
// look: s = u_dut.s_q
// look: mask_h = u_dut.mask_h_q
// look: mask_l = u_dut.mask_l_q
// look: mask_s = u_dut.mask_s_q
// mutation: dsl/dsl_events.sv | h[dsl_regs_pkg::POS_LSB]        = pos; | h[dsl_regs_pkg::POS_LSB]        = pos && !stores_i.event_h;
// mutation: dsl/dsl_events.sv | s[dsl_regs_pkg::S_MIN_LSB]      = message_events_i.min; | s[dsl_regs_pkg::S_MIN_LSB]      = 1'b0;
// mutation: dsl/dsl_events.sv | {8{!stores_i.event_s}} | {8{!stores_i.event_l}}
// mutation: dsl/dsl_events.sv | assign safe = (s_q & mask_s_q) != 8'd0; | assign safe = (s_q & mask_h_q) != 8'd0;
// mutation: dsl/dsl_events.sv | ~(byte_i[6:0] & {7{stores_i.irq_status}}) | ~{7{stores_i.irq_status}}

module proof (
  input logic                     clk_i,
  input logic                     rst_ni,
  input dsl_pkg::message_events_t message_events_i,
  input dsl_pkg::orders_t         orders_i,
  input dsl_pkg::event_stores_t   stores_i,
  input logic [7:0]               byte_i,
  input dsl_pkg::answer_t         answer_i,
  input dsl_pkg::told_t           told_i,
  input logic [3:0]               state_i,
  input logic                     sdk_map_i, low_i, ended_i, edge_i, lost_i, tell_i
);

  dsl_pkg::event_bytes_t bytes;

  dsl_events u_dut (
    .clk_i, .rst_ni, .sdk_map_i, .answer_i, .state_i, .low_i, .ended_i, .edge_i, .told_i, .lost_i, .tell_i,
    .record_write_i   (1'b0),
    .record_address_i (6'd0),
    .record_byte_i    (8'd0),
    .messages_i       (6'd0),
    .message_events_i, .orders_i, .stores_i, .byte_i,
    .bytes_o          (bytes),
    .causes_o         (),
    .irq_o            ()
  );

  // Bits of the three bytes, and what they were.
  logic [23:0] now, before_q, set, set_q, clears, clears_q;
  logic [6:0]  status_q, clears_status_q;
  logic [23:0] mask_q;
  logic        live_q, gap_q, lost_q;
  logic        started = 1'b0;

  assign now = {bytes.event_h, bytes.event_l, bytes.event_s};

  logic prst, pos, low;
  assign prst = gap_q && state_i != 4'd0;
  assign pos  = lost_i && !lost_q;
  assign low  = ended_i && low_i && (answer_i.linked || answer_i.running);
  assign set  = {4'd0, pos, 2'd0, prst,
                 2'd0, message_events_i.min, message_events_i.ans, 1'b0, low,
                 message_events_i.frel && !orders_i.starts_long, message_events_i.fres && !orders_i.starts_main,
                 4'd0, low, prst, message_events_i.min, message_events_i.safe_fres && !orders_i.starts_safe};
  assign clears = {~byte_i & {8{stores_i.event_h}},
                   (~byte_i & {8{stores_i.event_l}}) | {6'd0, orders_i.starts_long, orders_i.starts_main},
                   (~byte_i & {8{stores_i.event_s}}) | {7'd0, orders_i.starts_safe}};

  always @(posedge clk_i) begin
    started         <= 1'b1;
    live_q          <= rst_ni;
    before_q        <= now;
    set_q           <= set;
    clears_q        <= clears;
    status_q        <= bytes.irq_status;
    clears_status_q <= byte_i[6:0] & {7{stores_i.irq_status}};
    gap_q           <= rst_ni && state_i == 4'd0;
    lost_q          <= !rst_ni || lost_i;
    if (!rst_ni) mask_q <= 24'd0;
    else begin
      if (stores_i.mask_h) mask_q[23:16] <= byte_i;
      if (stores_i.mask_l) mask_q[15:8]  <= byte_i;
      if (stores_i.mask_s) mask_q[7:0]   <= byte_i;
    end
  end

  // INT and SINT are no events.
  localparam logic [23:0] EVENTS = 24'h7FFF7F;

  // For the induction.
  wire [7:0] h, s, mask_h, mask_l, mask_s;

  always @* if (!started) assume (!rst_ni);

  always @* if (started && rst_ni && live_q) begin
    Set_A:  assert ((set_q & ~now) == 24'd0);
    Kept_A: assert ((before_q & ~clears_q & ~now & EVENTS) == 24'd0);
    Int_A:  assert (now[23] == ((now[22:8] & mask_q[22:8]) != 15'd0));
    Sint_A: assert (now[7] == ((now[6:0] & mask_q[6:0]) != 7'd0));
    Mask_A: assert (mask_q == {mask_h, mask_l, mask_s} && !h[7] && !s[7]);
    Irq_A:  assert ((status_q & ~clears_status_q & ~bytes.irq_status) == 7'd0);
  end

  always @(posedge clk_i) if (started && rst_ni && live_q) begin
    Race_C: cover ((set_q & clears_q) != 24'd0);
    Int_C:  cover (now[23] && now[7]);
  end

endmodule
