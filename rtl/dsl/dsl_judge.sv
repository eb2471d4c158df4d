// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges the answers: the words with their errors, and what they do to the quality of the link.
//
// Clock domain: core. A word shows with valid_o, two clocks behind word_valid_i, and stays up to
// the next one; number_o is a clock earlier. ends_o is two clocks behind done_i, and judged_o three
// behind ends_o: good_o and verdict_i then say whether the link goes on, and from the next clock on
// quality_o is that of this frame.
//
// Only running frames move the quality (running_i). VSYNC belongs into the last of the eight frames
// alone; where S_PAR has an error of its code, VSYNC is not looked at. The acceleration has one
// deduction for both of its words. With the strict check K28.x is a byte like others but in S_PAR.
// verdict_i is looked at behind ends_o. illegal_o comes in each frame with words (words_i).
// Misuse: a word less than three clocks behind another, or done_i less than two behind a word,
// loses events.
// Source: docs/dsl.md, "Choices of this master".

module dsl_judge (
  input  logic              clk_i,
  input  logic              rst_ni,
  input  dsl_pkg::quirks_t  quirks_i,
  input  logic              start_i,       // the quality begins
  input  logic              words_i,       // the window brings words of the code
  input  logic              running_i,
  input  logic [2:0]        place_i,
  // a window
  input  logic              word_valid_i,
  input  logic [2:0]        number_i,
  input  logic [9:0]        line_i,
  input  logic              done_i,
  input  logic [3:0]        rssi_i,
  input  dsl_pkg::verdict_t verdict_i,
  // its words
  output logic              valid_o,
  output logic [2:0]        number_o,
  output dsl_pkg::word_t    word_o,
  output logic              ends_o,
  // the frame
  output logic              judged_o,
  output logic              good_o,
  output logic [3:0]        quality_o,
  output logic              low_o,
  output logic              illegal_o      // one clock: only the strict check refuses a word
);

  localparam logic [2:0] VERTICAL   = 3'd0;
  localparam logic [2:0] PARAMETER  = 3'd1;
  localparam logic [2:0] PIPELINE   = 3'd2;
  localparam logic [2:0] HIGH_WORD  = 3'd3;      // of the acceleration
  localparam logic [2:0] LOW_WORD   = 3'd4;
  localparam logic [2:0] SECONDARY  = 3'd5;
  localparam logic [7:0] MARKER1    = 8'hFD;     // the encoder has no position
  localparam logic [7:0] MARKER2    = 8'hFB;     // ... no second safe position
  localparam logic [4:0] K28        = 5'd28;
  localparam logic [3:0] LOW_RSSI   = 4'd2;

  logic           comes_q;               // a word: the code is looked up,
  logic           valid_q, second_q;     // ... its first clock, and the next one
  logic [2:0]     number_q;
  dsl_pkg::word_t decoded, word_q;
  logic           before_q;              // the word before had an error of its code
  logic           done_q, ends_q;        // the steps at the end of a frame, one clock each
  logic           safe1_q, safe2_q, judged_q;
  logic           vsync, last, k28;
  logic           marker;                // allowed there
  logic           special;               // one that must not be there
  logic           add;
  logic [3:0]     what;                  // dsl_pkg::event_e

  dsl_code_rx u_code (
    .clk_i,
    .line_i,
    .strict_i (quirks_i.strict_code),
    .raw_i    (quirks_i.sdk_map || number_q == HIGH_WORD || number_q == LOW_WORD),
    .second_i (number_q == SECONDARY),
    .word_o   (decoded)
  );

  assign vsync = word_q.data[7];
  assign last  = place_i == dsl_pkg::LAST_PLACE;
  assign k28   = word_q.data[4:0] == K28;

  always_comb begin
    case (number_q)
      PARAMETER: marker = 1'b0;
      PIPELINE:  marker = 1'b1;
      SECONDARY: marker = word_q.data == MARKER2 || k28;
      default:   marker = word_q.data == MARKER1 || (k28 && quirks_i.strict_code);
    endcase
  end
  assign special = word_q.special && !word_q.error && !marker;

  // What happens in this clock.
  always_comb begin
    add  = 1'b0;
    what = dsl_pkg::SPECIAL;
    if (second_q) begin
      case (number_q)
        PARAMETER: begin
          add  = word_q.error || vsync || last;
          what = word_q.error ? dsl_pkg::CODE_ERROR
               : !last        ? dsl_pkg::VSYNC_EARLY
               : vsync        ? dsl_pkg::GOOD
                              : dsl_pkg::VSYNC_MISSING;
        end
        PIPELINE: begin
          add  = word_q.error;
          what = dsl_pkg::CODE_ERROR;
        end
        HIGH_WORD, LOW_WORD: begin
          add  = word_q.error && !(number_q == LOW_WORD && before_q);
          what = dsl_pkg::ACCELERATION;
        end
        default: ;
      endcase
    end else if (ends_q) begin
      add  = rssi_i < LOW_RSSI;
      what = dsl_pkg::RSSI_LOW;
    end else if (safe1_q) begin
      add  = verdict_i.safe1_error || verdict_i.safe1_good;
      what = verdict_i.safe1_error ? dsl_pkg::SAFE1_ERROR : dsl_pkg::GOOD;
    end else if (safe2_q) begin
      add  = verdict_i.safe2_error;
      what = dsl_pkg::SAFE2_ERROR;
    end else begin
      add  = valid_q && special;
    end
  end

  dsl_quality u_quality (
    .clk_i,
    .rst_ni,
    .rules_i (quirks_i.rules),
    .start_i,
    .add_i   (add && running_i),
    .event_i (what),
    .end_i   (judged_q),
    .good_o,
    .value_o (quality_o),
    .low_o
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      comes_q   <= 1'b0;
      valid_q   <= 1'b0;
      second_q  <= 1'b0;
      number_q  <= VERTICAL;
      word_q    <= '0;
      before_q  <= 1'b0;
      done_q    <= 1'b0;
      ends_q    <= 1'b0;
      safe1_q   <= 1'b0;
      safe2_q   <= 1'b0;
      judged_q  <= 1'b0;
    end else begin
      comes_q  <= word_valid_i;
      valid_q  <= comes_q;
      second_q <= valid_q;
      done_q   <= done_i;
      ends_q   <= done_q;
      safe1_q  <= ends_q;
      safe2_q  <= safe1_q;
      judged_q <= safe2_q;
      if (word_valid_i) number_q <= number_i;
      if (comes_q) begin
        word_q   <= decoded;
        before_q <= word_q.error;
      end
    end
  end

  assign valid_o   = valid_q;
  assign number_o  = number_q;
  assign word_o    = word_q;
  assign ends_o    = ends_q;
  assign judged_o  = judged_q;
  assign illegal_o = valid_q && words_i && word_q.only_strict;

endmodule
