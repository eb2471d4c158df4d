// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Sensor data of all eight data channels with their validity flags. The lower half holds
// SCDATA1..4, the upper half SCDATA5..8; each half has two banks. The module brings the received
// bytes and words of both lines to the halves: with SLAVELOC5 = 1 line 2 owns the upper half,
// otherwise line 1 fills both. The line delay that INIT measures goes to byte 0 of the half of its
// line, into the bank that the host reads (decision 16).
//
// Features may leave out data channels: a half without any is no memory. Two lines with at most
// four data channels each have one half each. With one bank SWBANK splits no word.
//
// SWBANK may change the bank while a word is being received. Each bank then has a part of the word,
// and the word is not valid (decision 34). Bytes of the clock of bank_i.swap still go to the old
// bank; a word that ends in this clock is complete.
//
// Clock domains:
// - core,
// - rd_clk_i: reads of the host,
// - rd2_clk_i: second read port (SCDATA5..8 with Port2, SCDATA1..4 with Tap).
// Latency: what a line brings (bytes, delays, flags of SVALID) takes effect one clock late, in the
// bank of its own clock. Read data are valid after the edge with the enable. A read gives the bytes
// and flags of both banks, bank 1 above bank 0.
// Vectors: bit i of a vector {2, 1} is for line i + 1. Host writes and clears act on the bank that
// the host had at the write; it comes with them (mb4_reg_file).
// Datasheet: pages 23, 26, 32, 33, 35, Tables 10, 20, 49, 61.

