// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes that the host wrote last to SCDATA and RDATA, until the core has taken them. With them
// the host reads a byte back at once, with or without a system clock. The last four different
// addresses are kept, the newest first. An address includes the host's bank of SCDATA, so a switch
// of the banks hides no byte and shows none of the other bank.
//
// The memory of these bytes also holds the registers of mb4_kept.
//
// Clock domains: host; writes in wr_clk_i, reads in rd_clk_i. These are one clock, or two strobes
// of the host, of which only one has edges at a time.
// Latency: hit_o and data_o are valid after the edge with host_i.rd_en, until the next read.
//
// An entry ends when the core has taken its byte (enc_posted); the core's memory answers from then
// on. Three things tell this at a read:
//
// - empty_i: the core has taken all bytes.
// - empty_i was 1 at the last edge of wr_clk_i. Then only the byte written with this edge can still
//   be on its way.
// - marked_i = mark_o: the core has taken all bytes written before the last change of mark_o.
//   mark_o changes with an edge of wr_clk_i, but not before marked_i has followed its last change.
//
// Misuse: a read at the edge that writes the same byte is undefined. The read of a fifth, older
// address gives what the core's memory holds. The host may write so fast that mark_o changes
// seldom: with less than 8 clocks of the core between two writes, a byte written behind the last
// change of mark_o may answer from here until the core has taken the last byte of this sequence.
// Features tells which addresses the core has; no other one is kept.
// Source: decisions 13, 36.

