// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// FRAME_STATE: tables 2-5 and 2-6, all 16 cells.
//
// Clock domain: core. state_next_o is combinational; state_q_o follows it with the next edge.
// clear_i leads to 00 from any state. end_i leads from 01 to 11, which no cell does: it is for the
// watchdog. Nothing but clear_i leaves 11.
//
// Misuse: end_i counts in state 01 only.
// Source: TIDM-1010, 2.3.5.2.

module clb_state (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       clear_i,
  input  logic       end_i,
  input  logic       e1_i,          // rising edge of SL
  input  logic       e0_i,          // START_OPERATION, or the last MA clock has ended
  output logic [1:0] state_o,       // clb_pkg::state_e
  output logic [1:0] state_next_o
);

  clb_pkg::state_e state_q;
  clb_pkg::state_e state_d;

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      clb_pkg::IDLE:
        // MA rests at 1.
        if (e0_i) state_d = clb_pkg::TRANSMIT;
      clb_pkg::TRANSMIT:
        // MA runs. The encoder holds SL at 0 until its start bit.
        if (e1_i)       state_d = clb_pkg::BOTH;
        else if (end_i) state_d = clb_pkg::RECEIVE;
      clb_pkg::BOTH:
        // MA runs. Bits come.
        if (e0_i) state_d = clb_pkg::RECEIVE;
      clb_pkg::RECEIVE:
        // MA holds the level that is CDM for the encoder. The last bits may still come.
        state_d = clb_pkg::RECEIVE;
      default:
        state_d = clb_pkg::IDLE;
    endcase
    if (clear_i) state_d = clb_pkg::IDLE;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) state_q <= clb_pkg::IDLE;
    else         state_q <= state_d;
  end

  assign state_o      = state_q;
  assign state_next_o = state_d;

endmodule
