// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Configuration registers 0xE2..0xE9, 0xEC..0xEF and 0xF5. The registers of the data channels are
// in mb4_slave_cfg.
//
// Clock domain: host (hclk_i: SCLK or bus strobe); no system clock is needed. An edge of hclk_i
// with wr_en_i writes; rd_data_o is combinational from rd_addr_i. The outputs are quasi-static for
// the core: the datasheet (page 28) asks the host to keep them stable while frames run. An
// instruction that the host writes after them reaches the core when they have settled
// (docs/crossings.md).
// Misuse: reserved bits and addresses accept writes and read 0 (decision 13). Table 35 does not
// permit FREQS code 0x10; it gives f_CLK / 20.
// Datasheet: pages 21..31, Tables 6..43.

module mb4_cfg_regs (
  input  logic       hclk_i,
  input  logic       rst_ni,
  // host byte bus
  input  logic       wr_en_i,
  input  logic [7:0] wr_addr_i,
  input  logic [7:0] wr_data_i,
  input  logic [7:0] rd_addr_i,
  output logic [7:0] rd_data_o,
  // configuration
  output mb4_pkg::cfg_t cfg_o
);

  logic [7:0] regadr_q;
  logic [5:0] regnum_q;
  logic [1:0] chsel_q;
  logic [7:0] ctrl_q;
  logic [7:0] freq_q;
  logic [1:0] bankcfg_q;
  logic [7:0] freqags_q;
  logic [7:0] mo_busy_q;
  logic       slaveloc5_q;
  logic [3:0] cfgch_q;
  logic [7:0] actnsens_q;
  logic [7:0] iface_q;

  always_ff @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      regadr_q    <= '0;
      regnum_q    <= '0;
      chsel_q     <= '0;
      ctrl_q      <= '0;
      freq_q      <= '0;
      bankcfg_q   <= '0;
      freqags_q   <= '0;
      mo_busy_q   <= '0;
      slaveloc5_q <= '0;
      cfgch_q     <= '0;
      actnsens_q  <= '0;
      iface_q     <= '0;
    end else if (wr_en_i) begin
      unique case (wr_addr_i)
        mb4_regs_pkg::ADDR_REGADR:    regadr_q    <= wr_data_i;
        mb4_regs_pkg::ADDR_REGNUM:    regnum_q    <= wr_data_i[5:0];
        mb4_regs_pkg::ADDR_CHSEL:     chsel_q     <= wr_data_i[1:0];
        mb4_regs_pkg::ADDR_CTRL:      ctrl_q      <= wr_data_i & mb4_regs_pkg::WMASK_CTRL;
        mb4_regs_pkg::ADDR_FREQ:      freq_q      <= wr_data_i;
        mb4_regs_pkg::ADDR_BANKCFG:   bankcfg_q   <= wr_data_i[1:0];
        mb4_regs_pkg::ADDR_FREQAGS:   freqags_q   <= wr_data_i;
        mb4_regs_pkg::ADDR_MO_BUSY:   mo_busy_q   <= wr_data_i;
        mb4_regs_pkg::ADDR_SLAVELOC5: slaveloc5_q <= wr_data_i[4];
        mb4_regs_pkg::ADDR_CFGCH:     cfgch_q     <= wr_data_i[3:0];
        mb4_regs_pkg::ADDR_ACTNSENS:  actnsens_q  <= wr_data_i;
        mb4_regs_pkg::ADDR_IFACE:     iface_q     <= wr_data_i;
        default: ;  // not kept here
      endcase
    end
  end

  always_comb begin
    unique case (rd_addr_i)
      mb4_regs_pkg::ADDR_REGADR:    rd_data_o = regadr_q;
      mb4_regs_pkg::ADDR_REGNUM:    rd_data_o = {2'b00, regnum_q};
      mb4_regs_pkg::ADDR_CHSEL:     rd_data_o = {6'b000000, chsel_q};
      mb4_regs_pkg::ADDR_CTRL:      rd_data_o = ctrl_q;
      mb4_regs_pkg::ADDR_FREQ:      rd_data_o = freq_q;
      mb4_regs_pkg::ADDR_BANKCFG:   rd_data_o = {6'b000000, bankcfg_q};
      mb4_regs_pkg::ADDR_FREQAGS:   rd_data_o = freqags_q;
      mb4_regs_pkg::ADDR_MO_BUSY:   rd_data_o = mo_busy_q;
      mb4_regs_pkg::ADDR_SLAVELOC5: rd_data_o = {3'b000, slaveloc5_q, 4'b0001};
      mb4_regs_pkg::ADDR_CFGCH:     rd_data_o = {4'b0000, cfgch_q};
      mb4_regs_pkg::ADDR_ACTNSENS:  rd_data_o = actnsens_q;
      mb4_regs_pkg::ADDR_IFACE:     rd_data_o = iface_q;
      default:                      rd_data_o = 8'h00;
    endcase
  end

  assign cfg_o = {regadr_q, regnum_q, ctrl_q[7:3], chsel_q, ctrl_q[1:0], freq_q, bankcfg_q,
                  freqags_q, mo_busy_q, slaveloc5_q, cfgch_q, actnsens_q, iface_q};

endmodule
