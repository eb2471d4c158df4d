-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- The tops of rtl/axi as VHDL components, made by tools/synth/vhdl.py: do not edit. The module
-- behind a component is the plain Verilog of the release (verilog/TOP.v), or the SystemVerilog of
-- rtl/ with its default parameters. Clocks, resets and misuse: the header of rtl/axi/TOP.sv.

library ieee;
use ieee.std_logic_1164.all;

package axi_components is

  component biss_spi
    port (
      clk_i            : in  std_logic;
      rst_ni           : in  std_logic;
      sclk_i           : in  std_logic;
      cs_ni            : in  std_logic;
      mosi_i           : in  std_logic;
      miso_o           : out std_logic;
      miso_oe_o        : out std_logic;
      ma_o             : out std_logic;
      slo_i            : in  std_logic;
      ext_sample_clk_i : in  std_logic;
      sample_clk_o     : out std_logic;
      sample_en_i      : in  std_logic;
      error_no         : out std_logic;
      warn_no          : out std_logic;
      irq_o            : out std_logic
    );
  end component;
end package;
