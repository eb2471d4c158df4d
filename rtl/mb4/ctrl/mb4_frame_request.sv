// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Requests automatic frames (AGS = 1): at the rate of FREQAGS, at once (AGSMIN), or by pin GETSENS
// (AGSINFINITE).
//
// Clock domain: core; GETSENS is asynchronous.
//
// - Rate: the first frame is due one period after AGS was set. Then one is due every 20 (FREQAGS +
//   1) or 625 (FREQAGS - 127) clocks, whatever the frames do. Writing AGS = 1 again does not move
//   these times; BREAK starts them again. request_o.due stays until taken_i.
// - missed_o: a frame is due while the one before has not ended. The new frame is left out.
// - GETSENS = 1 is a request whenever the lines are idle. With hold_cdm_i each pulse gives one
//   frame.
//
// Latency: 2 clocks from GETSENS to the start of a frame; MA falls half an MA period later. Codes
// AGSMIN and AGSINFINITE of freqags_i begin and cease to act one clock later.
// Misuse: a GETSENS pulse that begins and ends while a frame runs is not remembered.
// Datasheet: pages 30..32, Tables 37, 44, item C08; decision 19.

module mb4_frame_request (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       ags_i,
  input  logic       restart_i,    // BREAK
  input  logic [7:0] freqags_i,
  input  logic       hold_cdm_i,
  input  logic       getsens_i,    // pin
  input  logic       busy_i,       // a frame runs
  input  logic       lines_idle_i,
  input  logic       taken_i,
  output mb4_pkg::request_t request_o,
  output logic       missed_o
);

  logic       agsmin_q;
  logic       infinite_q;
  logic       timed;
  logic       getsens;
  logic [9:0] pre_q;      // clocks of the current step
  logic [6:0] step_q;     // steps of the current period
  logic       pre_end;
  logic       due;
  logic       by_time, by_pin;
  // Kept apart from lines_idle_i, which comes late: synthesis would put both into one gate.
  (* keep *) logic asks;
  logic       pending_d;
  logic       pending_q;
  logic       armed_d;
  logic       armed_q;    // GETSENS was low since the last frame

  enc_sync_bit u_getsens (
    .clk_i,
    .rst_ni,
    .data_i (getsens_i),
    .data_o (getsens)
  );

  // Flops, because what decides on the start of a frame is the longest path of small cores.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      agsmin_q   <= 1'b0;
      infinite_q <= 1'b0;
    end else begin
      agsmin_q   <= freqags_i == mb4_regs_pkg::AGS_RATE_AGS_MIN;
      infinite_q <= freqags_i[7:2] == 6'b011111 && freqags_i != mb4_regs_pkg::AGS_RATE_AGS_MIN;
    end
  end

  assign timed   = ags_i && !agsmin_q && !infinite_q && freqags_i[7:2] != 6'b011111;

  assign pre_end = pre_q == (freqags_i[7] ? 10'd624 : 10'd19);
  assign due     = timed && !restart_i && pre_end && step_q == freqags_i[6:0];

  always_comb begin
    armed_d   = (armed_q || !getsens) && !taken_i;
    pending_d = (pending_q && !taken_i) || (due && !busy_i);
    if (!timed || restart_i) pending_d = 1'b0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pre_q     <= '0;
      step_q    <= '0;
      pending_q <= 1'b0;
      armed_q   <= 1'b1;
    end else begin
      if (!timed || restart_i) begin
        pre_q  <= 10'd0;
        step_q <= 7'd0;
      end else begin
        pre_q <= pre_end ? 10'd0 : pre_q + 10'd1;
        if (pre_end) step_q <= due ? 7'd0 : step_q + 7'd1;
      end
      pending_q <= pending_d;
      armed_q   <= armed_d;
    end
  end

  assign by_time = ags_i && (agsmin_q || pending_q);
  assign by_pin  = ags_i && infinite_q && getsens && (armed_q || !hold_cdm_i);
  assign asks    = by_time || by_pin;
  assign request_o.due      = by_time || (by_pin && lines_idle_i);
  assign request_o.asks     = asks;
  assign request_o.agsmin   = agsmin_q;
  assign request_o.infinite = infinite_q;
  assign missed_o  = due && busy_i;

endmodule
