// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Slots of a control frame: one frame moves it by one slot or leaves it in those that wait (S until
// 14 zeros have gone, the slave's start bit), nothing else moves it; it carries the bits of
// datasheet pages 27..29, Figures 20..22 at their places; a register access does REGNUM + 1 bytes;
// a command to IDS = 0 has no IDA; BREAK and INIT end it. Header, IDS and CMD are those of the
// first clock from the second one after begin on in which no posted byte is on its way.
//
// claim: slot = number of frames since S, bits at their places, bytes counted, ends in rest
// clocks: one
// depth: 9
// cover: 12
// unbounded: induction 2
// look: dut_slot = u_dut.slot_q
// look: dut_carries = u_dut.carries_q
// look: dut_active = u_dut.active_q
// look: dut_last = u_dut.last_q
// look: dut_crc = u_dut.crc_q
// look: dut_fresh = u_dut.fresh_q
// look: dut_bits = u_dut.bits_q
// look: dut_broadcast = u_dut.broadcast_q
// mutation: biss/biss_control_frame.sv | if (!stay) slot_d
//   | if (!stay || slot_q == biss_pkg::SLOT_WAIT) slot_d
// mutation: biss/biss_control_frame.sv | start_i ? active_start_o : carries_q && !frame_done_i
//   | start_i ? active_start_o : carries_q
// mutation: biss/biss_control_frame.sv | last_d  = index_q == access_i.byte_last;
//   | last_d  = index_d == access_i.byte_last;
// mutation: biss/biss_control_frame.sv | biss_pkg::SLOT_START: cdm0 = cdm_timeout_i;
//   | biss_pkg::SLOT_START: cdm0 = 1'b1;
// mutation: biss/biss_control_frame.sv | fresh_q[1] && !post_busy_i; | fresh_q[1];
// mutation: biss/biss_control_frame.sv | if (take) broadcast_q | if (step) broadcast_q
// mutation: biss/biss_control_frame.sv | if (bits_header || bits_byte || bits_shift) bits_q
//   | if (step) bits_q

