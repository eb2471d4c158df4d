// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One channel: MA and SLO of one encoder, from the start of a frame to the end of the encoder's
// timeout.
//
// Clock domain: core. start_i begins a frame on an enabled channel that rests (busy_o = 0); MA
// falls half an MA period later. frame_o is high while the frame runs, busy_o until the timeout has
// ended too. The results change only in the last clock of frame_o.
//
// MA has as many rising edges as the encoder needs: 5, its processing clocks, and all bits of
// position, error, warning and CRC. The channel counts edges minus bits that have come before the
// start bit; at frame_i.edges (4 and the bits) MA stays 1. If more were sent before the start bit
// came back over a long line, MA stops with the start bit.
//
// A frame is bad, and changes neither position nor flags, if
// - SLO is 0 at start_i (MA does not move; the channel rests at once; the delay is 1023),
// - the acknowledge does not come within 1023 clocks, or the start bit not within StartLimit bits,
// - the CRC is wrong and frame_i.check is 1,
// - the channel is disabled or clear_i comes while it runs. MA then returns to 1 at the end of a
//   half period.
// A frame that ends before its CRC leaves 0 as CRC in the results.
// After a frame SLO = 0 counts as timeout for at most rule_i.timeout_last + 1 clocks. With
// rule_i.fixed, after a frame that was ended by enabled_i or clear_i, and after a reset the channel
// waits for all these clocks whatever SLO is: the encoder may be in a bit that is 1.
//
// Access = 1: the frame carries the CDM bit cdm_i[CDS], taken when it begins. MA shows it inverted
// until the timeout has ended.
//
// FrameSampler = 1: biss_frame_sampler takes the bits of the word, once the last one has come;
// biss_delay_sampler finds the acknowledge, takes CDS and ends MA. It may see the start bit one bit
// early, so MA has one rising edge more. If it has missed the start bit that biss_frame_sampler has
// seen, it goes on a bit later, and MA has two more. A start bit that biss_frame_sampler has not
// seen with CDS was a pulse: the frame ends as one without a start bit. Outside of 10 to 20 clocks
// a bit all is as with FrameSampler = 0. eye_o is of the last frame that came to its end this way.
//
// Misuse: start_i while busy_o is 1 starts no frame; word_o.good and word_o.crc_bad go to 0.
// frame_i must not change while frame_o is 1, nor rule_i while busy_o is 1.
// Source: hello-fpga BiSS-C master manual 1.1 and 2.4; docs/axi.md.

