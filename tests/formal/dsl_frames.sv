// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of a DSL master in free run (dsl_tx): no extra ones, so that each bit has its number. The
// plan of each frame is any one of these, and constant in its frame; dsl_states proves that the plans
// of the link are such. The bits last as long as they like.
//
// claim: in free run D of the equaliser is between -2 and 0 with any M_PAR; the driver is off in bits
//   26 to 99 of each frame with an answer and on in all its other bits; a gap follows if one is
//   asked for at the end, else a frame
// clocks: one
// depth: 150
// cover: 150
// unbounded: induction 1
// look: dut_field = u_dut.field_q
// look: dut_left = u_dut.left_q
// look: dut_disparity = u_dut.disparity
// mutation: dsl/dsl_tx.sv | WINDOW_LAST  = 7'd73 | WINDOW_LAST  = 7'd72
// mutation: dsl/dsl_tx.sv | (field_q == WINDOW_FIELD && plan_i.answer)
//   | (field_q == WINDOW_FIELD && plan_i.answer && !fresh_q)
// mutation: dsl/dsl_tx.sv | counts  = 8'd2; | counts  = 8'd0;
// mutation: dsl/dsl_tx.sv | disparity[7] ? 8'd2 : -8'd2; | 8'd2;
// mutation: dsl/dsl_tx.sv | if (gap_i) begin | if (gap_i && field_q != GAP_FIELD) begin
// mutation: dsl/dsl_tx.sv | PARAM_LAST   = 7'd9 | PARAM_LAST   = 7'd10

module proof (
  input logic           clk_i,
  input logic           rst_ni,
  input logic           slot_i,
  input logic           gap_i,
  input dsl_pkg::plan_t plan_i
);

  localparam logic [6:0] MANY = 7'd127;

  logic          begins;
  dsl_pkg::bit_t line_bit;

  dsl_tx #(.DisparityW(3)) u_dut (
    .clk_i, .rst_ni, .slot_i, .gap_i, .plan_i, .begin_o (begins), .bit_o (line_bit)
  );

  wire [3:0] dut_field;
  wire [6:0] dut_left;
  wire [7:0] dut_disparity;

  logic           started = 1'b0;
  logic           begins_q;
  logic           is_gap_q;   // no frame
  logic [6:0]     at_q;       // number of the bit in its frame, 127 at most
  dsl_pkg::plan_t plan_q;
  always @(posedge clk_i) begin
    started  <= 1'b1;
    begins_q <= begins;
    plan_q   <= plan_i;
    if (!rst_ni) begin
      begins_q <= 1'b1;
      is_gap_q <= 1'b1;
      at_q     <= 7'd0;
    end else if (begins) begin
      is_gap_q <= gap_i;
      at_q     <= 7'd0;
    end else if (slot_i && at_q != MANY) begin
      at_q     <= at_q + 7'd1;
    end
  end

  always @* begin
    if (!started) assume (!rst_ni);
    assume (plan_i.extra == 4'd0 && plan_i.rest == 3'd0 && plan_i.added == 4'd0);
    if (started && !begins_q) assume (plan_i == plan_q);
  end

  // Where each field of a frame is.
  logic [6:0] from, length;
  always @* begin
    case (dut_field)
      4'd1:    {from, length} = {7'd0, 7'd8};
      4'd4:    {from, length} = {7'd8, 7'd4};
      4'd5:    {from, length} = {7'd12, 7'd4};
      4'd6:    {from, length} = {7'd16, 7'd10};
      4'd7:    {from, length} = {7'd26, 7'd74};
      default: {from, length} = {7'd100, 7'd8};
    endcase
  end

  logic window;
  assign window = at_q >= 7'd26 && at_q <= 7'd99;

  always @* if (started && rst_ni) begin
    Balance_A: assert (dut_disparity == 8'd0 || dut_disparity == 8'hFE);
    if (dut_field == 4'd5) Balanced_A: assert (dut_disparity == 8'd0);
    if (!is_gap_q && plan_i.answer) Driver_A: assert (line_bit.drive == !window);
    if (!is_gap_q && !plan_i.answer) Silent_A: assert (line_bit.drive && !line_bit.turn);
    if (line_bit.turn) Turn_A: assert (at_q == 7'd26 && plan_i.answer);
    GapOrFrame_A: assert (is_gap_q == (dut_field == 4'd0));
    if (begins) EndOfFrame_A: assert (slot_i && (is_gap_q || at_q >= 7'd107));
    // For the induction.
    Fields_A: assert (dut_field <= 4'd9 && dut_field != 4'd2 && dut_field != 4'd3);
    if (!is_gap_q && dut_field != 4'd9)
      Place_A: assert (dut_left < length && at_q == from + length - 7'd1 - dut_left);
    if (dut_field == 4'd9) Stuffing_A: assert (at_q >= 7'd108 && dut_left <= 7'd5);
    if (is_gap_q) Gap_A: assert (dut_left <= 7'd31);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Window_C: cover (!is_gap_q && plan_i.answer && at_q == 7'd26);
    Twice_C:  cover (is_gap_q && begins_q && gap_i);
    Stuffed_C: cover (!is_gap_q && begins && plan_i.blocks == 5'd1);
    Filled_C: cover (!is_gap_q && !plan_i.answer && at_q == 7'd26 && dut_disparity == 8'hFE);
  end

endmodule
