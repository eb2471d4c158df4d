// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control communication: BiSS C control frames, BiSS B register access, the CDM bit of every frame,
// and the time limits.
//
// Clock domain: core. Latency, misuse and datasheet sections: see the modules.
// Vectors: bit i of a vector {2, 1} is for line i + 1.

module mb4_control_comm (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  mb4_pkg::access_t access_i,   // stable while run_o
  input  logic [2:0] freqr_i,
  input  logic       en_mo_i,
  input  logic [2:0] instr_i,
  input  logic       ida_invert_i,
  input  logic [1:0] in_use_i,
  input  logic [1:0] ssi_i,
  input  logic [1:0] manual_i,         // lines that CHSEL names
  input  logic [1:0] select_i,         // lines of the access: CHSEL names them, protocol fits
  // RDATA
  output mb4_pkg::rdata_cmd_t rdata_o,
  input  logic [7:0] rdata_i,
  input  logic       post_busy_i,
  // frames
  input  logic       begin_i,          // a BiSS C control communication begins
  input  logic       register_want_i,  // INSTR asks for BiSS B, or for what cannot run
  input  logic       void_i,           // an access that cannot run or begin ends
  input  logic       refused_i,        // SL is low: no frame for INSTR
  input  logic       abort_i,
  input  logic       clear_i,          // BREAK, INIT
  input  logic       init_clear_i,     // INIT begins
  input  logic       start_i,
  input  logic [1:0] use_i,            // lines that start_i is for
  input  logic       init_i,
  input  logic       register_i,       // start_i is for a BiSS B register access
  input  logic       frame_end_i,
  input  logic       live_i,           // frames run, or will come by themselves
  input  logic       automatic_i,      // no frame depends on INSTR
  input  logic       tick_i,
  input  logic [1:0] sl_i,
  input  logic [1:0] cds_i,
  input  logic [1:0] cdm_i,            // as sent
  output logic       active_o,
  output logic       run_o,            // an access runs or begins
  output logic       stale_o,          // access_i is still that of an access which has ended
  output logic       time_o,           // the time base must run between frames too
  output logic       stalled_o,        // no frame has ended for too long
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o,
  output logic       cdm_timeout_o,
  // BiSS B register access
  output logic       register_ma_o,
  output logic       register_end_o,
  output logic [1:0] register_mo_o,    // MO is low
  // results
  output logic       reg_begin_o,
  output logic       reg_end_o,
  output logic       reg_error_o,      // with reg_end_o
  output logic       delay_error_o,    // with reg_end_o
  output logic       ags_error_o,
  output logic [5:0] good_bytes_o
);

  logic       time_d, time_q;
  logic       refused_d, refused_q;    // SL was low: no frame since the last request
  logic       counted;                 // the watchdog's limit has been reached
  logic       void_q;                  // void_i one clock late, as all ends come
  logic       register_q;              // the results are those of BiSS B
  logic       unused;
  logic waiting, moved, control_runs;
  logic run_q;
  logic control_begin, control_end, control_error, control_delay, in_body, expired, sent;
  logic register_start, register_active, register_wait, register_init, register_error;
  logic register_delay, register_end, register_mo;
  logic [1:0] control0, control1, register_use;
  logic       control_wr_en, register_wr_en;
  logic [5:0] control_addr, control_bytes, register_addr, register_bytes;
  logic [7:0] control_data, register_data;

  // ---- BiSS C -------------------------------------------------------------------------------

  biss_control_frame u_frame (
    .clk_i,
    .rst_ni,
    .cts_i           (access_i.cts),
    .wnr_i           (access_i.wnr),
    .regadr_i        (access_i.regadr),
    .regnum_i        (access_i.regnum),
    .slaveid_i       (access_i.slaveid),
    .ida_invert_i,
    .select_i,
    .blind_i         ((select_i & ssi_i) != 2'b00),
    .rdata_addr_o    (control_addr),
    .rdata_i,
    .post_busy_i,
    .rdata_wr_en_o   (control_wr_en),
    .rdata_wr_data_o (control_data),
    .begin_i,
    .abort_i         (clear_i || void_q),
    .start_i         (start_i && !init_i && !register_i),
    .frame_end_i,
    .cds_i           (cds_i & in_use_i),
    .cdm_timeout_i   (cdm_timeout_o),
    .expired_i       (expired),
    .stalled_i       (stalled_o),
    .active_o,
    .running_o       (control_runs),
    .in_body_o       (in_body),
    .wait_o          (waiting),
    .moved_o         (moved),
    .cdm0_o          (control0),
    .cdm1_o          (control1),
    .begin_o         (control_begin),
    .end_o           (control_end),
    .reg_error_o     (control_error),
    .delay_error_o   (control_delay),
    .good_bytes_o    (control_bytes)
  );

  // ---- BiSS B register access ---------------------------------------------------------------

  assign register_start = start_i && register_i;

  biss_b_access u_biss_b (
    .clk_i,
    .rst_ni,
    .freqr_i,
    .wnr_i           (access_i.wnr),
    .regadr_i        (access_i.regadr),
    .regnum_i        (access_i.regnum),
    .slaveid_i       (access_i.slaveid),
    .mo_i            (en_mo_i),
    .start_i         (register_start),
    .use_i,
    .init_i,
    .abort_i,
    .tick_i,
    .expired_i       (expired),
    .wait_o          (register_wait),
    .active_o        (register_active),
    .init_o          (register_init),
    .use_o           (register_use),
    .sl_i,
    .ma_o            (register_ma_o),
    .mo_low_o        (register_mo),
    .rdata_addr_o    (register_addr),
    .rdata_i,
    .rdata_wr_en_o   (register_wr_en),
    .rdata_wr_data_o (register_data),
    .end_o           (register_end_o),
    .ags_error_o     (ags_error_o),
    .reg_error_o     (register_error),
    .delay_error_o   (register_delay),
    .good_bytes_o    (register_bytes)
  );

  assign register_end    = register_end_o && !register_init;
  assign register_mo_o   = register_use & {2{register_mo}};
  assign rdata_o         = {active_o || register_active,
                            register_active ? register_addr : control_addr,
                            control_wr_en || register_wr_en,
                            register_active ? register_data : control_data};

  mb4_cdm_select u_cdm (
    .manual_i,
    .instr_i,
    .active_i   (active_o),
    .control0_i (control0),
    .control1_i (control1),
    .cdm0_o,
    .cdm1_o
  );

  // After an access that cannot run, the byte count is that of BiSS C, which void_i has cleared.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                                        register_q <= 1'b0;
    else if (register_start || control_begin || void_i) register_q <= register_start;
  end

  // A flop delays time_o by one clock. This keeps it out of the long paths that begin at the end of
  // a half period. The delay does no harm, because the start of a frame restarts the time base.
  assign time_d = waiting || refused_q || (active_o && live_i);

  // The frame of the last request, or the BiSS B access, could not start. The watchdog then counts
  // the time up to the next request. With FREQAGS = AGSMIN a BiSS B access asks in every clock.
  assign refused_d = !start_i && !clear_i && !void_i && !automatic_i &&
                     ((refused_i && (active_o || register_i)) || (refused_q && !control_end));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {time_q, refused_q, void_q, run_q} <= '0;
    else         {time_q, refused_q, void_q, run_q} <= {time_d, refused_d, void_i, run_o};
  end

  assign time_o = time_q;

  mb4_reg_watchdog u_watchdog (
    .clk_i,
    .rst_ni,
    .freqr_i,
    .watch_i   (time_d || register_wait),
    .clear_i   (moved || (start_i && refused_q)),
    .live_i    (live_i || register_wait || refused_q),
    .tick_i,
    .expired_o (expired),
    .stalled_o (counted)
  );

  assign stalled_o = counted && (!refused_q || refused_i);
  assign run_o     = active_o || register_active || register_start;
  assign stale_o   = (run_q && !control_runs && !register_active) || void_q;

  // Zeros within a control frame do not count. The stop bit is the first zero that counts.
  assign sent = (cdm_i & in_use_i) != 2'b00;

  biss_cdm_timeout u_cdm_timeout (
    .clk_i,
    .rst_ni,
    .frame_end_i,
    .cdm_i       (sent || in_body),
    .clear_i     (init_clear_i),
    .timeout_o   (cdm_timeout_o)
  );

  // ---- results ------------------------------------------------------------------------------

  // REGEND falls with the instruction. It does not wait for the frame of the access.
  assign reg_begin_o   = control_begin || register_want_i;
  assign reg_end_o     = control_end || register_end || void_q;
  assign reg_error_o   = void_q || (control_end ? control_error : register_error);
  assign delay_error_o = control_end ? control_delay : register_delay;
  // Not needed: begin_i and register_want_i tell the kind of access.
  assign unused        = access_i.regvers;
  assign good_bytes_o  = register_q ? register_bytes : control_bytes;

endmodule
