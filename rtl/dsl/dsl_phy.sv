// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The pins: eight eighths of a bit go out and eight samples come in, one each clock.
//
// Clock domain: core, 75 MHz; a bit has eight clocks. line_i is asynchronous.
// Latency: bit_i is taken with the clock in which slot_o is 1, and its first eighth is at the pin
// one clock later. A sample shows three clocks after its clock edge: two flops at the pin, and the
// shift register.
//
// Sample 0 of the window is the level just before the clock edge that comes rx_start_i clocks after
// the one with which SWITCH begins at the pin. 576 samples follow each other.
// Misuse: a SWITCH while a window runs begins a new one.
// Source: docs/dsl.md, "The protocol".

module dsl_phy (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic [3:0]       rx_start_i,
  input  dsl_pkg::bit_t    bit_i,
  output logic             slot_o,
  output dsl_pkg::stream_t stream_o,
  // pins
  output logic             line_o,
  output logic             drive_o,
  input  logic             line_i
);

  // Clocks from the load of SWITCH to sample 0 with rx_start_i = 0: the flops at the pin.
  localparam logic [9:0] FLOPS = 10'd2;

  logic [2:0] tick_q;
  logic [7:0] out_q;
  logic       drive_q;
  logic       level;
  logic [8:0] levels_q;
  logic       runs_q;
  logic [9:0] count_q;     // number of the sample; negative in front of the window, where alone the
                           // highest four bits are ones
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
  assign ends   = count_q == dsl_pkg::LAST_SAMPLE;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tick_q   <= '1;
      out_q    <= '1;
      drive_q  <= 1'b0;
      levels_q <= '1;
      runs_q   <= 1'b0;
      count_q  <= '0;
    end else begin
      tick_q   <= tick_q + 3'd1;
      out_q    <= slot_o ? bit_i.eighths : {out_q[6:0], 1'b1};
      if (slot_o) drive_q <= bit_i.drive;
      levels_q <= {levels_q[7:0], level};
      if (begins)    runs_q <= 1'b1;
      else if (ends) runs_q <= 1'b0;
      count_q  <= begins ? 10'd0 - FLOPS - {6'd0, rx_start_i} : count_q + 10'd1;
    end
  end

  assign stream_o.valid  = runs_q && !early;
  assign stream_o.number = count_q;
  assign stream_o.levels = levels_q;
  assign line_o          = out_q[7];
  assign drive_o         = drive_q;

endmodule
