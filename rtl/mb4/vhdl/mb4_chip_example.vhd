-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- An instance of mb4_chip to copy, made by tools/synth/vhdl.py: do not edit. The entity only
-- passes the ports on.

library ieee;
use ieee.std_logic_1164.all;
use work.mb4_components.all;

entity mb4_chip_example is
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
end entity;

architecture rtl of mb4_chip_example is
begin
  u_mb4_chip : mb4_chip
    port map (
      clk_i      => clk_i,
      osc_i      => osc_i,
      nres_i     => nres_i,
      npor_i     => npor_i,
      cfgspi_i   => cfgspi_i,
      int_nmot_i => int_nmot_i,
      ncs_i      => ncs_i,
      ale_i      => ale_i,
      nrd_rnw_i  => nrd_rnw_i,
      nwr_e_i    => nwr_e_i,
      db_i       => db_i,
      db_o       => db_o,
      db_oe_o    => db_oe_o,
      eot_o      => eot_o,
      ner_i      => ner_i,
      ner_low_o  => ner_low_o,
      getsens_i  => getsens_i,
      ma1_o      => ma1_o,
      ma2_o      => ma2_o,
      mo1_o      => mo1_o,
      mo2_o      => mo2_o,
      sl1_i      => sl1_i,
      sl2_i      => sl2_i,
      quirks_i   => quirks_i
    );
end architecture;
