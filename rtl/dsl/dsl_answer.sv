// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers, nibble by nibble: of which message a nibble is, whether that is what was asked for, and
// whether its CRC is right. A long answer may pause while a short one comes.
//
// Clock domain: core. takes_i is one clock for each S_PAR, symbol_i stays up to the next one. A
// nibble of a message follows with compare_i, in which data_i is the byte of the request that it
// has to be like, and four clocks of divide_i, bit_i counting them. One clock behind the last one
// whole_o tells the end of a message, and bad_o and mine_o what it was.
// fresh_i: the nibble is the first one of a message, or of the second part of a long one (goes_i).
// breaks_i: a long message is not to go on. waits_i, long_open_i: a short, a long answer may come.
// Some flops have no reset: the first nibble of a message writes them.
// Misuse: none.
// Source: docs/dsl.md, "Messages".

module dsl_answer (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       check_i,
  input  logic       clear_i,      // no message comes
  input  logic       takes_i,
  input  logic [4:0] symbol_i,
  input  logic       nibble_i,
  input  logic       fresh_i,
  input  logic       goes_i,       // it is long
  input  logic       breaks_i,
  input  logic       waits_i,
  input  logic       long_open_i,
  input  logic       compare_i,
  input  logic       divide_i,
  input  logic [1:0] bit_i,
  input  logic [7:0] data_i,
  output logic [1:0] comes_o,      // dsl_message_pkg::comes_e
  output logic       paused_o,     // a long answer has begun
  output logic [4:0] count_o,      // nibbles that have come
  output logic       whole_o,
  output logic       bad_o,
  output logic       mine_o,
  output logic       read_o,       // of the short answer
  output logic       error_o,      // LOFF of the long one
  output logic [1:0] length_o
);

  dsl_message_pkg::comes_e comes_q;
  logic       is_long;
  logic [4:0] count;
  logic [2:0] short_count_q;  // nibbles that have come
  logic [4:0] long_count_q;
  logic       short_differs_q, long_differs_q;   // it is no answer to the open request
  logic       short_wrong_q, long_wrong_q;       // its CRC is wrong
  logic       short_read_q, long_read_q;
  logic       error_q;
  logic [1:0] answer_length_q;
  logic       paused, whole, whole_q;
  logic [2:0] crc_part;       // of a long answer, in parts of four nibbles
  logic       in_crc, in_crc_q;
  logic       low_byte;       // of the CRC
  logic       level;
  logic       top_short, top_long;
  logic [7:0] asked;          // byte of the request
  logic [3:0] expected;
  logic       same;
  logic       bit_wrong;
  assign is_long   = comes_q == dsl_message_pkg::LONG;
  assign count     = is_long ? long_count_q : {2'd0, short_count_q};
  assign crc_part  = {1'b0, answer_length_q} + 3'd1 + {2'd0, answer_length_q == 2'd3};
  assign in_crc    = is_long ? long_count_q[4:2] == crc_part
                             : short_count_q[2] || (!short_read_q && short_count_q[1]);
  assign low_byte  = is_long ? long_count_q[1] : short_count_q[1] == short_read_q;
  assign level     = symbol_i[{1'b0, ~bit_i}];
  assign bit_wrong = in_crc_q && (is_long ? top_long : top_short) == (level ^ low_byte ^ 1'b1);
  assign asked     = is_long ? data_i : {1'b0, data_i[7], data_i[5:0]};
  assign expected  = count[0] ? asked[3:0] : asked[7:4];

  always_comb begin
    same = expected == symbol_i[3:0];
    case (count)
      5'd0: if (is_long) same = expected[2] == symbol_i[2];
      5'd1: begin
        if (is_long) begin
          same = expected[1:0] == symbol_i[1:0]
              && (error_q || expected[3:2] == symbol_i[3:2]
                  || (!long_read_q && symbol_i[3:2] == 2'd0));
        end
      end
      5'd2, 5'd3: if (!is_long) same = 1'b1;
      default:    same = 1'b1;
    endcase
    if (!check_i) same = 1'b1;
  end

  // ---- Messages ---------------------------------------------------------------------------------

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      comes_q      <= dsl_message_pkg::NONE;
      long_count_q <= '0;
      whole_q      <= 1'b0;
    end else if (clear_i) begin
      comes_q      <= dsl_message_pkg::NONE;
      long_count_q <= '0;
      whole_q      <= 1'b0;
    end else begin
      whole_q <= whole;
      if (fresh_i) begin
        comes_q <= goes_i ? dsl_message_pkg::LONG : dsl_message_pkg::SHORT;
      end else if (takes_i && !nibble_i) begin
        comes_q <= dsl_message_pkg::NONE;
      end
      if (breaks_i) long_count_q <= '0;
      if (divide_i && bit_i == 2'd3 && is_long) begin
        long_count_q <= whole ? 5'd0 : long_count_q + 5'd1;
      end
      if (whole_q) comes_q <= dsl_message_pkg::REST;
    end
  end

  // Written before they are read. What the first nibbles tell does not change in_crc in their own
  // clocks.
  always_ff @(posedge clk_i) begin
    in_crc_q <= in_crc;
    if (fresh_i && !goes_i) begin
      short_count_q   <= '0;
      short_wrong_q   <= 1'b0;
      short_differs_q <= !waits_i;
    end
    if (fresh_i && goes_i && !paused) begin
      long_wrong_q    <= 1'b0;
      long_differs_q  <= !long_open_i;
    end
    if (compare_i) begin
      if (is_long) begin
        if (!same) long_differs_q <= 1'b1;
        if (count == 5'd0) {long_read_q, error_q} <= symbol_i[2:1];
        if (count == 5'd1) answer_length_q <= symbol_i[3:2];
      end else begin
        if (!same) short_differs_q <= 1'b1;
        if (count == 5'd0) short_read_q <= symbol_i[2];
      end
    end
    if (divide_i) begin
      if (bit_wrong && is_long)  long_wrong_q  <= 1'b1;
      if (bit_wrong && !is_long) short_wrong_q <= 1'b1;
      if (bit_i == 2'd3 && !is_long) short_count_q <= short_count_q + 3'd1;
    end
  end

  dsl_crc16 u_short (
    .clk_i,
    .load_i  (fresh_i && !goes_i),
    .shift_i (divide_i && !is_long),
    .feed_i  (!in_crc_q),
    .bit_i   (level),
    .top_o   (top_short)
  );

  dsl_crc16 u_long (
    .clk_i,
    .load_i  (fresh_i && goes_i && !paused),
    .shift_i (divide_i && is_long),
    .feed_i  (!in_crc_q),
    .bit_i   (level),
    .top_o   (top_long)
  );

  assign paused   = long_count_q != 5'd0;
  assign whole    = divide_i && bit_i == 2'd3 && in_crc_q
                 && (is_long ? long_count_q[1:0] == 2'd3
                             : short_count_q == {1'b1, short_read_q, 1'b1});
  assign comes_o  = comes_q;
  assign paused_o = paused;
  assign count_o  = count;
  assign whole_o  = whole_q;
  assign bad_o    = is_long ? long_wrong_q : short_wrong_q;
  assign mine_o   = is_long ? long_open_i && !long_differs_q : waits_i && !short_differs_q;
  assign read_o   = short_read_q;
  assign error_o  = error_q;
  assign length_o = answer_length_q;

endmodule
