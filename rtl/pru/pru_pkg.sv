// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types of the BiSS C master with the memory of TIDEP0022 (biss_pru).

package pru_pkg;

  // Frequencies of MA, in the order of the published jump table.
  typedef enum logic [1:0] {
    MHZ_1  = 2'd0,
    MHZ_2  = 2'd1,
    MHZ_5  = 2'd2,
    MHZ_10 = 2'd3
  } mhz_e;

  // Known differences to the published firmware, and one of its constants.
  typedef struct packed {
    logic       sma_wrap;     // average of the bit numbers, as published
    logic       first_low;    // sample point from the first low sample, not from the ones count
    logic       extra_10;     // LINE_DELAY shows two periods more at 10 MHz
  } quirks_t;

  // What the host configures. All registers.
  typedef struct packed {
    logic [7:0]  data_length;
    logic [7:0]  crc_err_war;
    logic [7:0]  frequency;
    logic        run;
    logic [23:0] period;       // TRIGGER_PERIOD
    logic [15:0] overhead;
    logic [9:0]  proc_max;     // PROC_TIME_MAX
  } cfg_t;

  // What a frame is. Constant while it runs.
  typedef struct packed {
    logic [1:0]  mhz;          // mhz_e
    logic [5:0]  data_bits;    // 1 to 63
    logic [5:0]  tail_bits;    // nE, nW, CRC: 0 to 32
    logic        cdm;
  } plan_t;

  // What a frame has found. Valid from its end to the start of the next one.
  typedef struct packed {
    logic        acked;
    logic        late;         // too much processing time
    logic        crc_bad;
    logic [3:0]  place;        // sample point of this frame alone
    logic [3:0]  point;        // the one that was used
    logic [7:0]  raw;          // byte with the acknowledge
    logic [6:0]  line;         // line delay, MA periods
    logic [10:0] processing;   // MA periods
    logic        cds;
    logic [62:0] position;
    logic        nerr;
    logic        nwarn;
    logic [5:0]  crc;
  } found_t;

  // What the control frame shows. All registers.
  typedef struct packed {
    logic        sending;      // from the frame of START to the end
    logic        crc_bad;
    logic [3:0]  crc;
    logic [7:0]  result;
  } control_t;

  // The result bytes and what stands beside them. All registers.
  typedef struct packed {
    logic [62:0] position;
    logic [15:0] crc_errors;
    logic        no_slave;
    logic        pos_crc_bad;
    logic        late;
    logic        averaged;
    logic [7:0]  raw;
    logic [5:0]  crc;
    logic [10:0] processing;
    logic [6:0]  line;
    logic        after;        // SIGNALS
    logic [2:0]  used;
    logic [2:0]  measured;
    logic        nwarn;
    logic        nerr;
    logic [15:0] frames;
  } memory_t;

  // An access of the host. Requests are high for one clock.
  typedef struct packed {
    logic        rd;
    logic        wr;
    logic [3:0]  be;
    logic [11:0] addr;         // of a word
    logic [31:0] data;
  } bus_t;

endpackage
