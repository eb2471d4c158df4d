// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Instruction register 0xF4, host half: keeps the written byte for the core and reads it back.
//
// Clock domain: host (wr_clk_i). instr_o.count, a Gray count, tells the core of a write. The core
// acts once for each step and answers with its own count, instr_i.ack. Until both counts are equal:
//
// - the register reads as written (BREAK never reads 1),
// - pending_o keeps EOT at 0; with INSTR 100 or 111 it keeps REGEND at 0 as well. So the first
//   status read after an instruction already sees it (decisions 25, 26).
//
// Writes that are closer than the core can take: the count runs at most two steps ahead, and the
// last step comes with the last byte. A BREAK among these writes stays in the byte until the core
// has acted.
//
// The bank of the host follows the order of the writes. SWBANK acts at its write. The base is the
// bank without the inversions of SWBANK. A write that sets, keeps or clears HOLDBANK
// keeps a base until the core has acted: with HOLDBANK = 1 the one that the host had, with
// HOLDBANK = 0 that of the newest word. kept_o tells the core which base it is (mb4_bank_ctrl).
//
// Misuse: the host writes while the core takes the previous byte. The core may then take some bits
// of the older byte; three clocks later it takes the new one.
// Without TwoBanks the host's bank is always 0; SWBANK and HOLDBANK only read back.
// Datasheet: pages 32, 33, Tables 44..49; decisions 25, 26, 41.

module mb4_instr_reg #(
  parameter bit TwoBanks = 1'b1
) (
  input  logic       wr_clk_i,
  input  logic       rst_ni,
  // host byte bus
  input  mb4_pkg::host_t host_i,
  output logic [7:0] rd_data_o,
  output logic       pending_o,
  output logic       pending_control_o,  // ... for INSTR 100 or 111
  // to and from the core domain
  output mb4_pkg::instr_host_t instr_o,
  input  mb4_pkg::instr_core_t instr_i,
  // banks
  input  logic            base_i,       // core domain: of the host's bank
  input  logic            newest_i,     // core domain: of the bank with the newest word
  output logic            bank_o,       // bank that the host reads and writes
  output logic            kept_o        // base that the host keeps until the core has acted
);

  logic [7:0] byte_q;
  logic [1:0] count_q;
  logic       kept_q;
  logic       hold_q;     // the byte, or one that the core has not answered, has HOLDBANK = 1
  logic       base;

  always_ff @(posedge wr_clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      byte_q  <= '0;
      count_q <= '0;
      kept_q  <= 1'b0;
      hold_q  <= 1'b0;
    end else if (host_i.wr_en && host_i.wr_addr == mb4_regs_pkg::ADDR_INSTR) begin
      byte_q  <= host_i.wr_data | (byte_q & {8{pending_o}} & mb4_regs_pkg::BREAK_MASK);
      if (count_q != ~instr_i.ack) count_q <= {count_q[0], !count_q[1]};
      kept_q  <= host_i.wr_data[mb4_regs_pkg::HOLDBANK_LSB] ? base : newest_i;
      hold_q  <= host_i.wr_data[mb4_regs_pkg::HOLDBANK_LSB] || byte_q[mb4_regs_pkg::HOLDBANK_LSB] ||
                 (pending_o && hold_q);
    end
  end

  assign instr_o.count   = count_q;
  assign instr_o.written = byte_q;
  assign pending_o = count_q != instr_i.ack;
  assign pending_control_o = pending_o &&
      (byte_q[mb4_regs_pkg::INSTR_LSB +: 3] == mb4_regs_pkg::INSTR_CONTROL ||
       byte_q[mb4_regs_pkg::INSTR_LSB +: 3] == mb4_regs_pkg::INSTR_CONTROL_REDUCED);
  assign base      = (pending_o && hold_q) ? kept_q : base_i;
  assign bank_o    = TwoBanks && (base ^ byte_q[mb4_regs_pkg::SWBANK_LSB]);
  assign kept_o    = TwoBanks && kept_q;
  assign rd_data_o = pending_o ? (byte_q & ~mb4_regs_pkg::BREAK_MASK) : instr_i.held;

endmodule
