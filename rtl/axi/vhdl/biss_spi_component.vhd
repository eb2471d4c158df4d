-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- biss_spi as a VHDL component, made by tools/synth/vhdl.py: do not edit. The module behind it is
-- rtl/axi/biss_spi.sv, for tools that read both languages. With the default generics it is the
-- plain Verilog of a release too (verilog/biss_spi.v).
-- Clock, reset and misuse: the header of rtl/axi/biss_spi.sv.

library ieee;
use ieee.std_logic_1164.all;

package biss_spi_component is

  component biss_spi
    generic (
      BISS_CHANNEL_WIDTH  : natural := 1;  -- channels, 1 to 4
      ENABLE_ACTIVE_LOW   : natural range 0 to 1 := 0;  -- 0x20: 0 = enabled
      CRC_BIT_IGNORES     : natural range 0 to 1 := 0;  -- 0x1C: 1 = not checked
      VALID_UNTIL_REQUEST : natural range 0 to 1 := 1;  -- an accepted request clears 0x34
      START_LIMIT         : natural := 1024;  -- MA periods up to the start bit
      TIMEOUT_LIMIT       : natural := 4000;  -- clocks of an encoder's timeout
      ALIGN_LATCH         : natural range 0 to 1 := 0;  -- 0x28 acts
      EXTRAS              : natural := 0  -- bits as in axi_pkg and register FEATURES
    );
    port (
      clk_i            : in  std_logic;
      rst_ni           : in  std_logic;
      sclk_i           : in  std_logic;
      cs_ni            : in  std_logic;
      mosi_i           : in  std_logic;
      miso_o           : out std_logic;
      miso_oe_o        : out std_logic;
      ma_o             : out std_logic_vector(BISS_CHANNEL_WIDTH-1 downto 0);
      slo_i            : in  std_logic_vector(BISS_CHANNEL_WIDTH-1 downto 0);
      ext_sample_clk_i : in  std_logic;
      sample_clk_o     : out std_logic;
      sample_en_i      : in  std_logic;
      error_no         : out std_logic;
      warn_no          : out std_logic;
      irq_o            : out std_logic
    );
  end component;

end package;
