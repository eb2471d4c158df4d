-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- The tops of rtl/dsl as VHDL components, made by tools/synth/vhdl.py: do not edit. The module
-- behind a component is the plain Verilog of the release (verilog/TOP.v), or the SystemVerilog of
-- rtl/ with its default parameters. Clocks, resets and misuse: the header of rtl/dsl/TOP.sv.

library ieee;
use ieee.std_logic_1164.all;

package dsl_components is

  component dsl_axil
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
  end component;
end package;
