// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Instruction register 0xF4, host half: keeps the written byte for the core and reads back.
//
// Clock domain: host (hclk_i). The byte is held from the write on; toggle_o tells the core, which
// answers with ack_i = toggle after it has acted. Until then the register reads as written, and
// pending_o keeps EOT at 0, and with INSTR 100 or 111 REGEND as well, so that the first status read
// after an instruction sees it (decisions 25, 26). BREAK never reads 1.
// HOLDBANK works from its own write on: until the core has acted the host goes on with the bank
// that it had then, and bank_kept_o tells the core which that is (mb4_bank_ctrl).
// Misuse: two writes within three core clocks are taken as one (the later byte, or none if the core
// clock stands still and the number of writes is even); pending_o needs five between them.
// Datasheet: pages 32, 33, Tables 44..49.

module mb4_instr_reg (
  input  logic       hclk_i,
  input  logic       rst_ni,
  // host byte bus
  input  logic       wr_en_i,
  input  logic [7:0] wr_addr_i,
  input  logic [7:0] wr_data_i,
  output logic [7:0] rd_data_o,
  output logic       pending_o,
  output logic       pending_control_o,  // ... and the byte asks for control communication
  // to and from the core domain
  output mb4_pkg::instr_t written_o,
  output logic            toggle_o,
  input  logic            ack_i,
  input  mb4_pkg::instr_t held_i,
  // banks
  input  logic            host_bank_i,  // core domain
  output logic            bank_o,       // that the host reads
  output logic            bank_kept_o   // ... when it wrote 0xF4
);

  logic [7:0] byte_q;
  logic       toggle_q;
  logic       bank_q;

  always_ff @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      byte_q   <= '0;
      toggle_q <= 1'b0;
      bank_q   <= 1'b0;
    end else if (wr_en_i && wr_addr_i == mb4_regs_pkg::ADDR_INSTR) begin
      byte_q   <= wr_data_i;
      toggle_q <= !toggle_q;
      bank_q   <= bank_o;
    end
  end

  assign written_o = byte_q;
  assign toggle_o  = toggle_q;
  assign pending_o = toggle_q ^ ack_i;
  assign pending_control_o = pending_o && byte_q[3];
  assign bank_o      = (pending_o && byte_q[6]) ? bank_q : host_bank_i;
  assign bank_kept_o = bank_q;
  assign rd_data_o = pending_o ? {1'b0, byte_q[6:0]} : held_i;

endmodule
