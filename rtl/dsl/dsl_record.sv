// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Records of frames in eight banks of a memory: dsl_position writes one, readers see whole ones.
//
// Clock domain: core. tell_i makes the bank that was written the newest one. A group of registers
// reads from a bank of its own: hold_i makes it the newest one for group_i. A read with read_i is
// of the bank that group_i had a clock before, or got there. So reading the first register of a
// group with hold_i copies the others in the same clock, as R20 has it, and a copy lasts up to the
// next hold_i of its group. data_o is the byte of address_i from the edge with read_i on.
//
// Six groups, the newest record and the one that is written are eight banks. The banks of the
// groups stand in a memory. The next record gets a bank that is none of the others: busy_o is 1
// while it is looked for, 64 clocks at most, and while the memory is cleared behind a reset. hold_i
// waits for the first fall of busy_o, write_i for each.
// Before the first hold_i of a group it reads the first record, which is empty. Within 900 clocks
// of the reset that record is not whole yet.
// Misuse: a write while busy_o is 1 can go into a record that is read. Groups 6 and 7 read the
// newest record, and must not hold.
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
  output logic       busy_o,
  // reader
  input  logic       read_i,
  input  logic       hold_i,
  input  logic [2:0] group_i,
  input  logic [5:0] address_i,
  output logic [7:0] data_o
);

  localparam logic [2:0] LAST_GROUP = 3'd5;

  logic [2:0] bank_q;            // of the record that is written
  logic [2:0] newest_q;
  logic       clears_q;          // the memory of the banks is cleared
  logic       moves_q;           // bank_q looks for a place
  logic [2:0] walk_q;            // group whose bank is asked for
  logic [2:0] held, walked;      // banks of groups
  logic       fresh_q;           // the read is of the record that was the newest one
  logic [2:0] fresh_bank_q;
  logic [2:0] bank;              // of the read
  logic       used;              // bank_q is another one's
  logic       holds;
  logic [2:0] hold_to;

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

  // Two memories of the same banks, for the reader and for the search. With eight words the tools
  // would make flops of them.
  assign holds   = hold_i || clears_q;
  assign hold_to = clears_q ? walk_q : group_i;

  enc_ram #(.Width(3), .AddrW(6)) u_held (
    .wr_clk_i  (clk_i),
    .wr_en_i   (holds),
    .wr_addr_i ({3'd0, hold_to}),
    .wr_data_i (newest_q),
    .rd_clk_i  (clk_i),
    .rd_en_i   (1'b1),
    .rd_addr_i ({3'd0, group_i}),
    .rd_data_o (held)
  );

  enc_ram #(.Width(3), .AddrW(6)) u_walked (
    .wr_clk_i  (clk_i),
    .wr_en_i   (holds),
    .wr_addr_i ({3'd0, hold_to}),
    .wr_data_i (newest_q),
    .rd_clk_i  (clk_i),
    .rd_en_i   (1'b1),
    .rd_addr_i ({3'd0, walk_q}),
    .rd_data_o (walked)
  );

  // A group that holds meanwhile goes to the newest bank, which bank_q is not.
  assign used = bank_q == newest_q || (walk_q != 3'd0 && bank_q == walked);
  assign bank = fresh_q ? fresh_bank_q : held;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank_q       <= '0;
      newest_q     <= '0;
      clears_q     <= 1'b1;
      moves_q      <= 1'b0;
      walk_q       <= '0;
      fresh_q      <= 1'b0;
      fresh_bank_q <= '0;
    end else begin
      fresh_q      <= hold_i || group_i > LAST_GROUP;
      fresh_bank_q <= newest_q;
      walk_q       <= walk_q + 3'd1;
      if (clears_q) begin
        clears_q <= walk_q != 3'd7;
      end else if (tell_i) begin
        newest_q <= bank_q;
        moves_q  <= 1'b1;
        walk_q   <= 3'd0;
      end else if (moves_q && used) begin
        bank_q   <= bank_q + 3'd1;
        walk_q   <= 3'd0;
      end else if (walk_q > LAST_GROUP) begin
        moves_q  <= 1'b0;
        walk_q   <= 3'd0;
      end
    end
  end

  assign busy_o = moves_q || clears_q;

  `ENC_ASSERT(WriteInPlace_A, clk_i, rst_ni, !(write_i && busy_o))

endmodule
