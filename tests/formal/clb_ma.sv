// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MA of biss_clb (clb_frame): no level is shorter than half a period, whatever SL does, with a frame
// that the host starts in state 00, at any time, before or after the clock tile, and with any clock
// counts and watchdog. The host changes nothing while MA runs: the header of clb_frame says which
// writes cut a pulse. Half a period has 2 or 3 clocks here, the counters run as with any number.
//
// claim: every level of MA lasts half a period at least, from the first edge on to the last one
// clocks: one
// depth: 200
// cover: 34
// unbounded: no: the counters would have to be tied to the time since the last edge
// look: state = u_dut.state
// mutation: clb/clb_frame.sv | (hold_q && !level) | 1'b0
// mutation: clb/clb_frame.sv | default:          ma_q <= high; | default:          ma_q <= level_q;
// mutation: clb/clb_frame.sv | clb_pkg::RECEIVE: ma_q <= cfg_i.end_level || watchdog_q || expired;
//   | clb_pkg::RECEIVE: ma_q <= cfg_i.end_level;
// mutation: clb/clb_frame.sv | complete = state == clb_pkg::BOTH && rise && count_is_match
//   | complete = state == clb_pkg::BOTH && count_is_match

module proof (
  input logic        clk_i,
  input logic        rst_ni,
  input logic        three_i,        // clocks of half a period: 3, not 2
  input logic        run_i,
  input logic        start_i,
  input logic        end_level_i,
  input logic [7:0]  r0_i,
  input logic [15:0] watchdog_i,
  input logic        sl_i
);

  logic        ma;
  wire  [1:0]  state;

  clb_pkg::cfg_t cfg;
  clb_pkg::act_t act;
  always @* begin
    cfg = '0;
    cfg.ma.match1      = three_i ? 12'd2 : 12'd1;
    cfg.ma.match2      = three_i ? 12'd5 : 12'd3;
    cfg.receive.match1 = cfg.ma.match1;
    cfg.receive.match2 = cfg.ma.match2;
    cfg.clock_run      = run_i;
    cfg.clock_enable   = 1'b1;
    cfg.end_level      = end_level_i;
    cfg.fsm_enable     = 1'b1;
    cfg.spi_match      = 8'd24;
    cfg.r0             = r0_i;
    act = '0;
    act.start          = start_i;
  end

  clb_frame u_dut (
    .clk_i, .rst_ni, .cfg_i (cfg), .act_i (act), .data_i (16'd0), .watchdog_i,
    .frame_o (), .take_o (), .bit_o (), .start_seen_o (), .watchdog_o (),
    .ma_o (ma), .sl_i, .spi_clk_o ()
  );

  // The host's numbers stay, and a tile that runs goes on.
  logic        started = 1'b0;
  logic        three_q, level_q, run_q;
  logic [7:0]  r0_q;
  logic [15:0] watchdog_q;
  always @(posedge clk_i) begin
    started    <= 1'b1;
    three_q    <= three_i;
    level_q    <= end_level_i;
    r0_q       <= r0_i;
    watchdog_q <= watchdog_i;
    run_q      <= run_i && rst_ni;
  end
  always @* begin
    if (!started) assume (!rst_ni);
    if (started) begin
      assume (rst_ni);
      assume (three_i == three_q && end_level_i == level_q && r0_i == r0_q);
      assume (watchdog_i == watchdog_q);
      if (run_q) assume (run_i);
    end
    if (state != 2'b00) assume (!start_i);
  end

  // Clocks since the last edge of MA, up to 7; 7 before the first one.
  logic       ma_q;
  logic [2:0] age_q;
  always @(posedge clk_i) begin
    ma_q  <= ma;
    age_q <= ma != ma_q ? 3'd1 : age_q == 3'd7 ? 3'd7 : age_q + 3'd1;
    if (!rst_ni) begin
      ma_q  <= 1'b1;
      age_q <= 3'd7;
    end
  end

  always @* if (rst_ni && started) begin
    if (ma != ma_q) Whole_A: assert (age_q >= (three_i ? 3'd3 : 3'd2));
    if (state == 2'b00) Rest_A: assert (ma);
  end

  always @(posedge clk_i) if (rst_ni) begin
    High_C:     cover (state == 2'b11 && ma && end_level_i && r0_i == 8'd3);
    Low_C:      cover (state == 2'b11 && !ma && three_i);
    Watchdog_C: cover (state == 2'b11 && ma && !end_level_i);
  end

endmodule
