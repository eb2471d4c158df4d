// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The rows of dsl_map: what stands at a byte of the host's map.

package dsl_map_pkg;

  typedef enum logic [2:0] {
    CONSTANT   = 3'd0,
    REGISTER   = 3'd1,
    RECORD     = 3'd2,       // a byte of a frame's record (dsl_position)
    STATUS     = 3'd3,       // ... its status without the errors of the two safe channels
    SAFE1_STATE = 3'd4,      // ... whether its safe position 1 was good, and its error
    SAFE2_STATE = 3'd5
  } kind_e;

  // Groups of dsl_record.
  localparam logic [2:0] MAP_FAST     = 3'd0;
  localparam logic [2:0] MAP_SAFE1    = 3'd1;
  localparam logic [2:0] MAP_SAFE2    = 3'd2;
  localparam logic [2:0] WINDOW_FAST  = 3'd3;
  localparam logic [2:0] WINDOW_SAFE1 = 3'd4;
  localparam logic [2:0] WINDOW_SAFE2 = 3'd5;
  localparam logic [2:0] NEWEST       = 3'd7;   // no group

  // Bytes of registers.
  localparam logic [7:0] SYS_CTRL    = 8'd0;
  localparam logic [7:0] SYNC_CTRL   = 8'd1;
  localparam logic [7:0] MASTER_QM   = 8'd2;
  localparam logic [7:0] EVENT_H     = 8'd3;
  localparam logic [7:0] EVENT_L     = 8'd4;
  localparam logic [7:0] EDGES       = 8'd5;
  localparam logic [7:0] DELAY       = 8'd6;
  localparam logic [7:0] CODE_VERSION = 8'd7;
  localparam logic [7:0] ENC_ID2     = 8'd8;
  localparam logic [7:0] ENC_ID1     = 8'd9;
  localparam logic [7:0] ENC_ID0     = 8'd10;
  localparam logic [7:0] SAFE_CTRL   = 8'd11;
  localparam logic [7:0] ACC_ERR_CNT = 8'd12;
  localparam logic [7:0] THRESH      = 8'd13;
  localparam logic [7:0] STATUS0     = 8'd14;
  localparam logic [7:0] STATUS1     = 8'd15;
  localparam logic [7:0] STATUS2     = 8'd16;
  localparam logic [7:0] STATUS3     = 8'd17;
  localparam logic [7:0] RESETS_L    = 8'd18;
  localparam logic [7:0] RESETS_H    = 8'd19;
  localparam logic [7:0] ILLEGAL_L   = 8'd20;
  localparam logic [7:0] ILLEGAL_H   = 8'd21;
  localparam logic [7:0] PLACE_L     = 8'd22;
  localparam logic [7:0] PLACE_H     = 8'd23;
  localparam logic [7:0] FEATURES    = 8'd24;
  localparam logic [7:0] IRQ_STATUS  = 8'd25;
  localparam logic [7:0] IRQ_ENABLE  = 8'd26;
  localparam logic [7:0] TIME        = 8'd27;

  typedef struct packed {
    logic [2:0] kind;        // kind_e
    logic       sdk;         // only in the personality of the SDK
    logic       hold;        // reading it copies its group, or the time
    logic [2:0] group;
    logic [7:0] value;       // the constant, the register, or the place in the record
  } row_t;

endpackage
