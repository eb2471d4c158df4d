// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types and numbers that the whole chip shares. Register addresses and field positions are in the
// generated package mb4_regs_pkg. Neither package refers to the other.

package mb4_pkg;

  // Number of single-cycle data channels, and width in bits of the configuration of one of them.
  // Channel x has the four bytes 0xC0 + 4 (x - 1) .. + 3; the first byte is in bits 7:0.
  localparam int unsigned NUM_SLAVES  = 8;
  localparam int unsigned SLAVE_CFG_W = 36;

  // Configuration of a data channel, as the word lists read it.
  typedef struct packed {
    logic [15:0] crc_start;  // SCRCSTARTx
    logic        crc_on;     // CRC choice as mb4_crc_decode makes it
    logic [3:0]  crc_last;
    logic [6:0]  crc_poly;   // without its lowest bit, a 1
    logic        gray_lstop; // GRAYSx (SSI) or LSTOPx (actuator)
    logic        enscd;      // ENSCDx
    logic [5:0]  scdlen;     // SCDLENx: data bits minus 1
  } slave_cfg_t;

  // Configuration of a control communication (0xE2..0xE5).
  typedef struct packed {
    logic [1:0] chsel;
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

  // Contents of 0xF4 (datasheet Tables 44..49), bit 7 first.
  typedef struct packed {
    logic       brk;
    logic       holdbank;
    logic       swbank;
    logic       init;
    logic [2:0] instr;
    logic       ags;
  } instr_t;

  // Accesses of the host, each sampled by its clock. Combinational.
  typedef struct packed {
    logic       wr_en;
    logic [7:0] wr_addr;
    logic [7:0] wr_data;
    logic       rd_en;
    logic [7:0] rd_addr;
  } host_t;

  // Access to a data memory. A byte that is read comes one clock later.
  typedef struct packed {
    logic       en;
    logic [5:0] addr;
    logic [7:0] data;
  } mem_wr_t;

  typedef struct packed {
    logic       en;
    logic [5:0] addr;
  } mem_rd_t;

  // A byte that the host has written, on its way to the core's memories.
  typedef struct packed {
    logic       elsewhere;   // 0: SCDATA, 1: RDATA or SVALID
    logic       select;      // SCDATA: the bank; else 1: SVALID
    logic [5:0] addr;        // of SVALID bit 5 is the bank
    logic [7:0] data;
  } posted_t;

  // What a line brings for SVALID: a word of a data channel (of four) begins, is complete, or is
  // split by SWBANK.
  typedef struct packed {
    logic [1:0] slave;
    logic       begins;
    logic       done;
    logic       ok;          // ... with a right CRC
    logic       split;
  } word_flag_t;

  // 0xF4 on its way to the core. Registers of the host domain.
  typedef struct packed {
    logic [1:0] count;       // one step for each write
    instr_t     written;
  } instr_host_t;

  // ... and back. Registers of the core domain.
  typedef struct packed {
    logic [1:0] ack;         // steps taken
    instr_t     held;
  } instr_core_t;

  // What INSTR, CHSEL and CFGCH ask for (mb4_frame_kind). Vectors {line 2, line 1}.
  typedef struct packed {
    logic [1:0] in_use;      // lines in use
    logic [1:0] ssi;         // lines with SSI
    logic [1:0] manual;      // lines that CHSEL names
    logic [1:0] select;      // ... and whose protocol fits: lines of the control communication
    logic [1:0] frame_use;   // lines of the frame that INSTR asks for
    logic [1:0] init_use;    // lines of INIT
    logic       is_frame;    // INSTR asks for a frame
    logic       is_control;  // ... with a BiSS C control communication
    logic       is_register; // ... that is a BiSS B register access
    logic       is_void;     // INSTR asks for a control communication that no line can do
  } kind_t;

  // What the sequence of frames tells the flags.
  typedef struct packed {
    logic       busy;        // a frame or INIT runs or is requested
    logic       clear;       // INIT, BREAK
    logic       scd_en;      // a frame is complete: scd_bad is its result
    logic       scd_bad;
    logic       ags_error;   // a frame could not start
    logic       bank_fail;   // a bank switch was prevented
  } frame_flags_t;

  // What the sequence of frames tells the banks.
  typedef struct packed {
    logic       run;         // a frame with sensor data runs
    logic       frame_end;   // a frame is complete
    logic       data_end;    // ... with sensor data
    logic       reduced;     // the frame was reduced: only the CDS bits switch
    logic       swap;        // SWBANK has changed its value
    logic       clear;       // INIT of BiSS C begins: SVALID is cleared
  } bank_cmd_t;

  // What the memories and banks tell the sequence of frames. Registers.
  typedef struct packed {
    logic       clears;      // the memories are being cleared after a reset
    logic       pending;     // HOLDBANK holds back a switch of the banks
  } mem_state_t;

  // What the switches of the banks tell the flags. Combinational.
  typedef struct packed {
    logic       swapped;     // the swap of a frame's end happens, or has just happened
    logic       lost;        // the pending swap will not happen
  } bank_event_t;

  // The banks that the host and frames use. Registers.
  typedef struct packed {
    logic       host;
    logic       eng;
  } banks_t;

  // RDATA, for the control communication. A byte that is read comes one clock later.
  typedef struct packed {
    mem_wr_t    wr;
    mem_rd_t    rd;
  } rdata_cmd_t;

  // Requests of automatic frames.
  typedef struct packed {
    logic       due;         // a frame is requested
    logic       asks;        // ..., if the lines are idle
    logic       agsmin;      // FREQAGS is AGSMIN, with AGS = 1 or 0
    logic       infinite;    // FREQAGS is AGSINFINITE
  } request_t;

  // What a control communication tells the flags. Combinational.
  typedef struct packed {
    logic       begins;
    logic       ends;
    logic       reg_error;   // with ends
    logic       delay_error; // with ends: no start bit came
  } access_event_t;

  // ... and what it keeps for the host. Registers.
  typedef struct packed {
    logic       cdm_timeout;
    logic [5:0] good_bytes;
  } access_state_t;

  // Status bits that control makes, one flop for each bit.
  typedef struct packed {
    logic       n_agserr;
    logic       n_delayerr;
    logic       n_scderr;
    logic       n_regerr;
    logic       regend;
    logic       eot;
    logic       swbank_fail;
    logic       cdm_timeout;
    logic [5:0] regbytes;
  } flags_t;

  // Status bits of the core. SVALID and CDS are not here: they have two banks.
  typedef struct packed {
    flags_t     flags;
    logic       n_err;
    logic       sl2;
    logic       sl1;
  } status_t;

  // What a bus top looks at in the register file. Core domain.
  typedef struct packed {
    logic        empty;      // the core has taken all posted bytes; changes with either clock
    banks_t      banks;
    logic [15:0] svalid;     // bank 1 in the upper byte
    logic [3:0]  cds;        // of lines {2, 1}, bank 1 in the upper half
    logic [15:0] hi;         // byte that the second port has read from SCDATA5..8, of both banks
    logic [15:0] lo;         // ... and from SCDATA1..4
  } reg_tap_t;

  // What a bus top looks at in the engine. Core domain; vectors are of lines {2, 1}.
  typedef struct packed {
    reg_tap_t    regs;
    logic        ready;      // the memories are cleared
    logic        slaveloc5;
    logic [1:0]  ssi;        // the line has SSI
    logic [1:0]  start;      // a frame begins on the line
    logic        stop;       // ... and is aborted
    logic [1:0]  ma;
    logic [1:0]  wr;         // a byte of a word comes
    logic [1:0]  done;       // a word ends
    logic [5:0]  slave;      // data channels of these words
    logic        frame_end;
    logic        lost;       // a frame was left out or overwritten
    logic [3:0]  good;       // nAGSERR, nDELAYERR, nSCDERR, nREGERR
    logic        regend;
    logic        swbank_fail;
  } tap_t;

  // A bus top asks the core to fill a shadow. Registers of the bus domain.
  typedef struct packed {
    logic        req;        // changes with each request
    logic        stamp;      // the time; else the snapshot of a data channel
    logic [2:0]  channel;
  } page_req_t;

  // Features of a core (decision 44). They travel as one number, the parameter Features, whose bits
  // are these. The word FEATURES of a bus top's page shows it (mb4_page), and so does a byte of
  // smaller cores.
  localparam int unsigned FREE_CRC_LSB       = 0;   // any CRC polynomial and start value
  localparam int unsigned SLAVES_ON_LINE_LSB = 1;   // a line has more than one data channel
  localparam int unsigned CONTROL_LSB        = 2;   // control communication
  localparam int unsigned MO_LSB             = 3;   // actuators and the delay of MO
  localparam int unsigned SSI_LSB            = 4;   // SSI
  localparam int unsigned BISS_B_LSB         = 5;   // BiSS B
  localparam int unsigned TWO_LINES_LSB      = 6;   // line 2
  localparam int unsigned GRAY_LSB           = 7;   // Gray code
  localparam int unsigned FORCE_LSB          = 8;   // levels of MA and MO by hand
  localparam int unsigned TWO_BANKS_LSB      = 9;   // two banks of data
  localparam int unsigned SLAVES_LSB         = 12;  // data channels, 4 bits
  localparam logic [31:0] FEATURES_FULL = 32'h000083FF;
  localparam logic [7:0]  ADDR_FEATURES = 8'h7F;  // of FEATURES(6:0), in cores that are not full

  // SLAVES is 0 if a number is out of its range; mb4_engine then stops.
  function automatic logic [31:0] features(
      input logic [31:0] lines, input logic [31:0] slaves, input logic [31:0] banks,
      input logic force_bits, input logic gray, input logic biss_b, input logic ssi,
      input logic mo, input logic control, input logic free_crc);
    features = 32'd0;
    features[FREE_CRC_LSB]       = free_crc;
    features[SLAVES_ON_LINE_LSB] = slaves != 32'd1;
    features[CONTROL_LSB]        = control;
    features[MO_LSB]             = mo;
    features[SSI_LSB]            = ssi;
    features[BISS_B_LSB]         = biss_b;
    features[TWO_LINES_LSB]      = lines == 32'd2;
    features[GRAY_LSB]           = gray;
    features[FORCE_LSB]          = force_bits;
    features[TWO_BANKS_LSB]      = banks == 32'd2;
    features[SLAVES_LSB +: 4]    = slaves[3:0];
    if (lines < 32'd1 || lines > 32'd2 || banks < 32'd1 || banks > 32'd2 || slaves > 32'd8 ||
        (lines == 32'd2 && slaves > 32'd4 && slaves != 32'd8)) features[SLAVES_LSB +: 4] = 4'd0;
  endfunction

  // Data channels of a core; those of one line if the other one has data channels 5..8.
  function automatic logic [7:0] channels(input logic two_lines, input logic [3:0] slaves);
    channels = (8'h01 << slaves) - 8'h01;
    if (two_lines && !slaves[3]) channels[7:4] = channels[3:0];
  endfunction

  // The core has SCDATA or RDATA at this address.
  function automatic logic in_memory(input logic [7:3] addr, input logic [7:0] present,
                                     input logic control);
    in_memory = !addr[6] && (addr[7] ? control : present[addr[5:3]]);
  endfunction

  // Quirks: a static input vector that adapts the chip to real silicon (docs/choices.md).
  localparam int unsigned QUIRKS_W                   = 6;
  localparam int unsigned QUIRK_IDA_TEST_INVERT      = 0;
  localparam int unsigned QUIRK_AGSERR_ON_INSTR_WR   = 1;
  localparam int unsigned QUIRK_AGSERR_ON_HOLDBANK   = 2;
  localparam int unsigned QUIRK_AGS_CLEARED_ON_ERROR = 3;
  localparam int unsigned QUIRK_REVISION_LSB = 4;   // 2 bits: 0 = Y, 1 = Z, 2 = Z1
  localparam logic [5:0]  QUIRKS_DEFAULT             = 6'b000000;

endpackage
