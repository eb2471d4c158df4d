// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One counter of the clock tile, with its clock: it counts from 0 to match 2 and from 0 again.
//
// Clock domain: core. match_o is high one clock after the count is match 1, wrap_o one clock after
// the last clock of a period. Both are flops. clear_i sets the count to 0, load_i to load_value_i;
// clear_i is the stronger one, and with it no match or wrap follows.
//
// Misuse: a count above match 2 runs on to 4095 and then to 0; lost_o is high one clock after its
// last clock. With match 1 above match 2 match_o stays 0 from then on.
// Source: TIDM-1010, 2.3.5.3.

module clb_counter (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  clb_pkg::period_t period_i,
  input  logic        run_i,
  input  logic        clear_i,
  input  logic        load_i,
  input  logic [11:0] load_value_i,
  output logic        match_o,
  output logic        wrap_o,
  output logic        lost_o         // runs over, because it was above match 2
);

  logic [11:0] count_q;
  logic [12:0] next;
  logic        last;
  logic        loads;
  logic        steps;
  logic        counts;
  logic        match_q;
  logic        wrap_q;
  logic        lost_q;

  assign next    = 13'(count_q) + 13'd1;
  assign last    = count_q == period_i.match2;
  assign counts  = run_i && !clear_i;
  assign loads   = load_i && !clear_i;
  assign steps   = counts && !last && !load_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q <= '0;
      match_q <= 1'b0;
      wrap_q  <= 1'b0;
      lost_q  <= 1'b0;
    end else begin
      if (run_i || load_i || clear_i)
        count_q <= (load_value_i & {12{loads}}) | (next[11:0] & {12{steps}});
      match_q <= counts && count_q == period_i.match1;
      wrap_q  <= counts && last;
      lost_q  <= counts && next[12];
    end
  end

  assign match_o = match_q;
  assign wrap_o  = wrap_q;
  assign lost_o  = lost_q;

endmodule
