// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame on one line, BiSS C, BiSS B or SSI: follows the slaves from the request to their timeout.
//
// Clock domain: core. go_i.start begins a frame on a line that takes part when the time base
// restarts: MA is high for half a period, then it falls. After the last needed rising edge MA takes
// the inverted CDM and keeps it through the slaves' timeout. The number of rising edges of MA is
// the largest of these:
//
// - the edges that the slaves need: BiSS C 5 plus processing clocks, BiSS B 4 plus processing
//   clocks, SSI 1, each plus all data and CRC bits,
// - the edges already sent when the start bit comes back over a long line (decision 17),
// - the edges already sent when CDS comes back, if CDM depends on it.
//
// With mo_bus_i actuators are on MO, and more edges would shift their words. So mo_busy counts as
// the number of processing clocks, and MA does not wait for the start bit.
//
//   go_i.reduced         the frame ends after CDS (decision 14)
//   event_o.line_end     the last data bit has been taken; status_o.cds is valid from the next
//                        clock on (0 in BiSS B and SSI)
//   go_i.init            the line makes the two-pulse initialisation instead of a frame:
//                        event_o.init_done comes with the acknowledge. event_o.init_fail comes with
//                        late_i, if there is no acknowledge by then; on an SSI line at once
//   go_i.register_access MA belongs to the BiSS B register access (biss_b_access) until
//                        register_ma_i.ends, which makes event_o.line_end
//
// A frame keeps the protocol and the mo_bus_i of the clock of its start. Both come from flops.
// A line that is taken out of use (UNUSED) does not wait for SL in its timeout.
//
// Parameters: a protocol that is left out acts as UNUSED (decision 44). Such a line must not take
// part in a frame.
//
// Misuse: go_i.start while status_o.idle is low begins another frame in the middle of one. A slave
// that never answers keeps the frame running until go_i.stop (decision 4). After go_i.stop, and
// after a reset, MA returns to 1 with the next tick.
// Datasheet: pages 12..16, 27, 32, 33, Figures 8..16.

