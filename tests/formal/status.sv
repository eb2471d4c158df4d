// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The status flags against their table: what sets and what clears each (datasheet pages 33..35,
// Tables 54..60, 62; decisions 8, 9, 15, 24, 26). Setting wins. NER is low while an error flag is
// 0.
//
// claim: every flag is set and cleared by exactly its conditions; NER follows the error flags
// clocks: one
// depth: 12
// cover: 8
// unbounded: reachability
// mutation: mb4/ctrl/mb4_status_flags.sv | if (frame_i.scd_en)    n_scderr_d = !frame_i.scd_bad;
//   | if (frame_i.scd_bad) n_scderr_d = 1'b0;
// mutation: mb4/ctrl/mb4_status_flags.sv | fail_q && !bank_i.swapped | fail_q && !frame_i.clear
// mutation: mb4/ctrl/mb4_status_flags.sv | && n_agserr_d && n_regerr_d &&
//   | && n_regerr_d &&
// mutation: mb4/ctrl/mb4_status_flags.sv | n_delayerr_d = !access_i.delay_error;
//   | n_delayerr_d = !access_i.reg_error;

module proof (
  input logic clk_i,
  input logic rst_ni,
  input logic busy_i, clear_i, scd_en_i, scd_bad_i, ags_error_i, bank_fail_i, bank_swapped_i,
  input logic bank_lost_i,
  input mb4_pkg::access_state_t access_state_i,
  input logic reg_begin_i, reg_end_i, reg_error_i, delay_error_i
);

  logic eot, n_scderr, n_agserr, n_regerr, n_delayerr, regend, fail, ner_low, zeros;
  logic [5:0] bytes;
  mb4_pkg::flags_t flags;
  assign {n_agserr, n_delayerr, n_scderr, n_regerr, regend, eot, fail, zeros, bytes} = flags;

  mb4_status_flags u_dut (
    .clk_i, .rst_ni,
    .frame_i({busy_i, clear_i, scd_en_i, scd_bad_i, ags_error_i, bank_fail_i}),
    .bank_i({bank_swapped_i, bank_lost_i}),
    .access_i({reg_begin_i, reg_end_i, reg_error_i, delay_error_i}), .access_state_i,
    .flags_o(flags), .ner_low_o(ner_low)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  // One row a flag: {error seen, condition that sets it, that clears it}; error = flag is 0.
  logic [5:0] set, clear, flags_q;   // scderr, agserr, regerr, delayerr, regend, swbank fail
  logic       ended;

  assign ended = reg_end_i && !clear_i && !reg_begin_i;
  assign set   = {scd_en_i && scd_bad_i, ags_error_i, ended && reg_error_i,
                  ended && delay_error_i, ended, bank_fail_i || bank_lost_i};
  assign clear = {clear_i || (scd_en_i && !scd_bad_i), clear_i,
                  clear_i || reg_begin_i || (ended && !reg_error_i),
                  clear_i || reg_begin_i || (ended && !delay_error_i),
                  clear_i || reg_begin_i, bank_swapped_i};

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) flags_q <= '0;
    else         flags_q <= set | (flags_q & ~clear);
  end

  always @* if (started) begin
    Table_A: assert ({!n_scderr, !n_agserr, !n_regerr, !n_delayerr, regend, fail} == flags_q);
    Zeros_A: assert (zeros == access_state_i.cdm_timeout);
    Bytes_A: assert (bytes == (n_regerr && n_delayerr ? 6'd0 : access_state_i.good_bytes));
    Ner_A: assert (ner_low == (flags_q[5:2] != 4'd0));
  end
  always @(posedge clk_i) begin
    Errors_C: cover (rst_ni && flags_q == 6'b111111);
    NoError_C: cover (rst_ni && flags_q == 6'b000010 && eot);
  end

endmodule
