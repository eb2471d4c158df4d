// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Core half of the instruction register 0xF4, and the order of events: it decides which frame runs
// when, and when an instruction clears itself.
//
// Clock domain: core.
// Latency: a written byte arrives 2..3 clocks after its last bit. The frame that it asks for starts
// one clock later at the earliest. busy rises before instr_o.ack tells the host half. A frame ends
// two clocks after its last bit (frame_end). Its result comes one clock before this end, and the
// banks switch one clock after it (mb4_bank_ctrl).
//
// - With AGS = 1 INSTR sets the CDM of the automatic frames (mb4_frame_request) and stays. Only
//   with FREQAGS = AGSINFINITE it also asks for a frame.
// - A BiSS B register access (go_o.register_access) takes the place of a frame. INIT of BiSS B is
//   only the hand-over of such an access.
// - INIT waits for the slaves' timeout of the frame before it, but not without limit (WAIT).
// - A BREAK that cuts something, and a reset, leave slaves that may still be in a frame, where SL
//   tells nothing. INIT then waits until MA has rested and SL has been 1 on the lines in use for
//   1024 clocks, or for 2048 clocks in which they did not rest (decision 46). An INIT that drives
//   no line does not wait.
//
// Misuse and errors:
//
// - SL is low when a frame is due: no frame, nAGSERR = 0. With FREQAGS = AGSMIN the frame waits for
//   SL = 1 instead (decision 3).
// - A frame is due while HOLDBANK holds back a switch: the frame runs into the other bank and the
//   switch is lost (mb4_bank_ctrl). With QUIRK_AGSERR_ON_HOLDBANK there is no frame,
//   SWBANKFAIL = 1 and nAGSERR = 0 (decision 15).
// - A control communication that cannot run ends at once (decision 37). A core without BissB ends
//   INIT with REGVERS = 0 at once too. A BiSS B access that waits for its automatic frame ends too
//   when its lines or REGVERS are changed.
// - A BiSS B access without AGS cannot begin while SL is low: the first request after the limit of
//   the watchdog ends it (decision 42). A BiSS C access begins even while SL is low;
//   biss_control_frame ends it.
// - INSTR written with the code whose frame runs does not ask for another frame.
//
// Datasheet: pages 31..33, Tables 44..49; decisions 1, 3, 8, 14, 15, 19, 23, 25, 26, 37, 42, 46.

