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
    SAFE2_STATE = 3'd5,
    TOGGLES    = 3'd6,       // ... the upper bits of its STATUS2
    STORED     = 3'd7        // a byte of dsl_message's memory
  } kind_e;

  // Groups of dsl_record.
  localparam logic [2:0] MAP_FAST     = 3'd0;
  localparam logic [2:0] MAP_SAFE1    = 3'd1;
  localparam logic [2:0] MAP_SAFE2    = 3'd2;
  localparam logic [2:0] WINDOW_FAST  = 3'd3;
  localparam logic [2:0] WINDOW_SAFE1 = 3'd4;
  localparam logic [2:0] WINDOW_SAFE2 = 3'd5;
  localparam logic [2:0] NEWEST       = 3'd7;   // no group

  // What a write of a register or a stored byte reaches besides the memory: the group of
  // its row, or 0.
  localparam logic [2:0] STORE_H      = 3'd1;   // event register, or its mask
  localparam logic [2:0] STORE_L      = 3'd2;
  localparam logic [2:0] STORE_S      = 3'd3;
  localparam logic [2:0] STORE_CTRL   = 3'd4;   // SYS_CTRL, SAFE_CTRL
  localparam logic [2:0] STORE_START  = 3'd5;   // PC_CTRL
  localparam logic [2:0] STORE_LIMIT  = 3'd6;   // ACC_ERR_CNT or its threshold
  localparam logic [2:0] STORE_IRQ    = 3'd7;   // status, enable
  localparam logic [2:0] STORE_SUM    = 3'd4;   // of a stored byte: MASK_SUM
  localparam logic [2:0] STORE_BITS   = 3'd5;   // ... SAFE2_BITS
  localparam logic [2:0] STORE_TOLERANCE = 3'd6;
  localparam logic [2:0] STORE_ALIAS  = 3'd7;   // ... in the SDK it is the one of the safe host

  // Bytes of registers.
  localparam logic [5:0] SYS_CTRL     = 6'd0;
  localparam logic [5:0] MASTER_QM    = 6'd1;
  localparam logic [5:0] EVENT_H      = 6'd2;
  localparam logic [5:0] EVENT_L      = 6'd3;
  localparam logic [5:0] EVENT_S      = 6'd4;
  localparam logic [5:0] EDGES        = 6'd5;
  localparam logic [5:0] DELAY        = 6'd6;
  localparam logic [5:0] CODE_VERSION = 6'd7;
  localparam logic [5:0] ENC_ID2      = 6'd8;
  localparam logic [5:0] ENC_ID1      = 6'd9;
  localparam logic [5:0] ENC_ID0      = 6'd10;
  localparam logic [5:0] PC_CTRL      = 6'd11;
  localparam logic [5:0] PIPE_S       = 6'd12;
  localparam logic [5:0] PIPE_D       = 6'd13;
  localparam logic [5:0] SAFE_CTRL    = 6'd14;
  localparam logic [5:0] ACC_ERR_CNT  = 6'd15;
  localparam logic [5:0] THRESH       = 6'd16;
  localparam logic [5:0] POSTX        = 6'd17;
  localparam logic [5:0] ONLINE_D_H   = 6'd18;
  localparam logic [5:0] ONLINE_D_L   = 6'd19;
  localparam logic [5:0] ONLINE_1_H   = 6'd20;
  localparam logic [5:0] ONLINE_1_L   = 6'd21;
  localparam logic [5:0] ONLINE_2_H   = 6'd22;
  localparam logic [5:0] STATUS0      = 6'd23;
  localparam logic [5:0] STATUS1      = 6'd24;
  localparam logic [5:0] STATUS2      = 6'd25;
  localparam logic [5:0] STATUS3      = 6'd26;
  localparam logic [5:0] PLACE_L      = 6'd27;
  localparam logic [5:0] PLACE_H      = 6'd28;
  localparam logic [5:0] CHECKS_L     = 6'd29;
  localparam logic [5:0] CHECKS_H     = 6'd30;
  localparam logic [5:0] FEATURES     = 6'd31;
  localparam logic [5:0] IRQ_STATUS   = 6'd32;
  localparam logic [5:0] IRQ_ENABLE   = 6'd33;
  localparam logic [5:0] TIME         = 6'd34;

  // Who may write a stored byte: bits 7 and 6 of its row.
  localparam logic [1:0] NOBODY    = 2'd0;
  localparam logic [1:0] ALWAYS    = 2'd1;
  localparam logic [1:0] NO_LONG   = 2'd2;   // not while a long message runs
  localparam logic [1:0] NO_SHORT  = 2'd3;   // not while the short one of its host does

  typedef struct packed {
    logic [2:0] kind;        // kind_e
    logic       sdk;         // only in the personality of the SDK; with hold only in the other one
    logic       hold;        // reading it copies its group, or the time
    logic [2:0] group;       // of dsl_record; what a write reaches
    logic [7:0] value;       // the constant, the register, or the place in the record or the memory
  } row_t;

endpackage
