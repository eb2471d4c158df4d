// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Status flags with their set and clear conditions; EOT and the NER output.
//
// Clock domain: core.
// Latency: EOT falls one clock after busy_i rises. It rises three clocks after busy_i falls, when
// the other flags, SVALID and the banks have settled. So a host that reads EOT = 1 also reads their
// new values. If a set and a clear come in one clock, the set wins.
// Datasheet: pages 33..35, Tables 54..60, 62; decisions 1, 8, 9, 15, 24, 26.

module mb4_status_flags (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic busy_i,         // a frame or INIT runs or is requested
  input  logic clear_i,        // INIT, BREAK
  input  logic scd_en_i,       // a frame is complete: scd_bad_i is its result
  input  logic scd_bad_i,
  input  logic ags_error_i,    // a frame could not start
  input  logic bank_fail_i,    // a bank switch was prevented
  input  logic bank_swapped_i,
  input  logic reg_begin_i,    // a control communication begins
  input  logic reg_end_i,      // the control communication has ended
  input  logic reg_error_i,    // ... with an error
  input  logic delay_error_i,  // ... because no start bit came
  output logic eot_o,
  output logic n_scderr_o,
  output logic n_agserr_o,
  output logic n_regerr_o,
  output logic n_delayerr_o,
  output logic regend_o,
  output logic swbank_fail_o,
  output logic ner_low_o       // pull NER low
);

  logic [1:0] quiet_q;
  logic       eot_q;
  logic       n_scderr_d;
  logic       n_scderr_q;
  logic       n_agserr_d;
  logic       n_agserr_q;
  logic       n_regerr_d;
  logic       n_regerr_q;
  logic       n_delayerr_d;
  logic       n_delayerr_q;
  logic       regend_d;
  logic       regend_q;
  logic       fail_d;
  logic       fail_q;
  logic       ner_low_q;

  always_comb begin
    n_scderr_d   = n_scderr_q;
    n_agserr_d   = n_agserr_q;
    fail_d       = fail_q && !bank_swapped_i;
    n_regerr_d   = n_regerr_q;
    n_delayerr_d = n_delayerr_q;
    regend_d     = regend_q;
    if (clear_i) begin
      n_scderr_d = 1'b1;
      n_agserr_d = 1'b1;
    end
    if (clear_i || reg_begin_i) begin
      n_regerr_d   = 1'b1;
      n_delayerr_d = 1'b1;
      regend_d     = 1'b0;
    end else if (reg_end_i) begin
      n_regerr_d   = !reg_error_i;
      n_delayerr_d = !delay_error_i;
      regend_d     = 1'b1;
    end
    if (scd_en_i)    n_scderr_d = !scd_bad_i;
    if (ags_error_i) n_agserr_d = 1'b0;
    if (bank_fail_i) fail_d     = 1'b1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      quiet_q      <= 2'b11;
      eot_q        <= 1'b1;
      n_scderr_q   <= 1'b1;
      n_agserr_q   <= 1'b1;
      n_regerr_q   <= 1'b1;
      n_delayerr_q <= 1'b1;
      regend_q     <= 1'b0;
      fail_q       <= 1'b0;
      ner_low_q    <= 1'b0;
    end else begin
      quiet_q      <= {quiet_q[0], !busy_i};
      eot_q        <= (quiet_q == 2'b11) && !busy_i;
      n_scderr_q   <= n_scderr_d;
      n_agserr_q   <= n_agserr_d;
      n_regerr_q   <= n_regerr_d;
      n_delayerr_q <= n_delayerr_d;
      regend_q     <= regend_d;
      fail_q       <= fail_d;
      ner_low_q    <= !(n_scderr_d && n_agserr_d && n_regerr_d && n_delayerr_d);
    end
  end

  assign eot_o         = eot_q;
  assign n_scderr_o    = n_scderr_q;
  assign n_agserr_o    = n_agserr_q;
  assign n_regerr_o    = n_regerr_q;
  assign n_delayerr_o  = n_delayerr_q;
  assign regend_o      = regend_q;
  assign swbank_fail_o = fail_q;
  assign ner_low_o     = ner_low_q;

endmodule
