// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control: sequencer, frames due by themselves, flags (instances only). Bit i of a vector {2, 1}
// belongs to line i + 1.
//
// Clock domain: core. Misuse and datasheet sections: see the modules.

module mb4_control (
  input  logic clk_i,
  input  logic rst_ni,
  // registers
  input  mb4_pkg::instr_t written_i,
  input  logic            toggle_i,
  output logic            ack_o,
  output mb4_pkg::instr_t held_o,
  input  logic [4:0]      freqs_i,
  input  logic [7:0]      freqags_i,
  input  logic            hold_cdm_i,
  input  logic            regvers_i,
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i,
  // pins
  input  logic       getsens_i,
  output logic       eot_o,
  output logic       ner_low_o,
  // memories and banks
  input  logic       mem_busy_i,
  input  logic       bank_pending_i,
  input  logic       bank_swapped_i,
  output logic       bank_end_o,
  output logic       holdbank_o,
  output logic       swbank_pulse_o,
  // lines
  input  logic [1:0] use_i,
  output logic [7:0] half_len_o,
  output logic       start_o,
  output logic       init_o,
  output logic       cdm_o,
  output logic       abort_o,
  input  logic       tick_i,
  input  logic       cdssel_i,
  input  logic [1:0] idle_i,
  input  logic [1:0] timeout_i,
  input  logic [1:0] sl_i,
  input  logic [1:0] frame_end_i,
  input  logic [1:0] word_done_i,
  input  logic [1:0] word_ok_i,
  input  logic [1:0] init_done_i,
  input  logic [1:0] init_fail_i,
  // status
  output logic       n_scderr_o,
  output logic       n_agserr_o,
  output logic       swbank_fail_o,
  output logic       cdm_timeout_o
);

  logic agsmin, infinite, request, missed, taken, lines_idle, running, brk;
  logic busy, clear_flags, scd_en, scd_bad, ags_error, bank_fail, init_clear, frame_cdm;

  mb4_sequencer u_sequencer (
    .clk_i,
    .rst_ni,
    .written_i,
    .toggle_i,
    .ack_o,
    .held_o,
    .mem_busy_i,
    .agsmin_i          (agsmin),
    .infinite_i        (infinite),
    .regvers_i,
    .use_i,
    .agserr_on_hold_i  (quirks_i[mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK]),
    .agserr_on_write_i (quirks_i[mb4_pkg::QUIRK_AGSERR_ON_INSTR_WR]),
    .ags_clear_i       (quirks_i[mb4_pkg::QUIRK_AGS_CLEARED_ON_ERROR]),
    .request_i         (request),
    .missed_i          (missed),
    .taken_o           (taken),
    .lines_idle_o      (lines_idle),
    .running_o         (running),
    .break_o           (brk),
    .start_o,
    .init_o,
    .cdm_o,
    .abort_o,
    .tick_i,
    .cdssel_i,
    .idle_i,
    .timeout_i,
    .sl_i,
    .frame_end_i,
    .word_done_i,
    .word_ok_i,
    .init_done_i,
    .init_fail_i,
    .bank_pending_i,
    .bank_end_o,
    .holdbank_o,
    .swbank_pulse_o,
    .busy_o            (busy),
    .clear_flags_o     (clear_flags),
    .scd_en_o          (scd_en),
    .scd_bad_o         (scd_bad),
    .ags_error_o       (ags_error),
    .bank_fail_o       (bank_fail),
    .init_clear_o      (init_clear),
    .frame_cdm_o       (frame_cdm)
  );

  mb4_frame_request u_request (
    .clk_i,
    .rst_ni,
    .ags_i        (held_o.ags),
    .restart_i    (brk),
    .freqags_i,
    .hold_cdm_i,
    .getsens_i,
    .busy_i       (running),
    .lines_idle_i (lines_idle),
    .taken_i      (taken),
    .agsmin_o     (agsmin),
    .infinite_o   (infinite),
    .request_o    (request),
    .missed_o     (missed)
  );

  mb4_status_flags u_flags (
    .clk_i,
    .rst_ni,
    .busy_i         (busy),
    .clear_i        (clear_flags),
    .scd_en_i       (scd_en),
    .scd_bad_i      (scd_bad),
    .ags_error_i    (ags_error),
    .bank_fail_i    (bank_fail),
    .bank_swapped_i,
    .eot_o,
    .n_scderr_o,
    .n_agserr_o,
    .swbank_fail_o,
    .ner_low_o
  );

  mb4_cdm_timeout u_cdm_timeout (
    .clk_i,
    .rst_ni,
    .frame_end_i (bank_end_o),
    .cdm_i       (frame_cdm),
    .clear_i     (init_clear),
    .timeout_o   (cdm_timeout_o)
  );

  mb4_freqs_dec u_freqs (
    .freqs_i,
    .half_len_o
  );

endmodule
