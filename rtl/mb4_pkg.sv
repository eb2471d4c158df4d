// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types and numbers shared by the whole chip. Register addresses and field positions are not here
// but in the generated mb4_regs_pkg; neither package refers to the other.

package mb4_pkg;

  // Single-cycle data channels of the chip and width of one channel's four configuration bytes
  // (0xC0 + 4 (x - 1) .. + 3, first byte in bits 7:0).
  localparam int unsigned NUM_SLAVES  = 8;
  localparam int unsigned SLAVE_CFG_W = 32;

  // What captures SL on both clock edges (mb4_sl_capture): flops, or the pin's DDR cell.
  localparam logic [1:0] SL_FLOPS   = 2'd0;
  localparam logic [1:0] SL_ICE40   = 2'd1;
  localparam logic [1:0] SL_ECP5    = 2'd2;
  localparam logic [1:0] SL_XILINX7 = 2'd3;

  typedef struct packed {
    logic [15:0] crc_start;  // SCRCSTARTx
    logic        selcrc;     // SELCRCSx: 1 = crc_code is the polynomial without its last 1
    logic [6:0]  crc_code;   // SCRCLENx or SCRCPOLYx(7:1)
    logic        gray_lstop; // GRAYSx (SSI) or LSTOPx (actuator)
    logic        enscd;      // ENSCDx
    logic [5:0]  scdlen;     // SCDLENx: data bits minus 1
  } slave_cfg_t;

  // Everything the host configures outside the slaves (0xE2..0xEF, 0xF5).
  typedef struct packed {
    logic       wnr;
    logic [6:0] regadr;
    logic [5:0] regnum;
    logic [1:0] chsel;
    logic       cts;
    logic       regvers;
    logic [2:0] slaveid;     // or CMD(1:0), IDA_TEST
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

  // One data word as the line engine sees it: lengths and CRC decoded, no register map in it.
  typedef struct packed {
    logic [5:0]  data_last;  // data bits minus 1
    logic [4:0]  crc_len;    // 0, 1..8 or 16
    logic [7:0]  crc_poly;   // without the highest power; 16-bit CRC: its lower half
    logic [7:0]  crc_top;    // one-hot: highest bit of the remainder; 16-bit CRC: 0
    logic [15:0] crc_start;
    logic        crc_store;  // received CRC goes to the top byte(s)
    logic        gray;       // data bits are Gray coded
    logic        actuator;   // sent on MO; what SL shows meanwhile is not looked at
    logic        stop;       // a stop bit precedes the data of the actuator
  } word_cfg_t;

  localparam int unsigned WORD_CFG_W = 47;

  // What 0xF4 holds (datasheet Tables 44..49), bit 7 first.
  typedef struct packed {
    logic       brk;
    logic       holdbank;
    logic       swbank;
    logic       init;
    logic [2:0] instr;
    logic       ags;
  } instr_t;

  // Status as the core drives it, one flop a bit; SVALID comes from its banks.
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

  // Slots of a BiSS C control frame: frames since the start bit S (slot 0). CDM of the slots named;
  // CDS answers one slot later. Datasheet pages 27..29; decision 31 for the commands.
  localparam logic [5:0] SLOT_START        = 6'd0;
  localparam logic [5:0] SLOT_CTS          = 6'd1;
  localparam logic [5:0] SLOT_HEADER       = 6'd1;   // covered by the header's CRC from here on
  localparam logic [5:0] SLOT_CRC          = 6'd12;
  localparam logic [5:0] SLOT_READ         = 6'd16;  // R; EX of a command executed at once
  localparam logic [5:0] SLOT_WRITE        = 6'd17;  // W
  localparam logic [5:0] SLOT_BYTE         = 6'd18;  // S of the data part
  localparam logic [5:0] SLOT_WAIT         = 6'd19;  // first data bit, or S again
  localparam logic [5:0] SLOT_DATA_CRC     = 6'd27;
  localparam logic [5:0] SLOT_STOP         = 6'd31;
  localparam logic [5:0] SLOT_NEXT         = 6'd32;  // S of the next byte, or the end
  localparam logic [5:0] SLOT_IDA          = 6'd17;  // first acknowledge on CDS
  localparam logic [5:0] SLOT_STOP_COMMAND = 6'd17;
  localparam logic [5:0] SLOT_EX_TESTED    = 6'd24;  // and last acknowledge on CDS
  localparam logic [5:0] SLOT_STOP_TESTED  = 6'd25;

  // Generator of the control CRC, x^4 + x + 1, without its highest power.
  localparam logic [3:0] CONTROL_CRC_POLY = 4'h3;

  // Quirks: one static input vector by which real silicon can be matched (docs/choices.md).
  localparam int unsigned QUIRKS_W                   = 6;
  localparam int unsigned QUIRK_IDA_TEST_INVERT      = 0;
  localparam int unsigned QUIRK_AGSERR_ON_INSTR_WR   = 1;
  localparam int unsigned QUIRK_AGSERR_ON_HOLDBANK   = 2;
  localparam int unsigned QUIRK_AGS_CLEARED_ON_ERROR = 3;
  localparam int unsigned QUIRK_REVISION_LSB         = 4;  // 2 bits: 0 = Y, 1 = Z, 2 = Z1
  localparam logic [5:0]  QUIRKS_DEFAULT             = 6'b000100;

endpackage
