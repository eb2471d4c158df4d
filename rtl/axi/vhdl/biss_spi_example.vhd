-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- An instance of biss_spi to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.biss_spi_component.all;

entity biss_spi_example is
  port (
    clk_i            : in  std_logic;
    rst_ni           : in  std_logic;
    sclk_i           : in  std_logic;
    cs_ni            : in  std_logic;
    mosi_i           : in  std_logic;
    miso_o           : out std_logic;
    miso_oe_o        : out std_logic;
    ma_o             : out std_logic_vector(1 downto 0);
    slo_i            : in  std_logic_vector(1 downto 0);
    ext_sample_clk_i : in  std_logic;
    sample_clk_o     : out std_logic;
    sample_en_i      : in  std_logic;
    error_no         : out std_logic;
    warn_no          : out std_logic;
    irq_o            : out std_logic
  );
end entity;

architecture rtl of biss_spi_example is
begin
  u_biss_spi : biss_spi
    generic map (
      BISS_CHANNEL_WIDTH => 2
    )
    port map (
      clk_i            => clk_i,
      rst_ni           => rst_ni,
      sclk_i           => sclk_i,
      cs_ni            => cs_ni,
      mosi_i           => mosi_i,
      miso_o           => miso_o,
      miso_oe_o        => miso_oe_o,
      ma_o             => ma_o,
      slo_i            => slo_i,
      ext_sample_clk_i => ext_sample_clk_i,
      sample_clk_o     => sample_clk_o,
      sample_en_i      => sample_en_i,
      error_no         => error_no,
      warn_no          => warn_no,
      irq_o            => irq_o
    );
end architecture;
