// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers without a reserved bit, and the configuration of the data channel of a core with one:
// the host reads them back from the memory of mb4_recent. This costs less than their share of a
// multiplexer. This module tells which of them have been written since the reset; the others read
// 0, as their flops do.
//
// Clock domain: wr_clk_i. hits_o is combinational in the address of the read.
// Latency: a register answers from the edge of its write on.
// Misuse: none; an address without a register here neither writes nor hits.
// Features tells which registers the core has whole: bits of a feature that it does not have are
// reserved, and such a register is read elsewhere (decision 44).
// Source: decisions 13, 44.

module mb4_kept #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic       wr_clk_i,
  input  logic       rst_ni,
  input  mb4_pkg::host_t host_i,
  output logic       wr_o,        // the host writes a register that is kept here
  output logic [1:0] hits_o       // one is kept at the odd, at the even address of the read
);

  localparam bit CONTROL = Features[mb4_pkg::CONTROL_LSB];
  localparam bit MO      = Features[mb4_pkg::MO_LSB];
  localparam bit FORCE   = Features[mb4_pkg::FORCE_LSB];
  localparam logic [7:0] PRESENT = mb4_pkg::channels(Features[mb4_pkg::TWO_LINES_LSB],
                                                     Features[mb4_pkg::SLAVES_LSB +: 4]);
  localparam logic [5:0] WHOLE = {CONTROL, 1'b1, 1'b1, MO, MO && PRESENT == 8'hFF, FORCE};
  localparam int unsigned KEPT = PRESENT == 8'h01 ? 10 : 6;

  // One bit for each register that is kept. The bit of the register at this address is set.
  function automatic logic [KEPT-1:0] kept(input logic [7:0] addr);
    kept = KEPT'({{3'b000, addr[7:2] == mb4_regs_pkg::ADDR_SLAVE_CFG[7:2]} << addr[1:0],
                  WHOLE & {addr == mb4_regs_pkg::ADDR_REGADR, addr == mb4_regs_pkg::ADDR_FREQ,
                           addr == mb4_regs_pkg::ADDR_FREQAGS, addr == mb4_regs_pkg::ADDR_MO_BUSY,
                           addr == mb4_regs_pkg::ADDR_ACTNSENS, addr == mb4_regs_pkg::ADDR_IFACE}});
  endfunction

  logic [KEPT-1:0] wr;
  logic [KEPT-1:0] written_q;
  logic            unused;

  assign wr   = kept(host_i.wr_addr) & {KEPT{host_i.wr_en}};
  assign wr_o = wr != '0;

  always_ff @(posedge wr_clk_i or negedge rst_ni) begin
    if (!rst_ni) written_q <= '0;
    else         written_q <= written_q | wr;
  end

  // Bit 0 of the address comes late over SPI, so it only chooses between two results.
  for (genvar k = 0; k < 2; k++) begin : gen_register
    assign hits_o[k] = (kept({host_i.rd_addr[7:1], 1'(k)}) & written_q) != '0;
  end

  assign unused = ^{host_i.wr_data, host_i.rd_en, host_i.rd_addr[0]};

endmodule
