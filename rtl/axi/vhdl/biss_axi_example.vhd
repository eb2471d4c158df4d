-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- An instance of biss_axi to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.biss_axi_component.all;

entity biss_axi_example is
  port (
    axi_aclk          : in  std_logic;
    axi_aresetn       : in  std_logic;
    por_n             : in  std_logic;
    S_AXI_AWADDR      : in  std_logic_vector(7 downto 0);
    S_AXI_AWVALID     : in  std_logic;
    S_AXI_AWREADY     : out std_logic;
    S_AXI_WDATA       : in  std_logic_vector(31 downto 0);
    S_AXI_WSTRB       : in  std_logic_vector(3 downto 0);
    S_AXI_WVALID      : in  std_logic;
    S_AXI_WREADY      : out std_logic;
    S_AXI_BRESP       : out std_logic_vector(1 downto 0);
    S_AXI_BVALID      : out std_logic;
    S_AXI_BREADY      : in  std_logic;
    S_AXI_ARADDR      : in  std_logic_vector(7 downto 0);
    S_AXI_ARVALID     : in  std_logic;
    S_AXI_ARREADY     : out std_logic;
    S_AXI_RDATA       : out std_logic_vector(31 downto 0);
    S_AXI_RRESP       : out std_logic_vector(1 downto 0);
    S_AXI_RVALID      : out std_logic;
    S_AXI_RREADY      : in  std_logic;
    s_axis_tdata      : out std_logic_vector(127 downto 0);
    s_axis_tvalid     : out std_logic;
    s_axis_tready     : in  std_logic;
    s_axis_tlast      : out std_logic;
    s_axis_tuser      : out std_logic_vector(3 downto 0);
    ma                : out std_logic_vector(3 downto 0);
    slo               : in  std_logic_vector(3 downto 0);
    ext_sample_clk    : in  std_logic;
    sample_clk_output : out std_logic;
    sample_en         : in  std_logic;
    error             : out std_logic;
    warn              : out std_logic;
    irq               : out std_logic
  );
end entity;

architecture rtl of biss_axi_example is
begin
  u_biss_axi : biss_axi
    generic map (
      BISS_CHANNEL_WIDTH => 4,
      S_AXIS_TDATA_WIDTH => 128,
      S_AXIS_TUSER_WIDTH => 4
    )
    port map (
      axi_aclk          => axi_aclk,
      axi_aresetn       => axi_aresetn,
      por_n             => por_n,
      S_AXI_AWADDR      => S_AXI_AWADDR,
      S_AXI_AWVALID     => S_AXI_AWVALID,
      S_AXI_AWREADY     => S_AXI_AWREADY,
      S_AXI_WDATA       => S_AXI_WDATA,
      S_AXI_WSTRB       => S_AXI_WSTRB,
      S_AXI_WVALID      => S_AXI_WVALID,
      S_AXI_WREADY      => S_AXI_WREADY,
      S_AXI_BRESP       => S_AXI_BRESP,
      S_AXI_BVALID      => S_AXI_BVALID,
      S_AXI_BREADY      => S_AXI_BREADY,
      S_AXI_ARADDR      => S_AXI_ARADDR,
      S_AXI_ARVALID     => S_AXI_ARVALID,
      S_AXI_ARREADY     => S_AXI_ARREADY,
      S_AXI_RDATA       => S_AXI_RDATA,
      S_AXI_RRESP       => S_AXI_RRESP,
      S_AXI_RVALID      => S_AXI_RVALID,
      S_AXI_RREADY      => S_AXI_RREADY,
      s_axis_tdata      => s_axis_tdata,
      s_axis_tvalid     => s_axis_tvalid,
      s_axis_tready     => s_axis_tready,
      s_axis_tlast      => s_axis_tlast,
      s_axis_tuser      => s_axis_tuser,
      ma                => ma,
      slo               => slo,
      ext_sample_clk    => ext_sample_clk,
      sample_clk_output => sample_clk_output,
      sample_en         => sample_en,
      error             => error,
      warn              => warn,
      irq               => irq
    );
end architecture;
