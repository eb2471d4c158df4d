// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Configuration registers 0xE2..0xE9, 0xEC..0xEF and 0xF5. The registers of the data channels are
// in mb4_slave_cfg.
//
// Clock domain: host (wr_clk_i: SCLK or bus strobe); no system clock is needed. An edge of wr_clk_i
// with host_i.wr_en writes; rd_data_o is combinational from bits 4..1 of host_i.rd_addr and has the
// registers of both addresses, the odd one in the upper byte. A register without reserved bits
// reads 0 here: mb4_recent reads it back. The outputs are quasi-static for the core: the datasheet
// (page 28) asks the host to keep them stable while frames run. An instruction that the host writes
// after them reaches the core when they have settled (docs/crossings.md).
// Bits of features that the core does not have are like reserved ones (decision 44).
// Misuse: reserved bits and addresses accept writes and read 0 (decision 13). Table 35 does not
// permit FREQS code 0x10; it gives f_CLK / 20.
// Datasheet: pages 21..31, Tables 6..43.

module mb4_cfg_regs #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic       wr_clk_i,
  input  logic       rst_ni,
  // host byte bus
  input  mb4_pkg::host_t host_i,
  output logic [15:0] rd_data_o,
  // configuration
  output mb4_pkg::cfg_t cfg_o
);

  localparam bit CONTROL = Features[mb4_pkg::CONTROL_LSB];
  localparam bit MO      = Features[mb4_pkg::MO_LSB];
  localparam bit FORCE   = Features[mb4_pkg::FORCE_LSB];
  localparam logic [7:0] PRESENT = mb4_pkg::channels(Features[mb4_pkg::TWO_LINES_LSB],
                                                     Features[mb4_pkg::SLAVES_LSB +: 4]);

  // Bits that the host can write.
  localparam logic [7:0] REGADR = mb4_regs_pkg::WMASK_REGADR & {8{CONTROL}};
  localparam logic [7:0] REGNUM = mb4_regs_pkg::WMASK_REGNUM & {8{CONTROL}};
  localparam logic [7:0] CTRL   = mb4_regs_pkg::WMASK_CTRL &
      ~((mb4_regs_pkg::CTS_MASK | mb4_regs_pkg::SLAVEID_MASK) & {8{!CONTROL}});
  localparam logic [7:0] MO_BUSY  = mb4_regs_pkg::WMASK_MO_BUSY & {8{MO}};
  localparam logic [7:0] ACTNSENS = mb4_regs_pkg::WMASK_ACTNSENS & {8{MO}} & PRESENT;
  localparam logic [7:0] IFACE    = mb4_regs_pkg::WMASK_IFACE &
      ~((mb4_regs_pkg::MAFS_MASK | mb4_regs_pkg::MAVS_MASK | mb4_regs_pkg::MAFO_MASK |
         mb4_regs_pkg::MAVO_MASK) & {8{!FORCE}});

  // Bits that the host cannot write stay 0.
  logic [7:0] regadr_q;
  logic [7:0] regnum_q;
  logic [7:0] chsel_q;
  logic [7:0] ctrl_q;
  logic [7:0] freq_q;
  logic [7:0] bankcfg_q;
  logic [7:0] freqags_q;
  logic [7:0] mo_busy_q;
  logic [7:0] slaveloc5_q;
  logic [7:0] cfgch_q;
  logic [7:0] actnsens_q;
  logic [7:0] iface_q;

  mb4_pkg::access_t access;
  logic [4:1] rd_addr;
  logic       unused;

  assign rd_addr = host_i.rd_addr[4:1];
  assign unused  = ^host_i;   // the other bits

  always_ff @(posedge wr_clk_i or negedge rst_ni) begin
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
    end else if (host_i.wr_en) begin
      unique case (host_i.wr_addr)
        mb4_regs_pkg::ADDR_REGADR:    regadr_q    <= host_i.wr_data & REGADR;
        mb4_regs_pkg::ADDR_REGNUM:    regnum_q    <= host_i.wr_data & REGNUM;
        mb4_regs_pkg::ADDR_CHSEL:     chsel_q     <= host_i.wr_data & mb4_regs_pkg::WMASK_CHSEL;
        mb4_regs_pkg::ADDR_CTRL:      ctrl_q      <= host_i.wr_data & CTRL;
        mb4_regs_pkg::ADDR_FREQ:      freq_q      <= host_i.wr_data & mb4_regs_pkg::WMASK_FREQ;
        mb4_regs_pkg::ADDR_BANKCFG:   bankcfg_q   <= host_i.wr_data & mb4_regs_pkg::WMASK_BANKCFG;
        mb4_regs_pkg::ADDR_FREQAGS:   freqags_q   <= host_i.wr_data & mb4_regs_pkg::WMASK_FREQAGS;
        mb4_regs_pkg::ADDR_MO_BUSY:   mo_busy_q   <= host_i.wr_data & MO_BUSY;
        mb4_regs_pkg::ADDR_SLAVELOC5: slaveloc5_q <= host_i.wr_data & mb4_regs_pkg::WMASK_SLAVELOC5;
        mb4_regs_pkg::ADDR_CFGCH:     cfgch_q     <= host_i.wr_data & mb4_regs_pkg::WMASK_CFGCH;
        mb4_regs_pkg::ADDR_ACTNSENS:  actnsens_q  <= host_i.wr_data & ACTNSENS;
        mb4_regs_pkg::ADDR_IFACE:     iface_q     <= host_i.wr_data & IFACE;
        default: ;  // not kept here
      endcase
    end
  end

  // mb4_recent reads the registers without a reserved bit back.
  always_comb begin
    for (int unsigned k = 0; k < 2; k++) begin
      unique case ({mb4_regs_pkg::ADDR_REGADR[7:5], rd_addr[4:1], 1'(k)})
        mb4_regs_pkg::ADDR_REGADR:    rd_data_o[8*k +: 8] = REGADR == 8'hFF ? 8'h00 : regadr_q;
        mb4_regs_pkg::ADDR_REGNUM:    rd_data_o[8*k +: 8] = regnum_q;
        mb4_regs_pkg::ADDR_CHSEL:     rd_data_o[8*k +: 8] = chsel_q;
        mb4_regs_pkg::ADDR_CTRL:      rd_data_o[8*k +: 8] = ctrl_q;
        mb4_regs_pkg::ADDR_FREQ:
          rd_data_o[8*k +: 8] = mb4_regs_pkg::WMASK_FREQ == 8'hFF ? 8'h00 : freq_q;
        mb4_regs_pkg::ADDR_BANKCFG:   rd_data_o[8*k +: 8] = bankcfg_q;
        mb4_regs_pkg::ADDR_FREQAGS:
          rd_data_o[8*k +: 8] = mb4_regs_pkg::WMASK_FREQAGS == 8'hFF ? 8'h00 : freqags_q;
        mb4_regs_pkg::ADDR_MO_BUSY:   rd_data_o[8*k +: 8] = MO_BUSY == 8'hFF ? 8'h00 : mo_busy_q;
        mb4_regs_pkg::ADDR_SLAVELOC5:
          rd_data_o[8*k +: 8] = slaveloc5_q | mb4_regs_pkg::RESET_SLAVELOC5;
        mb4_regs_pkg::ADDR_CFGCH:     rd_data_o[8*k +: 8] = cfgch_q;
        mb4_regs_pkg::ADDR_ACTNSENS:  rd_data_o[8*k +: 8] = ACTNSENS == 8'hFF ? 8'h00 : actnsens_q;
        mb4_regs_pkg::ADDR_IFACE:     rd_data_o[8*k +: 8] = IFACE == 8'hFF ? 8'h00 : iface_q;
        default:                      rd_data_o[8*k +: 8] = 8'h00;
      endcase
    end
  end

  assign access.wnr     = regadr_q[mb4_regs_pkg::WNR_LSB];
  assign access.regadr  = regadr_q[mb4_regs_pkg::REGADR_LSB +: mb4_regs_pkg::REGADR_W];
  assign access.regnum  = regnum_q[mb4_regs_pkg::REGNUM_LSB +: mb4_regs_pkg::REGNUM_W];
  assign access.cts     = ctrl_q[mb4_regs_pkg::CTS_LSB];
  assign access.regvers = ctrl_q[mb4_regs_pkg::REGVERS_LSB];
  assign access.slaveid = ctrl_q[mb4_regs_pkg::SLAVEID_LSB +: mb4_regs_pkg::SLAVEID_W];

  assign cfg_o.access     = access;
  assign access.chsel   = chsel_q[mb4_regs_pkg::CHSEL_LSB +: mb4_regs_pkg::CHSEL_W];
  assign cfg_o.en_mo      = ctrl_q[mb4_regs_pkg::EN_MO_LSB];
  assign cfg_o.holdcdm    = ctrl_q[mb4_regs_pkg::HOLDCDM_LSB];
  assign cfg_o.freqr      = freq_q[mb4_regs_pkg::FREQR_LSB +: mb4_regs_pkg::FREQR_W];
  assign cfg_o.freqs      = freq_q[mb4_regs_pkg::FREQS_LSB +: mb4_regs_pkg::FREQS_W];
  assign cfg_o.nocrc      = bankcfg_q[mb4_regs_pkg::NOCRC_LSB];
  assign cfg_o.singlebank = bankcfg_q[mb4_regs_pkg::SINGLEBANK_LSB];
  assign cfg_o.freqags    = freqags_q;
  assign cfg_o.mo_busy    = mo_busy_q;
  assign cfg_o.slaveloc5  = slaveloc5_q[mb4_regs_pkg::SLAVELOC5_LSB];
  assign cfg_o.cfgch2     = cfgch_q[mb4_regs_pkg::CFGCH_LSB + mb4_regs_pkg::CFGCH_LSB_STEP +:
                                    mb4_regs_pkg::CFGCH_W];
  assign cfg_o.cfgch1     = cfgch_q[mb4_regs_pkg::CFGCH_LSB +: mb4_regs_pkg::CFGCH_W];
  assign cfg_o.actnsens   = actnsens_q;
  assign cfg_o.mavo       = iface_q[mb4_regs_pkg::MAVO_LSB];
  assign cfg_o.mafo       = iface_q[mb4_regs_pkg::MAFO_LSB];
  assign cfg_o.mavs       = iface_q[mb4_regs_pkg::MAVS_LSB];
  assign cfg_o.mafs       = iface_q[mb4_regs_pkg::MAFS_LSB];
  assign cfg_o.cfgif      = iface_q[mb4_regs_pkg::CFGIF_LSB +: mb4_regs_pkg::CFGIF_W];
  assign cfg_o.entest     = iface_q[mb4_regs_pkg::ENTEST_LSB];
  assign cfg_o.clkeni     = iface_q[mb4_regs_pkg::CLKENI_LSB];

endmodule
