-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- An instance of dsl_axil to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.dsl_components.all;

entity dsl_axil_example is
  port (
    s_axi_aclk       : in  std_logic;
    s_axi_aresetn    : in  std_logic;
    s_axi_awvalid    : in  std_logic;
    s_axi_awready    : out std_logic;
    s_axi_awaddr     : in  std_logic_vector(11 downto 0);
    s_axi_wvalid     : in  std_logic;
    s_axi_wready     : out std_logic;
    s_axi_wdata      : in  std_logic_vector(31 downto 0);
    s_axi_wstrb      : in  std_logic_vector(3 downto 0);
    s_axi_bvalid     : out std_logic;
    s_axi_bready     : in  std_logic;
    s_axi_bresp      : out std_logic_vector(1 downto 0);
    s_axi_arvalid    : in  std_logic;
    s_axi_arready    : out std_logic;
    s_axi_araddr     : in  std_logic_vector(11 downto 0);
    s_axi_rvalid     : out std_logic;
    s_axi_rready     : in  std_logic;
    s_axi_rdata      : out std_logic_vector(31 downto 0);
    s_axi_rresp      : out std_logic_vector(1 downto 0);
    irq_o            : out std_logic;
    clk_i            : in  std_logic;
    rst_ni           : in  std_logic;
    link_o           : out std_logic;
    sample_edge_o    : out std_logic;
    position_ready_o : out std_logic;
    interrupts_o     : out std_logic_vector(4 downto 0);
    dsl_out_o        : out std_logic;
    dsl_en_o         : out std_logic;
    dsl_in_i         : in  std_logic
  );
end entity;

architecture rtl of dsl_axil_example is
begin
  u_dsl_axil : dsl_axil
    port map (
      s_axi_aclk       => s_axi_aclk,
      s_axi_aresetn    => s_axi_aresetn,
      s_axi_awvalid    => s_axi_awvalid,
      s_axi_awready    => s_axi_awready,
      s_axi_awaddr     => s_axi_awaddr,
      s_axi_wvalid     => s_axi_wvalid,
      s_axi_wready     => s_axi_wready,
      s_axi_wdata      => s_axi_wdata,
      s_axi_wstrb      => s_axi_wstrb,
      s_axi_bvalid     => s_axi_bvalid,
      s_axi_bready     => s_axi_bready,
      s_axi_bresp      => s_axi_bresp,
      s_axi_arvalid    => s_axi_arvalid,
      s_axi_arready    => s_axi_arready,
      s_axi_araddr     => s_axi_araddr,
      s_axi_rvalid     => s_axi_rvalid,
      s_axi_rready     => s_axi_rready,
      s_axi_rdata      => s_axi_rdata,
      s_axi_rresp      => s_axi_rresp,
      irq_o            => irq_o,
      clk_i            => clk_i,
      rst_ni           => rst_ni,
      link_o           => link_o,
      sample_edge_o    => sample_edge_o,
      position_ready_o => position_ready_o,
      interrupts_o     => interrupts_o,
      dsl_out_o        => dsl_out_o,
      dsl_en_o         => dsl_en_o,
      dsl_in_i         => dsl_in_i
    );
end architecture;