module proof (
  input logic clk_i, rst_ni,
  input logic begin_i, abort_i, start_i, frame_done_i, cdm_timeout_i, expired_i, stalled_i,
  input logic post_busy_i,
  input logic [1:0] cds_i,
  input logic [7:0] rdata_i
);

  (* anyconst *) logic       cts, wnr, ida_invert, blind;
  (* anyconst *) logic [6:0] regadr;
  (* anyconst *) logic [5:0] regnum;
  (* anyconst *) logic [2:0] slaveid;
  (* anyconst *) logic [1:0] select;

  logic active, body, waits, moved, begins, ends, reg_error, delay_error, wr_en;
  logic [1:0] cdm0, cdm1;
  logic [5:0] good, addr;
  logic [7:0] wr_data;
  biss_pkg::access_byte_t bytes;
  biss_pkg::access_end_t  result;
  assign {wr_en, addr, wr_data}               = bytes;
  assign {ends, reg_error, delay_error, good} = result;

  biss_control_frame u_dut (
    .clk_i, .rst_ni, .access_i({cts, wnr, regadr, regnum, slaveid}),
    .ida_invert_i(ida_invert), .select_i(select), .blind_i(blind),
    .byte_o(bytes), .rdata_i, .post_busy_i, .begin_i, .abort_i,
    .start_i, .frame_done_i, .cds_i, .cdm_timeout_i, .expired_i, .stalled_i,
    .stalled_start_i(stalled_i), .active_o(active),
    .in_body_o(body), .wait_o(waits), .moved_o(moved), .cdm0_o(cdm0), .cdm1_o(cdm1),
    .begin_o(begins), .end_o(result)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* begin
    if (!started) assume (!rst_ni);
    assume (cts ? select == 2'b01 || select == 2'b10 : select != 2'b00);
    // A frame starts after the one before has ended; frames that start carry what begins with them.
    if (start_i) assume (!frame_done_i && !running_q);
    if (frame_done_i) assume (running_q);
    // post_busy_i ends: the fields are there before the frame after that of S ends.
    if (frame_done_i && mine_q && dut_slot != 6'd0) assume (taken_q);
  end

  // The fields: when they are taken, and what they were then.
  logic       taken_q, due;
  logic [1:0] since_q;   // clocks since begin
  logic [9:0] fields_q;
  assign due = !taken_q && since_q == 2'd2 && !post_busy_i;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                          {taken_q, since_q} <= {1'b1, 2'd0};
    else if (begins)                      {taken_q, since_q} <= {1'b0, 2'd1};
    else begin
      if (due)                            taken_q <= 1'b1;
      if (!taken_q && since_q != 2'd2)    since_q <= since_q + 2'd1;
    end
  end
  always @(posedge clk_i) if (due) fields_q <= cts ? {slaveid, regadr} : {rdata_i, slaveid[2:1]};
  logic to_all;   // IDS = 0
  assign to_all = fields_q[9:2] == 8'h00;

  logic running_q;   // a frame runs
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)           running_q <= 1'b0;
    else if (start_i)      running_q <= 1'b1;
    else if (frame_done_i || abort_i)  running_q <= 1'b0;
  end

  wire [5:0] dut_slot;
  wire       dut_carries, dut_active, dut_last, dut_broadcast;
  wire [1:0] dut_fresh;
  wire [3:0] dut_crc;
  wire [9:0] dut_bits;

  // A step: the frame that ends had begun while the control communication was active.
  logic       mine_q;
  logic [5:0] slot_q, good_q;
  logic       active_q, step_q, abort_q, live_q, wait_q, begin_q, stalled_q, zeros_q;
  logic [1:0] cds_q;
  always @(posedge clk_i) begin
    slot_q    <= dut_slot;
    good_q    <= good;
    active_q  <= dut_active;
    live_q    <= rst_ni;
    step_q    <= mine_q && frame_done_i;
    abort_q   <= abort_i;
    begin_q   <= begins;
    stalled_q <= stalled_i;
    wait_q    <= waits;
    zeros_q   <= cdm_timeout_i;
    cds_q     <= cds_i;
  end
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                                     mine_q <= 1'b0;
    else if (abort_i)                                mine_q <= 1'b0;
    else if (start_i && !ending)                     mine_q <= dut_active || begins;
    else if (frame_done_i || ending)                  mine_q <= 1'b0;
  end
  logic ending;    // stalled: it ends without a frame
  assign ending = dut_active && stalled_i && !(mine_q && frame_done_i);

  logic [1:0] sent;
  assign sent = cdm0 | cdm1;
  logic [19:0] rotated;
  assign rotated = {2{fields_q}} << (dut_slot - 6'd2);

  always @* if (started) begin
    Range_A: assert (dut_slot <= 6'd32 && (cts || dut_slot <= 6'd25));
    SameFrame_A: assert (dut_carries == mine_q);
    if (!dut_active) Rest_A: assert (dut_slot == 6'd0 && !dut_carries);
    if (rst_ni && live_q) begin
      if (abort_q) Abort_A: assert (!dut_active && dut_slot == 6'd0);
      if (!step_q && dut_slot != slot_q)
        OnlyFrames_A: assert (dut_slot == 6'd0 && (abort_q || ends));
      if (step_q && dut_active && !begin_q && !abort_q && !ends)
        ByOne_A: assert (dut_slot == slot_q + 6'd1 || (slot_q == 6'd32 && dut_slot == 6'd19) ||
                         (dut_slot == slot_q && (slot_q == 6'd0 || (cts && slot_q == 6'd19))));
      if (step_q && slot_q == 6'd0 && dut_slot == 6'd1) AfterZeros_A: assert (zeros_q);
      if (step_q && slot_q == 6'd19 && dut_slot == 6'd20 && cts && !blind)
        AfterStartBit_A: assert ((cds_q & select) != 2'b00);
      if (ends) EndIsRest_A: assert (dut_slot == 6'd0 && (!dut_active || begin_q || abort_q));
      if (dut_last && dut_active) Bytes_A: assert (good == regnum + 6'd1);
      if (good != good_q && !abort_q && !begin_q)
        ByteByByte_A: assert (good == good_q + 6'd1 && step_q && slot_q == 6'd31);
    end
    // The fields, on their way and at their places.
    Fresh_A: assert (dut_fresh == (taken_q ? 2'b00 : {since_q == 2'd2, 1'b1}));
    if (!taken_q) NotYet_A: assert (dut_slot <= 6'd1 && since_q != 2'd0 && since_q != 2'd3);
    if (dut_active && taken_q) begin
      if (!cts) Broadcast_A: assert (dut_broadcast == to_all);
      if (dut_slot <= 6'd1) Fields_A: assert (dut_bits == fields_q);
      if (dut_slot >= 6'd2 && dut_slot <= 6'd11) begin
        Way_A: assert (dut_bits == rotated[19:10]);
        Header_A: assert (sent == (fields_q[6'd11 - dut_slot] ? select : 2'b00));
      end
      if (!cts && to_all) NoIda_A: assert (dut_slot <= 6'd17);
    end
    if (rst_ni && live_q && step_q && !abort_q && !cts && slot_q <= 6'd17)
      CommandEnds_A: assert (ends == (slot_q == 6'd17 && to_all));
    // A CRC leaves zeros after it, bit by bit: the next one starts at zero.
    if (dut_slot == 6'd13 || dut_slot == 6'd29) Zeros1_A: assert (!dut_crc[0]);
    if (dut_slot == 6'd14 || dut_slot == 6'd30) Zeros2_A: assert (dut_crc[1:0] == 2'b00);
    if (dut_slot == 6'd15 || dut_slot == 6'd31) Zeros3_A: assert (dut_crc[2:0] == 3'b000);
    if ((dut_slot >= 6'd16 && dut_slot <= 6'd18) || dut_slot == 6'd32)
      Zeros4_A: assert (dut_crc == 4'h0);
    // Bits at their places.
    if ((dut_active || begins) && dut_slot == 6'd0)
      StartAfterZeros_A: assert (sent == (cdm_timeout_i ? select : 2'b00));
    if (dut_active && dut_slot == 6'd1) Cts_A: assert (sent == (cts ? select : 2'b00));
    if (dut_active && (dut_slot == 6'd31 || (cts && dut_slot == 6'd16 && wnr) ||
                       (!cts && dut_slot == 6'd25)))
      Zero_A: assert (sent == 2'b00);
    if (dut_active && cts && dut_slot == 6'd16) Read_A: assert (sent == (wnr ? 2'b00 : select));
    if (dut_active && cts && dut_slot == 6'd17) Write_A: assert (sent == (wnr ? select : 2'b00));
    OnlySelected_A: assert ((sent & ~select) == 2'b00);
  end
  always @(posedge clk_i) begin
    Header_C: cover (rst_ni && dut_slot == 6'd2);
    Late_C: cover (rst_ni && dut_slot == 6'd1 && !taken_q && since_q == 2'd2);
    Stalled_C: cover (rst_ni && ends && delay_error == 1'b0 && reg_error);
  end

endmodule
