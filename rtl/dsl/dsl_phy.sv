// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The pins: eight eighths of a bit go out and eight samples come in, one each clock.
//
// Clock domain: core, 75 MHz; a bit has eight clocks. line_i is asynchronous.
// Latency: bit_i is taken with the clock in which slot_o is 1, and its first eighth is at the pin
// one clock later. A byte of samples shows in the clock of taken_o, behind two flops at the pin and
// the shift register.
//
// Slot 0 of the window begins rx_start_i clocks after that of SWITCH at the pin; the flops at the
// pin are compensated: a sample is the level just before the clock edge that it is named after.
// taken_o is then 1 in each eighth clock, 72 times, and number_o counts.
// Misuse: a SWITCH while a window runs begins a new one.
// Source: docs/dsl.md, "The protocol".

module dsl_phy (
  input  logic           clk_i,
  input  logic           rst_ni,
  input  logic [3:0]     rx_start_i,
  input  dsl_pkg::bit_t  bit_i,
  output logic           slot_o,
  // the window
  output logic           taken_o,
  output logic [6:0]     number_o,   // of the slot
  output logic [7:0]     samples_o,  // the first one is bit 7
  // pins
  output logic           line_o,
  output logic           drive_o,
  input  logic           line_i
);

  // Clocks from the load of SWITCH to the first byte: eight samples, two flops, less one for the
  // counter.
  localparam logic [9:0] BEFORE = 10'd9;

  logic [2:0] tick_q;
  logic [7:0] out_q;
  logic       drive_q;
  logic       level;
  logic [7:0] samples_q;
  logic       runs_q;
  logic [9:0] count_q;     // in front of the window negative, then samples; the highest four bits
                           // are ones only in front of it
  logic       begins;
  logic       ends;
  logic       early;       // the window has not begun

  enc_sync_bit #(.ResetValue(1'b1)) u_line (
    .clk_i,
    .rst_ni,
    .data_i (line_i),
    .data_o (level)
  );

  assign slot_o = tick_q == 3'd7;
  assign begins = slot_o && bit_i.turn;
  assign early  = count_q[9:6] == 4'b1111;
  assign ends   = taken_o && number_o == dsl_pkg::LAST_SLOT;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tick_q    <= '1;
      out_q     <= '1;
      drive_q   <= 1'b0;
      samples_q <= '1;
      runs_q    <= 1'b0;
      count_q   <= '0;
    end else begin
      tick_q    <= tick_q + 3'd1;
      out_q     <= slot_o ? bit_i.eighths : {out_q[6:0], 1'b1};
      if (slot_o) drive_q <= bit_i.drive;
      samples_q <= {samples_q[6:0], level};
      if (begins)    runs_q <= 1'b1;
      else if (ends) runs_q <= 1'b0;
      count_q   <= begins ? 10'd0 - BEFORE - {6'd0, rx_start_i} : count_q + 10'd1;
    end
  end

  assign taken_o   = runs_q && count_q[2:0] == 3'd0 && !early;
  assign number_o  = count_q[9:3];
  assign samples_o = samples_q;
  assign line_o    = out_q[7];
  assign drive_o   = drive_q;

endmodule
