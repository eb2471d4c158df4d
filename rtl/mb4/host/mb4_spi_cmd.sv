// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SPI command decoder: opcode, address, data with auto-increment.
//
// Clock domain: SCLK.
// Latency: a write takes effect at the 8th rising edge of its byte. Read data must be in tx_byte_i
// of the shifter after the edge at which host_o.rd_en is high. Some unknown opcodes read a byte
// too; it is not sent.
// The last bit of a byte comes from MOSI without a flop. Only host_o.rd_addr(0), host_o.wr_data(0)
// and the next state depend on it.
// Misuse: an unknown opcode is ignored until NCS rises. The address wraps from 0xFF to 0x00
// (decision 13). With ReadOnly only the opcodes 0x03 and 0x09 are known (SPI2).
// Datasheet: pages 17..19, Table 3.

`include "enc_check.svh"

module mb4_spi_cmd #(
  parameter bit         ReadOnly   = 1'b0,
  parameter logic [7:0] Registers0 = mb4_regs_pkg::ADDR_SCDATA
) (
  input  logic       sclk_i,
  input  logic       frame_rst_ni,
  // from the shifter
  input  logic       byte_valid_i,
  input  logic [7:0] byte_i,
  output logic       tx_en_o,
  // host byte bus, sampled at the rising edge of sclk_i
  output mb4_pkg::host_t host_o
);

  typedef enum logic [2:0] {
    OPCODE,
    ADDR_WRITE,
    ADDR_READ,
    WRITE,
    READ,
    IGNORE
  } state_e;

  state_e     state_d;
  state_e     state_q;
  logic [7:0] addr_d;
  logic [7:0] addr_q;      // of the byte that the host writes now, or has read last
  logic [7:0] opcode;
  logic [7:0] fixed;
  logic       wr_en, rd_en;

  // No opcode has the value 0x00.
  assign opcode = (ReadOnly && byte_i != mb4_regs_pkg::SPI_OPCODE_READ_REGISTERS &&
                   byte_i != mb4_regs_pkg::SPI_OPCODE_READ_REGISTERS0) ? 8'h00 : byte_i;

  // Address of an opcode without an address byte. Three bits tell these opcodes apart, and none of
  // them is the last bit, which comes late.
  assign fixed = byte_i[3] ? Registers0
                           : byte_i[1] ? mb4_regs_pkg::ADDR_INSTR : mb4_regs_pkg::ADDR_STATUS0;

  always_comb begin
    state_d   = state_q;
    addr_d    = addr_q;
    wr_en     = 1'b0;
    rd_en     = 1'b0;

    if (byte_valid_i) begin
      unique case (state_q)
        OPCODE: begin
          // The host sends the opcode. Two opcodes start a read at once. Others may read a byte
          // here too, but it is not sent (tx_en_o = 0).
          unique case (opcode)
            mb4_regs_pkg::SPI_OPCODE_WRITE_REGISTERS:   state_d = ADDR_WRITE;
            mb4_regs_pkg::SPI_OPCODE_READ_REGISTERS:    state_d = ADDR_READ;
            mb4_regs_pkg::SPI_OPCODE_READ_STATUS:       state_d = READ;
            mb4_regs_pkg::SPI_OPCODE_READ_REGISTERS0:   state_d = READ;
            mb4_regs_pkg::SPI_OPCODE_WRITE_INSTRUCTION: state_d = WRITE;
            mb4_regs_pkg::SPI_OPCODE_WRITE_REGISTERS0:  state_d = WRITE;
            default:                                    state_d = IGNORE;
          endcase
          rd_en   = !byte_i[1];
          addr_d  = fixed;
        end
        ADDR_WRITE: begin
          // The host sends the address of a write.
          state_d = WRITE;
          addr_d  = byte_i;
        end
        ADDR_READ: begin
          // The host sends the address of a read. The first data bit leaves with the next falling
          // edge.
          state_d = READ;
          rd_en   = 1'b1;
          addr_d  = byte_i;
        end
        WRITE: begin
          // The host sends bytes. Each one is written, then the address counts up.
          wr_en   = 1'b1;
          addr_d  = addr_q + 8'd1;
        end
        READ: begin
          // The host clocks bytes out. At the end of each byte the next address is read.
          rd_en   = 1'b1;
          addr_d  = addr_q + 8'd1;
        end
        IGNORE: begin
          // Nothing is read or written until NCS rises.
        end
        default: state_d = IGNORE;
      endcase
    end
  end

  always_ff @(posedge sclk_i or negedge frame_rst_ni) begin
    if (!frame_rst_ni) begin
      state_q <= OPCODE;
      addr_q  <= '0;
    end else begin
      state_q <= state_d;
      addr_q  <= addr_d;
    end
  end

  assign tx_en_o = state_q == READ;
  assign host_o.wr_en   = wr_en;
  assign host_o.wr_addr = addr_q;
  assign host_o.wr_data = byte_i;
  assign host_o.rd_en   = rd_en;
  assign host_o.rd_addr = addr_d;

  `ENC_ASSERT(StateInRange_A, sclk_i, frame_rst_ni, state_q <= IGNORE)
  `ENC_ASSERT(ReadOrWrite_A, sclk_i, frame_rst_ni, !(wr_en && rd_en))

endmodule
