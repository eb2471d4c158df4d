// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Instruction register 0xF4, core half, and the order of events: which frame runs when, what it does
// to the flags, when the instruction clears itself.
//
// Clock domain: core. A written byte arrives 2..3 clocks after its last bit; the frame it asks for
// starts with the next clock at the earliest. EOT falls one clock before ack_o tells the host half.
// In this version frames are started by INSTR = 001, 010 and 011 (with AGS = 0 or 1) and INIT runs
// with REGVERS = 1; the AGS timer and control communication are not there yet: other INSTR codes
// clear themselves without a frame, AGS is kept and read back.
// Misuse: SL low when a frame is due: no frame, nAGSERR = 0, or with FREQAGS = AGSMIN waiting for
// SL = 1 (decision 3). A frame due while a bank switch is held back: no frame, SWBANKFAIL = 1,
// nAGSERR = 0 (decision 15).
// Datasheet: pages 31..35, Tables 44..49, 54..62; decisions 1, 3, 8, 9, 15, 19, 25, 26.

`include "mb4_check.svh"

module mb4_sequencer (
  input  logic       clk_i,
  input  logic       rst_ni,
  // instruction register, host half
  input  mb4_pkg::instr_t written_i,
  input  logic       toggle_i,
  output logic       ack_o,
  output mb4_pkg::instr_t held_o,
  // configuration
  input  logic       mem_busy_i,
  input  logic       agsmin_i,
  input  logic       regvers_i,
  input  logic [1:0] use_i,           // lines in use: {2, 1}
  input  logic       agserr_on_hold_i,
  input  logic       agserr_on_write_i,
  // lines, {2, 1} each
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
  // banks
  input  logic       bank_pending_i,
  input  logic       bank_swapped_i,
  output logic       bank_end_o,      // a frame is complete
  output logic       holdbank_o,
  output logic       swbank_pulse_o,
  // flags
  output logic       eot_o,
  output logic       n_scderr_o,
  output logic       n_agserr_o,
  output logic       swbank_fail_o
);

  typedef enum logic [1:0] {
    IDLE,
    FRAME,
    INIT,
    INIT_TIMEOUT
  } state_e;

  state_e           state_d;
  state_e           state_q;
  mb4_pkg::instr_t  held_d;
  mb4_pkg::instr_t  held_q;
  logic             new_d;
  logic             new_q;         // INSTR was written and has not started yet
  logic [1:0]       use_d;
  logic [1:0]       use_q;
  logic [1:0]       done_d;
  logic [1:0]       done_q;
  logic             bad_d;
  logic             bad_q;
  logic             eot_d;
  logic             eot_q;
  logic             n_scderr_d;
  logic             n_scderr_q;
  logic             n_agserr_d;
  logic             n_agserr_q;
  logic             fail_d;
  logic             fail_q;
  logic             ack_q;
  logic [10:0]      wait_d;
  logic [10:0]      wait_q;        // half MA periods left for SL to return after INIT
  logic             written;
  logic             toggle_level;
  logic             all_idle;
  logic             sl_low;
  logic             is_frame;
  logic             word_bad;
  logic             clear_flags;

  // The slaves' longest timeout in the field is 40 us, 400 periods at 10 MHz.
  localparam logic [10:0] INIT_WAIT = 11'h7FF;

  mb4_toggle_rx u_written (
    .clk_i,
    .rst_ni,
    .toggle_i,
    .pulse_o (written),
    .level_o (toggle_level)
  );

  assign all_idle = (use_i & ~idle_i) == 2'b00;
  assign sl_low   = (use_i & (idle_i | timeout_i) & ~sl_i) != 2'b00;
  assign is_frame = held_q.instr == mb4_regs_pkg::INSTR_CDM1 ||
                    held_q.instr == mb4_regs_pkg::INSTR_CDM0 ||
                    held_q.instr == mb4_regs_pkg::INSTR_CDM_NOT_CDSSEL;
  assign word_bad = (word_done_i & ~word_ok_i) != 2'b00;

  always_comb begin
    unique case (held_q.instr)
      mb4_regs_pkg::INSTR_CDM1:           cdm_o = 1'b1;
      mb4_regs_pkg::INSTR_CDM_NOT_CDSSEL: cdm_o = !cdssel_i;
      default:                            cdm_o = 1'b0;
    endcase
  end

  always_comb begin
    state_d        = state_q;
    held_d         = held_q;
    new_d          = new_q;
    use_d          = use_q;
    done_d         = done_q;
    bad_d          = bad_q;
    n_scderr_d     = n_scderr_q;
    n_agserr_d     = n_agserr_q;
    fail_d         = fail_q && !bank_swapped_i;
    wait_d         = wait_q;
    start_o        = 1'b0;
    init_o         = 1'b0;
    abort_o        = 1'b0;
    bank_end_o     = 1'b0;
    swbank_pulse_o = 1'b0;
    clear_flags    = 1'b0;

    unique case (state_q)
      IDLE: begin
        if (held_q.init && !mem_busy_i) begin
          // INIT does not look at SL; a line still waiting for it is released first.
          if (!regvers_i || use_i == 2'b00) begin
            held_d.init = 1'b0;
            clear_flags = 1'b1;
          end else if (all_idle) begin
            start_o     = 1'b1;
            init_o      = 1'b1;
            clear_flags = 1'b1;
            use_d       = use_i;
            done_d      = ~use_i;
            state_d     = INIT;
          end else begin
            abort_o = 1'b1;
          end
        end else if (new_q && !mem_busy_i) begin
          if (!is_frame || use_i == 2'b00) begin
            new_d        = 1'b0;
            held_d.instr = 3'b000;
          end else if (bank_pending_i && agserr_on_hold_i) begin
            new_d        = 1'b0;
            held_d.instr = 3'b000;
            n_agserr_d   = 1'b0;
            fail_d       = 1'b1;
          end else if (sl_low && !agsmin_i) begin
            new_d        = 1'b0;
            held_d.instr = 3'b000;
            n_agserr_d   = 1'b0;
          end else if (all_idle && !sl_low) begin
            start_o = 1'b1;
            new_d   = 1'b0;
            use_d   = use_i;
            done_d  = ~use_i;
            bad_d   = 1'b0;
            state_d = FRAME;
          end
        end
      end
      FRAME: begin
        bad_d  = bad_q || word_bad;
        done_d = done_q | frame_end_i;
        if (done_d == 2'b11) begin
          // Lines of different length end one frame together.
          state_d    = IDLE;
          bank_end_o = 1'b1;
          n_scderr_d = !bad_d;
          if (!held_q.ags && !new_q) held_d.instr = 3'b000;
        end
      end
      INIT: begin
        done_d = done_q | init_done_i | init_fail_i;
        if ((init_fail_i & use_q) != 2'b00) n_agserr_d = 1'b0;
        wait_d = INIT_WAIT;
        if (done_d == 2'b11) state_d = INIT_TIMEOUT;
      end
      INIT_TIMEOUT: begin
        // Ends with the slaves' timeout, or without it if SL stays low.
        if (tick_i) wait_d = wait_q - 11'd1;
        if ((use_q & ~idle_i) == 2'b00 || wait_q == 11'd0) begin
          state_d     = IDLE;
          held_d.init = 1'b0;
        end
      end
      default: state_d = IDLE;
    endcase

    if (written) begin
      held_d.holdbank = written_i.holdbank;
      held_d.swbank   = written_i.swbank;
      held_d.ags      = written_i.ags;
      held_d.instr    = written_i.instr;
      held_d.init     = written_i.init || (held_q.init && state_q != IDLE);
      swbank_pulse_o  = written_i.swbank != held_q.swbank;
      new_d           = written_i.instr != 3'b000;
      if (agserr_on_write_i) n_agserr_d = 1'b0;
      if (written_i.brk) begin
        abort_o     = 1'b1;
        start_o     = 1'b0;
        state_d     = IDLE;
        held_d.init = written_i.init;
        clear_flags = 1'b1;
        bank_end_o  = 1'b0;
      end
    end

    if (clear_flags) begin
      n_scderr_d = 1'b1;
      n_agserr_d = !(written && agserr_on_write_i);
    end

    eot_d = state_d == IDLE && !new_d && !held_d.init;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q    <= IDLE;
      held_q     <= '0;
      new_q      <= 1'b0;
      use_q      <= '0;
      done_q     <= '0;
      bad_q      <= 1'b0;
      eot_q      <= 1'b1;
      n_scderr_q <= 1'b1;
      n_agserr_q <= 1'b1;
      fail_q     <= 1'b0;
      wait_q     <= '0;
      ack_q      <= 1'b0;
    end else begin
      state_q    <= state_d;
      held_q     <= held_d;
      new_q      <= new_d;
      use_q      <= use_d;
      done_q     <= done_d;
      bad_q      <= bad_d;
      eot_q      <= eot_d;
      n_scderr_q <= n_scderr_d;
      n_agserr_q <= n_agserr_d;
      fail_q     <= fail_d;
      wait_q     <= wait_d;
      if (!written) ack_q <= toggle_level;
    end
  end

  assign ack_o         = ack_q;
  assign held_o        = held_q;
  assign holdbank_o    = held_q.holdbank;
  assign eot_o         = eot_q;
  assign n_scderr_o    = n_scderr_q;
  assign n_agserr_o    = n_agserr_q;
  assign swbank_fail_o = fail_q;

  `MB4_ASSERT_IF(EotIsLowInFrame_A, clk_i, rst_ni, state_q != IDLE, !eot_q)
  `MB4_ASSERT(BreakIsNotKept_A, clk_i, rst_ni, !held_q.brk)

endmodule
