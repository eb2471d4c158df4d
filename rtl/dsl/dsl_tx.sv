// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bits of a frame, one after another: SYNC 001011, SAMPLE 11, the window of EXTRA, 0, CYCLE
// RESET 110, EQUALISATION, M_PAR, SWITCH with the answer's window, TRAILER 00000011, stuffing.
// Behind each answer the disparity counter begins with 0.
//
// Clock domain: core. bit_o follows the registers: the bit that dsl_phy takes with slot_i. begin_o
// is 1 with the slot_i at whose end bit_o becomes the first bit of a frame; from the next clock on
// plan_i is the one of this frame.
//
// gap_i: what follows is no frame: the driver is off for 16 bits, 16 zeros follow, and the
// disparity begins with 0. It counts at the end of the trailer, where it drops the stuffing, at the
// end of each block of stuffing and at the end of a gap. While the driver is off in a gap, gap_i
// keeps it off. A gap is what a reset begins with.
// EXTRA: extra ones, then, if rest is not 0, a bit that is high for rest eighths.
// A free run (extra, rest and added are 0) keeps the counter between -2 and 0: three bits are
// enough.
// Misuse: a plan that changes within its frame mixes two frames.
// Source: docs/dsl.md, "The protocol".

module dsl_tx #(
  parameter int unsigned DisparityW = 8    // 3 to 8 bits of the disparity counter
) (
  input  logic           clk_i,
  input  logic           rst_ni,
  input  logic           slot_i,
  input  logic           gap_i,
  input  dsl_pkg::plan_t plan_i,
  output logic           begin_o,
  output dsl_pkg::bit_t  bit_o
);

  localparam logic [6:0] HEAD_LAST    = 7'd7;     // number of the last bit of each field
  localparam logic [6:0] CYCLE_LAST   = 7'd3;
  localparam logic [6:0] EQUAL_LAST   = 7'd3;
  localparam logic [6:0] PARAM_LAST   = 7'd9;
  localparam logic [6:0] WINDOW_LAST  = 7'd73;
  localparam logic [6:0] TRAILER_LAST = 7'd7;
  localparam logic [6:0] BLOCK_LAST   = 7'd5;
  localparam logic [6:0] GAP_LAST     = 7'd31;
  localparam logic [9:0] HEAD         = 10'b00101111_00;
  localparam logic [9:0] CYCLE        = 10'b0110_000000;
  localparam logic [9:0] TRAILER      = 10'b00000011_00;
  localparam logic [9:0] BLOCK        = 10'b001011_0000;

  typedef enum logic [3:0] {
    GAP_FIELD,
    HEAD_FIELD,
    ONES_FIELD,
    REST_FIELD,
    CYCLE_FIELD,
    EQUAL_FIELD,
    PARAM_FIELD,
    WINDOW_FIELD,
    TRAILER_FIELD,
    BLOCK_FIELD
  } field_e;

  field_e     field_d, field_q;
  logic [6:0] left_d, left_q;             // bits of the field behind this one
  logic [9:0] bits_d, bits_q;             // of the field, the next one first
  logic [4:0] blocks_d, blocks_q;         // to come
  logic       fresh_d, fresh_q;           // the first bit of a field
  logic [DisparityW-1:0] disparity_d, disparity_q;   // signed
  logic [7:0] disparity;                  // with all of its bits
  logic [7:0] moves;                      // of the counter, at the end of a field
  logic [7:0] moved;
  logic       unused;
  logic       clears;                     // it begins anew
  logic [3:0] pattern;                    // of EQUALISATION
  logic [7:0] counts;                     // ... and what it does to the counter
  logic [9:0] word;
  logic       uneven;
  logic       ends;                       // the field does
  logic       off;                        // the driver is, in a gap
  logic       frame_ends;

  dsl_code_tx u_code (
    .clk_i,
    .data_i      (plan_i.parameter_byte),
    .disparity_i (disparity),
    .uneven_o    (uneven),
    .word_o      (word)
  );

  always_comb begin
    pattern = 4'b0000;
    counts  = 8'd0;
    // Above 3, above 1; below -3, below -1.
    if (!disparity[7]) begin
      if (disparity[6:2] != '0) begin
        counts = -8'd4;
      end else if (disparity[1]) begin
        pattern = 4'b0010;
        counts  = -8'd2;
      end
    end else if (disparity[6:2] != '1 || disparity[1:0] == 2'b00) begin
      pattern = 4'b1111;
      counts  = 8'd4;
    end else if (disparity[1:0] != 2'b11) begin
      pattern = 4'b1101;
      counts  = 8'd2;
    end
  end

  assign ends       = slot_i && left_q == 7'd0;
  assign off        = field_q == GAP_FIELD && left_q[4];
  assign frame_ends = (field_q == TRAILER_FIELD || field_q == BLOCK_FIELD) && blocks_q == 5'd0;

  always_comb begin
    field_d     = field_q;
    left_d      = left_q;
    bits_d      = bits_q;
    blocks_d    = blocks_q;
    moves       = 8'd0;
    clears      = 1'b0;
    fresh_d     = fresh_q;
    if (slot_i) begin
      fresh_d = 1'b0;
      left_d  = left_q - 7'(!(off && gap_i));
      bits_d  = {bits_q[8:0], 1'b0};
    end
    if (ends) begin
      fresh_d = 1'b1;
      unique case (field_q)
        HEAD_FIELD, ONES_FIELD, REST_FIELD: begin
          // The line is high up to the edge of SAMPLE.
          if (field_q == HEAD_FIELD && plan_i.extra != 4'd0) begin
            field_d = ONES_FIELD;
            left_d  = {3'd0, plan_i.extra - 4'd1};
          end else if (field_q != REST_FIELD && plan_i.rest != 3'd0) begin
            field_d = REST_FIELD;
            left_d  = 7'd0;
          end else begin
            field_d     = CYCLE_FIELD;
            left_d      = CYCLE_LAST;
            bits_d      = CYCLE;
            moves       = {4'd0, plan_i.added};
          end
        end
        CYCLE_FIELD: begin
          field_d     = EQUAL_FIELD;
          left_d      = EQUAL_LAST;
          bits_d      = {pattern, 6'd0};
          moves       = counts;
        end
        EQUAL_FIELD: begin
          field_d = PARAM_FIELD;
          left_d  = PARAM_LAST;
          bits_d  = word;
          if (uneven) moves = disparity[7] ? 8'd2 : -8'd2;
        end
        PARAM_FIELD: begin
          // SWITCH.
          field_d = WINDOW_FIELD;
          left_d  = WINDOW_LAST;
        end
        WINDOW_FIELD: begin
          field_d  = TRAILER_FIELD;
          left_d   = TRAILER_LAST;
          bits_d   = TRAILER;
          blocks_d = plan_i.blocks;
          clears   = plan_i.answer;
        end
        default: begin
          // The frame is over, or a block of stuffing follows.
          if (gap_i) begin
            field_d     = GAP_FIELD;
            left_d      = GAP_LAST;
            clears      = 1'b1;
          end else if (field_q == GAP_FIELD || frame_ends) begin
            field_d = HEAD_FIELD;
            left_d  = HEAD_LAST;
            bits_d  = HEAD;
          end else begin
            field_d  = BLOCK_FIELD;
            left_d   = BLOCK_LAST;
            bits_d   = BLOCK;
            blocks_d = blocks_q - 5'd1;
          end
        end
      endcase
    end
  end

  assign disparity   = 8'(signed'(disparity_q));
  assign moved       = disparity + moves;
  assign disparity_d = moved[DisparityW-1:0] & {DisparityW{!clears}};
  assign unused      = ^moved;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      field_q     <= GAP_FIELD;
      left_q      <= GAP_LAST;
      bits_q      <= '0;
      blocks_q    <= '0;
      fresh_q     <= 1'b1;
      disparity_q <= '0;
    end else begin
      field_q     <= field_d;
      left_q      <= left_d;
      bits_q      <= bits_d;
      blocks_q    <= blocks_d;
      fresh_q     <= fresh_d;
      disparity_q <= disparity_d;
    end
  end

  logic       silent;      // the driver is off
  logic       level;
  logic [7:0] part;        // of the bit with eighths

  assign silent = (field_q == WINDOW_FIELD && plan_i.answer) || off;
  assign part   = ~(8'hFF >> plan_i.rest);
  always_comb begin
    level = bits_q[9];
    case (field_q)
      GAP_FIELD:    level = left_q[4];
      ONES_FIELD:   level = 1'b1;
      WINDOW_FIELD: level = plan_i.answer || !left_q[0];
      default:      ;
    endcase
  end

  assign begin_o         = ends && (field_d == HEAD_FIELD || field_d == GAP_FIELD);
  assign bit_o.eighths   = field_q == REST_FIELD ? part : {8{level}};
  assign bit_o.drive     = !silent;
  assign bit_o.first     = fresh_q && (field_q == HEAD_FIELD || field_q == GAP_FIELD);
  assign bit_o.edge_here = fresh_q && (plan_i.rest == 3'd0 ? field_q == CYCLE_FIELD
                                                           : field_q == REST_FIELD);
  assign bit_o.turn      = fresh_q && field_q == WINDOW_FIELD && plan_i.answer;

endmodule
