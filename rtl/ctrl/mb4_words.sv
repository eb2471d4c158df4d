// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Word lists of both lines. Each line has one list for the words on SL and one for the words on MO;
// the MO list also counts the bits of the frame.
//
// Clock domain: core. Timing and misuse: mb4_word_list. Each list reads the configuration of its
// data channel on its own port. With SLAVELOC5 = 1 line 2 has the data channels 5..8, otherwise
// line 1 has all eight. actuator_o: the line has an actuator among its words.
// Vectors: bit i of a vector {2, 1} is for line i + 1; wider fields are slices.
// Datasheet: pages 23..26, Tables 10, 17.

module mb4_words (
  input  logic        clk_i,
  input  logic        rst_ni,
  // configuration
  input  logic [7:0]  enscd_i,
  output logic [3:0]  cfg_en_o,    // lists {MO 2, MO 1, SL 2, SL 1}
  output logic [11:0] cfg_slave_o,
  input  logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_i,
  input  logic [7:0]  actnsens_i,
  input  logic        slaveloc5_i,
  input  logic        nocrc_i,
  input  logic [1:0]  ssi_i,
  input  logic        start_i,
  output logic [1:0]  actuator_o,
  // frame length
  output logic [1:0]  len_valid_o,
  output logic [13:0] len_o,
  // SL
  input  logic [1:0]  rx_next_i,
  output logic [1:0]  rx_any_o,
  output logic [1:0]  rx_last_o,
  output logic [5:0]  rx_slave_o,
  output logic [2*mb4_pkg::WORD_CFG_W-1:0] rx_word_o,
  // MO
  input  logic [1:0]  mo_next_i,
  output logic [1:0]  mo_any_o,
  output logic [1:0]  mo_last_o,
  output logic [5:0]  mo_slave_o,
  output logic [2*mb4_pkg::WORD_CFG_W-1:0] mo_word_o
);

  localparam int unsigned C = mb4_pkg::SLAVE_CFG_W;
  localparam int unsigned W = mb4_pkg::WORD_CFG_W;

  logic [15:0] mine;
  logic [1:0]  rx_actuator;
  logic [1:0]  rx_len_valid;
  logic [13:0] rx_len;
  logic        unused;

  assign mine = slaveloc5_i ? 16'hF00F : 16'h00FF;

  for (genvar i = 0; i < 2; i++) begin : gen_line
    mb4_word_list #(.Sum(1'b0)) u_rx (
      .clk_i,
      .rst_ni,
      .enscd_i,
      .actnsens_i,
      .mine_i      (mine[i*8 +: 8]),
      .ssi_i       (ssi_i[i]),
      .nocrc_i,
      .start_i,
      .next_i      (rx_next_i[i]),
      .cfg_en_o    (cfg_en_o[i]),
      .cfg_slave_o (cfg_slave_o[i*3 +: 3]),
      .cfg_i       (slave_cfg_i[i*C +: C]),
      .actuator_o  (rx_actuator[i]),
      .len_valid_o (rx_len_valid[i]),
      .len_o       (rx_len[i*7 +: 7]),
      .any_o       (rx_any_o[i]),
      .last_o      (rx_last_o[i]),
      .slave_o     (rx_slave_o[i*3 +: 3]),
      .word_o      (rx_word_o[i*W +: W])
    );

    mb4_word_list u_mo (
      .clk_i,
      .rst_ni,
      .enscd_i,
      .actnsens_i,
      .mine_i      (mine[i*8 +: 8]),
      .ssi_i       (ssi_i[i]),
      .nocrc_i,
      .start_i,
      .next_i      (mo_next_i[i]),
      .cfg_en_o    (cfg_en_o[2 + i]),
      .cfg_slave_o (cfg_slave_o[(2 + i)*3 +: 3]),
      .cfg_i       (slave_cfg_i[(2 + i)*C +: C]),
      .actuator_o  (actuator_o[i]),
      .len_valid_o (len_valid_o[i]),
      .len_o       (len_o[i*7 +: 7]),
      .any_o       (mo_any_o[i]),
      .last_o      (mo_last_o[i]),
      .slave_o     (mo_slave_o[i*3 +: 3]),
      .word_o      (mo_word_o[i*W +: W])
    );
  end

  // Only the MO list counts the bits.
  assign unused = ^{rx_actuator, rx_len_valid, rx_len};

endmodule
