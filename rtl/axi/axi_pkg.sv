// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types of the BiSS C master with N channels (biss_axi).

package axi_pkg;

  // Extras beyond the document: places in parameter EXTRAS of biss_axi. Register FEATURES
  // has them at the same places, but EXTRA_LAST at 13, EXTRA_FRAME_SAMPLER at 14.
  localparam int unsigned EXTRA_PAGE      = 0;  // identity, time, interrupt, skipped starts
  localparam int unsigned EXTRA_WIDE      = 1;  // positions of up to 64 bits
  localparam int unsigned EXTRA_CRC       = 2;  // any CRC polynomial up to 16 bits
  localparam int unsigned EXTRA_TIMEOUT   = 3;  // timeout by a register, adaptive or fixed
  localparam int unsigned EXTRA_COUNTERS  = 4;  // frames, CRC errors, late starts of each channel
  localparam int unsigned EXTRA_STAMP     = 5;  // time of the sampling instant
  localparam int unsigned EXTRA_ALARM     = 6;  // line delays that move
  localparam int unsigned EXTRA_ACCESS    = 7;  // registers of encoders
  localparam int unsigned EXTRA_ALIGN     = 8;  // ALIGN_LATCH
  localparam int unsigned EXTRA_LAST      = 9;  // the last word of each channel
  localparam int unsigned EXTRA_FRAME_SAMPLER = 10;  // biss_frame_sampler, and the eye of each line
  localparam int unsigned EXTRAS_W        = 11;

  // What a frame is, the same for all channels. Registers, taken when the frame starts.
  typedef struct packed {
    logic [7:0] half_last;  // clocks of half an MA period minus 1
    logic [6:0] data_last;  // bits of position, error and warning, minus 1
    logic [6:0] edges;      // rising MA edges from the start bit on; see axi_channel
    logic       check;      // a wrong CRC makes a word bad
    logic       single;     // single-point mode
  } frame_t;

  // CRC and timeout of a frame, the same for all channels. Constants, or registers that are taken
  // when the frame starts.
  typedef struct packed {
    logic [15:0] crc_poly;      // without the highest power
    logic [15:0] crc_top;       // one-hot: highest bit of the remainder
    logic [15:0] crc_start;
    logic [3:0]  crc_last;      // bits minus 1
    logic        fixed;         // the timeout lasts for all its clocks, whatever SLO is
    logic [19:0] timeout_last;  // clocks of the longest timeout minus 1
  } rule_t;

  // The configuration registers that are the same for all channels. All registers.
  typedef struct packed {
    logic        soft_reset;
    logic        external_clock;
    logic        single_point;
    logic        request;
    logic [27:0] sample_divider;
    logic [7:0]  ma_divider;
    logic [7:0]  position_bits;
    logic        crc_check;
  } cfg_t;

  // Switches that a parameter or a pin ties off.
  typedef struct packed {
    logic enable_active_low;    // 0x20: 0 = enabled
    logic crc_bit_ignores;      // 0x1C: 1 = not checked
    logic align_latch;          // 0x28 acts
    logic valid_until_request;  // an accepted request clears 0x34
  } switch_t;

  // Results of a channel that registers show. All registers.
  typedef struct packed {
    logic [31:0] single;        // position of the last good single-point frame
    logic [9:0]  delay;         // of the last frame
    logic [5:0]  received;      // CRC
    logic [5:0]  calculated;    // CRC
  } result_t;

  // What a stream says of a channel's frame. All registers.
  typedef struct packed {
    logic [31:0] position;      // of the last good frame
    logic        crc_bad;
    logic        nwarn;
    logic        nerr;
    logic        good;
  } word_t;

  // What extras add to the results of a channel. All registers, or 0 without the extra.
  typedef struct packed {
    logic [31:0] single_high;   // bits 63..32
    logic [31:0] position_high;
    logic [9:0]  received_high; // bits 15..6
    logic [9:0]  calculated_high;
  } more_t;

  // The eye of a channel's line in its last frame: with valid = 0 it has none, and width and last
  // are older. All registers, or 0 without the extra.
  typedef struct packed {
    logic        valid;
    logic        used;          // biss_frame_sampler takes the words at this MA divider
    logic [4:0]  width;         // clocks without an edge
    logic [4:0]  point;         // sampling point, clocks behind the rising edge of the start bit
  } eye_t;

  // What happens in a channel. Each of the first five is high for one clock.
  typedef struct packed {
    logic        begun;         // a frame begins and takes CDM
    logic        ended;         // its last CRC bit has come
    logic        failed;        // it ends before
    logic        crc_error;     // with ended
    logic        late;          // SLO was 0 at the start: no frame begins
    logic        cds;           // with ended: CDS and CDM of this frame
    logic        cdm;
  } event_t;

  // An access of the host to the page. The words of the page are written whole.
  typedef struct packed {
    logic        rd;
    logic        wr;
    logic [7:0]  addr;
    logic [31:0] data;
  } bus_t;

  // Configuration of the page.
  typedef struct packed {
    logic [16:0] crc_polynomial;
    logic [15:0] crc_start;
    logic        timeout_fixed;
    logic [19:0] timeout_limit;
  } page_t;

  // Widths of the types, for vectors of them, and places in word_t.
  localparam int unsigned RESULT_W      = 54;
  localparam int unsigned WORD_W        = 36;
  localparam int unsigned WORD_POSITION = 4;
  localparam int unsigned WORD_GOOD     = 0;
  localparam int unsigned WORD_NERR     = 1;
  localparam int unsigned WORD_NWARN    = 2;
  localparam int unsigned RESULT_DELAY  = 12;  // place in result_t
  localparam int unsigned MORE_W        = 84;
  localparam int unsigned MORE_POSITION = 20;  // place in more_t
  localparam int unsigned EYE_W         = 12;
  localparam int unsigned EYE_VALID     = 11;  // places in eye_t
  localparam int unsigned EYE_WIDTH     = 5;
  localparam int unsigned EVENT_W       = 7;
  localparam int unsigned EVENT_BEGUN     = 6;  // places in event_t
  localparam int unsigned EVENT_ENDED     = 5;
  localparam int unsigned EVENT_FAILED    = 4;
  localparam int unsigned EVENT_CRC_ERROR = 3;
  localparam int unsigned EVENT_LATE      = 2;
  localparam int unsigned EVENT_CDS       = 1;
  localparam int unsigned EVENT_CDM       = 0;

endpackage
