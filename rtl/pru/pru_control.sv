// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The control frame: one CDM bit a frame from the host's word, one CDS bit a frame into result and
// CRC.
//
// Clock domain: core. step_i comes with the end of a frame: what it changes is there one clock
// later, with the other results. cdm_o is the bit of the next frame.
//
// A frame's end takes the armed word: 14 frames with CDM = 0 follow, then START, then bits 31 to 1.
// CDS 20 to 27 behind START are the result, 28 to 31 its CRC. A frame without MA takes no bit, one
// without acknowledge takes one and its CDS counts as 0. end_o is high in the clock behind
// the last one, when its results are there.
// The host's write of the highest byte arms the word if the word then is not 0. A write in the
// clock in which the word would be taken wins: the word is taken later.
//
// Misuse: clear_i drops the frame that runs, not the word that waits.
// Source: TIDEP0022, 3.2.3.2; docs/pru.md.

module pru_control (
  input  logic        clk_i,
  input  logic        rst_ni,
  // host
  input  logic [3:0]  write_i,      // strobes of a write of the word
  input  logic [31:0] data_i,
  output logic [31:0] word_o,
  // frames
  input  logic        clear_i,
  input  logic        step_i,
  input  logic        clocked_i,    // with step_i: MA ran
  input  logic        cds_i,        // with step_i
  output logic        cdm_o,
  output logic        end_o,
  output pru_pkg::control_t control_o
);

  localparam logic [5:0] START  = 6'd14;  // number of the frame, from 0
  localparam logic [5:0] DATA   = START + 6'd20;
  localparam logic [5:0] CRC    = START + 6'd28;
  localparam logic [5:0] LAST   = START + 6'd31;

  logic [31:0] word_q;
  logic [3:0]  valid_q;      // bytes of word_q that have not been taken
  logic [31:0] word;         // the others are 0
  logic        wrote_q;      // its highest byte has been written
  logic        armed_q;
  logic        any;          // the word is not 0
  logic [30:0] bits_q;       // that have not been sent
  logic        runs_q;
  logic [5:0]  count_q;      // number of the next frame
  logic        take;
  logic        step;
  logic        ends;
  logic        end_q;
  logic        in_data, in_crc;
  logic        fits_q;
  logic        crc_top;
  pru_pkg::control_t control_q;
  logic [2:0]  crc_q;        // of the bits before the last one
  logic [7:0]  result_q;

  assign word    = word_q & {{8{valid_q[3]}}, {8{valid_q[2]}}, {8{valid_q[1]}}, {8{valid_q[0]}}};
  assign any     = word != 32'd0;
  assign step    = step_i && clocked_i && runs_q;
  assign ends    = step && count_q == LAST;
  assign take    = step_i && !clear_i && (!runs_q || ends) && armed_q && any && write_i == 4'd0;
  assign in_data = count_q >= DATA && count_q < CRC;
  assign in_crc  = count_q >= CRC;

  enc_crc u_crc (
    .clk_i,
    .rst_ni,
    .crc16_i (1'b0),
    .poly_i  (8'h03),
    .last_i  (3'd3),
    .start_i (16'h0000),
    .load_i  (take),
    .shift_i (step && (in_data || in_crc)),
    .feed_i  (in_data),
    .bit_i   (cds_i),
    .top_o   (crc_top)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      word_q  <= '0;
      valid_q <= '0;
      wrote_q <= 1'b0;
      armed_q <= 1'b0;
    end else begin
      for (int unsigned i = 0; i < 4; i++) begin
        if (write_i[i]) word_q[8*i +: 8] <= data_i[8*i +: 8];
      end
      valid_q <= (valid_q & {4{!take}}) | write_i;
      wrote_q <= write_i[3];
      armed_q <= !take && (wrote_q ? any : armed_q);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bits_q    <= '0;
      runs_q    <= 1'b0;
      count_q   <= '0;
      fits_q    <= 1'b1;
      crc_q     <= '0;
      result_q  <= '0;
      control_q <= '0;
      end_q     <= 1'b0;
    end else begin
      end_q  <= ends;
      runs_q <= !clear_i && (take || (runs_q && !ends));
      if (take) begin
        bits_q  <= word[31:1];
        count_q <= '0;
        fits_q  <= 1'b1;
      end else if (step) begin
        count_q <= count_q + 6'd1;
        if (count_q > START) bits_q <= {bits_q[29:0], 1'b0};
        if (in_data)         result_q <= {result_q[6:0], cds_i};
        if (in_crc) begin
          crc_q  <= {crc_q[1:0], cds_i};
          fits_q <= fits_q && cds_i != crc_top;
        end
      end
      control_q.sending <= !clear_i && !ends &&
                           (control_q.sending || (step && count_q == START));
      if (ends) begin
        control_q.crc_bad <= !(fits_q && cds_i != crc_top);
        control_q.crc     <= {crc_q, cds_i};
        control_q.result  <= result_q;
      end
    end
  end

  assign cdm_o     = runs_q && (count_q == START || (count_q > START && bits_q[30]));
  assign word_o    = word;
  assign end_o     = end_q;
  assign control_o = control_q;

endmodule
