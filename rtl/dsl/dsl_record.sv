// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Records of frames in eight banks of a memory: dsl_position writes one, readers see whole ones.
//
// Clock domain: core. tell_i makes the bank that was written the newest one. A group of registers
// reads from a bank of its own: hold_i makes it the newest one for group_i, and this read is of it
// already. So reading the first register of a group with hold_i copies the others in the same
// clock, as R20 has it, and a copy lasts up to the next hold_i of its group. data_o is the byte of
// address_i from the edge with read_i on.
//
// Six groups, the newest record and the one that is written are eight banks. The next record gets a
// bank that is none of the others within seven clocks of tell_i.
// Before the first hold_i of a group it reads the first record, which is empty. Within 900 clocks
// of the reset that record is not whole yet.
// Misuse: a write within eight clocks of tell_i can go into a record that is read. Groups 6 and 7
// read the newest record, and hold nothing.
// Source: docs/dsl.md, "Position".

`include "enc_check.svh"

module dsl_record (
  input  logic       clk_i,
  input  logic       rst_ni,
  // dsl_position
  input  logic       write_i,
  input  logic [5:0] write_address_i,
  input  logic [7:0] write_data_i,
  input  logic       tell_i,
  // reader
  input  logic       read_i,
  input  logic       hold_i,
  input  logic [2:0] group_i,
  input  logic [5:0] address_i,
  output logic [7:0] data_o
);

  localparam int unsigned GROUPS = 6;
  localparam int unsigned W      = 3;     // of the number of a bank

  logic [W-1:0] bank_q;          // of the record that is written
  logic [W-1:0] newest_q;
  logic         moves_q;         // bank_q looks for a place
  logic [W*GROUPS-1:0] held_q;   // banks of the groups
  logic [W-1:0] bank;            // of the read
  logic         used;            // bank_q is another one's

  enc_ram #(.Width(8), .AddrW(9)) u_ram (
    .wr_clk_i  (clk_i),
    .wr_en_i   (write_i),
    .wr_addr_i ({bank_q, write_address_i}),
    .wr_data_i (write_data_i),
    .rd_clk_i  (clk_i),
    .rd_en_i   (read_i),
    .rd_addr_i ({bank, address_i}),
    .rd_data_o (data_o)
  );

  always_comb begin
    bank = newest_q;
    used = bank_q == newest_q;
    for (int unsigned i = 0; i < GROUPS; i++) begin
      if (group_i == 3'(i) && !hold_i) bank = held_q[i*W +: W];
      if (bank_q == held_q[i*W +: W]) used = 1'b1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank_q   <= '0;
      newest_q <= '0;
      moves_q  <= 1'b0;
      held_q   <= '0;
    end else begin
      if (tell_i) begin
        newest_q <= bank_q;
        moves_q  <= 1'b1;
      end else if (moves_q) begin
        if (used) bank_q  <= bank_q + 3'd1;
        else      moves_q <= 1'b0;
      end
      for (int unsigned i = 0; i < GROUPS; i++) begin
        if (read_i && hold_i && group_i == 3'(i)) held_q[i*W +: W] <= newest_q;
      end
    end
  end

  `ENC_ASSERT(WriteInPlace_A, clk_i, rst_ni, !(write_i && moves_q))

endmodule
