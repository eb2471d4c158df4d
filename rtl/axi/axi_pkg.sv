// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types of the BiSS C master with N channels (biss_axi).

package axi_pkg;

  // What a frame is, the same for all channels. Registers, taken when the frame starts.
  typedef struct packed {
    logic [7:0] half_len;   // half an MA period in clocks, not 0
    logic [6:0] data_last;  // bits of position, error and warning, minus 1
    logic [6:0] edges;      // rising MA edges from the start bit on; see axi_channel
    logic       check;      // a wrong CRC makes a word bad
    logic       single;     // single-point mode
  } frame_t;

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

  // Widths of the types, for vectors of them, and places in word_t.
  localparam int unsigned RESULT_W      = 54;
  localparam int unsigned WORD_W        = 36;
  localparam int unsigned WORD_POSITION = 4;
  localparam int unsigned WORD_GOOD     = 0;
  localparam int unsigned WORD_NERR     = 1;
  localparam int unsigned WORD_NWARN    = 2;

endpackage