`include "enc_check.svh"

module axi_channel #(
  parameter int unsigned StartLimit = 1024,  // bits, 1 to 4095
  parameter int unsigned CountW     = 12,    // bits of StartLimit and of the timeout, 7 to 20
  parameter bit          Wide       = 1'b0,  // up to 64 bits of position
  parameter bit          AnyCrc     = 1'b0,  // 0: rule_i.crc_* are those of 0x43, whatever they are
  parameter bit          Access     = 1'b0,  // CDM
  parameter bit          FrameSampler = 1'b0
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,            // resets MA
  // frames
  input  axi_pkg::frame_t frame_i,
  input  axi_pkg::rule_t  rule_i,
  input  logic [1:0] cdm_i,             // CDM to send if CDS of the frame is 1, 0
  input  logic       clear_i,           // soft reset
  input  logic       enabled_i,
  input  logic       start_i,
  input  logic       request_i,         // with start_i: clears single_valid_o
  // time base
  input  logic       tick_i,
  input  logic       half_next_i,
  // results
  output logic       busy_o,
  output logic       frame_o,
  output logic       single_valid_o,
  output axi_pkg::result_t result_o,
  output axi_pkg::word_t   word_o,
  output axi_pkg::more_t   more_o,
  output axi_pkg::event_t  event_o,
  output axi_pkg::eye_t    eye_o,
  // pins
  output logic       ma_o,
  input  logic       slo_i
);

  localparam logic [CountW-1:0] START_LAST = CountW'(StartLimit - 1);
  localparam logic [CountW-1:0] ONE        = CountW'(1);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (StartLimit < 1 || StartLimit > 4095 || CountW < 7 || CountW > 20 ||
      StartLimit > (32'd1 << CountW))
  begin : gen_limits
    $error("StartLimit is 1 to 4095, CountW 7 to 20 and enough for it");
  end
`endif

  typedef enum logic [3:0] {
    IDLE,
    REQUEST,
    ACK,
    START,
    CDS,
    DATA,
    CRC,
    STOP,
    TIMEOUT,
    BROKEN
  } state_e;

  state_e      state_d;
  state_e      state_q;
  logic        first_q;        // one rising MA edge has come
  logic [CountW-1:0] count_d;
  logic [CountW-1:0] count_q; // bits of a part, or clocks of the timeout
  logic [6:0]  ahead_d;
  logic [6:0]  ahead_q;        // rising MA edges minus bits before the start bit
  logic        all_sent;       // ahead_q has reached frame_i.edges
  logic        enough;
  logic        ended_q;        // the last CRC bit has been taken
  logic        start;
  logic        begin_frame;
  logic        no_ack;
  logic        no_start;
  logic        breaks;         // the frame is ended by the host
  logic        fail;           // the frame ends as a bad one
  logic        late_start;
  logic        running;        // the frame waits for bits
  logic        over;           // MA may return to 1
  logic        limit;          // the timeout has lasted as long as it can
  logic        rests;          // MA is 1 and stays 1
  logic        sl, ack, late, bit_valid, sl_bit;
  logic        framed;         // biss_frame_sampler takes the word
  logic        median;
  logic        started;        // with bit_valid: the start bit has come
  logic        lost;           // what was taken for it was a pulse
  logic        word_valid, word_bit;
  logic [9:0]  delay;
  logic        rise, ma_clocks, ma, unused_released, unused_release;
  logic        crc_error;
  logic [1:0]  cdm;            // for CDS = 1, 0
  logic        cds;            // of this frame
  logic        sent;           // CDM of this frame
  logic        patient;        // SLO does not end the timeout
  logic [3:0]  crc_last;
  logic        unused;

  biss_delay_sampler #(.Median(FrameSampler)) u_sampler (
    .clk_i,
    .rst_ni,
    .sl_i        (slo_i),
    .half_last_i (frame_i.half_last),
    .median_i    (median),
    .clear_i     (start),
    .armed_i     (state_q == ACK),
    .sl_o        (sl),
    .ack_o       (ack),
    .delay_o     (delay),
    .late_o      (late),
    .bit_valid_o (bit_valid),
    .bit_o       (sl_bit)
  );

  biss_ma_drive u_ma (
    .clk_i,
    .rst_ni,
    .por_ni,
    .tick_i,
    .half_next_i,
    .start_i,
    .begin_i       (begin_frame && sl),
    .clocked_i     (1'b1),
    .stop_i        (fail),
    .enough_i      (enough),
    .cdm_i         (sent),
    .high_i        (over || state_q == BROKEN),
    .register_i    (1'b0),
    .register_ma_i (1'b1),
    .force_i       (1'b0),
    .force_level_i (1'b1),
    .released_o    (unused_released),
    .release_next_o (unused_release),
    .rise_o        (rise),
    .clocking_o    (ma_clocks),
    .ma_o          (ma)
  );

  axi_word #(.Wide(Wide), .AnyCrc(AnyCrc)) u_word (
    .clk_i,
    .rst_ni,
    .frame_i,
    .rule_i,
    .clear_i,
    .enabled_i,
    .start_i,
    .request_i,
    .load_i         (state_q == CDS),
    .data_i         (state_q == DATA),
    .crc_i          (state_q == CRC),
    .bit_valid_i    (word_valid),
    .bit_i          (word_bit),
    .ended_i        (ended_q),
    .failed_i       (fail),
    .late_i         (late_start),
    .ack_i          (ack),
    .delay_i        (delay),
    .crc_error_o    (crc_error),
    .single_valid_o,
    .result_o,
    .word_o,
    .more_o
  );

  if (FrameSampler) begin : gen_frame_sampler
    logic usable, rose, frame_valid, frame_bit, eye_valid, taken, shown;
    logic usable_q;
    logic [4:0] width, point;
    logic       eye_valid_q;
    logic [4:0] eye_width_q;
    logic [4:0] eye_point_q;

    biss_frame_sampler u_frame_sampler (
      .clk_i,
      .rst_ni,
      .sl_i        (sl),
      .half_last_i (frame_i.half_last),
      .bit_last_i  (frame_i.edges),
      .run_i       (start || state_q != IDLE),
      .clear_i     (start),
      .ack_i       (ack),
      .usable_o    (usable),
      .started_o   (rose),
      .bit_valid_o (frame_valid),
      .bit_o       (frame_bit),
      .eye_valid_o (eye_valid),
      .eye_width_o (width),
      .eye_point_o (point)
    );

    // frame_i stays while a frame runs.
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) usable_q <= 1'b0;
      else         usable_q <= usable;
    end

    assign framed     = usable;
    assign median     = usable_q;
    assign taken      = usable_q && (state_q == DATA || state_q == CRC);
    assign started    = sl_bit || (usable_q && rose);
    assign lost       = usable_q && state_q == CDS && bit_valid && !rose;
    assign word_valid = taken ? frame_valid : bit_valid;
    assign word_bit   = taken ? frame_bit : sl_bit;
    assign shown      = ended_q && eye_valid && enabled_i && !clear_i;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        eye_valid_q <= 1'b0;
        eye_width_q <= '0;
        eye_point_q <= '0;
      end else begin
        if (clear_i || !enabled_i || ended_q || fail || late_start) eye_valid_q <= shown;
        if (shown) eye_width_q <= width;
        if (shown) eye_point_q <= point;
      end
    end

    assign eye_o.valid = eye_valid_q;
    assign eye_o.used  = usable;
    assign eye_o.width = eye_width_q;
    assign eye_o.point = eye_point_q;
  end else begin : gen_no_frame_sampler
    assign framed     = 1'b0;
    assign median     = 1'b0;
    assign started    = sl_bit;
    assign lost       = 1'b0;
    assign word_valid = bit_valid;
    assign word_bit   = sl_bit;
    assign eye_o      = '0;
  end

  // If CDM depends on CDS, MA goes on until CDS has come.
  if (Access) begin : gen_access
    logic [1:0] cdm_q;
    logic       cds_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        cdm_q <= '0;
        cds_q <= 1'b0;
      end else begin
        if (begin_frame)                        cdm_q <= cdm_i;
        if (begin_frame)                        cds_q <= 1'b0;
        else if (state_q == CDS && bit_valid)   cds_q <= sl_bit;
      end
    end

    assign cdm  = cdm_q;
    assign cds  = cds_q;
    assign sent = cds_q ? cdm_q[1] : cdm_q[0];
  end else begin : gen_no_access
    assign cdm  = 2'b00;
    assign cds  = 1'b0;
    assign sent = 1'b0;
  end

  // A disabled channel may still wait for its stop bit when a frame begins on the others.
  assign start       = start_i && state_q == IDLE;
  assign begin_frame = start && enabled_i;
  assign late_start  = begin_frame && !sl;
  assign running     = state_q != IDLE && state_q != TIMEOUT && state_q != STOP &&
                       state_q != BROKEN;
  assign no_ack      = state_q == ACK && !ack && late;
  assign no_start    = state_q == START && bit_valid && !started && count_q == START_LAST;
  assign breaks      = running && (clear_i || !enabled_i);
  assign fail        = no_ack || no_start || (FrameSampler && lost) || breaks;
  assign limit       = count_q == rule_i.timeout_last[CountW-1:0];
  assign crc_last    = AnyCrc ? rule_i.crc_last : 4'd5;
  assign patient     = rule_i.fixed;
  assign over        = state_q == TIMEOUT && ((sl && !patient) || limit || !sent);
  assign rests       = !ma_clocks && ma;
  assign all_sent    = ahead_q == frame_i.edges;
  assign enough      = all_sent && ((state_q == CDS && cdm[1] == cdm[0]) || state_q == DATA ||
                                    state_q == CRC || state_q == STOP || state_q == TIMEOUT);

  always_comb begin
    state_d = state_q;
    count_d = count_q;
    unique case (state_q)
      IDLE: begin
        // MA and SLO are 1.
        if (begin_frame && sl) state_d = REQUEST;
      end
      REQUEST: begin
        // The encoder latches at the first rising edge of MA and acknowledges the second one.
        if (rise && first_q) state_d = ACK;
      end
      ACK: begin
        // SLO is still 1: the acknowledge is on its way.
        count_d = '0;
        if (ack) state_d = START;
      end
      START: begin
        // SLO is 0 for as long as the encoder processes, then 1 for one bit.
        if (bit_valid) begin
          count_d = count_q + ONE;
          if (started) state_d = CDS;
        end
      end
      CDS: begin
        // The bit after the start bit.
        count_d = '0;
        if (bit_valid) state_d = DATA;
      end
      DATA: begin
        // Position, error, warning.
        if (word_valid) begin
          count_d = count_q + ONE;
          if (count_q[6:0] == frame_i.data_last) begin
            state_d = CRC;
            count_d = '0;
          end
        end
      end
      CRC: begin
        if (word_valid) begin
          count_d = count_q + ONE;
          if (count_q[3:0] == crc_last) state_d = STOP;
        end
      end
      STOP: begin
        // SLO falls with the last edge of MA. Before that its level is the last CRC bit. A short
        // word can be complete before MA has sent the edge that is more.
        count_d = '0;
        if (bit_valid && !(framed && ma_clocks)) state_d = TIMEOUT;
      end
      TIMEOUT: begin
        // SLO is 0 until the encoder is ready.
        count_d = count_q + CountW'(!limit);
        if (((sl && !patient) || limit) && rests) state_d = IDLE;
      end
      BROKEN: begin
        // The encoder is in the middle of its word: SLO does not show when its timeout begins. The
        // timeout cannot begin before MA rests (below).
        count_d = count_q + CountW'(!limit);
        if (limit && rests) state_d = IDLE;
      end
      default: state_d = IDLE;
    endcase
    if (fail) state_d = breaks ? BROKEN : TIMEOUT;
    if (fail || (state_q == BROKEN && !rests)) count_d = '0;
  end

  always_comb begin
    ahead_d = ahead_q;
    if (state_q == START && bit_valid && !started) begin
      if (!rise) ahead_d = ahead_q - 7'd1;
    end else if (rise && !all_sent) begin
      ahead_d = ahead_q + 7'd1;
    end
    if (start) ahead_d = {7{framed}};  // -1: one edge more
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= BROKEN;
      first_q <= 1'b0;
      count_q <= '0;
      ahead_q <= '0;
      ended_q <= 1'b0;
    end else begin
      state_q <= state_d;
      first_q <= state_q == REQUEST && (first_q || rise);
      count_q <= count_d;
      ahead_q <= ahead_d;
      ended_q <= state_q == CRC && state_d == STOP;
    end
  end

  assign event_o.begun     = begin_frame && sl;
  assign event_o.ended     = ended_q;
  assign event_o.failed    = fail;
  assign event_o.crc_error = crc_error;
  assign event_o.late      = late_start;
  assign event_o.cds       = cds;
  assign event_o.cdm       = sent;

  assign unused  = (^rule_i) ^ (^cdm_i);

  assign busy_o  = state_q != IDLE;
  assign frame_o = running || ended_q;
  assign ma_o    = ma;

  `ENC_ASSERT(StateInRange_A, clk_i, rst_ni, state_q <= BROKEN)
  `ENC_ASSERT_IF(RestIsHigh_A, clk_i, rst_ni, state_q == IDLE, rests)

endmodule
