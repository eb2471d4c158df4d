














module mb4_cfg_regs (
  input  logic       hclk_i,
  input  logic       rst_ni,
  
  input  mb4_pkg_host_t host_i,
  output logic [7:0] rd_data_o,
  
  output mb4_pkg_cfg_t cfg_o
);

  
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

  mb4_pkg_access_t access;
  logic [7:0] rd_addr;

  assign rd_addr = host_i.rd_addr;

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
    end else if (host_i.wr_en) begin
      case (host_i.wr_addr)
        mb4_regs_pkg_ADDR_REGADR:    regadr_q    <= host_i.wr_data & mb4_regs_pkg_WMASK_REGADR;
        mb4_regs_pkg_ADDR_REGNUM:    regnum_q    <= host_i.wr_data & mb4_regs_pkg_WMASK_REGNUM;
        mb4_regs_pkg_ADDR_CHSEL:     chsel_q     <= host_i.wr_data & mb4_regs_pkg_WMASK_CHSEL;
        mb4_regs_pkg_ADDR_CTRL:      ctrl_q      <= host_i.wr_data & mb4_regs_pkg_WMASK_CTRL;
        mb4_regs_pkg_ADDR_FREQ:      freq_q      <= host_i.wr_data & mb4_regs_pkg_WMASK_FREQ;
        mb4_regs_pkg_ADDR_BANKCFG:   bankcfg_q   <= host_i.wr_data & mb4_regs_pkg_WMASK_BANKCFG;
        mb4_regs_pkg_ADDR_FREQAGS:   freqags_q   <= host_i.wr_data & mb4_regs_pkg_WMASK_FREQAGS;
        mb4_regs_pkg_ADDR_MO_BUSY:   mo_busy_q   <= host_i.wr_data & mb4_regs_pkg_WMASK_MO_BUSY;
        mb4_regs_pkg_ADDR_SLAVELOC5: slaveloc5_q <= host_i.wr_data & mb4_regs_pkg_WMASK_SLAVELOC5;
        mb4_regs_pkg_ADDR_CFGCH:     cfgch_q     <= host_i.wr_data & mb4_regs_pkg_WMASK_CFGCH;
        mb4_regs_pkg_ADDR_ACTNSENS:  actnsens_q  <= host_i.wr_data & mb4_regs_pkg_WMASK_ACTNSENS;
        mb4_regs_pkg_ADDR_IFACE:     iface_q     <= host_i.wr_data & mb4_regs_pkg_WMASK_IFACE;
        default: ;  
      endcase
    end
  end

  logic [7:0] rd_data_o_shadow; always begin begin
    case (rd_addr)
      mb4_regs_pkg_ADDR_REGADR:    rd_data_o_shadow = regadr_q;
      mb4_regs_pkg_ADDR_REGNUM:    rd_data_o_shadow = regnum_q;
      mb4_regs_pkg_ADDR_CHSEL:     rd_data_o_shadow = chsel_q;
      mb4_regs_pkg_ADDR_CTRL:      rd_data_o_shadow = ctrl_q;
      mb4_regs_pkg_ADDR_FREQ:      rd_data_o_shadow = freq_q;
      mb4_regs_pkg_ADDR_BANKCFG:   rd_data_o_shadow = bankcfg_q;
      mb4_regs_pkg_ADDR_FREQAGS:   rd_data_o_shadow = freqags_q;
      mb4_regs_pkg_ADDR_MO_BUSY:   rd_data_o_shadow = mo_busy_q;
      mb4_regs_pkg_ADDR_SLAVELOC5: rd_data_o_shadow = slaveloc5_q | mb4_regs_pkg_RESET_SLAVELOC5;
      mb4_regs_pkg_ADDR_CFGCH:     rd_data_o_shadow = cfgch_q;
      mb4_regs_pkg_ADDR_ACTNSENS:  rd_data_o_shadow = actnsens_q;
      mb4_regs_pkg_ADDR_IFACE:     rd_data_o_shadow = iface_q;
      default:                      rd_data_o_shadow = 8'h00;
    endcase
  end rd_data_o = rd_data_o_shadow; @(actnsens_q or bankcfg_q or cfgch_q or chsel_q or ctrl_q or freq_q or freqags_q or iface_q or mo_busy_q or rd_addr or regadr_q or regnum_q or slaveloc5_q); end

  assign access.wnr     = regadr_q[mb4_regs_pkg_WNR_LSB];
  assign access.regadr  = regadr_q[mb4_regs_pkg_REGADR_LSB +: mb4_regs_pkg_REGADR_W];
  assign access.regnum  = regnum_q[mb4_regs_pkg_REGNUM_LSB +: mb4_regs_pkg_REGNUM_W];
  assign access.cts     = ctrl_q[mb4_regs_pkg_CTS_LSB];
  assign access.regvers = ctrl_q[mb4_regs_pkg_REGVERS_LSB];
  assign access.slaveid = ctrl_q[mb4_regs_pkg_SLAVEID_LSB +: mb4_regs_pkg_SLAVEID_W];

  assign cfg_o.access     = access;
  assign access.chsel   = chsel_q[mb4_regs_pkg_CHSEL_LSB +: mb4_regs_pkg_CHSEL_W];
  assign cfg_o.en_mo      = ctrl_q[mb4_regs_pkg_EN_MO_LSB];
  assign cfg_o.holdcdm    = ctrl_q[mb4_regs_pkg_HOLDCDM_LSB];
  assign cfg_o.freqr      = freq_q[mb4_regs_pkg_FREQR_LSB +: mb4_regs_pkg_FREQR_W];
  assign cfg_o.freqs      = freq_q[mb4_regs_pkg_FREQS_LSB +: mb4_regs_pkg_FREQS_W];
  assign cfg_o.nocrc      = bankcfg_q[mb4_regs_pkg_NOCRC_LSB];
  assign cfg_o.singlebank = bankcfg_q[mb4_regs_pkg_SINGLEBANK_LSB];
  assign cfg_o.freqags    = freqags_q;
  assign cfg_o.mo_busy    = mo_busy_q;
  assign cfg_o.slaveloc5  = slaveloc5_q[mb4_regs_pkg_SLAVELOC5_LSB];
  assign cfg_o.cfgch2     = cfgch_q[mb4_regs_pkg_CFGCH_LSB + mb4_regs_pkg_CFGCH_LSB_STEP +:
                                    mb4_regs_pkg_CFGCH_W];
  assign cfg_o.cfgch1     = cfgch_q[mb4_regs_pkg_CFGCH_LSB +: mb4_regs_pkg_CFGCH_W];
  assign cfg_o.actnsens   = actnsens_q;
  assign cfg_o.mavo       = iface_q[mb4_regs_pkg_MAVO_LSB];
  assign cfg_o.mafo       = iface_q[mb4_regs_pkg_MAFO_LSB];
  assign cfg_o.mavs       = iface_q[mb4_regs_pkg_MAVS_LSB];
  assign cfg_o.mafs       = iface_q[mb4_regs_pkg_MAFS_LSB];
  assign cfg_o.cfgif      = iface_q[mb4_regs_pkg_CFGIF_LSB +: mb4_regs_pkg_CFGIF_W];
  assign cfg_o.entest     = iface_q[mb4_regs_pkg_ENTEST_LSB];
  assign cfg_o.clkeni     = iface_q[mb4_regs_pkg_CLKENI_LSB];

endmodule
