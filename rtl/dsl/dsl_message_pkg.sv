// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Bytes of the memory that dsl_message shares with the host. Those that only the host writes and
// reads stand there too: a byte of memory costs no logic.

package dsl_message_pkg;

  localparam logic [5:0] ADD_H       = 6'd0;     // of a long message; bit 7 is 1
  localparam logic [5:0] ADD_L       = 6'd1;
  localparam logic [5:0] OFF_H       = 6'd2;     // bit 7 is 1
  localparam logic [5:0] OFF_L       = 6'd3;
  localparam logic [5:0] BUFFER      = 6'd4;     // eight
  localparam logic [5:0] MAIN_CTRL   = 6'd16;    // of a short message: what the host has written
  localparam logic [5:0] MAIN_DATA   = 6'd17;
  localparam logic [5:0] SAFE_CTRL   = 6'd18;    // ... the safe host
  localparam logic [5:0] SAFE_DATA   = 6'd19;
  localparam logic [5:0] SYNC_CTRL   = 6'd20;
  localparam logic [5:0] MASK_H      = 6'd21;
  localparam logic [5:0] MASK_L      = 6'd22;
  localparam logic [5:0] MASK_S      = 6'd23;
  localparam logic [5:0] MASK_SUM    = 6'd24;
  localparam logic [5:0] SAFE2_BITS  = 6'd26;
  localparam logic [5:0] TOLERANCE   = 6'd27;
  localparam logic [5:0] MAXACC      = 6'd28;
  localparam logic [5:0] FOREIGN     = 6'd32;    // two bytes, the low one first
  localparam logic [5:0] RETRIES     = 6'd34;
  localparam logic [5:0] RESTARTS    = 6'd36;
  localparam logic [5:0] ILLEGAL     = 6'd38;
  localparam logic [5:0] LAST        = 6'd39;

  localparam logic [7:0] NOTHING     = 8'h3F;    // a CTRL reads so while no message runs

  // Symbols of S_PAR; those below 10h are nibbles. M_PAR: dsl_pkg.
  localparam logic [4:0] IDLE      = 5'h10;
  localparam logic [4:0] SHORT_NAK = 5'h15;
  localparam logic [4:0] LONG_NAK  = 5'h1A;
  localparam logic [4:0] INIT      = 5'h1F;

  // What dsl_message works on.
  typedef enum logic [3:0] {
    CLEAR     = 4'd0,         // the memory gets its first values
    READY     = 4'd1,         // waits
    FETCH     = 4'd2,         // a nibble of a request
    LOAD      = 4'd3,
    SHIFT     = 4'd4,
    STORE     = 4'd5,         // a nibble of an answer; it is compared with the request
    COMPARE   = 4'd6,
    DIVIDE    = 4'd7,
    HIGH      = 4'd8,         // a byte of it becomes one of the host's
    LOW       = 4'd9,
    PUT       = 4'd10,
    COUNT     = 4'd11,        // a counter of two bytes
    ADD       = 4'd12,
    JUDGE     = 4'd13         // a nibble is divided: is it the last one of an answer?
  } work_e;

  // What comes.
  typedef enum logic [1:0] {
    NONE  = 2'd0,
    SHORT = 2'd1,
    LONG  = 2'd2,
    REST  = 2'd3              // what follows a message, up to a symbol that is no nibble
  } comes_e;

endpackage
