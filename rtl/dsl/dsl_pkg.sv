// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types and numbers of the DSL master.

package dsl_pkg;

  // Lowest five bits of M_PAR. 0 to 15 are nibbles of messages.
  localparam logic [4:0] IDLE       = 5'h10;
  localparam logic [4:0] SYNC       = 5'h19;
  localparam logic [4:0] START      = 5'h1A;
  localparam logic [4:0] LEARN      = 5'h1B;
  localparam logic [4:0] CHECK      = 5'h1C;
  localparam logic [4:0] ID_REQUEST = 5'h1D;
  localparam logic [4:0] INIT       = 5'h1E;
  localparam logic [4:0] RESET      = 5'h1F;

  localparam logic [5:0] LAST_BIT    = 6'd60;    // of an answer
  localparam logic [9:0] LAST_SAMPLE = 10'd575;  // of the window that is looked at: 72 slots
  localparam logic [3:0] MIN_DELAY   = 4'd1;     // whole bits that an answer may come late
  localparam logic [3:0] MAX_DELAY   = 4'd11;
  localparam logic [2:0] LAST_PLACE  = 3'd7;     // of a frame in its vertical frame

  // What the encoder sends while the line is trained, the first bit highest.
  localparam logic [60:0] TEST_PATTERN =
    61'b0100110011_0010000001_0001010111_0111111011_0011001101_0_0010011001;

  // Where the first bit of an answer is taken.
  typedef enum logic [1:0] {
    PUBLISHED  = 2'd0,       // by the number of ones in the slot with the first edge
    FIRST_ZERO = 2'd1,
    TRACKING   = 2'd2        // by the mean of all edges
  } sample_e;

  // What the window of a frame is for.
  typedef enum logic [1:0] {
    FOR_START = 2'd0,        // the answer is looked for
    FOR_MATCH = 2'd1,        // LEARN, CHECK: it has to be the test pattern
    FOR_WORDS = 2'd2,        // it carries data of a link
    FOR_IDENTITY = 2'd3      // ... that makes one
  } purpose_e;

  // Whose steps the quality monitor has.
  typedef enum logic [1:0] {
    DOCUMENT = 2'd0,
    SICK     = 2'd1,
    FIRMWARE = 2'd2
  } rules_e;

  // What moves the quality.
  typedef enum logic [3:0] {
    GOOD          = 4'd0,    // VSYNC where it must be, a right CRC of safe channel 1
    VSYNC_EARLY   = 4'd1,
    VSYNC_MISSING = 4'd2,
    RSSI_LOW      = 4'd3,
    CODE_ERROR    = 4'd4,    // of S_PAR or the pipeline
    ACCELERATION  = 4'd5,    // an error of its code
    SPECIAL       = 4'd6,    // a special character that must not be there
    SAFE1_ERROR   = 4'd7,
    SAFE2_ERROR   = 4'd8
  } event_e;

  // The samples of a window, as they come.
  typedef struct packed {
    logic       valid;       // this clock has one
    logic [9:0] number;      // of the sample
    logic [8:0] levels;      // the newest sample is bit 0
  } stream_t;

  // What a frame is. Constant from its first bit to its last one.
  typedef struct packed {
    logic       answer;      // the window is the encoder's; else the master sends 0101...
    logic [7:0] parameter_byte;
    logic [3:0] extra;       // whole ones before the edge of SAMPLE
    logic [2:0] rest;        // eighths that follow them
    logic [3:0] added;       // what the plan of a sync mode adds to the disparity
    logic [4:0] blocks;      // of stuffing
  } plan_t;

  // The bit that comes next on the line.
  typedef struct packed {
    logic [7:0] eighths;     // the first one is bit 7
    logic       drive;
    logic       first;       // of a frame or gap
    logic       edge_here;   // the falling edge of SAMPLE is in it, after `rest` eighths
    logic       turn;        // SWITCH
  } bit_t;

  // A word of an answer.
  typedef struct packed {
    logic [7:0] data;
    logic       error;       // of the code
    logic       special;     // a special character
    logic       only_strict; // an error that the published check does not see
  } word_t;

  // What a user chooses. docs/dsl.md, "Quirks".
  typedef struct packed {
    logic       check_answers;
    logic       sdk_map;
    logic       recover;
    logic       strict_code;
    logic       strict_id;
    logic [1:0] sample;          // sample_e
    logic [1:0] rules;           // rules_e
    logic       rssi_table;
    logic [3:0] rx_start;
    logic [4:0] start_blocks;
    logic [7:0] vsync_limit;
    logic [1:0] stale_limit;
  } quirks_t;

  // Where the link is.
  typedef enum logic [3:0] {
    GAP_STATE   = 4'd0,      // no frame
    RESET_STATE = 4'd1,
    SYNC_STATE  = 4'd2,
    START_STATE = 4'd3,
    LEARN_STATE = 4'd4,
    CHECK_STATE = 4'd5,
    ID_STATE    = 4'd6,
    VSYNC_STATE = 4'd7,      // waits for VSYNC
    RUN_STATE   = 4'd8
  } state_e;

  // Why the link began again.
  typedef enum logic [2:0] {
    NO_RESTART   = 3'd0,
    NOT_FOUND    = 3'd1,     // START: no answer, or not where one fits
    WRONG_LEARN  = 3'd2,
    WRONG_CHECK  = 3'd3,
    BAD_IDENTITY = 3'd4,
    NO_VSYNC     = 3'd5,
    LOW_QUALITY  = 3'd6,
    TOO_MANY_LOST = 3'd7     // accelerations, one after another
  } reason_e;

  // The answer of a frame, word after word, and its end. All of it comes from flops.
  typedef struct packed {
    logic       linked;      // from the encoder's identity to the end of the link
    logic       begins;      // one clock, the first one with linked
    logic       running;     // VSYNC has been: the frame is one of a vertical frame
    logic [2:0] place;       // ... its number there, 0 to 7
    logic       valid;       // one clock: there is a word
    logic [2:0] number;      // vertical, S_PAR, pipeline, two of the acceleration, secondary
    word_t      word;        // up to the next one
    logic       ends;        // one clock, nine clocks or more behind the last word
  } answer_t;

  // What a running frame has told about safe channels and position. Right from the clock behind
  // `ends` on, up to the first word of the next frame.
  typedef struct packed {
    logic safe1_error;       // its code, once in a vertical frame, or its CRC
    logic safe1_good;        // a whole vertical frame without an error of code or CRC
    logic safe2_error;
    logic misfit;            // a good safe position 1 has bits above the width of the identity
    logic missing;           // too many accelerations, one after another
  } verdict_t;

  // What a user can see of the line.
  typedef struct packed {
    logic [3:0]  state;      // state_e
    logic [2:0]  reason;     // reason_e
    logic [19:0] identity;   // of the encoder
    logic [5:0]  width;      // of its position, less 8
    logic [3:0]  quality;
    logic        low;        // ... is below 14
    logic [3:0]  rssi;
    logic [7:0]  edges;
    logic [11:0] place;      // sample of the first bit, five bits behind the point
  } line_status_t;

  // What safe channels and VSYNC did in the last vertical frame: bits of SAFE_STATUS.
  typedef struct packed {
    logic vsync_late;        // VSYNC of the vertical frame before came with the first frame
    logic vsync_missing;     // ... did not come
    logic vsync_early;
    logic code2;             // an error of the code
    logic code1;
    logic crc2;              // a wrong CRC without an error of the code
    logic crc1;
    logic marked2;           // the encoder says that it has no position
    logic marked1;
    logic fix2;              // of a good STATUS2: its lowest bits are not 11100
    logic err2;
    logic test2;
    logic tog2;              // ... its toggle has not changed with each vertical frame
  } safe_checks_t;

  // What dsl_vertical tells dsl_position and the registers.
  typedef struct packed {
    safe_checks_t checks;
    logic       acceleration_good;    // of this frame
    logic       acceleration_marked;  // the encoder says that it has none
    logic [4:0] missing;              // accelerations, one after another
    logic       safe1_valid;          // the last vertical frame brought a good safe position
    logic       safe1_error;          // its code or its CRC was wrong
    logic       safe2_valid;
    logic       safe2_error;
  } told_t;

  // What dsl_message tells the registers.
  typedef struct packed {
    logic long_runs;         // from its start to its end
    logic main_runs;         // the short message of the main host
    logic safe_runs;         // ... of the safe host
    logic resets;            // MRST waits for the encoder
    logic failed;            // ANS, up to the next start of a long message
    logic renewed;           // MIN, up to the next start of any message
  } messages_t;

  // Events of messages, one clock each.
  typedef struct packed {
    logic min;
    logic ans;
    logic frel;
    logic fres;              // of the main host
    logic safe_fres;
  } message_events_t;

  // Writes of the host to dsl_events, one clock each.
  typedef struct packed {
    logic event_h;
    logic event_l;
    logic event_s;
    logic mask_h;
    logic mask_l;
    logic mask_s;
    logic mask_sum;
    logic irq_status;
    logic irq_enable;
  } event_stores_t;

  // What the host reads of dsl_events.
  typedef struct packed {
    logic [7:0] event_h;
    logic [7:0] event_l;
    logic [7:0] event_s;
    logic [7:0] online_d_h;
    logic [7:0] online_d_l;
    logic [7:0] online_1_h;
    logic [7:0] online_1_l;
    logic [7:0] online_2_h;
    logic       low;         // QMLW, with a link
    logic [1:0] postx;
    logic [6:0] irq_status;
    logic [6:0] irq_enable;
  } event_bytes_t;

  // The five interrupts of the published master, one clock each.
  typedef struct packed {
    logic safe_event;        // SINT rises
    logic frame;             // a running frame has its record
    logic safe2;             // a good safe position 2 has come
    logic safe1;
    logic main_event;        // INT rises
  } causes_t;

  // What is counted, one clock each.
  typedef struct packed {
    logic restart;           // of the link
    logic illegal;           // a word that only the strict check refused
  } counts_t;

  // Starts of messages, one clock each.
  typedef struct packed {
    logic resets;            // MRST
    logic starts_long;
    logic starts_main;
    logic starts_safe;
  } orders_t;

endpackage
