-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- The tops of rtl/mb4 as VHDL components, made by tools/synth/vhdl.py: do not edit. The module
-- behind a component is the plain Verilog of the release (verilog/TOP.v), or the SystemVerilog of
-- rtl/ with its default parameters. Clocks, resets and misuse: the header of rtl/mb4/TOP.sv.

library ieee;
use ieee.std_logic_1164.all;

package mb4_components is

  component mb4_core
    port (
      clk_i     : in  std_logic;
      rst_ni    : in  std_logic;
      por_ni    : in  std_logic;  -- power-on reset; asserted together with rst_ni
      sclk_i    : in  std_logic;
      cs_ni     : in  std_logic;
      mosi_i    : in  std_logic;
      miso_o    : out std_logic;
      miso_oe_o : out std_logic;
      eot_o     : out std_logic;
      ner_low_o : out std_logic;  -- an error flag is set: pull NER low
      ner_i     : in  std_logic;  -- level at NER
      clkeni_o  : out std_logic;  -- 1 = internal oscillator
      paired_o  : out std_logic;  -- CFGIF: line 1 is differential and takes the pins of line 2
      getsens_i : in  std_logic;
      ma1_o     : out std_logic;
      sl1_i     : in  std_logic;
      mo1_o     : out std_logic;
      ma2_o     : out std_logic;
      sl2_i     : in  std_logic;
      mo2_o     : out std_logic;
      quirks_i  : in  std_logic_vector(5 downto 0)
    );
  end component;

  component mb4_engine
    port (
      clk_i      : in  std_logic;
      rst_ni     : in  std_logic;
      por_ni     : in  std_logic;  -- power-on reset; asserted together with rst_ni
      wr_clk_i   : in  std_logic;
      wr_en_i    : in  std_logic;
      wr_addr_i  : in  std_logic_vector(7 downto 0);
      wr_data_i  : in  std_logic_vector(7 downto 0);
      rd_clk_i   : in  std_logic;
      rd_en_i    : in  std_logic;
      rd_addr_i  : in  std_logic_vector(7 downto 0);
      rd_data_o  : out std_logic_vector(7 downto 0);
      rd2_clk_i  : in  std_logic;
      rd2_en_i   : in  std_logic;
      rd2_addr_i : in  std_logic_vector(4 downto 0);
      rd2_data_o : out std_logic_vector(7 downto 0);
      eot_o      : out std_logic;
      ner_low_o  : out std_logic;  -- an error flag is set: pull NER low
      ner_i      : in  std_logic;  -- level at NER
      clkeni_o   : out std_logic;  -- 1 = internal oscillator
      paired_o   : out std_logic;  -- CFGIF: line 1 is differential and takes the pins of line 2
      getsens_i  : in  std_logic;
      ma1_o      : out std_logic;
      sl1_i      : in  std_logic;
      mo1_o      : out std_logic;
      ma2_o      : out std_logic;
      sl2_i      : in  std_logic;
      mo2_o      : out std_logic;
      tap_o      : out std_logic_vector(81 downto 0);
      quirks_i   : in  std_logic_vector(5 downto 0)
    );
  end component;

  component mb4_chip
    port (
      clk_i      : in  std_logic;  -- pin CLK
      osc_i      : in  std_logic;  -- internal oscillator
      nres_i     : in  std_logic;  -- pin NRES
      npor_i     : in  std_logic;  -- internal power-on reset, low together with NRES
      cfgspi_i   : in  std_logic;  -- pin CFGSPI
      int_nmot_i : in  std_logic;  -- pin INT_NMOT
      ncs_i      : in  std_logic;  -- pin NCS
      ale_i      : in  std_logic;  -- pin ALE: SCLK with CFGSPI = 1
      nrd_rnw_i  : in  std_logic;  -- pin NRD_RNW
      nwr_e_i    : in  std_logic;  -- pin NWR_E: 0 = SPI2 with CFGSPI = 1
      db_i       : in  std_logic_vector(7 downto 0);  -- pins DB7..DB0: 0 MOSI; SPI2: 4 NCS, 5 SCLK, 6 MOSI
      db_o       : out std_logic_vector(7 downto 0);  -- 1 MISO; 7 MISO of SPI2
      db_oe_o    : out std_logic_vector(7 downto 0);  -- 1 = pin is driven
      eot_o      : out std_logic;  -- pin EOT
      ner_i      : in  std_logic;  -- level at pin NER
      ner_low_o  : out std_logic;  -- 1 = pin NER is pulled low by the chip
      getsens_i  : in  std_logic;  -- pin GETSENS
      ma1_o      : out std_logic;  -- pin MA1
      ma2_o      : out std_logic;  -- pin MA2_NMA1
      mo1_o      : out std_logic;  -- pin MO1
      mo2_o      : out std_logic;  -- pin MO2_NMO1
      sl1_i      : in  std_logic;  -- pin SL1
      sl2_i      : in  std_logic;  -- pin SL2_NSL1
      quirks_i   : in  std_logic_vector(5 downto 0)
    );
  end component;

  component mb4_axil
    port (
      s_axi_aclk    : in  std_logic;
      s_axi_aresetn : in  std_logic;
      s_axi_awvalid : in  std_logic;
      s_axi_awready : out std_logic;
      s_axi_awaddr  : in  std_logic_vector(11 downto 0);
      s_axi_wvalid  : in  std_logic;
      s_axi_wready  : out std_logic;
      s_axi_wdata   : in  std_logic_vector(31 downto 0);
      s_axi_wstrb   : in  std_logic_vector(3 downto 0);
      s_axi_bvalid  : out std_logic;
      s_axi_bready  : in  std_logic;
      s_axi_bresp   : out std_logic_vector(1 downto 0);
      s_axi_arvalid : in  std_logic;
      s_axi_arready : out std_logic;
      s_axi_araddr  : in  std_logic_vector(11 downto 0);
      s_axi_rvalid  : out std_logic;
      s_axi_rready  : in  std_logic;
      s_axi_rdata   : out std_logic_vector(31 downto 0);
      s_axi_rresp   : out std_logic_vector(1 downto 0);
      irq_o         : out std_logic;
      clk_i         : in  std_logic;
      por_ni        : in  std_logic;  -- power-on reset; asserted together with s_axi_aresetn
      eot_o         : out std_logic;
      ner_low_o     : out std_logic;  -- an error flag is set: pull NER low
      ner_i         : in  std_logic;  -- level at NER
      clkeni_o      : out std_logic;  -- CLKENI as written
      paired_o      : out std_logic;  -- CFGIF: line 1 is differential and takes the pins of line 2
      getsens_i     : in  std_logic;
      ma1_o         : out std_logic;
      sl1_i         : in  std_logic;
      mo1_o         : out std_logic;
      ma2_o         : out std_logic;
      sl2_i         : in  std_logic;
      mo2_o         : out std_logic;
      quirks_i      : in  std_logic_vector(5 downto 0)
    );
  end component;

  component mb4_wb
    port (
      wb_clk_i   : in  std_logic;
      wb_rst_i   : in  std_logic;
      wb_cyc_i   : in  std_logic;
      wb_stb_i   : in  std_logic;
      wb_we_i    : in  std_logic;
      wb_adr_i   : in  std_logic_vector(9 downto 0);
      wb_dat_i   : in  std_logic_vector(31 downto 0);
      wb_sel_i   : in  std_logic_vector(3 downto 0);
      wb_dat_o   : out std_logic_vector(31 downto 0);
      wb_ack_o   : out std_logic;
      wb_err_o   : out std_logic;
      wb_stall_o : out std_logic;  -- of pipelined cycles; classic masters leave it open
      irq_o      : out std_logic;
      clk_i      : in  std_logic;
      por_ni     : in  std_logic;  -- power-on reset; asserted together with wb_rst_i
      eot_o      : out std_logic;
      ner_low_o  : out std_logic;  -- an error flag is set: pull NER low
      ner_i      : in  std_logic;  -- level at NER
      clkeni_o   : out std_logic;  -- CLKENI as written
      paired_o   : out std_logic;  -- CFGIF: line 1 is differential and takes the pins of line 2
      getsens_i  : in  std_logic;
      ma1_o      : out std_logic;
      sl1_i      : in  std_logic;
      mo1_o      : out std_logic;
      ma2_o      : out std_logic;
      sl2_i      : in  std_logic;
      mo2_o      : out std_logic;
      quirks_i   : in  std_logic_vector(5 downto 0)
    );
  end component;
end package;
