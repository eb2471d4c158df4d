// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The last word of each channel for a host without the stream, in every mode: position, flags, and
// the number of the read that brought it. The words show the channel of index_i.
//
// Reads are counted from 1 on, modulo 2^16; a soft reset begins anew. A channel has the number of
// the last read that it has ended, good or not, so a number that has not moved is no new word, and
// one that has moved by more than 1 tells how many the host has missed. A word that is not good
// has position 0, nE = 0 and nW = 0.
//
// Clock domain: core. An access never waits. Reading LAST_STATUS copies the position that belongs
// to it: the two words of the position are those of this moment until LAST_STATUS is read again.
//
// Misuse: an index beyond the last channel reads 0.
// Source: regmap/axi.rdl.

module axi_last #(
  parameter int unsigned Channels = 1,
  parameter bit          Wide     = 1'b0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,      // soft reset
  input  axi_pkg::bus_t bus_i,
  input  logic [3:0]  index_i,
  output logic [31:0] data_o,
  input  logic        start_i,      // a read begins
  input  logic        check_i,      // a wrong CRC makes its words bad
  input  logic [Channels-1:0] enabled_i,
  input  logic [Channels*axi_pkg::EVENT_W-1:0] events_i,
  input  logic [Channels*axi_pkg::WORD_W-1:0]  words_i,
  input  logic [Channels*axi_pkg::MORE_W-1:0]  mores_i
);

  localparam int unsigned POSITION_W = Wide ? 64 : 32;

  logic [15:0] number_q;             // of the read that runs, or of the last one
  logic [Channels-1:0] ended_q;      // the channel has ended it
  logic [Channels-1:0] good_q;
  logic [Channels-1:0] crc_q;
  logic [Channels-1:0] late_q;
  logic        ended, good, crc, late;    // of the channel of index_i
  logic [axi_pkg::WORD_W-1:0] word;
  logic [31:0] high;
  logic        present;
  logic [15:0] number;
  logic [POSITION_W-1:0] copy_q;
  logic        unused;

  for (genvar i = 0; i < Channels; i++) begin : gen_channel
    localparam int unsigned AT = i * axi_pkg::EVENT_W;
    logic end_now, end_late, end_crc, end_good;

    assign end_late = events_i[AT + axi_pkg::EVENT_LATE];
    assign end_crc  = events_i[AT + axi_pkg::EVENT_CRC_ERROR];
    assign end_good = events_i[AT + axi_pkg::EVENT_ENDED] && !(end_crc && check_i);
    assign end_now  = events_i[AT + axi_pkg::EVENT_ENDED] ||
                      events_i[AT + axi_pkg::EVENT_FAILED] || end_late;

    // They change in the clock in which the channel's word does.
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        ended_q[i] <= 1'b1;
        good_q[i]  <= 1'b0;
        crc_q[i]   <= 1'b0;
        late_q[i]  <= 1'b0;
      end else begin
        ended_q[i] <= end_now || clear_i || (ended_q[i] && !start_i);
        good_q[i]  <= enabled_i[i] && !clear_i && (end_now ? end_good : good_q[i]);
        crc_q[i]   <= enabled_i[i] && !clear_i && (end_now ? end_crc : crc_q[i]);
        late_q[i]  <= enabled_i[i] && !clear_i && (end_now ? end_late : late_q[i]);
      end
    end
  end

  always_comb begin
    ended   = 1'b0;
    good    = 1'b0;
    crc     = 1'b0;
    late    = 1'b0;
    word    = '0;
    high    = '0;
    present = 1'b0;
    for (int unsigned i = 0; i < Channels; i++) begin
      if (index_i == 4'(i)) begin
        ended   = ended_q[i];
        good    = good_q[i];
        crc     = crc_q[i];
        late    = late_q[i];
        word    = words_i[i*axi_pkg::WORD_W +: axi_pkg::WORD_W];
        high    = mores_i[i*axi_pkg::MORE_W + axi_pkg::MORE_POSITION +: 32];
        present = 1'b1;
      end
    end
  end

  assign number = number_q - 16'(!ended);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      number_q <= '0;
      copy_q   <= '0;
    end else begin
      number_q <= clear_i ? 16'd0 : number_q + 16'(start_i);
      if (bus_i.rd && bus_i.addr == axi_regs_pkg::ADDR_LAST_STATUS)
        copy_q <= POSITION_W'({high, word[axi_pkg::WORD_POSITION +: 32]}) & {POSITION_W{good}};
    end
  end

  always_comb begin
    data_o = '0;
    unique case (bus_i.addr)
      axi_regs_pkg::ADDR_LAST_STATUS: begin
        data_o[31:16] = number & {16{present}};
        data_o[4]     = late;
        data_o[3]     = crc;
        data_o[2]     = good && word[axi_pkg::WORD_NWARN];
        data_o[1]     = good && word[axi_pkg::WORD_NERR];
        data_o[0]     = good;
      end
      axi_regs_pkg::ADDR_LAST_POSITION:      data_o = copy_q[31:0];
      axi_regs_pkg::ADDR_LAST_POSITION_HIGH: data_o = Wide ? copy_q[POSITION_W-1 -: 32] : 32'd0;
      default:                               data_o = '0;
    endcase
  end

  assign unused = (^events_i) ^ bus_i.wr ^ (^bus_i.data) ^ (^words_i) ^ (^mores_i) ^ (^high) ^
                  (^word);

endmodule