module mb4_scd_store #(
  parameter bit Port2 = 1'b0,
  parameter bit Tap   = 1'b0,  // the second read port reads the lower half too
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       slaveloc5_i,
  input  mb4_pkg::banks_t    banks_i,
  input  mb4_pkg::bank_cmd_t bank_i,
  input  mb4_pkg::mem_wr_t   clear_i,  // after reset
  // host, posted into the core domain
  input  logic       post_valid_i,
  input  mb4_pkg::posted_t post_i,
  output logic       post_ready_o,    // also 1 if the byte is not for this module
  // host read port
  input  logic        rd_clk_i,
  input  mb4_pkg::mem_rd_t rd_i,
  output logic [15:0] rd_lo_data_o,
  output logic [15:0] rd_hi_data_o,
  output logic [15:0] svalid_o,
  // second host read port
  input  logic        rd2_clk_i,
  input  mb4_pkg::mem_rd_t rd2_i,
  output logic [15:0] rd2_data_o,
  output logic [15:0] rd2_lo_data_o,  // of SCDATA1..4, with Tap
  // actuator data for MO of lines {2, 1}, one clock later
  input  logic [2*biss_pkg::MO_READ_W-1:0] mo_read_i,
  output logic [15:0] mo_data_o,
  // received bytes and words of lines {2, 1}
  input  logic [2*biss_pkg::LINE_DATA_W-1:0] data_i,
  output logic [1:0]  word_bad_o       // a word ends: its CRC is wrong, or it is split
);

  localparam bit TWO_LINES = Features[mb4_pkg::TWO_LINES_LSB];
  localparam bit TWO_BANKS = Features[mb4_pkg::TWO_BANKS_LSB];
  localparam logic [3:0] SLAVES  = Features[mb4_pkg::SLAVES_LSB +: 4];
  localparam logic [7:0] PRESENT = mb4_pkg::channels(TWO_LINES, SLAVES);
  localparam bit         UPPER   = PRESENT[7:4] != 4'h0;

  logic       post_bank;
  logic       post_lo, post_hi, post_svalid_lo, post_svalid_hi;
  logic [3:0] keep;
  logic       ready_lo, ready_hi;
  biss_pkg::line_data_t data1, data2;
  biss_pkg::mo_read_t   mo1, mo2, hi_mo;
  logic       second;              // line 2 owns the upper half
  logic [1:0] split, ok, split_q;  // the word being received is split
  logic       hi_en, hi_first, hi_done, hi_ok, hi_split;
  logic [2:0] hi_slave, hi_byte;   // word of the line that owns the upper half
  mb4_pkg::mem_wr_t lo_wr_d, lo_wr_q, hi_wr_d, hi_wr_q;
  mb4_pkg::word_flag_t lo_flag_d, lo_flag_q, hi_flag_d, hi_flag_q;
  logic       flag_bank_q;
  logic       mo_en;
  logic [7:0] lo_mo_data, hi_mo_data;
  logic [15:0] hi_data;
  mb4_pkg::mem_rd_t rd, rd2, lo_mo_rd, hi_mo_rd;
  mb4_pkg::mem_wr_t lo_post, hi_post;
  logic [7:0] svalid_lo, svalid_hi;

  // SVALID1..4 is at an odd address, SVALID5..8 at the next one.
  assign post_lo        = post_valid_i && !post_i.elsewhere && !post_i.addr[5];
  assign post_hi        = post_valid_i && !post_i.elsewhere && post_i.addr[5];
  assign post_svalid_lo = post_valid_i && post_i.elsewhere && post_i.select && post_i.addr[0];
  assign post_svalid_hi = post_valid_i && post_i.elsewhere && post_i.select && post_i.addr[1];
  assign post_ready_o   = (ready_lo || !post_lo) && (ready_hi || !post_hi);

  for (genvar i = 0; i < 4; i++) begin : gen_keep
    assign keep[i] = post_i.data[mb4_regs_pkg::SVALID_LSB + mb4_regs_pkg::SVALID_LSB_STEP * i];
  end

  // A single bank is bank 0 of its memory.
  assign post_bank = TWO_BANKS && post_i.select;
  assign rd.en     = rd_i.en;
  assign rd.addr   = {TWO_BANKS && rd_i.addr[5], rd_i.addr[4:0]};
  assign rd2.en    = rd2_i.en;
  assign rd2.addr  = {TWO_BANKS && rd2_i.addr[5], rd2_i.addr[4:0]};

  assign data1 = data_i[0 +: biss_pkg::LINE_DATA_W];
  assign data2 = data_i[biss_pkg::LINE_DATA_W +: biss_pkg::LINE_DATA_W];
  assign mo1 = mo_read_i[0 +: biss_pkg::MO_READ_W];
  assign mo2 = mo_read_i[biss_pkg::MO_READ_W +: biss_pkg::MO_READ_W];

  // ---- words ----------------------------------------------------------------------------------

  assign split      = {data2.rx.open, data1.rx.open} & {2{bank_i.swap && TWO_BANKS}};
  assign ok         = {data2.rx.ok, data1.rx.ok} & ~split_q;
  assign word_bad_o = {data2.rx.done, data1.rx.done} & ~ok;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) split_q <= '0;
    else         split_q <= (split_q | split) & {data2.rx.open, data1.rx.open};
  end

  assign second   = TWO_LINES && (slaveloc5_i || !SLAVES[3]);
  assign hi_slave = second ? data2.rx.slave : data1.rx.slave;
  assign hi_en    = second ? data2.rx.wr_en : data1.rx.wr_en;
  assign hi_byte  = second ? data2.rx.wr_byte : data1.rx.wr_byte;
  assign hi_first = second ? data2.rx.first : data1.rx.first;
  assign hi_done  = second ? data2.rx.done : data1.rx.done;
  assign hi_ok    = second ? ok[1] : ok[0];
  assign hi_split = second ? split[1] : split[0];

  // Assignments field by field: the simulator then sees which fields matter.
  assign lo_wr_d.en   = data1.delay_en || (data1.rx.wr_en && !data1.rx.slave[2]);
  assign lo_wr_d.addr = data1.delay_en ? {banks_i.host, 5'd0}
                                       : {banks_i.eng, data1.rx.slave[1:0], data1.rx.wr_byte};
  assign lo_wr_d.data = data1.delay_en ? data1.delay : data1.rx.wr_data;
  assign hi_wr_d.en   = data2.delay_en || (hi_slave[2] && hi_en);
  assign hi_wr_d.addr = data2.delay_en ? {banks_i.host, 5'd0}
                                       : {banks_i.eng, hi_slave[1:0], hi_byte};
  assign hi_wr_d.data = data2.delay_en ? data2.delay
                                       : second ? data2.rx.wr_data : data1.rx.wr_data;

  assign lo_flag_d.slave  = data1.rx.slave[1:0];
  assign lo_flag_d.begins = data1.rx.first && !data1.rx.slave[2];
  assign lo_flag_d.done   = data1.rx.done && !data1.rx.slave[2];
  assign lo_flag_d.ok     = ok[0];
  assign lo_flag_d.split  = split[0] && !data1.rx.slave[2];
  assign hi_flag_d.slave  = hi_slave[1:0];
  assign hi_flag_d.begins = hi_first && hi_slave[2];
  assign hi_flag_d.done   = hi_done && hi_slave[2];
  assign hi_flag_d.ok     = hi_ok;
  assign hi_flag_d.split  = hi_split && hi_slave[2];

  // A byte of a line comes late in its clock, and the host's byte waits for it. So the memories and
  // SVALID get what the lines bring one clock later, with the bank of its own clock. The end of a
  // frame switches the banks after that.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      lo_wr_q     <= '0;
      hi_wr_q     <= '0;
      lo_flag_q   <= '0;
      hi_flag_q   <= '0;
      flag_bank_q <= 1'b0;
    end else begin
      lo_wr_q     <= lo_wr_d;
      hi_wr_q     <= hi_wr_d;
      lo_flag_q   <= lo_flag_d;
      hi_flag_q   <= hi_flag_d;
      flag_bank_q <= banks_i.eng;
    end
  end

  // ---- memories -------------------------------------------------------------------------------

  assign hi_mo     = second ? mo2 : mo1;
  assign mo_en     = mo1.rd_en || mo2.rd_en;
  assign mo_data_o = {hi_mo_data, mo1.slave[2] ? hi_mo_data : lo_mo_data};

  assign lo_mo_rd.en   = mo_en;
  assign lo_mo_rd.addr = {banks_i.eng, mo1.slave[1:0], mo1.place};
  assign hi_mo_rd.en   = mo_en;
  assign hi_mo_rd.addr = {banks_i.eng, hi_mo.slave[1:0], hi_mo.place};
  assign lo_post.en    = post_lo;
  assign lo_post.addr  = {post_bank, post_i.addr[4:0]};
  assign lo_post.data  = post_i.data;
  assign hi_post.en    = post_hi;
  assign hi_post.addr  = {post_bank, post_i.addr[4:0]};
  assign hi_post.data  = post_i.data;

  mb4_memory #(.Banks(TWO_BANKS), .Port2(Tap)) u_scd_lo (
    .clk_i,
    .clear_i,
    .eng_wr_i     (lo_wr_q),
    .eng_rd_i     (lo_mo_rd),
    .eng_data_o   (lo_mo_data),
    .host_wr_i    (lo_post),
    .host_ready_o (ready_lo),
    .rd_clk_i,
    .rd_i         (rd),
    .rd_data_o    (rd_lo_data_o),
    .rd2_clk_i,
    .rd2_i        (rd2),
    .rd2_data_o   (rd2_lo_data_o)
  );

  mb4_memory #(.Banks(TWO_BANKS), .Port2(Port2 && UPPER)) u_scd_hi (
    .clk_i,
    .clear_i,
    .eng_wr_i     (hi_wr_q),
    .eng_rd_i     (hi_mo_rd),
    .eng_data_o   (hi_mo_data),
    .host_wr_i    (hi_post),
    .host_ready_o (ready_hi),
    .rd_clk_i,
    .rd_i         (rd),
    .rd_data_o    (hi_data),
    .rd2_clk_i,
    .rd2_i        (rd2),
    .rd2_data_o
  );

  assign rd_hi_data_o = hi_data & {16{UPPER}};

  // Validity flags of the lower and the upper four data channels.
  mb4_svalid #(.Channels(PRESENT[3:0]), .TwoBanks(TWO_BANKS)) u_svalid_lo (
    .clk_i,
    .rst_ni,
    .eng_bank_i  (flag_bank_q),
    .begin_i     (lo_flag_q.begins),
    .set_en_i    (lo_flag_q.done),
    .set_slave_i (lo_flag_q.slave),
    .set_valid_i (lo_flag_q.ok),
    .split_i     (lo_flag_q.split),
    .clear_i     (bank_i.clear),
    .keep_en_i   (post_svalid_lo),
    .keep_i      (keep),
    .keep_bank_i (post_i[13]),
    .svalid_o    (svalid_lo)
  );

  mb4_svalid #(.Channels(PRESENT[7:4]), .TwoBanks(TWO_BANKS)) u_svalid_hi (
    .clk_i,
    .rst_ni,
    .eng_bank_i  (flag_bank_q),
    .begin_i     (hi_flag_q.begins),
    .set_en_i    (hi_flag_q.done),
    .set_slave_i (hi_flag_q.slave),
    .set_valid_i (hi_flag_q.ok),
    .split_i     (hi_flag_q.split),
    .clear_i     (bank_i.clear),
    .keep_en_i   (post_svalid_hi),
    .keep_i      (keep),
    .keep_bank_i (post_i[13]),
    .svalid_o    (svalid_hi)
  );

  assign svalid_o = {svalid_hi[7:4], svalid_lo[7:4], svalid_hi[3:0], svalid_lo[3:0]};

  // The enables of MO are common.
  logic unused;
  assign unused = ^{mo1, mo2, hi_mo, rd_i, rd2_i};

endmodule
