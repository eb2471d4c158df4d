-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- An instance of mb4_engine to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.mb4_components.all;

entity mb4_engine_example is
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
end entity;

architecture rtl of mb4_engine_example is
begin
  u_mb4_engine : mb4_engine
    port map (
      clk_i      => clk_i,
      rst_ni     => rst_ni,
      por_ni     => por_ni,
      wr_clk_i   => wr_clk_i,
      wr_en_i    => wr_en_i,
      wr_addr_i  => wr_addr_i,
      wr_data_i  => wr_data_i,
      rd_clk_i   => rd_clk_i,
      rd_en_i    => rd_en_i,
      rd_addr_i  => rd_addr_i,
      rd_data_o  => rd_data_o,
      rd2_clk_i  => rd2_clk_i,
      rd2_en_i   => rd2_en_i,
      rd2_addr_i => rd2_addr_i,
      rd2_data_o => rd2_data_o,
      eot_o      => eot_o,
      ner_low_o  => ner_low_o,
      ner_i      => ner_i,
      clkeni_o   => clkeni_o,
      paired_o   => paired_o,
      getsens_i  => getsens_i,
      ma1_o      => ma1_o,
      sl1_i      => sl1_i,
      mo1_o      => mo1_o,
      ma2_o      => ma2_o,
      sl2_i      => sl2_i,
      mo2_o      => mo2_o,
      tap_o      => tap_o,
      quirks_i   => quirks_i
    );
end architecture;
