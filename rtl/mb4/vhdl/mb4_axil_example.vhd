-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- An instance of mb4_axil to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.mb4_components.all;

entity mb4_axil_example is
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
end entity;

architecture rtl of mb4_axil_example is
begin
  u_mb4_axil : mb4_axil
    port map (
      s_axi_aclk    => s_axi_aclk,
      s_axi_aresetn => s_axi_aresetn,
      s_axi_awvalid => s_axi_awvalid,
      s_axi_awready => s_axi_awready,
      s_axi_awaddr  => s_axi_awaddr,
      s_axi_wvalid  => s_axi_wvalid,
      s_axi_wready  => s_axi_wready,
      s_axi_wdata   => s_axi_wdata,
      s_axi_wstrb   => s_axi_wstrb,
      s_axi_bvalid  => s_axi_bvalid,
      s_axi_bready  => s_axi_bready,
      s_axi_bresp   => s_axi_bresp,
      s_axi_arvalid => s_axi_arvalid,
      s_axi_arready => s_axi_arready,
      s_axi_araddr  => s_axi_araddr,
      s_axi_rvalid  => s_axi_rvalid,
      s_axi_rready  => s_axi_rready,
      s_axi_rdata   => s_axi_rdata,
      s_axi_rresp   => s_axi_rresp,
      irq_o         => irq_o,
      clk_i         => clk_i,
      por_ni        => por_ni,
      eot_o         => eot_o,
      ner_low_o     => ner_low_o,
      ner_i         => ner_i,
      clkeni_o      => clkeni_o,
      paired_o      => paired_o,
      getsens_i     => getsens_i,
      ma1_o         => ma1_o,
      sl1_i         => sl1_i,
      mo1_o         => mo1_o,
      ma2_o         => ma2_o,
      sl2_i         => sl2_i,
      mo2_o         => mo2_o,
      quirks_i      => quirks_i
    );
end architecture;