`include "enc_check.svh"

module mb4_sequencer #(
  parameter bit BissB = 1'b1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  // instruction register, host half
  input  mb4_pkg::instr_host_t instr_i,
  output mb4_pkg::instr_core_t instr_o,
  // configuration
  input  logic       regvers_i,
  input  mb4_pkg::kind_t kind_i,
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i,
  // automatic frames
  input  mb4_pkg::request_t request_i,
  input  logic       missed_i,
  output logic       taken_o,
  output logic       lines_idle_o,
  output logic       running_o,
  output logic       break_o,
  // lines, {2, 1} each
  output biss_pkg::line_go_t go_o,
  output logic [1:0] start_use_o,     // lines that go_o.start is for
  input  logic       tick_i,
  input  logic [2*biss_pkg::LINE_STATUS_W-1:0] status_i,
  input  logic [2*biss_pkg::LINE_EVENT_W-1:0]  event_i,
  input  logic [1:0] word_bad_i,      // a word ends that is not valid
  // banks
  input  mb4_pkg::mem_state_t mem_i,
  output mb4_pkg::bank_cmd_t bank_o,
  output logic       frame_done_o,    // a frame ends; also 1 if BREAK comes in this clock
  // status
  output mb4_pkg::frame_flags_t flags_o,
  output logic       init_clear_o,    // INIT begins
  // control communication
  output logic       control_begin_o, // INSTR asks for BiSS C; stays until a frame takes it
  output logic       register_begin_o, // INSTR asks for BiSS B, or for what cannot run
  output logic       void_o,          // INSTR asks for what cannot run or begin, and ends
  output logic       refused_o,       // SL is low: no frame for INSTR
  input  logic       control_active_i,
  input  logic       control_start_i, // ..., if a frame starts in this clock
  input  logic       control_end_i,
  input  logic       control_stalled_i, // because no frame ends
  input  logic       stale_i          // kind_i still has the settings of an access that has ended
);

  typedef enum logic [2:0] {IDLE, FRAME, FRAME_DONE, INIT, INIT_TIMEOUT} state_e;

  state_e           state_d, state_q;
  mb4_pkg::instr_t  held_d, held_q;
  logic             new_d, new_q;  // INSTR was written, its frame has not started
  logic [1:0]       use_d, use_q, done_d, done_q;
  logic             bad_d, bad_q;
  logic             reduced_d, reduced_q;  // the running frame ends after CDS
  logic             cut_d, cut_q;  // slaves may be in a frame that has been cut
  logic [11:0]      wait_d, wait_q;  // half MA periods left for the return of SL; clocks if cut_q
  logic             written;
  mb4_pkg::instr_t  asked;         // the byte of the host
  biss_pkg::line_status_t status1, status2;
  biss_pkg::line_event_t  event1, event2;
  logic [1:0]       ack, idle, line_end, init_done, init_fail;
  logic             held_back, may_run;  // a frame is held back by HOLDBANK, may run
  logic             start, init, register_access, abort;
  logic             frame_end, swap, all_idle, sl_low, sl_high, rests, waited;
  logic             returned, runs;        // INIT's timeout is over; a frame or INIT goes on
  logic             scd_en, ags_error, bank_fail;
  logic             by_instr, begins;  // INSTR asks for a frame, for a control communication
  logic             register_d, register_q;  // a BiSS B register access runs, not a frame
  logic             awaits_d, awaits_q;      // one waits for its automatic frame

  // INIT does not test SL (page 33), but the slaves need their timeout before and after it. So SL
  // has 1024 MA periods to return to 1. The longest timeout in the field has 400 (40 us, 10 MHz).
  localparam logic [11:0] WAIT = 12'hFFF;  // with cut_q bit 11 is a flag: 0 = lines rest

  // ---- inputs -----------------------------------------------------------------------------------

  // ack comes two clocks after new_q. REGEND has fallen by then: a host that sees ack does not read
  // the REGEND of the access before.
  enc_count_rx u_written (
    .clk_i, .rst_ni, .count_i (instr_i.count), .pulse_o (written), .ack_o (ack)
  );

  assign status1 = status_i[0 +: biss_pkg::LINE_STATUS_W];
  assign status2 = status_i[biss_pkg::LINE_STATUS_W +: biss_pkg::LINE_STATUS_W];
  assign event1 = event_i[0 +: biss_pkg::LINE_EVENT_W];
  assign event2 = event_i[biss_pkg::LINE_EVENT_W +: biss_pkg::LINE_EVENT_W];
  assign asked     = instr_i.written;
  assign idle      = {status2.idle, status1.idle};
  assign line_end  = {event2.line_end, event1.line_end};
  assign init_done = {event2.init_done, event1.init_done};
  assign init_fail = {event2.init_fail, event1.init_fail};

  assign all_idle = idle == 2'b11;   // also lines out of use: they share the time base
  assign sl_low   = (kind_i.in_use & (idle | {status2.timeout, status1.timeout}) &
                     ~{status2.sl, status1.sl}) != 2'b00;
  assign sl_high  = (kind_i.in_use & ~{status2.sl, status1.sl}) == 2'b00;
  assign rests    = all_idle && sl_high;
  assign waited   = wait_q[10:0] == 11'd0;
  assign by_instr = new_q && kind_i.is_frame && kind_i.in_use != 2'b00 &&
                    (!held_q.ags || request_i.infinite);
  assign begins   = new_q && kind_i.in_use != 2'b00 && !held_q.init && state_q != INIT_TIMEOUT;
  assign control_begin_o  = begins && kind_i.is_control && state_q != INIT && !stale_i;
  // A new instruction clears REGEND at once. After a stall held_q is still the old instruction, so
  // control_stalled_i excludes it.
  assign register_begin_o = (begins && (kind_i.is_register ||
                                        (kind_i.is_control && stale_i && !control_stalled_i))) ||
                            (new_q && kind_i.is_void && !void_o);
  assign register_access  = BissB && (init ? !regvers_i : kind_i.is_register);
  assign register_d  = start ? register_access : register_q;
  assign start_use_o = init ? kind_i.init_use : kind_i.frame_use;
  assign reduced_d   = start ? control_start_i &&
                                 held_q.instr == mb4_regs_pkg::INSTR_CONTROL_REDUCED
                               : reduced_q;
  // With AGS = 1 new_q falls in IDLE, so awaits_q remembers the request.
  assign awaits_d    = (new_q ? kind_i.is_register && held_q.ags && !stale_i : awaits_q) &&
                       !(written || start || void_o);

  assign held_back   = mem_i.pending && held_q.holdbank && !kind_i.is_register &&
                       quirks_i[mb4_pkg::QUIRK_AGSERR_ON_HOLDBANK];
  assign may_run     = !mem_i.clears && kind_i.in_use != 2'b00 &&
                       !(stale_i && held_q.instr != 3'b000);

  // ---- start of a frame or of INIT ------------------------------------------------------------

  // The cases below decide the same (StartAsDecided_A). start and init stand apart, because all
  // lines wait for them late in the clock: of the lines they take all_idle and SL, nothing else.
  // While all lines are idle each request by GETSENS is due, so request_i.asks stands for
  // request_i.due here; and a line in use whose SL is low lets no frame begin.
  assign init        = all_idle && state_q == IDLE && held_q.init && !cut_q &&
                       kind_i.init_use != 2'b00 && (BissB || regvers_i);
  assign start       = all_idle && state_q == IDLE && !(written && asked.brk) &&
                       (held_q.init
                            ? !cut_q && kind_i.init_use != 2'b00 && (BissB || regvers_i)
                            : may_run && (by_instr || request_i.asks) && !held_back && sl_high);

  // ---- states -----------------------------------------------------------------------------------

  always_comb begin
    state_d      = state_q;
    held_d       = held_q;
    new_d        = new_q && (by_instr || state_q != IDLE || held_q.init || stale_i);
    use_d        = use_q;
    done_d       = done_q;
    bad_d        = bad_q;
    wait_d       = ((tick_i || cut_q) && !waited) ? wait_q - 12'd1 : wait_q;
    cut_d        = cut_q;
    abort        = 1'b0;
    swap         = 1'b0;
    init_clear_o = 1'b0;
    scd_en       = 1'b0;
    ags_error    = 1'b0;
    bank_fail    = 1'b0;
    taken_o      = 1'b0;
    break_o      = 1'b0;
    void_o       = 1'b0;
    refused_o    = 1'b0;

    unique case (state_q)
      IDLE: begin
        // The host sees EOT = 1, unless a request waits. An INSTR that asks for no frame ends here;
        // it does not delay an automatic frame.
        if (new_q && !new_d && (!kind_i.is_frame || !held_q.ags)) begin
          held_d.instr = 3'b000;
          void_o       = kind_i.is_void;
        end else if (awaits_q && !kind_i.is_register) begin
          held_d.instr = 3'b000;
          void_o       = 1'b1;
        end
        if (cut_q && wait_q[11] == rests) wait_d = {!rests, !rests, 10'h3FF};
        else if (waited)                  cut_d  = 1'b0;
        if (held_q.init) begin
          if (kind_i.init_use == 2'b00 || (!BissB && !regvers_i)) begin
            held_d.init  = 1'b0;
            init_clear_o = 1'b1;
            if (!BissB && !regvers_i) void_o = 1'b1;
          end else if (cut_q) begin  // what has been cut comes to rest first
          end else if (all_idle) begin
            init_clear_o = 1'b1;
            use_d        = kind_i.init_use;
            done_d       = ~kind_i.init_use;
            state_d      = INIT;
          end else if (waited) begin
            abort = 1'b1;
          end
        end else if ((by_instr || request_i.due) && may_run) begin
          if (held_back) begin
            taken_o   = 1'b1;
            ags_error = 1'b1;
            bank_fail = 1'b1;
          end else if (sl_low) begin
            taken_o   = !request_i.agsmin;
            ags_error = !request_i.agsmin;
            refused_o = by_instr && (!request_i.agsmin || kind_i.is_register);
            // Requests for an access that has not begun have been refused for too long.
            if (control_stalled_i && !control_active_i && !control_end_i && held_q.instr[2]) begin
              held_d.instr = 3'b000;
              void_o       = 1'b1;
            end
          end else if (all_idle) begin
            taken_o = 1'b1;
            use_d   = kind_i.frame_use;
            done_d  = ~kind_i.frame_use;
            bad_d   = 1'b0;
            state_d = FRAME;
          end
          if (taken_o) new_d = 1'b0;
          if (ags_error && !held_q.ags) held_d.instr = 3'b000;
        end
      end
      FRAME: begin
        // A frame or a register access runs. It ends when the last of its lines has ended.
        bad_d  = bad_q || word_bad_i != 2'b00;
        done_d = done_q | line_end;
        wait_d = WAIT;
        if (done_d == 2'b11) begin
          state_d = FRAME_DONE;
          scd_en  = !reduced_q && !register_q;
        end
      end
      FRAME_DONE: begin
        // All lines have brought their last bit. The banks switch in the next clock.
        state_d   = IDLE;
        wait_d    = WAIT;
        if (!held_q.ags && !new_q) held_d.instr = 3'b000;
      end
      INIT: begin
        // INIT runs: MA makes its two pulses and the line delay is measured (BiSS C), or MA does
        // the hand-over (BiSS B).
        done_d    = done_q | init_done | init_fail | line_end;
        ags_error = (init_fail & use_q) != 2'b00;
        wait_d    = WAIT;
        if (done_d == 2'b11) state_d = INIT_TIMEOUT;
      end
      INIT_TIMEOUT: begin
        // The slaves are in their timeout. The host still reads INIT = 1.
        if (returned) begin
          state_d     = IDLE;
          held_d.init = 1'b0;
        end
      end
      default: state_d = IDLE;
    endcase
    // With AGS = 1 the instruction ends with the control communication.
    if (control_end_i && held_q.instr[2] && (!new_q || control_stalled_i)) begin
      held_d.instr = 3'b000;
    end
    if (missed_i) ags_error = 1'b1;
    if (ags_error && quirks_i[mb4_pkg::QUIRK_AGS_CLEARED_ON_ERROR]) held_d.ags = 1'b0;

    if (written) begin
      // INSTR written with the code whose frame runs is no new request. A frame runs from the clock
      // of start to the last clock of FRAME. A write does not cancel an INIT; automatic frames wait
      // until the INIT has ended.
      new_d = asked.instr != 3'b000 &&
              (new_d || !(state_q == FRAME || (start && !init)) || asked.instr != held_q.instr);
      held_d.holdbank = asked.holdbank;
      held_d.swbank   = asked.swbank;
      held_d.ags      = asked.ags;
      held_d.instr    = asked.instr;
      held_d.init     = asked.init || held_d.init;
      swap            = asked.swbank != held_q.swbank;
      if (asked.brk) begin
        abort       = 1'b1;
        break_o     = 1'b1;
        scd_en      = 1'b0;
        state_d     = IDLE;
        new_d       = asked.instr != 3'b000;
        held_d.init = asked.init;
        ags_error   = 1'b0;
        if (state_q != IDLE || !all_idle || control_active_i) cut_d = 1'b1;
      end
      if (quirks_i[mb4_pkg::QUIRK_AGSERR_ON_INSTR_WR]) ags_error = 1'b1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q    <= IDLE;
      held_q     <= '0;
      new_q      <= 1'b0;
      use_q      <= 2'b00;
      done_q     <= 2'b00;
      bad_q      <= 1'b0;
      reduced_q  <= 1'b0;
      register_q <= 1'b0;
      awaits_q   <= 1'b0;
      cut_q      <= 1'b1;
      wait_q     <= WAIT;
    end else begin
      state_q    <= state_d;
      held_q     <= held_d;
      new_q      <= new_d;
      use_q      <= use_d;
      done_q     <= done_d;
      bad_q      <= bad_d;
      reduced_q  <= reduced_d;
      register_q <= register_d;
      awaits_q   <= awaits_d;
      cut_q      <= cut_d;
      wait_q     <= wait_d;
    end
  end

  // ---- outputs ------------------------------------------------------------------------------

  assign instr_o.ack  = ack;
  assign instr_o.held = held_q;

  assign running_o    = state_q != IDLE;
  assign lines_idle_o = all_idle;
  assign frame_done_o = state_q == FRAME_DONE && !register_q;
  assign frame_end    = frame_done_o && !(written && asked.brk);

  assign go_o.start           = start;
  assign go_o.init            = init;
  assign go_o.register_access = register_access;
  assign go_o.reduced         = reduced_d;
  // Slaves that pass MO on do not show their timeout on SL. So MO stays low for half of WAIT, which
  // covers the timeout. In the other half SL follows MO (decision 39).
  assign go_o.mo_return       = state_q == INIT_TIMEOUT && !wait_q[10];
  assign go_o.stop            = abort;

  assign bank_o.run       = state_q == FRAME && !reduced_q && !register_q;
  assign bank_o.frame_end = frame_end;
  assign bank_o.data_end  = frame_end && !reduced_q;
  assign bank_o.reduced   = reduced_q;
  assign bank_o.swap      = swap;
  assign bank_o.clear     = init && regvers_i;

  assign flags_o.busy      = runs || (new_d && (!held_d.ags || request_i.infinite)) || held_d.init;
  assign flags_o.clear     = init_clear_o || break_o;
  assign flags_o.scd_en    = scd_en;
  assign flags_o.scd_bad   = bad_d;
  assign flags_o.ags_error = ags_error;
  assign flags_o.bank_fail = bank_fail;

  // runs has the value of state_d != IDLE, computed without the last bit of a frame and without SL,
  // which come late in the clock: the last bit leads to FRAME_DONE, not to IDLE, and SL only delays
  // a start.
  assign returned = (use_q & ~idle) == 2'b00 || waited;
  assign runs     = start || (!(written && asked.brk) &&
                              (state_q == FRAME || state_q == INIT ||
                               (state_q == INIT_TIMEOUT && !returned)));

  `ENC_ASSERT(BreakIsNotKept_A, clk_i, rst_ni, !held_q.brk)
  `ENC_ASSERT_IF(StartAsDecided_A, clk_i, rst_ni, !(written && asked.brk),
                 start == (init || (taken_o && state_d == FRAME && state_q == IDLE)))
  `ENC_ASSERT(RunsAsDecided_A, clk_i, rst_ni, runs == (state_d != IDLE))
  `ENC_ASSERT_IF(StartOnIdleLines_A, clk_i, rst_ni, start, all_idle)

endmodule
