// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control: connects the sequencer, the requests of automatic frames, control communication, status
// flags and MA force bits.
//
// Clock domain: core. Latency, misuse and datasheet sections: see the modules.
// Vectors: bit i of a vector {2, 1} is for line i + 1.

module mb4_control #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic clk_i,
  input  logic rst_ni,
  // registers
  input  mb4_pkg::instr_host_t instr_i,
  output mb4_pkg::instr_core_t instr_o,
  input  mb4_pkg::cfg_t   cfg_i,
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i,
  input  logic       getsens_i,
  // memories and banks
  input  mb4_pkg::mem_state_t mem_i,
  input  mb4_pkg::bank_event_t bank_event_i,
  output mb4_pkg::bank_cmd_t bank_o,
  // RDATA
  output mb4_pkg::rdata_cmd_t rdata_o,
  input  logic [7:0] rdata_i,
  input  logic       post_busy_i,     // bytes of the host are on their way to RDATA
  // lines
  output logic [2*biss_pkg::LINE_CMD_W-1:0] cmd_o,
  output biss_pkg::line_go_t go_o,
  output biss_pkg::register_ma_t register_ma_o,
  output logic [2*biss_pkg::LINE_START_W-1:0] start_o,
  output logic       time_run_o,      // the time base runs between frames too
  output logic       time_restart_o,  // ... and begins a half period, if no frame runs
  input  logic       tick_i,
  input  logic [2*biss_pkg::LINE_STATUS_W-1:0] status_i,
  input  logic [2*biss_pkg::LINE_EVENT_W-1:0]  event_i,
  input  logic [1:0] word_bad_i,      // a word ends that is not valid
  // status
  output mb4_pkg::flags_t flags_o,
  output logic       ner_low_o,
  output logic       frame_lost_o     // a frame was left out or overwritten
);

  localparam bit TWO_LINES = Features[mb4_pkg::TWO_LINES_LSB];
  localparam bit BISS_B    = Features[mb4_pkg::BISS_B_LSB];
  localparam bit SSI       = Features[mb4_pkg::SSI_LSB];

  mb4_pkg::kind_t         kind;
  mb4_pkg::request_t      request;
  mb4_pkg::frame_flags_t  frame_flags;
  mb4_pkg::access_event_t access_event;
  mb4_pkg::access_state_t access_state;
  logic missed, taken, lines_idle, running, brk, init_clear;
  logic control_want, register_want, control_active, control_start, void_end, refused, access_stale;
  logic frame_done;
  logic live, automatic_frames, stalled, access_ags_error;
  // lines
  logic [3:0] protocol_q;
  logic [1:0] start_use, cdm0, cdm1, mo_low, forced, force_level;
  biss_pkg::line_cmd_t   cmd1, cmd2;
  biss_pkg::line_start_t start1, start2;
  logic force_change, force_any, keep_time, keep_time_q;

  mb4_sequencer #(.BissB(BISS_B)) u_sequencer (
    .clk_i,
    .rst_ni,
    .instr_i,
    .instr_o,
    .regvers_i         (cfg_i.access.regvers),
    .kind_i            (kind),
    .quirks_i,
    .request_i         (request),
    .missed_i          (missed || access_ags_error),
    .taken_o           (taken),
    .lines_idle_o      (lines_idle),
    .running_o         (running),
    .break_o           (brk),
    .go_o,
    .start_use_o       (start_use),
    .tick_i,
    .status_i,
    .event_i,
    .word_bad_i,
    .mem_i,
    .bank_o,
    .frame_done_o      (frame_done),
    .flags_o           (frame_flags),
    .init_clear_o      (init_clear),
    .control_begin_o   (control_want),
    .register_begin_o  (register_want),
    .void_o            (void_end),
    .refused_o         (refused),
    .control_active_i  (control_active),
    .control_start_i   (control_start),
    .control_end_i     (access_event.ends),
    .control_stalled_i (stalled),
    .stale_i           (access_stale)
  );

  mb4_frame_request u_request (
    .clk_i,
    .rst_ni,
    .ags_i        (instr_o.held.ags),
    .restart_i    (brk),
    .freqags_i    (cfg_i.freqags),
    .hold_cdm_i   (cfg_i.holdcdm),
    .getsens_i,
    .busy_i       (running),
    .lines_idle_i (lines_idle),
    .taken_i      (taken),
    .request_o    (request),
    .missed_o     (missed)
  );

  mb4_status_flags u_flags (
    .clk_i,
    .rst_ni,
    .frame_i        (frame_flags),
    .bank_i         (bank_event_i),
    .access_i       (access_event),
    .access_state_i (access_state),
    .flags_o,
    .ner_low_o
  );

  mb4_control_comm #(.Features(Features)) u_comm (
    .clk_i,
    .rst_ni,
    .cfg_i,
    .quirks_i,
    .protocol_i    (protocol_q),
    .instr_i       (instr_o.held.instr),
    .kind_o        (kind),
    .rdata_o,
    .rdata_i,
    .post_busy_i,
    .begin_i       (control_want),
    .register_want_i (register_want),
    .void_i        (void_end),
    .refused_i     (refused),
    .clear_i       (frame_flags.clear),
    .init_clear_i  (init_clear),
    .go_i          (go_o),
    .start_use_i   (start_use),
    .frame_done_i  (frame_done),
    .live_i        (live),
    .automatic_i   (automatic_frames),
    .tick_i,
    .status_i,
    .active_o      (control_active),
    .active_start_o (control_start),
    .stale_o       (access_stale),
    .time_o        (keep_time),
    .stalled_o     (stalled),
    .cdm0_o        (cdm0),
    .cdm1_o        (cdm1),
    .register_ma_o,
    .register_mo_o (mo_low),
    .event_o       (access_event),
    .state_o       (access_state),
    .ags_error_o   (access_ags_error)
  );

  assign frame_lost_o = frame_flags.ags_error || frame_flags.bank_fail || bank_event_i.lost;

  // A frame runs, or automatic frames come without the host. A time limit on the next frame needs
  // this: a frame that the host asks for, or holds back with HOLDBANK, has no latest time.
  assign automatic_frames = instr_o.held.ags && !request.infinite;
  assign live = !flags_o.eot || (automatic_frames &&
                           !(instr_o.held.holdbank && quirks_i[mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK]));

  mb4_ma_force #(.Force(Features[mb4_pkg::FORCE_LSB])) u_force (
    .clk_i,
    .rst_ni,
    .mafs_i   (cfg_i.mafs),
    .mavs_i   (cfg_i.mavs),
    .mafo_i   (cfg_i.mafo),
    .mavo_i   (cfg_i.mavo),
    .chsel_i  (cfg_i.access.chsel),
    .force_o  (forced),
    .level_o  (force_level),
    .change_o (force_change),
    .any_o    (force_any)
  );

  // ---- lines --------------------------------------------------------------------------------

  // CFGCHx has the codes of biss_pkg::protocol_e. Line 2 is unused too with SLAVELOC5 = 0 or if it
  // is left out, and so is a line whose protocol is left out. The host may write CFGCHx at any
  // time: the sequencer and the line take the protocol of a frame from the same flop.
  for (genvar i = 0; i < 2; i++) begin : gen_protocol
    logic [1:0] code, protocol;

    assign code     = i == 0 ? cfg_i.cfgch1 : cfg_i.cfgch2 | {2{!cfg_i.slaveloc5 || !TWO_LINES}};
    assign protocol = code == biss_pkg::BISS_C             ? biss_pkg::BISS_C
                    : (BISS_B && code == biss_pkg::BISS_B) ? biss_pkg::BISS_B
                    : (SSI && code == biss_pkg::SSI)       ? biss_pkg::SSI
                                                           : biss_pkg::UNUSED;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) protocol_q[2*i +: 2] <= biss_pkg::UNUSED;
      else         protocol_q[2*i +: 2] <= protocol;
    end
  end

  assign cmd1.protocol    = protocol_q[1:0];
  assign cmd1.mo_en       = cfg_i.en_mo;
  assign cmd1.mo_busy     = cfg_i.mo_busy;
  assign cmd1.hold_cdm    = cfg_i.holdcdm;
  assign cmd1.forced      = forced[0];
  assign cmd1.force_level = force_level[0];
  assign cmd1.mo_low      = mo_low[0];
  assign cmd2.protocol    = protocol_q[3:2];
  assign cmd2.mo_en       = cfg_i.en_mo;
  assign cmd2.mo_busy     = cfg_i.mo_busy;
  assign cmd2.hold_cdm    = cfg_i.holdcdm;
  assign cmd2.forced      = forced[1];
  assign cmd2.force_level = force_level[1];
  assign cmd2.mo_low      = mo_low[1];

  assign cmd_o[0 +: biss_pkg::LINE_CMD_W]                    = cmd1;
  assign cmd_o[biss_pkg::LINE_CMD_W +: biss_pkg::LINE_CMD_W] = cmd2;

  assign start1.takes_part = start_use[0];
  assign start1.cdm0       = cdm0[0];
  assign start1.cdm1       = cdm1[0];
  assign start2.takes_part = start_use[1];
  assign start2.cdm0       = cdm0[1];
  assign start2.cdm1       = cdm1[1];

  assign start_o[0 +: biss_pkg::LINE_START_W]                      = start1;
  assign start_o[biss_pkg::LINE_START_W +: biss_pkg::LINE_START_W] = start2;

  // A forced level lasts whole half periods, and a time limit counts them.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) keep_time_q <= 1'b0;
    else         keep_time_q <= keep_time;
  end
  assign time_run_o     = keep_time || force_any;
  assign time_restart_o = !force_any && (force_change || (keep_time && !keep_time_q));

endmodule