`include "enc_check.svh"

module biss_frame #(
  parameter bit          BissB    = 1'b1,
  parameter bit          Ssi      = 1'b1,
  parameter bit          Mo       = 1'b1,  // the line may have actuators: mo_bus_i
  parameter int unsigned Slaves   = 8,     // most words of a frame
  parameter int unsigned DataBits = 64     // the longest word
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,       // power-on reset of MA
  // control
  input  biss_pkg::line_cmd_t    cmd_i,
  input  biss_pkg::line_go_t     go_i,
  input  biss_pkg::line_start_t  start_i,
  input  logic                   mo_bus_i,
  input  biss_pkg::register_ma_t register_ma_i,
  // time base
  input  logic       tick_i,
  input  logic       half_next_i,
  // sampler
  output logic       armed_a_o,
  output logic       armed_b_o,
  input  logic       ack_i,
  input  logic       late_i,       // no acknowledge for as long as the sampler counts
  input  logic       sl_i,
  input  logic       bit_valid_i,
  input  logic       bit_i,
  // words
  input  logic       len_valid_i,
  input  logic [6:0] len_last_i,
  input  biss_pkg::offer_t offer_i,
  input  logic       word_done_i,
  output logic       word_load_o,  // the next bit is the first of a word
  output logic       word_bit_o,
  output logic       word_run_o,   // a word is on SL
  // results
  output logic       ssi_o,        // the frame is SSI
  output logic       biss_c_o,     // protocol of this frame
  output logic       rise_o,       // a rising MA edge of a frame
  output logic       final_rise_o, // ... the last one, as far as it is known
  output logic       ma_clocks_o,  // MA is clocking; 1 in INIT, which ends MO itself
  output biss_pkg::line_status_t status_o,
  output biss_pkg::line_event_t  event_o,
  output logic       ma_o
);

  typedef enum logic [2:0] {
    IDLE,
    REQUEST,
    CDS,
    DATA,
    STOP,
    TIMEOUT,
    RELEASE,
    REGISTER
  } state_e;

  state_e             state_d, state_n;
  state_e             state_q;
  logic [1:0]         cdm_q;       // for CDS = 1, 0
  logic               reduced_q;
  logic               hold_q;
  logic               init_q;
  logic               started_d;
  logic               started_q;   // the start bit has come
  logic               none_left, one_left;   // no more MA edges needed; at most one
  logic               cds_d;
  logic               cds_q;
  logic               load_d;
  logic               load_q;
  logic               enough;
  logic               rise;
  logic               ma_clocks;
  logic               released, release_next;
  logic               idle_q;      // state_q is IDLE, and the line does not go to RELEASE
  logic               begin_frame;
  logic               waited;      // one more processing clock
  logic               cdm;
  logic               cdm_known;
  logic               biss_c, ssi;
  logic               rests;       // no frame: the configuration may change
  logic               new_ssi, new_biss_c, new_bus;   // of a frame that begins
  logic               ssi_q, biss_c_q;
  logic               bus, bus_q;
  logic               unused;      // the line is out of use
  logic               sl_high;     // the slaves' timeout has ended, or no longer counts
  logic               line_end, init_done, init_fail;
  state_e             new_state;
  logic [1:0]         new_cdm;
  logic               new_reduced, new_init, abort;

  enc_sync_bit u_unused (
    .clk_i,
    .rst_ni,
    .data_i (cmd_i.protocol == biss_pkg::UNUSED ||
             (!BissB && cmd_i.protocol == biss_pkg::BISS_B) ||
             (!Ssi && cmd_i.protocol == biss_pkg::SSI)),
    .data_o (unused)
  );

  assign rests       = state_q == IDLE || state_q == TIMEOUT || state_q == RELEASE;
  assign new_ssi     = Ssi && cmd_i.protocol == biss_pkg::SSI;
  assign new_biss_c  = BissB ? cmd_i.protocol == biss_pkg::BISS_C : !new_ssi;
  assign new_bus     = Mo && mo_bus_i && !new_ssi;
  assign ssi         = Ssi && ssi_q;
  assign biss_c      = BissB ? biss_c_q : !ssi;
  assign bus         = Mo && bus_q;
  assign sl_high     = sl_i || unused;
  assign begin_frame = go_i.start && start_i.takes_part;
  // If CDM depends on CDS, it is known when CDS has come. Until then MA goes on.
  assign cdm         = cds_q ? cdm_q[1] : cdm_q[0];
  assign cdm_known   = cdm_q[1] == cdm_q[0] || state_q == DATA || state_q == STOP ||
                       state_q == TIMEOUT;
  assign enough      = init_q ? armed_a_o
                              : (started_q || bus) && none_left && cdm_known && !len_valid_i;

  biss_ma_drive u_ma (
    .clk_i,
    .rst_ni,
    .por_ni,
    .tick_i,
    .half_next_i,
    .start_i       (go_i.start),
    .begin_i       (begin_frame),
    .clocked_i     (!go_i.register_access),
    .stop_i        (go_i.stop && state_q != RELEASE),
    .enough_i      (enough),
    .cdm_i         (cdm),
    .high_i        (state_q == RELEASE || (state_q == TIMEOUT && sl_high && !hold_q)),
    .register_i    (BissB && state_q == REGISTER),
    .register_ma_i (register_ma_i.level),
    .force_i       (cmd_i.forced),
    .force_level_i (cmd_i.force_level),
    .released_o    (released),
    .release_next_o (release_next),
    .rise_o        (rise),
    .clocking_o    (ma_clocks),
    .ma_o
  );

  biss_edge_count #(.Slaves(Slaves), .DataBits(DataBits), .Mo(Mo)) u_edges (
    .clk_i,
    .rst_ni,
    .biss_c_i    (new_biss_c),
    .ssi_i       (new_ssi),
    .bus_i       (new_bus),
    .mo_busy_i   (cmd_i.mo_busy),
    .begin_i     (begin_frame),
    .len_valid_i (len_valid_i && !reduced_q),
    .len_last_i,
    .wait_i      (waited && !bus),
    .rise_i      (rise),
    .two_edges_o (armed_a_o),
    .two_edges_next_o (armed_b_o),
    .none_left_o (none_left),
    .one_left_o  (one_left)
  );

  // What begins with go_i.start, and what go_i.stop ends. MA may be low in IDLE (hold_cdm).
  assign new_state   = BissB && go_i.register_access ? REGISTER : REQUEST;
  assign new_cdm     = (go_i.init || !(new_biss_c || new_ssi)) ? 2'b00
                                                               : {start_i.cdm1, start_i.cdm0};
  assign new_reduced = go_i.reduced && !go_i.init;
  assign new_init    = go_i.init && !go_i.register_access;
  assign abort       = go_i.stop && (state_q == IDLE ? !ma_o : state_q != RELEASE);

  // The bits on SL move the frame to its next state.
  always_comb begin
    state_d     = state_q;
    started_d   = started_q;
    cds_d       = cds_q;
    load_d      = 1'b0;
    waited      = 1'b0;
    word_bit_o  = 1'b0;
    line_end    = 1'b0;
    init_done   = 1'b0;
    init_fail   = 1'b0;

    unique case (state_q)
      IDLE: begin
        // The line rests; MA is high, or keeps its level with hold_cdm.
        if (released) state_d = RELEASE;
      end
      REQUEST: begin
        // The slaves acknowledge and process, up to the start bit. With SSI the first word follows
        // at once; with INIT only the acknowledge counts.
        if (init_q) begin
          init_done = ack_i;
          init_fail = !ack_i && (late_i || ssi);
          if (init_done || init_fail) state_d = TIMEOUT;
        end else if (bit_valid_i && biss_c) begin
          waited    = !bit_i;
          started_d = bit_i;
          if (bit_i) state_d = CDS;
        end else if (ssi || bit_valid_i) begin
          waited = !ssi && !bit_i;
          if (!waited) begin
            started_d   = 1'b1;
            load_d      = offer_i.any && !reduced_q;
            line_end    = !load_d;
            state_d     = load_d ? DATA : ssi ? TIMEOUT : STOP;
          end
        end
      end
      CDS: begin
        // The bit after the start bit is CDS (BiSS C).
        if (bit_valid_i) begin
          cds_d     = bit_i;
          load_d    = offer_i.any && !reduced_q;
          line_end = !load_d;
          state_d     = load_d ? DATA : STOP;
        end
      end
      DATA: begin
        // SL brings the words.
        word_bit_o = bit_valid_i;
        if (word_done_i) begin
          load_d    = !offer_i.last;
          line_end = offer_i.last;
          if (offer_i.last) state_d = STOP;
        end
      end
      STOP: begin
        // SL shows the last bit of the frame up to the next sampling point.
        if (bit_valid_i) state_d = TIMEOUT;
      end
      REGISTER: begin
        // The BiSS B register access drives MA.
        line_end = register_ma_i.ends;
        if (register_ma_i.ends) state_d = TIMEOUT;
      end
      TIMEOUT: begin
        // The slaves are in their timeout. It ends with SL = 1.
        if (tick_i && sl_high && !ma_clocks) state_d = IDLE;
      end
      RELEASE: begin
        // After an abort, a reset or a forced level MA goes to 1 with the next tick.
        if (tick_i) state_d = IDLE;
      end
      default: state_d = RELEASE;
    endcase
  end

  assign state_n = abort ? RELEASE : begin_frame ? new_state : state_d;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q    <= RELEASE;
      cdm_q      <= '0;
      reduced_q  <= 1'b0;
      hold_q     <= 1'b0;
      init_q     <= 1'b0;
      started_q  <= 1'b0;
      cds_q      <= 1'b0;
      load_q     <= 1'b0;
      ssi_q      <= 1'b0;
      biss_c_q   <= 1'b0;
      bus_q      <= 1'b0;
      idle_q     <= 1'b0;
    end else begin
      state_q    <= state_n;
      started_q  <= started_d;
      cds_q      <= cds_d;
      load_q     <= load_d;
      // A frame keeps the configuration with which it begins.
      if (rests) begin
        ssi_q    <= new_ssi;
        biss_c_q <= new_biss_c;
        bus_q    <= new_bus;
      end
      idle_q     <= state_n == IDLE && !release_next;
      // go_i.start comes late, and the line is in IDLE then.
      if (begin_frame) begin
        cdm_q     <= new_cdm;
        cds_q     <= 1'b0;
        reduced_q <= new_reduced;
        hold_q    <= cmd_i.hold_cdm;
        init_q    <= new_init;
        started_q <= new_ssi;
      end
    end
  end

  assign word_load_o = load_q;
  assign word_run_o  = state_q == DATA && !go_i.stop;
  assign ssi_o       = ssi;
  assign rise_o      = rise;
  assign final_rise_o = rise && (started_q || bus) && one_left && cdm_known;
  assign ma_clocks_o  = ma_clocks || init_q;
  assign biss_c_o    = biss_c;
  assign status_o.idle    = idle_q;
  assign status_o.timeout = state_q == TIMEOUT;
  assign status_o.cds     = cds_q;
  assign status_o.cdm     = cdm;
  assign status_o.sl      = sl_i;
  assign event_o.line_end  = line_end;
  assign event_o.init_done = init_done;
  assign event_o.init_fail = init_fail;

  `ENC_ASSERT_IF(IdleDoesNotClock_A, clk_i, rst_ni, state_q == IDLE, !ma_clocks)

endmodule