module mb4_recent #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic       wr_clk_i,
  input  logic       rst_ni,
  input  logic       rd_clk_i,
  input  mb4_pkg::host_t host_i,
  input  logic       bank_i,      // bank of SCDATA that the host has
  output logic       hit_o,
  output logic [7:0] data_o,
  // posted writes
  input  logic       empty_i,     // no byte waits in the queue
  output logic       mark_o,      // a change asks when all bytes written so far have been taken
  input  logic       marked_i     // follows mark_o when they have been taken
);

  localparam bit CONTROL = Features[mb4_pkg::CONTROL_LSB];
  localparam bit BANKS   = Features[mb4_pkg::TWO_BANKS_LSB];
  localparam logic [7:0] PRESENT = mb4_pkg::channels(Features[mb4_pkg::TWO_LINES_LSB],
                                                     Features[mb4_pkg::SLAVES_LSB +: 4]);
  // Bits of a key that are 1 for at least one address that the core has.
  localparam logic [7:0] VARIES = {CONTROL, BANKS, BANKS || CONTROL || PRESENT[7:4] != 4'h0,
                                   CONTROL || {PRESENT[7:6], PRESENT[3:2]} != 4'h0,
                                   CONTROL || (PRESENT & 8'hAA) != 8'h00, 3'b111};

  // With at most four data channels SCDATA needs no bit 5: the bank takes it, and bit 6 is 0.
  localparam bit SHORT = PRESENT[7:4] == 4'h0;

  // Address of a byte in the memory: SCDATA has the bank in bit 6.
  function automatic logic [7:0] place(input logic [7:0] addr, input logic bank);
    place = {addr[7], addr[7] ? addr[6] : bank, addr[5:0]};
  endfunction

  // The part of a place that differs between the addresses of this core.
  function automatic logic [7:0] key(input logic [7:0] at);
    key = VARIES & (SHORT ? {at[7], 1'b0, at[7] ? at[5] : at[6], at[4:0]} : at);
  endfunction

  logic        wr_en;
  logic        kept_wr;            // the host writes a register of mb4_kept
  logic [7:0]  wr_place, rd_place;
  logic [7:0]  wr_addr, rd_addr;   // their keys
  logic [31:0] addr_q;    // four addresses, the newest lowest
  logic [3:0]  valid_q;
  logic [3:0]  old_q;     // written before the mark
  logic [3:0]  drained;   // at the last edge of wr_clk_i no byte waited, and this was not written
  logic [3:0]  valid;     // valid_q without the bytes that the core has taken
  logic [3:0]  old;
  logic        passed;
  logic        mark_q;
  logic        marked_q;
  logic        empty_q;
  logic        fresh_q;   // the newest entry was written at the last edge of wr_clk_i
  logic        hit_q;
  logic [2:0]  wr_match;
  logic [3:0]  rd_match;  // without bit 0 of the address
  logic [3:0]  odd;
  logic [1:0]  kept_hits; // registers at the odd and at the even address
  // At the odd and at the even address. keep: synthesis would compare with bit 0, which comes late.
  (* keep *) logic [1:0] hits;
  logic [3:0]  move;      // entry takes the address of its newer neighbour

  // Only addresses of SCDATA (bit 7 = 0) and RDATA have bit 6 = 0.
  assign wr_en    = host_i.wr_en && mb4_pkg::in_memory(host_i.wr_addr[7:3], PRESENT, CONTROL);
  assign wr_place = place(host_i.wr_addr, bank_i);
  assign rd_place = place(host_i.rd_addr, bank_i);
  assign wr_addr  = key(wr_place);
  assign rd_addr  = key(rd_place);

  mb4_kept #(.Features(Features)) u_kept (
    .wr_clk_i,
    .rst_ni,
    .host_i,
    .wr_o   (kept_wr),
    .hits_o (kept_hits)
  );

  for (genvar i = 0; i < 3; i++) begin : gen_write
    assign wr_match[i] = valid_q[i] && addr_q[8*i +: 8] == wr_addr;
  end

  // Bit 0 of the address comes late over SPI, so it only chooses between two results.
  for (genvar i = 0; i < 4; i++) begin : gen_read
    assign rd_match[i] = valid_q[i] && !drained[i] && !(old_q[i] && marked_i == mark_q) &&
                         addr_q[8*i + 1 +: 7] == rd_addr[7:1];
    assign odd[i]      = addr_q[8*i];
  end

  assign hits = ({(rd_match & odd) != 4'b0000, (rd_match & ~odd) != 4'b0000} &
                {2{mb4_pkg::in_memory(host_i.rd_addr[7:3], PRESENT, CONTROL) && !empty_i}}) |
                kept_hits;

  assign move = {wr_match == 3'b000, wr_match[1:0] == 2'b00, !wr_match[0], 1'b1} &
                {4{wr_en}};

  assign passed = marked_q == mark_q;
  assign drained = {{3{empty_q}}, empty_q && !fresh_q};
  assign valid  = valid_q & ~(old_q & {4{passed}}) & ~drained;
  assign old    = old_q | {4{passed}};

  always_ff @(posedge wr_clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      addr_q   <= '0;
      valid_q  <= '0;
      old_q    <= '0;
      mark_q   <= 1'b0;
      marked_q <= 1'b0;
      empty_q  <= 1'b0;
      fresh_q  <= 1'b0;
    end else begin
      empty_q  <= empty_i;
      fresh_q  <= wr_en;
      if (passed && valid != 4'b0000) mark_q <= !mark_q;
      marked_q <= marked_i;
      if (move[0]) addr_q[7:0]   <= wr_addr;
      if (move[1]) addr_q[15:8]  <= addr_q[7:0];
      if (move[2]) addr_q[23:16] <= addr_q[15:8];
      if (move[3]) addr_q[31:24] <= addr_q[23:16];
      valid_q <= (valid & ~move) | ({valid[2:0], 1'b1} & move);
      old_q   <= (old & ~move) | ({old[2:0], 1'b0} & move);
    end
  end

  enc_ram #(.Width(8), .AddrW(8)) u_ram (
    .wr_clk_i,
    .wr_en_i   (wr_en || kept_wr),
    .wr_addr_i (wr_place),
    .wr_data_i (host_i.wr_data),
    .rd_clk_i,
    .rd_en_i   (host_i.rd_en),
    .rd_addr_i (rd_place),
    .rd_data_o (data_o)
  );

  always_ff @(posedge rd_clk_i or negedge rst_ni) begin
    if (!rst_ni)           hit_q <= 1'b0;
    else if (host_i.rd_en) hit_q <= rd_addr[0] ? hits[1] : hits[0];
  end

  assign hit_o  = hit_q;
  assign mark_o = mark_q;

endmodule
