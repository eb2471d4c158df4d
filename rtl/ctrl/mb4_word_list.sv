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
  input  logic [7:0] enscd_i,
  input  logic [7:0] actnsens_i,
  input  logic [7:0] mine_i,      // data channels that this line carries
  input  logic       ssi_i,
  input  logic       nocrc_i,
  // control
  input  logic       start_i,
  input  logic       next_i,      // the current word is complete
  output logic       cfg_en_o,
  output logic [2:0] cfg_slave_o, // configuration wanted ...
  input  mb4_pkg::slave_cfg_t cfg_i,  // ... one clock later
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
  logic [7:0]  rest;       // behind the current word
  logic [7:0]  sum_d;
  logic [7:0]  sum_q;     // words whose length has not been offered
  logic        summing;
  logic [7:0]  sum_left;   // ... behind the one that is being offered
  logic [2:0]  first_new;
  logic [2:0]  first_todo;
  logic [2:0]  first_rest;
  logic [2:0]  last_new;
  logic [2:0]  last_left;
  logic [2:0]  slave_d;
  logic [2:0]  slave_q;
  logic [4:0]  crc_len;
  logic [7:0]  crc_poly;
  logic [7:0]  crc_top;
  logic        actuator;
  logic        stop;
  logic        crc_room;
  logic        unused;

  assign enabled = enscd_i & mine_i;
  assign rest    = todo_q & (todo_q - 8'd1);
  assign summing = Sum && sum_q != 8'h00;
  // Known from enscd_i.
  assign unused  = cfg_i.enscd;

  mb4_crc_decode u_decode (
    .selcrc_i   (cfg_i.selcrc),
    .crc_code_i (cfg_i.crc_code),
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
      if (summing) sum_d = sum_left;
      if (next_i)  todo_d = rest;
    end
  end

  // The data channel of the next clock, so that its configuration is there with it. start_i and
  // next_i come late: each case is known before, and they only choose.
  assign sum_left = sum_q & ~(8'h01 << slave_q);

  always_comb begin
    first_new  = 3'd0;
    first_todo = 3'd0;
    first_rest = 3'd0;
    last_new   = 3'd0;
    last_left  = 3'd0;
    for (int i = 0; i < 8; i++) begin
      if (enabled[7-i]) first_new  = 3'(7 - i);
      if (todo_q[7-i])  first_todo = 3'(7 - i);
      if (rest[7-i])    first_rest = 3'(7 - i);
      if (enabled[i])   last_new   = 3'(i);
      if (sum_left[i])  last_left  = 3'(i);
    end
  end

  always_comb begin
    if (start_i)                            slave_d = Sum ? last_new : first_new;
    else if (summing && sum_left != 8'h00)  slave_d = last_left;
    else if (next_i)                        slave_d = first_rest;
    else                                    slave_d = first_todo;
  end

  assign cfg_en_o    = start_i || next_i || summing;
  assign cfg_slave_o = slave_d;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      todo_q  <= 8'h00;
      sum_q   <= 8'h00;
      slave_q <= 3'd0;
    end else if (cfg_en_o) begin
      todo_q  <= todo_d;
      sum_q   <= sum_d;
      slave_q <= slave_d;
    end
  end

  assign actuator_o = (enabled & actnsens_i) != 8'h00 && !ssi_i;

  assign actuator = actnsens_i[slave_q] && !ssi_i;
  assign stop     = actuator && cfg_i.gray_lstop;

  assign len_valid_o = summing;
  assign len_o       = 7'(cfg_i.scdlen) + 7'd1 + 7'(crc_len) + 7'(stop);

  assign any_o   = todo_q != 8'h00;
  assign last_o  = rest == 8'h00;
  assign slave_o = slave_q;

  // The CRC is stored only if the data leave its byte(s) free (page 26).
  assign crc_room = crc_len[4] ? cfg_i.scdlen < 6'd48 : cfg_i.scdlen < 6'd56;

  assign word_o = {cfg_i.scdlen, crc_len, crc_poly, crc_top, cfg_i.crc_start,
                   crc_room && !nocrc_i && crc_len != 5'd0, ssi_i && cfg_i.gray_lstop, actuator,
                   stop};

endmodule
