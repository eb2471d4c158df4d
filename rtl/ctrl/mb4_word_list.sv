// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Word list of one physical channel: which data channel comes next, and how long the frame is.
//
// Clock domain: core. start_i takes the list of words (enabled data channels of this line, lowest
// first = next to SL first). In the 8 clocks after it len_o is offered once for every data channel
// with len_valid_o: its data and CRC bits, 0 if it takes no part. word_o is the current word, valid
// two clocks after start_i's eight and one clock after next_i.
// Misuse: the configuration must not change between start_i and the end of the frame.
// Datasheet: pages 23..26; order of words: protocol of the chain, first slave first.

module mb4_word_list (
  input  logic       clk_i,
  input  logic       rst_ni,
  // configuration
  input  logic [mb4_pkg::NUM_SLAVES*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_i,
  input  logic [7:0] mine_i,      // data channels that this line carries
  input  logic       nocrc_i,
  // control
  input  logic       start_i,
  input  logic       next_i,      // the current word is complete
  // frame length
  output logic       len_valid_o,
  output logic [6:0] len_o,
  // current word
  output logic       any_o,
  output logic       last_o,
  output logic [2:0] slave_o,
  output mb4_pkg::word_cfg_t word_o
);

  logic [3:0]  count_d;
  logic [3:0]  count_q;   // 0..7: summing, 8: done
  logic [7:0]  todo_d;
  logic [7:0]  todo_q;
  logic [2:0]  first;
  logic [2:0]  slave;
  logic        summing;
  logic        enabled;
  logic [4:0]  crc_len;
  logic [15:0] crc_poly;
  logic [15:0] crc_top;
  mb4_pkg::slave_cfg_t cfg;

  always_comb begin
    first = 3'd0;
    for (int i = 7; i >= 0; i--) begin
      if (todo_q[i]) first = 3'(i);
    end
  end

  assign summing = !count_q[3];
  assign slave   = summing ? count_q[2:0] : first;
  assign cfg     = slave_cfg_i[slave*mb4_pkg::SLAVE_CFG_W +: mb4_pkg::SLAVE_CFG_W];
  assign enabled = cfg.enscd && mine_i[slave];

  mb4_crc_decode u_decode (
    .selcrc_i   (cfg.selcrc),
    .crc_code_i (cfg.crc_code),
    .crc_len_o  (crc_len),
    .crc_poly_o (crc_poly),
    .crc_top_o  (crc_top)
  );

  always_comb begin
    count_d = count_q;
    todo_d  = todo_q;
    if (start_i) begin
      count_d = 4'd0;
      todo_d  = 8'h00;
    end else if (summing) begin
      count_d = count_q + 4'd1;
      todo_d  = {enabled, todo_q[7:1]};
    end else if (next_i) begin
      todo_d  = todo_q & (todo_q - 8'd1);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q <= 4'd8;
      todo_q  <= 8'h00;
    end else begin
      count_q <= count_d;
      todo_q  <= todo_d;
    end
  end

  assign len_valid_o = summing;
  assign len_o       = enabled ? 7'(cfg.scdlen) + 7'd1 + 7'(crc_len) : 7'd0;

  assign any_o   = todo_q != 8'h00;
  assign last_o  = (todo_q & (todo_q - 8'd1)) == 8'h00;
  assign slave_o = slave;

  // The CRC is stored only if the data leave its byte(s) free (page 26).
  logic crc_room;
  assign crc_room = crc_len[4] ? cfg.scdlen < 6'd48 : cfg.scdlen < 6'd56;

  assign word_o = {cfg.scdlen, crc_len, crc_poly, crc_top, cfg.crc_start,
                   crc_room && !nocrc_i && crc_len != 5'd0};

endmodule
