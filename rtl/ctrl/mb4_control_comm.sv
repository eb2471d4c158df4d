// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control communication: BiSS C control frames, BiSS B register access, CDM of every frame, limits
// (instances and glue only). Bit i of a vector {2, 1} belongs to line i + 1.
//
// Clock domain: core. Misuse and datasheet sections: see the modules.

module mb4_control_comm (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  mb4_pkg::cfg_t cfg_i,
  input  logic [2:0] instr_i,
  input  logic       ida_invert_i,
  input  logic [1:0] in_use_i,
  input  logic [1:0] ssi_i,
  output logic [1:0] select_o,         // lines that CHSEL selects
  // RDATA
  output logic       rdata_rd_en_o,
  output logic [5:0] rdata_addr_o,
  input  logic [7:0] rdata_i,
  output logic       rdata_wr_en_o,
  output logic [7:0] rdata_wr_data_o,
  // frames
  input  logic       begin_i,          // of a BiSS C control communication
  input  logic       register_want_i,  // INSTR asks for a BiSS B register access
  input  logic       abort_i,
  input  logic       clear_i,          // BREAK, INIT
  input  logic       init_clear_i,     // INIT begins
  input  logic       start_i,
  input  logic [1:0] use_i,            // lines that start_i is for
  input  logic       init_i,
  input  logic       register_i,       // start_i is for a BiSS B register access
  input  logic       frame_end_i,
  input  logic       live_i,           // frames run, or are bound to come
  input  logic       tick_i,
  input  logic [1:0] sl_i,
  input  logic [1:0] cds_i,
  input  logic [1:0] cdm_i,            // as sent
  output logic       active_o,
  output logic       time_o,           // the time base is needed between frames as well
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
  logic waiting, moved;
  logic control_begin, control_end, control_error, control_delay, in_body, expired, sent;
  logic register_start, register_active, register_wait, register_init, register_error;
  logic register_delay, register_end, register_mo;
  logic [1:0] control0, control1, register_use;
  logic       control_wr_en, register_wr_en;
  logic [5:0] control_addr, control_bytes, register_addr, register_bytes;
  logic [7:0] control_data, register_data;

  // ---- BiSS C -------------------------------------------------------------------------------

  mb4_control_frame u_frame (
    .clk_i,
    .rst_ni,
    .cts_i           (cfg_i.cts),
    .wnr_i           (cfg_i.wnr),
    .regadr_i        (cfg_i.regadr),
    .regnum_i        (cfg_i.regnum),
    .slaveid_i       (cfg_i.slaveid),
    .ida_invert_i,
    .select_i        (select_o),
    .blind_i         ((select_o & ssi_i) != 2'b00),
    .rdata_addr_o    (control_addr),
    .rdata_i,
    .rdata_wr_en_o   (control_wr_en),
    .rdata_wr_data_o (control_data),
    .begin_i,
    .abort_i         (clear_i),
    .start_i         (start_i && !init_i && !register_i),
    .frame_end_i,
    .cds_i           (cds_i & in_use_i),
    .cdm_timeout_i   (cdm_timeout_o),
    .expired_i       (expired),
    .stalled_i       (stalled_o),
    .active_o,
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

  mb4_biss_b u_biss_b (
    .clk_i,
    .rst_ni,
    .freqr_i         (cfg_i.freqr),
    .wnr_i           (cfg_i.wnr),
    .regadr_i        (cfg_i.regadr),
    .regnum_i        (cfg_i.regnum),
    .slaveid_i       (cfg_i.slaveid),
    .mo_i            (cfg_i.en_mo),
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
  assign rdata_rd_en_o   = active_o || register_active;
  assign rdata_addr_o    = register_active ? register_addr : control_addr;
  assign rdata_wr_en_o   = control_wr_en || register_wr_en;
  assign rdata_wr_data_o = register_active ? register_data : control_data;

  mb4_cdm_select u_cdm (
    .chsel_i    (cfg_i.chsel),
    .cts_i      (cfg_i.cts),
    .instr_i,
    .active_i   (active_o),
    .control0_i (control0),
    .control1_i (control1),
    .select_o,
    .cdm0_o,
    .cdm1_o
  );

  // A clock late: much hangs on the end of a half period, and a frame begins the time anew.
  assign time_d = waiting || (active_o && live_i);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) time_q <= 1'b0;
    else         time_q <= time_d;
  end

  assign time_o = time_q;

  mb4_reg_watchdog u_watchdog (
    .clk_i,
    .rst_ni,
    .freqr_i   (cfg_i.freqr),
    .watch_i   (time_d || register_wait),
    .clear_i   (moved),
    .live_i    (live_i || register_wait),
    .tick_i,
    .expired_o (expired),
    .stalled_o
  );

  // Zeros inside a control frame do not count; its stop bit is the first that does.
  assign sent = (cdm_i & in_use_i) != 2'b00;

  mb4_cdm_timeout u_cdm_timeout (
    .clk_i,
    .rst_ni,
    .frame_end_i,
    .cdm_i       (sent || in_body),
    .clear_i     (init_clear_i),
    .timeout_o   (cdm_timeout_o)
  );

  // ---- results ------------------------------------------------------------------------------

  // REGEND falls with the instruction, not first with the frame that has its turn.
  assign reg_begin_o   = control_begin || register_want_i;
  assign reg_end_o     = control_end || register_end;
  assign reg_error_o   = control_end ? control_error : register_error;
  assign delay_error_o = control_end ? control_delay : register_delay;
  assign good_bytes_o  = cfg_i.regvers ? control_bytes : register_bytes;

endmodule
