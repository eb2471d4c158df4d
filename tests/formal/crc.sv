// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The CRC of a word is the remainder that polynomial division defines: for every CRC that can be
// configured, every start value and, by induction, every length. Up to four bits it is also
// compared with long division of the whole message (datasheet pages 24, 25).
//
// claim: remainder of the polynomial division for every polynomial, start value and length
// clocks: one
// depth: 5
// cover: 9
// unbounded: induction 1
// look: dut_rem = u_dut.rem_q
// mutation: common/enc_crc.sv | feed_i & (bit_i ^ top) | feed_i & bit_i
// mutation: common/enc_crc.sv | if (load_i) rem_d = start_i; | if (load_i) rem_d = {start_i[15:1], 1'b0};
// mutation: mb4/regs/mb4_crc_code.sv | poly_o = 8'hEC; | poly_o = 8'hED;
// mutation: mb4/regs/mb4_crc_decode.sv | last = 3'(i); | last = 3'(i + 1);

module proof (
  input logic clk_i,
  input logic rst_ni,
  input logic load_i,
  input logic shift_i,
  input logic feed_i,
  input logic bit_i
);

  (* anyconst *) logic        selcrc;
  (* anyconst *) logic [6:0]  code;
  (* anyconst *) logic [15:0] start;

  logic       on;
  logic [3:0] last;
  logic [7:0] choice, poly;
  logic       out;

  mb4_crc_code u_code (
    .selcrc_i (selcrc),
    .code_i   (code),
    .poly_o   (choice)
  );

  mb4_crc_decode u_decode (
    .poly_i     (choice),
    .crc_on_o   (on),
    .crc_last_o (last),
    .crc_poly_o (poly)
  );

  enc_crc u_dut (
    .clk_i,
    .rst_ni,
    .crc16_i (last[3]),
    .poly_i  (poly),
    .last_i  (last[2:0]),
    .start_i (start),
    .load_i,
    .shift_i,
    .feed_i,
    .bit_i,
    .top_o   (out)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  // The polynomial with its highest power, and its degree.
  logic [16:0] p;
  logic [4:0]  n;
  logic [15:0] mask;   // bits of the remainder

  always @* begin
    p = 17'h0;
    if (selcrc) p = {9'h0, code, 1'b1};
    else case (code)
      7'h03: p = 17'h0000B;
      7'h04: p = 17'h00013;
      7'h05: p = 17'h00025;
      7'h06: p = 17'h00043;
      7'h07: p = 17'h00089;
      7'h08: p = 17'h0012F;
      7'h10: p = 17'h190D9;
      default: p = 17'h0;
    endcase
    n = 5'd0;
    for (int i = 1; i <= 16; i++) if (p[i]) n = 5'(i);
  end

  always @* begin
    Degree_A: assert (n == 5'd0 ? !on && last == 4'd0 : on && last == 4'(n - 5'd1));
    if (n != 5'd0) Polynomial_A: assert (((poly ^ p[7:0]) & mask[7:0]) == 8'd0);
    assume (n != 5'd0);
  end

  // The remainder, bit by bit as the definition says.
  logic [15:0] r_q;
  logic [16:0] v;

  assign mask = 16'((17'd1 << n) - 17'd1);

  always @* begin
    v = {r_q & mask, 1'b0} ^ ({16'h0, feed_i && bit_i} << n);
    if (feed_i && v[n]) v = v ^ p;
  end

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)      r_q <= '0;
    else if (load_i)  r_q <= start & mask;
    else if (shift_i) r_q <= v[15:0] & mask;
  end

  wire [15:0] dut_rem;
  always @* if (started) begin
    Remainder_A: assert ((dut_rem & mask) == (r_q & mask));
    Top_A: assert (out == ((r_q >> (n - 5'd1)) & 16'd1));
    Masked_A: assert ((r_q & ~mask) == 16'd0);
  end

  // A short message as a whole.
  logic [2:0]  bits_q;     // 7: none, or too long
  logic [3:0]  message_q;
  logic [20:0] rest;

  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {bits_q, message_q} <= {3'd7, 4'd0};
    end else if (load_i) begin
      {bits_q, message_q} <= 7'd0;
    end else if (shift_i) begin
      message_q <= {message_q[2:0], bit_i};
      bits_q    <= (feed_i && bits_q < 3'd4) ? bits_q + 3'd1 : 3'd7;
    end
  end

  always @* begin
    rest = ({17'd0, message_q} << n) ^ ({5'd0, start & mask} << bits_q);
    for (int i = 3; i >= 0; i--) begin
      if (i < bits_q && rest[n + 5'(i)]) rest = rest ^ ({4'd0, p} << i);
    end
  end

  always @* if (started && bits_q != 3'd7) begin
    Counted_A: assert (bits_q <= 3'd4 && (message_q >> bits_q) == 4'd0);
    LongDivision_A: assert (rest == {5'd0, r_q});
  end
  always @(posedge clk_i) Message_C: cover (bits_q == 3'd4 && n == 5'd6 && out);

endmodule
