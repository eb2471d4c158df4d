// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Word list of one line: tells which data channel comes next, and how long the frame is.
//
// Clock domain: core. start_i takes the list of words: the enabled data channels of this line,
// lowest first. The lowest is the slave next to SL. Channels names the data channels that the line
// can have; enscd_i of the others must be 0.
// Latency: offer_o is the current word. It is valid one clock after start_i and one clock after
// next_i. With Sum = 1 the module first walks through the list once: from the clock after start_i
// on, len_last_o gives the bits of one word, minus 1, in each clock, with len_valid_o. offer_o is
// the first word when len_valid_o has fallen.
// Misuse: if start_i comes while idle_i = 0, a list of one data channel takes an old row.
// If the host changes the configuration between start_i and the end of the frame, the frame
// may have other words or fail by its flags, but it ends (decision 38).
// Datasheet: pages 23..26; order of the words: protocol of the chain, first slave first.

module mb4_word_list #(
  parameter bit Sum = 1'b1,
  parameter logic [7:0] Channels = 8'hFF
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  // configuration
  input  logic [7:0] enscd_i,    // enabled data channels of this line
  input  logic [7:0] actnsens_i,
  input  logic       ssi_i,
  input  logic       nocrc_i,
  // control
  input  logic       idle_i,      // no frame runs; start_i comes only then
  input  logic       start_i,
  input  logic       next_i,      // the current word is complete
  output logic       cfg_en_o,
  output logic [2:0] cfg_slave_o, // data channel whose configuration is needed
  input  mb4_pkg::slave_cfg_t cfg_i,  // its configuration, one clock later
  output logic       actuator_o,  // the line has an actuator, unless it is SSI
  // frame length
  output logic       len_valid_o,
  output logic [6:0] len_last_o,  // bits of a word minus 1
  output biss_pkg::offer_t offer_o  // the current word
);

  // The lowest data channel of a set. For the empty set it is the lowest that the line can have.
  function automatic logic [2:0] lowest(input logic [7:0] channels);
    lowest = 3'd0;
    for (int i = 7; i >= 0; i--) begin
      if (Channels[i]) lowest = 3'(i);
    end
    for (int i = 7; i >= 0; i--) begin
      if (channels[i]) lowest = 3'(i);
    end
  endfunction

  localparam logic [2:0] LOWEST = lowest(8'h00);
  localparam bit ONE = (Channels & (Channels - 8'd1)) == 8'h00;

  logic [7:0]  enscd_q;    // of this frame
  logic        any_d;
  logic        any_q;      // there is a current word
  logic [7:0]  rest;       // words after the current one
  logic        begins;     // next clock: the first word
  logic        steps;      // next clock: another word, or none
  logic        summing_d;
  logic        summing_q;  // the walk that sums up the lengths
  logic [2:0]  first_new;
  logic [2:0]  first_rest;
  logic [2:0]  first_next;  // without start_i
  logic [2:0]  slave_d;
  logic [2:0]  slave_q;
  logic        actuator;
  logic        stop;
  logic        crc_room;
  biss_pkg::word_t word;
  logic        last;
  logic        unused;

  // Not needed: enscd_i tells the same, and no word precedes channel 0.
  assign unused = cfg_i.enscd ^ enscd_q[0] ^ idle_i;

  assign rest[0] = 1'b0;
  for (genvar i = 1; i < 8; i++) begin : gen_rest
    assign rest[i] = enscd_q[i] && slave_q < 3'(i);
  end

  assign begins = start_i || (summing_q && last);

  // Data channel of the next clock. Its configuration arrives together with it. start_i and next_i
  // come late, so both results are prepared and these inputs only choose.
  assign first_new  = lowest(enscd_i);
  assign first_rest = lowest(rest);

  assign first_next = (summing_q && last) ? first_new : first_rest;

  always_comb begin
    any_d     = begins ? enscd_i != 8'h00 : rest != 8'h00;
    slave_d   = start_i ? first_new : first_next;
    summing_d = Sum && (start_i ? enscd_i != 8'h00 : summing_q && !last);
  end

  // A list of one data channel needs no start_i, which comes late: while no frame runs it reads the
  // configuration in every clock.
  assign steps       = start_i || next_i || summing_q;
  assign cfg_en_o    = ONE ? idle_i || next_i || summing_q : steps;
  assign cfg_slave_o = slave_d;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      enscd_q   <= 8'h00;
      any_q     <= 1'b0;
      summing_q <= 1'b0;
      slave_q   <= LOWEST;
    end else begin
      if (start_i) enscd_q <= enscd_i;
      if (steps) begin
        any_q     <= any_d;
        summing_q <= summing_d;
        slave_q   <= slave_d;
      end
    end
  end

  assign actuator_o = (enscd_i & actnsens_i) != 8'h00;

  assign actuator = actnsens_i[slave_q] && !ssi_i;
  assign stop     = actuator && cfg_i.gray_lstop;

  assign len_valid_o = summing_q;
  assign len_last_o  = 7'(cfg_i.scdlen) + 7'(cfg_i.crc_last) + 7'(cfg_i.crc_on) +
                       7'(stop);

  assign last = rest == 8'h00;

  // The CRC is stored only if the data leave the top byte free, with 16 bits the top two (page 26).
  assign crc_room = !(cfg_i.scdlen[5:4] == 2'b11 && (cfg_i.scdlen[3] || cfg_i.crc_last[3]));

  assign word.data_last = cfg_i.scdlen;
  assign word.crc_on    = cfg_i.crc_on;
  assign word.crc_last  = cfg_i.crc_last;
  assign word.crc_poly  = {cfg_i.crc_poly, 1'b1};
  assign word.crc_start = cfg_i.crc_start;
  assign word.crc_store = crc_room && !nocrc_i && cfg_i.crc_on;
  assign word.gray      = ssi_i && cfg_i.gray_lstop;
  assign word.actuator  = actuator;
  assign word.stop      = stop;

  assign offer_o.any   = any_q;
  assign offer_o.last  = last;
  assign offer_o.slave = slave_q;
  assign offer_o.word  = word;

endmodule
