// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types and numbers that the whole chip shares. Register addresses and field positions are in the
// generated package mb4_regs_pkg. Neither package refers to the other.

package mb4_pkg;

  // Number of single-cycle data channels, and width in bits of the configuration of one of them.
  // Channel x has the four bytes 0xC0 + 4 (x - 1) .. + 3; the first byte is in bits 7:0.
  localparam int unsigned NUM_SLAVES  = 8;
  localparam int unsigned SLAVE_CFG_W = 32;

  // What captures SL on both clock edges (mb4_sl_capture): flops, or the DDR cell of the pin.
  localparam logic [1:0] SL_FLOPS   = 2'd0;
  localparam logic [1:0] SL_ICE40   = 2'd1;
  localparam logic [1:0] SL_ECP5    = 2'd2;
  localparam logic [1:0] SL_XILINX7 = 2'd3;

  // Configuration of a data channel, as the word lists read it.
  typedef struct packed {
    logic [15:0] crc_start;  // SCRCSTARTx
    logic [7:0]  crc_poly;   // CRC choice in the form of mb4_crc_code
    logic        gray_lstop; // GRAYSx (SSI) or LSTOPx (actuator)
    logic        enscd;      // ENSCDx
    logic [5:0]  scdlen;     // SCDLENx: data bits minus 1
  } slave_cfg_t;

  // Configuration of a control communication (0xE2, 0xE3, 0xE5).
  typedef struct packed {
    logic       wnr;
    logic [6:0] regadr;
    logic [5:0] regnum;
    logic       cts;
    logic       regvers;
    logic [2:0] slaveid;     // or CMD(1:0), IDA_TEST
  } access_t;

  // Configuration outside the data channels (0xE2..0xE9, 0xEC..0xEF, 0xF5).
  typedef struct packed {
    access_t    access;
    logic [1:0] chsel;
    logic       en_mo;
    logic       holdcdm;
    logic [2:0] freqr;
    logic [4:0] freqs;
    logic       nocrc;
    logic       singlebank;
    logic [7:0] freqags;
    logic [7:0] mo_busy;
    logic       slaveloc5;
    logic [1:0] cfgch2;
    logic [1:0] cfgch1;
    logic [7:0] actnsens;
    logic       mavo;
    logic       mafo;
    logic       mavs;
    logic       mafs;
    logic [1:0] cfgif;
    logic       entest;
    logic       clkeni;
  } cfg_t;

  // One data word as the line engine sees it: lengths and CRC are decoded, no register map in it.
  typedef struct packed {
    logic [5:0]  data_last;  // data bits minus 1
    logic        crc_on;
    logic [3:0]  crc_last;   // CRC bits minus 1: 0..7 or 15 (only 15 has bit 3 set)
    logic [7:0]  crc_poly;   // without the highest power; 16-bit CRC: the lower half
    logic [7:0]  crc_top;    // one-hot: highest bit of the remainder; 16-bit CRC: 0
    logic [15:0] crc_start;
    logic        crc_store;  // the received CRC goes to the top byte(s)
    logic        gray;       // the data bits are Gray coded
    logic        actuator;   // the word is sent on MO; SL is not looked at in its slot
    logic        stop;       // a stop bit precedes the data of the actuator
  } word_cfg_t;

  localparam int unsigned WORD_CFG_W = 47;

  // Contents of 0xF4 (datasheet Tables 44..49), bit 7 first.
  typedef struct packed {
    logic       brk;
    logic       holdbank;
    logic       swbank;
    logic       init;
    logic [2:0] instr;
    logic       ags;
  } instr_t;

  // Status bits of the core, one flop for each bit. SVALID is not here: it has two banks.
  typedef struct packed {
    logic       n_err;
    logic       n_agserr;
    logic       n_delayerr;
    logic       n_scderr;
    logic       n_regerr;
    logic       regend;
    logic       eot;
    logic       cdm_timeout;
    logic       cdssel;
    logic [5:0] regbytes;
    logic       cds2;
    logic       sl2;
    logic       cds1;
    logic       sl1;
    logic       swbank_fail;
  } status_t;

  // Slots of a BiSS C control frame: the number of frames since the start bit S (slot 0). A name
  // stands for the CDM of its slot, SLOT_IDA for the CDS. CDS answers CDM one slot later.
  // Datasheet: pages 27..29; commands: decision 31.
  localparam logic [5:0] SLOT_START        = 6'd0;
  localparam logic [5:0] SLOT_CTS          = 6'd1;
  localparam logic [5:0] SLOT_HEADER       = 6'd1;   // first slot that the CRC of the header covers
  localparam logic [5:0] SLOT_CRC          = 6'd12;
  localparam logic [5:0] SLOT_READ         = 6'd16;  // R; EX of a command that is executed at once
  localparam logic [5:0] SLOT_WRITE        = 6'd17;  // W
  localparam logic [5:0] SLOT_BYTE         = 6'd18;  // S of the first data byte
  localparam logic [5:0] SLOT_WAIT         = 6'd19;  // S until the slave answers; first data bit
  localparam logic [5:0] SLOT_DATA_CRC     = 6'd27;
  localparam logic [5:0] SLOT_STOP         = 6'd31;
  localparam logic [5:0] SLOT_NEXT         = 6'd32;  // S of the next byte, or end
  localparam logic [5:0] SLOT_IDA          = 6'd17;  // first acknowledge on CDS
  localparam logic [5:0] SLOT_STOP_COMMAND = 6'd17;
  localparam logic [5:0] SLOT_EX_TESTED    = 6'd24;  // EX after the test; last acknowledge on CDS
  localparam logic [5:0] SLOT_STOP_TESTED  = 6'd25;

  // Generator of the control CRC, x^4 + x + 1, without its highest power.
  localparam logic [3:0] CONTROL_CRC_POLY = 4'h3;

  // Quirks: a static input vector that adapts the chip to real silicon (docs/choices.md).
  localparam int unsigned QUIRKS_W                   = 6;
  localparam int unsigned QUIRK_IDA_TEST_INVERT      = 0;
  localparam int unsigned QUIRK_AGSERR_ON_INSTR_WR   = 1;
  localparam int unsigned QUIRK_AGSERR_ON_HOLDBANK   = 2;
  localparam int unsigned QUIRK_AGS_CLEARED_ON_ERROR = 3;
  localparam int unsigned QUIRK_REVISION_LSB         = 4;  // 2 bits: 0 = Y, 1 = Z, 2 = Z1
  localparam logic [5:0]  QUIRKS_DEFAULT             = 6'b000000;

endpackage
