// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The rows of dsl_program, as dsl_position runs them.
//
// A SUM makes one value out of two, byte by byte from the lowest one on. A value has eight bytes.

package dsl_program_pkg;

  localparam logic [1:0] SUM  = 2'd0;
  localparam logic [1:0] JUMP = 2'd1;
  localparam logic [1:0] SET  = 2'd2;      // the state of the alignment; a jump too
  localparam logic [1:0] TELL = 2'd3;      // the record is complete

  localparam logic [4:0] BYTES1 = 5'd8;    // values that the answers write
  localparam logic [4:0] BYTES2 = 5'd9;
  localparam logic [4:0] WORD   = 5'd10;

  typedef struct packed {
    logic [1:0] kind;
    logic [4:0] to;
    logic [4:0] first;      // operands
    logic [4:0] second;     // ... or the number of the input
    logic [2:0] last;       // byte
    logic [1:0] source;     // of the first operand
    logic [1:0] change;     // of the second one
    logic [1:0] carry;      // into the lowest byte
    logic [1:0] widen;      // 2, 3: from this byte on the sum is the sign of the byte before
    logic       upper;      // bytes 4 to 7 of `to` and of the operands in the memory
    logic       down;       // the sum goes one byte down, and its lowest byte is lost
    logic       fits;       // the sum is written only if it has a carry
    logic       hold;       // the carry stays; only for sums of one byte
  } sum_t;

  typedef enum logic [1:0] {
    MEMORY = 2'd0,
    INPUT  = 2'd1,
    ZEROS  = 2'd2,
    ONES   = 2'd3
  } source_e;

  typedef enum logic [1:0] {
    PLAIN    = 2'd0,
    INVERTED = 2'd1,
    ANDED    = 2'd2,        // with a carry of 1 the sum is first AND second
    NONE     = 2'd3
  } change_e;

  typedef enum logic [1:0] {
    NO_CARRY = 2'd0,
    PLUS_ONE = 2'd1,
    CARRIED  = 2'd2         // the one that the row before has left
  } carry_e;

  typedef enum logic [2:0] {
    IN_TIME      = 3'd0,    // of the frame's edge, eight bytes
    IN_STATUS    = 3'd1,    // four bytes
    IN_WIDTH     = 3'd2,    // of the position
    IN_BITS      = 3'd3,    // of safe position 2
    IN_TOLERANCE = 3'd4     // in its steps
  } input_e;

  typedef struct packed {
    logic [1:0]  kind;
    logic        inverted;  // jump if the condition is not true
    logic [3:0]  condition; // number of a bit of conditions_t
    logic [7:0]  target;
    logic [2:0]  state;     // of SET and in_state
    logic [13:0] unused;    // of TELL the lowest one: the record is that of no link
  } jump_t;

  typedef struct packed {
    logic check;            // the last vertical frame has two safe positions to be compared
    logic over;             // a link is that the newest record still shows
    logic is_signed;        // the position is
    logic in_state;         // the alignment is in the state of the row
    logic recover;          // a missing acceleration is repaired, this one too
    logic stale;            // too many vertical frames without a good safe position 1
    logic new2;             // the vertical frame has a good safe position 2
    logic new1;
    logic vertical;         // the frame ends a vertical frame
    logic good;             // its acceleration is
    logic begun;            // a link has
    logic frame;            // a running frame has its acceleration, and no end yet
    logic any;              // it is always true
    logic negative;         // the last sum was, ...
    logic carry;
    logic zero;
  } conditions_t;

  // Of the alignment, at the ends of vertical frames.
  typedef enum logic [2:0] {
    FIRST   = 3'd0,         // the position is set
    SECOND  = 3'd1,         // speed and position are corrected
    THIRD   = 3'd2,         // nothing
    FOURTH  = 3'd3,         // they have to agree
    ALIGNED = 3'd4,         // ... and do
    LOST    = 3'd5,         // an acceleration is missing
    MENDING = 3'd6,         // the next safe position will tell it
    MISMATCH = 3'd7         // no state: the two safe positions do not agree
  } align_e;

endpackage
