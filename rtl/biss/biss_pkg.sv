// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Commands to a line of BiSS or SSI, and the answers of the line. No register map stands here, so
// any master can use the line.
//
// A frame begins on all lines at once, so all lines share one line_go_t, register_ma_t and
// sample_t. Each line has its own value of the other line types. In a vector of two, line 1 is the
// lower half. access_t, access_byte_t and access_end_t belong to the control communication.

package biss_pkg;

  // UNUSED: nothing is on the line, and it does not wait for SL.
  typedef enum logic [1:0] {
    BISS_B = 2'd0,
    BISS_C = 2'd1,
    SSI    = 2'd2,
    UNUSED = 2'd3
  } protocol_e;

  // What captures SL on both clock edges (biss_sl_capture): flops, or the DDR cell of the pin.
  localparam logic [1:0] SL_FLOPS   = 2'd0;
  localparam logic [1:0] SL_ICE40   = 2'd1;
  localparam logic [1:0] SL_ECP5    = 2'd2;
  localparam logic [1:0] SL_XILINX7 = 2'd3;

  // One data word: its lengths and its CRC.
  typedef struct packed {
    logic [5:0]  data_last;  // data bits minus 1
    logic        crc_on;
    logic [3:0]  crc_last;   // CRC bits minus 1: 0..7 or 15 (only 15 has bit 3 set)
    logic [7:0]  crc_poly;   // without the highest power; 16-bit CRC: the lower half
    logic [15:0] crc_start;
    logic        crc_store;  // the received CRC goes to the top byte(s)
    logic        gray;       // the data bits are Gray coded
    logic        actuator;   // the word is sent on MO; SL is not looked at in its slot
    logic        stop;       // a stop bit precedes the data of the actuator
  } word_t;

  // A word list offers its current word. All registers.
  typedef struct packed {
    logic        any;        // the frame has words
    logic        last;       // no word follows this one
    logic [2:0]  slave;      // data channel of the word
    word_t       word;
  } offer_t;

  // Configuration and requests that last. They come from registers.
  typedef struct packed {
    logic [1:0]  protocol;   // protocol_e
    logic        mo_en;      // MO takes part in frames
    logic [7:0]  mo_busy;    // processing clocks that MO shows
    logic        hold_cdm;   // MA keeps the inverted CDM up to the next frame
    logic        forced;     // MA has the level force_level between frames
    logic        force_level;
    logic        mo_low;     // BiSS B register access: MO is 0
  } line_cmd_t;

  // Strobes of the sequence of frames, and what comes with them.
  typedef struct packed {
    logic        start;      // a frame begins on the lines that take part
    logic        init;       // with start: the two pulses of INIT instead of a frame
    logic        register_access; // with start: MA belongs to the BiSS B register access
    logic        reduced;    // the frame ends after CDS, from start to its end
    logic        mo_return;  // INIT: MO returns to 1
    logic        stop;       // MA returns to 1 with the next tick
  } line_go_t;

  // With line_go_t.start, what it means for one line.
  typedef struct packed {
    logic        takes_part;
    logic        cdm0;       // CDM to send if CDS of this frame is 0
    logic        cdm1;       // CDM to send if CDS of this frame is 1
  } line_start_t;

  // MA in a BiSS B register access. Combinational.
  typedef struct packed {
    logic        level;      // from the next tick on
    logic        ends;       // the access ends
  } register_ma_t;

  // Sampling points of SL. Registers of the time base.
  typedef struct packed {
    logic        a;          // beginning of a half period
    logic        b;          // middle of it
    logic        b_neg;      // the middle is at a falling clock edge
  } sample_t;

  // MO reads a byte of an actuator. Registers of the line.
  typedef struct packed {
    logic        rd_en;
    logic [2:0]  slave;
    logic [2:0]  place;      // of the byte in the word
  } mo_read_t;

  // What the sequence of frames needs to know. Flops of the line; timeout and cdm are decoded.
  typedef struct packed {
    logic        idle;       // no frame, and the slaves' timeout has ended
    logic        timeout;    // waiting for SL = 1
    logic        cds;        // of the last frame
    logic        cdm;        // as sent
    logic        sl;         // level at SL, synchronised
  } line_status_t;

  // Ends, each high for one clock. Combinational.
  typedef struct packed {
    logic        line_end;   // the last data bit has been taken
    logic        init_done;  // the slaves have acknowledged INIT
    logic        init_fail;  // they have not
  } line_event_t;

  // Words of sensors. Combinational.
  typedef struct packed {
    logic [2:0]  slave;      // data channel of the byte and of the word
    logic        wr_en;      // a byte has been received
    logic [2:0]  wr_byte;    // its place in the word
    logic [7:0]  wr_data;
    logic        first;      // first bit of a word
    logic        open;       // bits of a word have come, more follow
    logic        done;       // last bit of a word
    logic        ok;         // with done: the CRC fits
  } rx_t;

  // What the data memories need. Combinational.
  typedef struct packed {
    rx_t         rx;
    logic        cds;        // of the last frame
    logic        delay_en;   // INIT has measured the line delay
    logic [7:0]  delay;      // in quarters of an MA period
  } line_data_t;

  // A register access or a command.
  typedef struct packed {
    logic        cts;        // 0: command
    logic        write;
    logic [6:0]  addr;
    logic [5:0]  byte_last;  // bytes minus 1
    logic [2:0]  id;         // of the slave; of a command its code and whether IDA is tested
  } access_t;

  // The byte of an access: its place, and its value if the slave has sent it.
  typedef struct packed {
    logic        wr_en;
    logic [5:0]  addr;
    logic [7:0]  wr_data;
  } access_byte_t;

  // How an access ends.
  typedef struct packed {
    logic        ends;
    logic        reg_error;   // with ends: wrong echo, wrong CRC
    logic        delay_error; // with ends: no start bit
    logic [5:0]  good_bytes;
  } access_end_t;

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

  // Widths of the types, for vectors of two.
  localparam int unsigned WORD_W        = 39;
  localparam int unsigned OFFER_W       = 44;
  localparam int unsigned LINE_CMD_W    = 15;
  localparam int unsigned LINE_START_W  = 3;
  localparam int unsigned LINE_STATUS_W = 5;
  localparam int unsigned LINE_EVENT_W  = 3;
  localparam int unsigned LINE_DATA_W   = 29;
  localparam int unsigned MO_READ_W     = 7;

endpackage
