-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- An instance of mb4_wb to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.mb4_components.all;

entity mb4_wb_example is
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
end entity;

architecture rtl of mb4_wb_example is
begin
  u_mb4_wb : mb4_wb
    port map (
      wb_clk_i   => wb_clk_i,
      wb_rst_i   => wb_rst_i,
      wb_cyc_i   => wb_cyc_i,
      wb_stb_i   => wb_stb_i,
      wb_we_i    => wb_we_i,
      wb_adr_i   => wb_adr_i,
      wb_dat_i   => wb_dat_i,
      wb_sel_i   => wb_sel_i,
      wb_dat_o   => wb_dat_o,
      wb_ack_o   => wb_ack_o,
      wb_err_o   => wb_err_o,
      wb_stall_o => wb_stall_o,
      irq_o      => irq_o,
      clk_i      => clk_i,
      por_ni     => por_ni,
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
      quirks_i   => quirks_i
    );
end architecture;
