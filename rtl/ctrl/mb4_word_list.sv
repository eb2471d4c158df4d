// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Word list of one physical channel: which data channel comes next, and how long the frame is.
//
// Clock domain: core. start_i takes the list of words (enabled data channels of this line, lowest
// first = next to SL first). word_o is the current word, valid one clock after start_i and one
// clock after next_i. With Sum = 1 the list is walked once before: in the clocks after start_i
// len_o offers the bits of one word a clock with len_valid_o, last word first; word_o is valid
// when len_valid_o has fallen.
// Misuse: the configuration must not change between start_i and the end of the frame.
// Datasheet: pages 23..26; order of words: protocol of the chain, first slave first.

module mb4_word_list #(
  parameter bit Sum = 1'b1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  // configuration
  input  logic [mb4_pkg::NUM_SLAVES*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_i,
  input  logic [7:0] actnsens_i,
  input  logic [7:0] mine_i,      // data channels that this line carries
  input  logic       ssi_i,
  input  logic       nocrc_i,
  // control
  input  logic       start_i,
  input  logic       next_i,      // the current word is complete
  output logic       actuator_o,  // there is an actuator on this line
  // frame length
  output logic       len_valid_o,
  output logic [6:0] len_o,
  // current word
  output logic       any_o,
  output logic       last_o,
  output logic [2:0] slave_o,
  output mb4_pkg::word_cfg_t word_o
);

  logic [7:0]  enabled;
  logic [7:0]  todo_d;
  logic [7:0]  todo_q;
  logic [7:0]  sum_d;
  logic [7:0]  sum_q;     // words whose length has not been offered
  logic        summing;
  logic [2:0]  first;
  logic [2:0]  last;
  logic [2:0]  slave;
  logic [4:0]  crc_len;
  logic [15:0] crc_poly;
  logic [15:0] crc_top;
  logic        actuator;
  logic        stop;
  logic        crc_room;
  mb4_pkg::slave_cfg_t cfg;
  logic        unused;

  always_comb begin
    for (int i = 0; i < 8; i++) begin
      // ENSCDx is bit 6 of the data channel's first byte.
      enabled[i] = slave_cfg_i[i*mb4_pkg::SLAVE_CFG_W + 6] && mine_i[i];
    end
  end

  always_comb begin
    first = 3'd0;
    last  = 3'd0;
    for (int i = 0; i < 8; i++) begin
      if (todo_q[7-i]) first = 3'(7 - i);
      if (sum_q[i])    last  = 3'(i);
    end
  end

  // Bits that the list itself has used.
  assign unused  = cfg.enscd;
  assign summing = Sum && sum_q != 8'h00;
  assign slave   = summing ? last : first;
  assign cfg     = slave_cfg_i[slave*mb4_pkg::SLAVE_CFG_W +: mb4_pkg::SLAVE_CFG_W];

  mb4_crc_decode u_decode (
    .selcrc_i   (cfg.selcrc),
    .crc_code_i (cfg.crc_code),
    .crc_len_o  (crc_len),
    .crc_poly_o (crc_poly),
    .crc_top_o  (crc_top)
  );

  always_comb begin
    todo_d = todo_q;
    sum_d  = sum_q;
    if (start_i) begin
      todo_d = enabled;
      sum_d  = Sum ? enabled : 8'h00;
    end else begin
      if (summing) sum_d[last] = 1'b0;
      if (next_i)  todo_d = todo_q & (todo_q - 8'd1);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      todo_q <= 8'h00;
      sum_q  <= 8'h00;
    end else begin
      todo_q <= todo_d;
      sum_q  <= sum_d;
    end
  end

  assign actuator_o = (enabled & actnsens_i) != 8'h00 && !ssi_i;

  assign actuator = actnsens_i[slave] && !ssi_i;
  assign stop     = actuator && cfg.gray_lstop;

  assign len_valid_o = summing;
  assign len_o       = 7'(cfg.scdlen) + 7'd1 + 7'(crc_len) + 7'(stop);

  assign any_o   = todo_q != 8'h00;
  assign last_o  = (todo_q & (todo_q - 8'd1)) == 8'h00;
  assign slave_o = slave;

  // The CRC is stored only if the data leave its byte(s) free (page 26).
  assign crc_room = crc_len[4] ? cfg.scdlen < 6'd48 : cfg.scdlen < 6'd56;

  assign word_o = {cfg.scdlen, crc_len, crc_poly, crc_top, cfg.crc_start,
                   crc_room && !nocrc_i && crc_len != 5'd0, ssi_i && cfg.gray_lstop, actuator,
                   stop};

endmodule
