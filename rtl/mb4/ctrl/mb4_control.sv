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
  input  logic       getsens_i,
  // memories and banks
  input  logic       mem_busy_i,
  input  logic       bank_pending_i,
  input  logic       bank_swapped_i,
  input  logic       bank_lost_i,
  output mb4_pkg::bank_cmd_t bank_o,
  output logic       svalid_clear_o,
  // RDATA
  output mb4_pkg::rdata_cmd_t rdata_o,
  input  logic [7:0] rdata_i,
  input  logic       post_busy_i,     // bytes of the host are on their way to RDATA
  // lines
  output logic [2*biss_pkg::LINE_CMD_W-1:0] cmd_o,
  output biss_pkg::line_go_t go_o,
  output logic       register_ma_o,   // BiSS B register access: next level of MA
  output logic       register_end_o,  // ... it ends
  output logic [2*biss_pkg::LINE_START_W-1:0] start_o,
  output logic       time_run_o,      // the time base runs between frames too
  output logic       time_restart_o,  // ... and begins a half period, if no frame runs
  input  logic       tick_i,
  input  logic [1:0] idle_i,
  input  logic [2*biss_pkg::LINE_STATUS_W-1:0] status_i,
  input  logic [2*biss_pkg::LINE_EVENT_W-1:0]  event_i,
  input  logic [1:0] sl_i,
  input  logic [1:0] word_ok_i,       // with word_done of event_i
  // status
  output mb4_pkg::flags_t flags_o,
  output logic       ner_low_o
);

  mb4_pkg::kind_t        kind;
  mb4_pkg::frame_flags_t frame_flags;
  mb4_pkg::access_t access_q;   // constant while an access runs
  logic [1:0] chsel_q;
  logic agsmin, infinite, request, missed, taken, lines_idle, running, brk, init_clear;
  logic control_want, register_want, control_active, void_end, refused, access_run, access_stale;
  logic live, automatic_frames, stalled;
  logic reg_begin, reg_end, reg_error, delay_error, reg_ags_error;
  logic [1:0] ssi, manual, select;
  logic eot, n_scderr, n_agserr, n_regerr, n_delayerr, regend, swbank_fail, cdm_timeout;
  logic [5:0] good_bytes;
  // lines
  biss_pkg::line_status_t status1, status2;
  logic [1:0] start_use, cdm0, cdm1, mo_low, forced, force_level;
  logic force_change, force_any, keep_time, keep_time_q;

  mb4_frame_kind u_kind (
    .instr_i       (held_o.instr),
    .chsel_i       (chsel_q),
    .cts_i         (access_q.cts),
    .regvers_i     (access_q.regvers),
    .slaveloc5_i   (cfg_i.slaveloc5),
    .cfgch1_i      (cfg_i.cfgch1),
    .cfgch2_i      (cfg_i.cfgch2),
    .kind_o        (kind),
    .ssi_o         (ssi),
    .manual_o      (manual),
    .select_o      (select)
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
    .kind_i            (kind),
    .agserr_on_hold_i  (quirks_i[mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK]),
    .agserr_on_write_i (quirks_i[mb4_pkg::QUIRK_AGSERR_ON_INSTR_WR]),
    .ags_clear_i       (quirks_i[mb4_pkg::QUIRK_AGS_CLEARED_ON_ERROR]),
    .request_i         (request),
    .missed_i          (missed || reg_ags_error),
    .taken_o           (taken),
    .lines_idle_o      (lines_idle),
    .running_o         (running),
    .break_o           (brk),
    .go_o,
    .start_use_o       (start_use),
    .tick_i,
    .idle_i,
    .timeout_i         ({status2.timeout, status1.timeout}),
    .sl_i,
    .event_i,
    .word_ok_i,
    .bank_pending_i,
    .bank_o,
    .flags_o           (frame_flags),
    .init_clear_o      (init_clear),
    .control_begin_o   (control_want),
    .register_begin_o  (register_want),
    .void_o            (void_end),
    .refused_o         (refused),
    .control_active_i  (control_active),
    .control_end_i     (reg_end),
    .control_stalled_i (stalled),
    .stale_i           (access_stale)
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
    .busy_i         (frame_flags.busy),
    .clear_i        (frame_flags.clear),
    .scd_en_i       (frame_flags.scd_en),
    .scd_bad_i      (frame_flags.scd_bad),
    .ags_error_i    (frame_flags.ags_error),
    .bank_fail_i    (frame_flags.bank_fail || bank_lost_i),
    .bank_swapped_i,
    .reg_begin_i    (reg_begin),
    .reg_end_i      (reg_end),
    .reg_error_i    (reg_error),
    .delay_error_i  (delay_error),
    .eot_o          (eot),
    .n_scderr_o     (n_scderr),
    .n_agserr_o     (n_agserr),
    .n_regerr_o     (n_regerr),
    .n_delayerr_o   (n_delayerr),
    .regend_o       (regend),
    .swbank_fail_o  (swbank_fail),
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
    .in_use_i      (kind.in_use),
    .ssi_i         (ssi),
    .manual_i      (manual),
    .select_i      (select),
    .rdata_o,
    .rdata_i,
    .post_busy_i,
    .begin_i       (control_want),
    .register_want_i (register_want),
    .void_i        (void_end),
    .refused_i     (refused),
    .abort_i       (go_o.stop),
    .clear_i       (brk || init_clear),
    .init_clear_i  (init_clear),
    .start_i       (go_o.start),
    .use_i         (start_use),
    .init_i        (go_o.init),
    .register_i    (go_o.register_access),
    .frame_end_i   (bank_o.frame_end),
    .live_i        (live),
    .automatic_i   (automatic_frames),
    .tick_i,
    .sl_i,
    .cds_i         ({status2.cds, status1.cds}),
    .cdm_i         ({status2.cdm, status1.cdm}),
    .active_o      (control_active),
    .run_o         (access_run),
    .stale_o       (access_stale),
    .time_o        (keep_time),
    .stalled_o     (stalled),
    .cdm0_o        (cdm0),
    .cdm1_o        (cdm1),
    .cdm_timeout_o (cdm_timeout),
    .register_ma_o,
    .register_end_o,
    .register_mo_o  (mo_low),
    .reg_begin_o   (reg_begin),
    .reg_end_o     (reg_end),
    .reg_error_o   (reg_error),
    .delay_error_o (delay_error),
    .ags_error_o   (reg_ags_error),
    .good_bytes_o  (good_bytes)
  );

  // REGBYTES tells the number of good bytes only after an error (Table 63).
  assign flags_o = {n_agserr, n_delayerr, n_scderr, n_regerr, regend, eot, swbank_fail, cdm_timeout,
                    (n_regerr && n_delayerr) ? 6'd0 : good_bytes};

  // The host may configure the next access while one runs (decision 38). Its settings are here two
  // clocks after the end. In the clock between, the sequencer waits (access_stale).
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)          {access_q, chsel_q} <= '0;
    else if (!access_run) {access_q, chsel_q} <= {cfg_i.access, cfg_i.chsel};
  end

  assign svalid_clear_o = go_o.init && cfg_i.access.regvers;

  // Frames run, or will come by themselves. A frame that the host has to ask for, or that it holds
  // back with HOLDBANK, may come as late as the host likes.
  assign automatic_frames = held_o.ags && !infinite;
  assign live = !eot || (automatic_frames &&
                           !(held_o.holdbank && quirks_i[mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK]));

  mb4_ma_force u_force (
    .clk_i,
    .rst_ni,
    .mafs_i   (cfg_i.mafs),
    .mavs_i   (cfg_i.mavs),
    .mafo_i   (cfg_i.mafo),
    .mavo_i   (cfg_i.mavo),
    .chsel_i  (cfg_i.chsel),
    .force_o  (forced),
    .level_o  (force_level),
    .change_o (force_change),
    .any_o    (force_any)
  );

  // ---- lines --------------------------------------------------------------------------------

  assign {status2, status1} = status_i;

  // CFGCHx has the codes of biss_pkg::protocol_e. Line 2 is unused if SLAVELOC5 = 0.
  assign cmd_o = {
    cfg_i.cfgch2 | {2{!cfg_i.slaveloc5}}, cfg_i.en_mo, cfg_i.mo_busy,
    cfg_i.holdcdm, forced[1], force_level[1], mo_low[1],
    cfg_i.cfgch1, cfg_i.en_mo, cfg_i.mo_busy,
    cfg_i.holdcdm, forced[0], force_level[0], mo_low[0]
  };
  assign start_o = {start_use[1], cdm0[1], cdm1[1], start_use[0], cdm0[0], cdm1[0]};

  // A forced level lasts whole half periods, and a time limit counts them.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) keep_time_q <= 1'b0;
    else         keep_time_q <= keep_time;
  end
  assign time_run_o     = keep_time || force_any;
  assign time_restart_o = !force_any && (force_change || (keep_time && !keep_time_q));

endmodule
