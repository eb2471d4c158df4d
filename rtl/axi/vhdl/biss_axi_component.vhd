-- SPDX-FileCopyrightText: 2026 The openmb4 authors
-- SPDX-License-Identifier: Apache-2.0
--
-- biss_axi as a VHDL component, made by tools/synth/vhdl.py: do not edit. The module behind it is
-- rtl/axi/biss_axi.sv, for tools that read both languages. With the default generics it is the
-- plain Verilog of a release too (verilog/biss_axi.v). A default cannot follow another generic
-- here: with other parameters set S_AXIS_TDATA_WIDTH and S_AXIS_TUSER_WIDTH too, to what the formula
-- beside each of them gives. Another width stops the elaboration, and the error names the right one.
-- Clock, reset and misuse: the header of rtl/axi/biss_axi.sv.

library ieee;
use ieee.std_logic_1164.all;

package biss_axi_component is

  component biss_axi
    generic (
      BISS_CHANNEL_WIDTH  : natural := 1;  -- channels, 1 to 16
      STREAM_MODE         : natural := 0;  -- 0: one beat; 1: one beat for each channel
      STREAM_WIDTH        : natural := 32;  -- mode 1: 32 or 64
      STREAM_DEPTH        : natural := 16;  -- mode 1: beats in the FIFO, a power of 2
      ENABLE_ACTIVE_LOW   : natural range 0 to 1 := 0;  -- 0x20: 0 = enabled
      CRC_BIT_IGNORES     : natural range 0 to 1 := 0;  -- 0x1C: 1 = not checked
      VALID_UNTIL_REQUEST : natural range 0 to 1 := 1;  -- an accepted request clears 0x34
      START_LIMIT         : natural := 1024;  -- MA periods up to the start bit
      TIMEOUT_LIMIT       : natural := 4000;  -- clocks of an encoder's timeout
      ALIGN_LATCH         : natural range 0 to 1 := 0;  -- 0x28 acts
      EXTRAS              : natural := 0;  -- bits as in axi_pkg and register FEATURES
      POR_PIN             : natural range 0 to 1 := 0;  -- 1: por_n alone resets MA
      S_AXIS_TDATA_WIDTH  : natural := 32;  -- STREAM_MODE == 1 ? STREAM_WIDTH : ((EXTRAS & 2) != 0 ? 64 : 32) * BISS_CHANNEL_WIDTH
      S_AXIS_TUSER_WIDTH  : natural := 1  -- STREAM_MODE == 0 ? BISS_CHANNEL_WIDTH : 16
    );
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
      s_axis_tdata      : out std_logic_vector(S_AXIS_TDATA_WIDTH-1 downto 0);
      s_axis_tvalid     : out std_logic;
      s_axis_tready     : in  std_logic;
      s_axis_tlast      : out std_logic;
      s_axis_tuser      : out std_logic_vector(S_AXIS_TUSER_WIDTH-1 downto 0);
      ma                : out std_logic_vector(BISS_CHANNEL_WIDTH-1 downto 0);
      slo               : in  std_logic_vector(BISS_CHANNEL_WIDTH-1 downto 0);
      ext_sample_clk    : in  std_logic;
      sample_clk_output : out std_logic;
      sample_en         : in  std_logic;
      error             : out std_logic;
      warn              : out std_logic;
      irq               : out std_logic
    );
  end component;

end package;
