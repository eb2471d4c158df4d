// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control communication: BiSS C control frames, BiSS B register access, the CDM bit of every frame,
// and the time limits. It also keeps the configuration of an access while the access runs, and
// tells what INSTR asks for with this configuration (kind_o).
//
// Features may leave out BiSS B, and both kinds of access (Control). The CDM bit by INSTR and its
// time limit stay, and so does INIT of BiSS B.
//
// Clock domain: core. Latency, misuse and datasheet sections: see the modules.
// Vectors: bit i of a vector {2, 1} is for line i + 1.

module mb4_control_comm #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  mb4_pkg::cfg_t cfg_i,
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i,
  input  logic [3:0] protocol_i,       // codes of lines {2, 1}
  input  logic [2:0] instr_i,
  output mb4_pkg::kind_t kind_o,
  // RDATA
  output mb4_pkg::rdata_cmd_t rdata_o,
  input  logic [7:0] rdata_i,
  input  logic       post_busy_i,
  // frames
  input  logic       begin_i,          // a BiSS C control communication begins
  input  logic       register_want_i,  // INSTR asks for BiSS B, or for what cannot run
  input  logic       void_i,           // an access that cannot run or begin ends
  input  logic       refused_i,        // SL is low: no frame for INSTR
  input  logic       clear_i,          // BREAK, INIT
  input  logic       init_clear_i,     // INIT begins
  input  biss_pkg::line_go_t go_i,
  input  logic [1:0] start_use_i,      // lines that go_i.start is for
  input  logic       frame_done_i,     // a frame ends, unless clear_i comes with its end
  input  logic       live_i,           // frames run, or will come by themselves
  input  logic       automatic_i,      // no frame depends on INSTR
  input  logic       tick_i,
  input  logic [2*biss_pkg::LINE_STATUS_W-1:0] status_i,
  output logic       active_o,
  output logic       active_start_o,   // active_o, if a frame starts in this clock
  output logic       stale_o,          // kind_o is still that of an access which has ended
  output logic       time_o,           // the time base must run between frames too
  output logic       stalled_o,        // no frame has ended for too long
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o,
  // BiSS B register access
  output biss_pkg::register_ma_t register_ma_o,
  output logic [1:0] register_mo_o,    // MO is low
  // results
  output mb4_pkg::access_event_t event_o,
  output mb4_pkg::access_state_t state_o,
  output logic       ags_error_o
);

  localparam bit BISS_B  = Features[mb4_pkg::BISS_B_LSB];
  localparam bit MO      = Features[mb4_pkg::MO_LSB];
  localparam bit CONTROL = Features[mb4_pkg::CONTROL_LSB];

  logic       time_d, time_q;
  logic       refused_d, refused_q;    // SL was low: no frame since the last request
  logic       counted;                 // the watchdog's limit has been reached
  logic       void_q;                  // void_i one clock late, as all ends come
  logic       register_q;              // the results are those of BiSS B
  logic       unused;
  logic waiting, moved, control_runs;
  logic run, run_q;                    // an access runs or begins
  logic control_begin, in_body, expired, sent, cdm_timeout;
  logic register_start, register_active, register_wait;
  logic [1:0] control0, control1;
  mb4_pkg::access_t       access_q;    // constant while an access runs
  biss_pkg::access_t      access;
  biss_pkg::access_byte_t control_byte, register_byte, rdata;
  mb4_pkg::mem_wr_t       rdata_wr_q;
  mb4_pkg::mem_rd_t       rdata_rd;
  biss_pkg::access_end_t  control_end, register_end;
  biss_pkg::line_status_t status1, status2;

  assign status1 = status_i[0 +: biss_pkg::LINE_STATUS_W];
  assign status2 = status_i[biss_pkg::LINE_STATUS_W +: biss_pkg::LINE_STATUS_W];

  // The host may configure the next access while one runs (decision 38). Its settings are here two
  // clocks after the end. In the clock between, the sequencer waits (stale_o).
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)   access_q <= '0;
    else if (!run) access_q <= cfg_i.access;
  end

  assign access.cts       = access_q.cts;
  assign access.write     = access_q.wnr;
  assign access.addr      = access_q.regadr;
  assign access.byte_last = access_q.regnum;
  assign access.id        = access_q.slaveid;

  mb4_frame_kind #(.Control(CONTROL)) u_kind (
    .instr_i,
    .access_i    (access_q),
    .protocol_i,
    .kind_o
  );

  // ---- BiSS C -------------------------------------------------------------------------------

  if (CONTROL) begin : gen_control
    biss_control_frame u_frame (
      .clk_i,
      .rst_ni,
      .access_i      (access),
      .ida_invert_i  (quirks_i[mb4_pkg::QUIRK_IDA_TEST_INVERT]),
      .select_i      (kind_o.select),
      .blind_i       ((kind_o.select & kind_o.ssi) != 2'b00),
      .byte_o        (control_byte),
      .rdata_i,
      .post_busy_i,
      .begin_i,
      .abort_i       (clear_i || void_q),
      .start_i       (go_i.start && !go_i.init && !go_i.register_access),
      .frame_done_i,
      .cds_i         ({status2.cds, status1.cds} & kind_o.in_use),
      .cdm_timeout_i (cdm_timeout),
      .expired_i     (expired),
      .stalled_i     (stalled_o),
      .stalled_start_i (counted && !refused_q),
      .active_o,
      .active_start_o,
      .running_o     (control_runs),
      .in_body_o     (in_body),
      .wait_o        (waiting),
      .moved_o       (moved),
      .cdm0_o        (control0),
      .cdm1_o        (control1),
      .begin_o       (control_begin),
      .end_o         (control_end)
    );
  end else begin : gen_no_control
    assign control_byte = '0;
    assign control_end  = '0;
    assign {active_o, active_start_o, control_runs, in_body, waiting, moved, control_begin} = '0;
    assign {control0, control1} = '0;
  end

  // ---- BiSS B register access ---------------------------------------------------------------

  assign register_start = go_i.start && go_i.register_access;

  if (BISS_B) begin : gen_biss_b
    biss_b_access u_biss_b (
      .clk_i,
      .rst_ni,
      .cell_shift_i (cfg_i.freqr),
      .access_i  (access),
      .mo_i      (MO && cfg_i.en_mo),
      .start_i   (register_start),
      .start_use_i,
      .init_i    (go_i.init),
      .abort_i   (go_i.stop),
      .tick_i,
      .expired_i (expired),
      .wait_o    (register_wait),
      .active_o  (register_active),
      .sl_i      ({status2.sl, status1.sl}),
      .ma_o      (register_ma_o),
      .mo_low_o  (register_mo_o),
      .byte_o    (register_byte),
      .rdata_i,
      .ags_error_o,
      .end_o     (register_end)
    );
  end else begin : gen_no_biss_b
    assign register_byte = '0;
    assign register_end  = '0;
    assign register_ma_o = '0;
    assign register_mo_o = '0;
    assign {register_active, register_wait, ags_error_o} = '0;
  end

  // A byte is written one clock later. This keeps the memory, and the queue of the host's writes,
  // out of the long paths. The end of an access reaches the flags no earlier.
  assign rdata   = register_active ? register_byte : control_byte;
  assign rdata_rd.en   = active_o || register_active;
  assign rdata_rd.addr = rdata.addr;
  assign rdata_o.wr    = rdata_wr_q;
  assign rdata_o.rd    = rdata_rd;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rdata_wr_q <= '0;
    end else begin
      rdata_wr_q.en   <= control_byte.wr_en || register_byte.wr_en;
      rdata_wr_q.addr <= rdata.addr;
      rdata_wr_q.data <= rdata.wr_data;
    end
  end

  mb4_cdm_select u_cdm (
    .manual_i   (kind_o.manual),
    .instr_i,
    .active_i   (active_start_o),
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
  assign refused_d = !go_i.start && !clear_i && !void_i && !automatic_i &&
                     ((refused_i && (active_o || go_i.register_access)) ||
                      (refused_q && !control_end.ends));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {time_q, refused_q, void_q, run_q} <= '0;
    else         {time_q, refused_q, void_q, run_q} <= {time_d, refused_d, void_i, run};
  end

  assign time_o = time_q;

  if (CONTROL || BISS_B) begin : gen_watchdog
    mb4_reg_watchdog u_watchdog (
      .clk_i,
      .rst_ni,
      .freqr_i   (cfg_i.freqr),
      .watch_i   (time_d || register_wait),
      .clear_i   (moved || (go_i.start && refused_q)),
      .live_i    (live_i || register_wait || refused_q),
      .tick_i,
      .expired_o (expired),
      .stalled_o (counted)
    );
  end else begin : gen_no_watchdog
    assign {expired, counted} = '0;
  end

  assign stalled_o = counted && (!refused_q || refused_i);
  assign run       = active_o || register_active || register_start;
  assign stale_o   = (run_q && !control_runs && !register_active) || void_q;

  // Zeros within a control frame do not count. The stop bit is the first zero that counts.
  assign sent = ({status2.cdm, status1.cdm} & kind_o.in_use) != 2'b00;

  biss_cdm_timeout u_cdm_timeout (
    .clk_i,
    .rst_ni,
    .frame_done_i (frame_done_i && !clear_i),
    .cdm_i        (sent || in_body),
    .clear_i      (init_clear_i),
    .timeout_o    (cdm_timeout)
  );

  // ---- results ------------------------------------------------------------------------------

  // REGEND falls with the instruction. It does not wait for the frame of the access.
  assign event_o.begins      = control_begin || register_want_i;
  assign event_o.ends        = control_end.ends || register_end.ends || void_q;
  assign event_o.reg_error   = void_q || (control_end.ends ?
                               control_end.reg_error : register_end.reg_error);
  assign event_o.delay_error = control_end.ends ?
                               control_end.delay_error : register_end.delay_error;
  assign state_o.cdm_timeout = cdm_timeout;
  assign state_o.good_bytes  = register_q ? register_end.good_bytes : control_end.good_bytes;
  // Only modules that Features can leave out use the other signals.
  assign unused  = ^{rdata.wr_en, access, quirks_i, rdata_i, post_busy_i, begin_i, start_use_i,
                     tick_i, moved, expired, register_wait, cfg_i.freqr};

endmodule
