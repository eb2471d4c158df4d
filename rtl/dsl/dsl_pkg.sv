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

  localparam logic [6:0] ANSWER_BITS = 7'd61;
  localparam logic [6:0] LAST_SLOT   = 7'd71;   // of the window that is looked at

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

endpackage
