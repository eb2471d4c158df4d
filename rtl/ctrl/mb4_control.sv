// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control: connects the sequencer, the requests of automatic frames, control communication, status
// flags and MA force bits. It also keeps the configuration of an access while the access runs.
//
// Clock domain: core. Latency, misuse and datasheet sections: see the modules.
// Vectors: bit i of a vector {2, 1} is for line i + 1.

module mb4_control (
  input  logic clk_i,
  input  logic rst_ni,
  // registers
  input  mb4_pkg::instr_t written_i,
  input  logic [1:0]      count_i,
  output logic [1:0]      ack_o,
  output mb4_pkg::instr_t held_o,
  input  mb4_pkg::cfg_t   cfg_i,
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i,
  // pins
  input  logic       getsens_i,
  output logic       eot_o,
  output logic       ner_low_o,
  // memories and banks
  input  logic       mem_busy_i,
  input  logic       bank_pending_i,
  input  logic       bank_swapped_i,
  input  logic       bank_lost_i,
  output logic       bank_run_o,
  output logic       svalid_clear_o,
  output logic       frame_end_o,
  output logic       bank_end_o,
  output logic       reduced_o,
  output logic       swbank_pulse_o,
  // RDATA
  output logic       rdata_rd_en_o,
  output logic [5:0] rdata_addr_o,
  input  logic [7:0] rdata_i,
  input  logic       post_busy_i,     // bytes of the host are on their way to RDATA
  output logic       rdata_wr_en_o,
  output logic [7:0] rdata_wr_data_o,
  // lines
  output logic [7:0] half_len_o,
  output logic [1:0] ssi_o,
  output logic       start_o,
  output logic [1:0] use_o,           // with start_o
  output logic       init_o,
  output logic       mo_return_o,
  output logic       register_o,      // with start_o
  output logic       register_ma_o,
  output logic       register_end_o,
  output logic [1:0] register_mo_o,   // MO is low
  output logic [1:0] force_o,
  output logic [1:0] force_level_o,
  output logic       force_change_o,
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o,
  output logic       abort_o,
  output logic       time_o,
  input  logic       tick_i,
  input  logic [1:0] cds_i,
  input  logic [1:0] cdm_i,
  input  logic [1:0] idle_i,
  input  logic [1:0] timeout_i,
  input  logic [1:0] sl_i,
  input  logic [1:0] line_end_i,
  input  logic [1:0] word_done_i,
  input  logic [1:0] word_ok_i,
  input  logic [1:0] init_done_i,
  input  logic [1:0] init_fail_i,
  // status
  output logic       n_scderr_o,
  output logic       n_agserr_o,
  output logic       n_regerr_o,
  output logic       n_delayerr_o,
  output logic       regend_o,
  output logic [5:0] regbytes_o,
  output logic       swbank_fail_o,
  output logic       cdm_timeout_o
);

  logic agsmin, infinite, request, missed, taken, lines_idle, running, brk;
  logic busy, clear_flags, scd_en, scd_bad, ags_error, bank_fail, init_clear;
  logic control_want, register_want, control_active, is_frame, is_control, is_register;
  logic reg_begin, reg_end, reg_error, delay_error, reg_ags_error;
  logic live, automatic_frames, stalled;
  logic [1:0] in_use, frame_use, init_use, manual, select;
  logic is_void, void_end, refused, access_run;
  mb4_pkg::access_t access_q;   // constant while an access runs
  logic [1:0] chsel_q;
  logic [5:0] good_bytes;

  mb4_frame_kind u_kind (
    .instr_i       (held_o.instr),
    .chsel_i       (chsel_q),
    .cts_i         (access_q.cts),
    .regvers_i     (access_q.regvers),
    .slaveloc5_i   (cfg_i.slaveloc5),
    .cfgch1_i      (cfg_i.cfgch1),
    .cfgch2_i      (cfg_i.cfgch2),
    .use_o         (in_use),
    .ssi_o,
    .manual_o      (manual),
    .select_o      (select),
    .frame_use_o   (frame_use),
    .init_use_o    (init_use),
    .is_frame_o    (is_frame),
    .is_control_o  (is_control),
    .is_register_o (is_register),
    .is_void_o     (is_void)
  );

  mb4_sequencer u_sequencer (
    .clk_i,
    .rst_ni,
    .written_i,
    .count_i,
    .ack_o,
    .held_o,
    .mem_busy_i,
    .agsmin_i          (agsmin),
    .infinite_i        (infinite),
    .regvers_i         (cfg_i.access.regvers),
    .use_i             (in_use),
    .frame_use_i       (frame_use),
    .init_use_i        (init_use),
    .is_frame_i        (is_frame),
    .is_control_i      (is_control),
    .is_register_i     (is_register),
    .is_void_i         (is_void),
    .agserr_on_hold_i  (quirks_i[mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK]),
    .agserr_on_write_i (quirks_i[mb4_pkg::QUIRK_AGSERR_ON_INSTR_WR]),
    .ags_clear_i       (quirks_i[mb4_pkg::QUIRK_AGS_CLEARED_ON_ERROR]),
    .request_i         (request),
    .missed_i          (missed || reg_ags_error),
    .taken_o           (taken),
    .lines_idle_o      (lines_idle),
    .running_o         (running),
    .break_o           (brk),
    .start_o,
    .start_use_o       (use_o),
    .init_o,
    .mo_return_o,
    .register_o,
    .reduced_o,
    .abort_o,
    .tick_i,
    .idle_i,
    .timeout_i,
    .sl_i,
    .frame_end_i       (line_end_i),
    .word_done_i,
    .word_ok_i,
    .init_done_i,
    .init_fail_i,
    .bank_pending_i,
    .frame_end_o,
    .bank_end_o,
    .bank_run_o,
    .swbank_pulse_o,
    .busy_o            (busy),
    .clear_flags_o     (clear_flags),
    .scd_en_o          (scd_en),
    .scd_bad_o         (scd_bad),
    .ags_error_o       (ags_error),
    .bank_fail_o       (bank_fail),
    .init_clear_o      (init_clear),
    .control_begin_o   (control_want),
    .register_begin_o  (register_want),
    .void_o            (void_end),
    .refused_o         (refused),
    .control_active_i  (control_active),
    .control_end_i     (reg_end),
    .control_stalled_i (stalled)
  );

  mb4_frame_request u_request (
    .clk_i,
    .rst_ni,
    .ags_i        (held_o.ags),
    .restart_i    (brk),
    .freqags_i    (cfg_i.freqags),
    .hold_cdm_i   (cfg_i.holdcdm),
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
    .bank_fail_i    (bank_fail || bank_lost_i),
    .bank_swapped_i,
    .reg_begin_i    (reg_begin),
    .reg_end_i      (reg_end),
    .reg_error_i    (reg_error),
    .delay_error_i  (delay_error),
    .eot_o,
    .n_scderr_o,
    .n_agserr_o,
    .n_regerr_o,
    .n_delayerr_o,
    .regend_o,
    .swbank_fail_o,
    .ner_low_o
  );

  mb4_control_comm u_comm (
    .clk_i,
    .rst_ni,
    .access_i      (access_q),
    .freqr_i       (cfg_i.freqr),
    .en_mo_i       (cfg_i.en_mo),
    .instr_i       (held_o.instr),
    .ida_invert_i  (quirks_i[mb4_pkg::QUIRK_IDA_TEST_INVERT]),
    .in_use_i      (in_use),
    .ssi_i         (ssi_o),
    .manual_i      (manual),
    .select_i      (select),
    .rdata_rd_en_o,
    .rdata_addr_o,
    .rdata_i,
    .post_busy_i,
    .rdata_wr_en_o,
    .rdata_wr_data_o,
    .begin_i       (control_want),
    .register_want_i (register_want),
    .void_i        (void_end),
    .refused_i     (refused),
    .abort_i       (abort_o),
    .clear_i       (brk || init_clear),
    .init_clear_i  (init_clear),
    .start_i       (start_o),
    .use_i         (use_o),
    .init_i        (init_o),
    .register_i    (register_o),
    .frame_end_i   (frame_end_o),
    .live_i        (live),
    .automatic_i   (automatic_frames),
    .tick_i,
    .sl_i,
    .cds_i,
    .cdm_i,
    .active_o      (control_active),
    .run_o         (access_run),
    .time_o,
    .stalled_o     (stalled),
    .cdm0_o,
    .cdm1_o,
    .cdm_timeout_o,
    .register_ma_o,
    .register_end_o,
    .register_mo_o,
    .reg_begin_o   (reg_begin),
    .reg_end_o     (reg_end),
    .reg_error_o   (reg_error),
    .delay_error_o (delay_error),
    .ags_error_o   (reg_ags_error),
    .good_bytes_o  (good_bytes)
  );

  // REGBYTES tells the number of good bytes only after an error (Table 63).
  assign regbytes_o = (n_regerr_o && n_delayerr_o) ? 6'd0 : good_bytes;

  // The host may configure the next access while one runs (decision 38). The next one may begin in
  // the clock after its end.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)          {access_q, chsel_q} <= '0;
    else if (!access_run) {access_q, chsel_q} <= {cfg_i.access, cfg_i.chsel};
  end

  assign svalid_clear_o = init_o && cfg_i.access.regvers;

  // Frames run, or will come by themselves. A frame that the host has to ask for, or that it holds
  // back with HOLDBANK, may come as late as the host likes.
  assign automatic_frames = held_o.ags && !infinite;
  assign live = !eot_o || (automatic_frames &&
                           !(held_o.holdbank && quirks_i[mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK]));

  mb4_ma_force u_force (
    .clk_i,
    .rst_ni,
    .mafs_i   (cfg_i.mafs),
    .mavs_i   (cfg_i.mavs),
    .mafo_i   (cfg_i.mafo),
    .mavo_i   (cfg_i.mavo),
    .chsel_i  (cfg_i.chsel),
    .force_o,
    .level_o  (force_level_o),
    .change_o (force_change_o)
  );

  mb4_freqs_dec u_freqs (
    .freqs_i    (cfg_i.freqs),
    .half_len_o
  );

endmodule
