// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Core half of the page at 0x100 of a bus top: time, frame numbers, snapshots and events.
//
// - A frame of a line is stamped with the clock of the edge at which its slaves latch: the first
//   rising edge of MA in BiSS, the first falling one in SSI. Frames of a line count from 1 on;
//   INIT and BiSS B register accesses do not count.
// - A word that ends keeps number and time of its frame, in the bank to which it goes.
// - A request copies the time, or all words of the snapshot of one data channel, into a shadow
//   memory that the bus reads. If the banks switch meanwhile, or the line writes to the very word
//   (one bank), the copy begins again. So it has one frame's data, flags, number and time, and
//   nothing is held: frames and banks do not notice. The eighth copy ends in any case: it then has
//   SVALID = 0, number and time 0.
//
// Clock domains: clk_i (core). page_i and shadow_* are of the bus: page_i.req changes with
// the rest of page_i, which then stays; ack_o follows it when the shadow is filled.
// Latency: at most 20 clocks for the time, 33 for a snapshot. A copy begins 16 clocks after its
// request, when the core has acted on all writes to 0xF4 that came before. One that begins again
// needs up to 15 clocks more, seven times at most.
// The words of a data channel that the core does not have are 0.
// Misuse: none. A snapshot with one bank while its word is being received has SVALID = 0.
// Source: datasheet pages 12..16; decision 45.

module mb4_page #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  mb4_pkg::tap_t tap_i,
  // pins
  input  logic        getsens_i,
  input  logic        ner_i,
  // second read port of SCDATA; data come with tap_i
  output logic        rd_en_o,
  output logic [4:0]  rd_addr_o,
  // bus
  input  mb4_pkg::page_req_t page_i,
  output logic        ack_o,
  output logic        beat_o,      // changes every 8 clocks
  output logic [4:0]  event_o,     // as in enc_irq
  input  logic        shadow_clk_i,
  input  logic        shadow_en_i,
  input  logic [5:0]  shadow_addr_i,  // channel, row; rows 6 and 7 of channel 1: time
  output logic [31:0] shadow_data_o
);

  localparam int unsigned TAG_W = 96;

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  // The map of the page has the bits of mb4_pkg.
  if (mb4_page_regs_pkg::RESET_FEATURES != mb4_pkg::FEATURES_FULL ||
      mb4_page_regs_pkg::FEATURES_FULL != mb4_pkg::FEATURES_FULL ||
      mb4_page_regs_pkg::FEATURES_BYTE != 32'(mb4_pkg::ADDR_FEATURES) ||
      mb4_page_regs_pkg::FREE_CRC_LSB != mb4_pkg::FREE_CRC_LSB ||
      mb4_page_regs_pkg::SLAVES_ON_LINE_LSB != mb4_pkg::SLAVES_ON_LINE_LSB ||
      mb4_page_regs_pkg::CONTROL_LSB != mb4_pkg::CONTROL_LSB ||
      mb4_page_regs_pkg::MO_LSB != mb4_pkg::MO_LSB ||
      mb4_page_regs_pkg::SSI_LSB != mb4_pkg::SSI_LSB ||
      mb4_page_regs_pkg::BISS_B_LSB != mb4_pkg::BISS_B_LSB ||
      mb4_page_regs_pkg::TWO_LINES_LSB != mb4_pkg::TWO_LINES_LSB ||
      mb4_page_regs_pkg::GRAY_LSB != mb4_pkg::GRAY_LSB ||
      mb4_page_regs_pkg::FORCE_LSB != mb4_pkg::FORCE_LSB ||
      mb4_page_regs_pkg::TWO_BANKS_LSB != mb4_pkg::TWO_BANKS_LSB ||
      mb4_page_regs_pkg::SLAVES_LSB != mb4_pkg::SLAVES_LSB) begin : gen_map
    $error("FEATURES in mb4_page.rdl has not the bits of mb4_pkg");
  end
`endif

  localparam bit TWO_LINES = Features[mb4_pkg::TWO_LINES_LSB];
  localparam logic [7:0] PRESENT = mb4_pkg::channels(TWO_LINES,
                                                     Features[mb4_pkg::SLAVES_LSB +: 4]);

  typedef enum logic [1:0] {
    REST,
    SETTLE,
    COPY,
    STAMP
  } state_e;

  mb4_pkg::reg_tap_t regs;
  state_e      state_q;
  logic [3:0]  step_q;
  logic        req, ack_q;
  logic [63:0] now;
  // frames of lines {2, 1}
  logic [1:0]  latch;
  logic [1:0]  ma_q, fall_q, rise_q;   // MA has to fall, to rise, until the slaves latch
  logic [TAG_W-1:0] tag1_q, tag2_q;    // number, time
  // words
  logic        late_q;                 // a word of line 2 waits for the memory of tags
  logic [3:0]  late_addr_q;
  logic        tag_wr;
  logic [3:0]  tag_addr;               // bank, channel
  logic [TAG_W-1:0] tag;
  logic [15:0] tagged_q;               // words that have a tag
  logic        has_tag_q;
  // copy
  logic        host_q;
  logic [2:0]  tries_q;
  logic        last;
  logic        disturbed, again;
  logic [1:0]  hit, hit_q;
  logic [15:0] pair;
  logic [7:0]  data;
  logic [31:0] word_q;
  logic        line2;
  logic [31:0] row_data;
  logic        row_wr;
  logic [2:0]  row;
  // events
  logic        getsens, getsens_q, ner;
  logic [1:0]  blind_q;                // clocks until the pins have come through after a reset
  logic        pins;
  logic [4:0]  good, good_q;
  logic        regend_q;
  logic        unused;

  assign regs = tap_i.regs;

  enc_time u_time (
    .clk_i,
    .rst_ni,
    .time_o (now)
  );

  enc_sync_bit u_req (
    .clk_i,
    .rst_ni,
    .data_i (page_i.req),
    .data_o (req)
  );

  enc_sync_bit u_getsens (
    .clk_i,
    .rst_ni,
    .data_i (getsens_i),
    .data_o (getsens)
  );

  enc_sync_bit #(.ResetValue(1'b1)) u_ner (
    .clk_i,
    .rst_ni,
    .data_i (ner_i),
    .data_o (ner)
  );

  // ---- frames -----------------------------------------------------------------------------------

  for (genvar i = 0; i < 2; i++) begin : gen_line
    assign latch[i] = (TWO_LINES || i == 0) &&
                      (tap_i.ssi[i] ? fall_q[i] && ma_q[i] && !tap_i.ma[i]
                                    : rise_q[i] && !ma_q[i] && tap_i.ma[i]);
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        ma_q[i]   <= 1'b1;
        fall_q[i] <= 1'b0;
        rise_q[i] <= 1'b0;
      end else begin
        ma_q[i]   <= tap_i.ma[i];
        fall_q[i] <= tap_i.start[i] ||
                     (fall_q[i] && !tap_i.stop && !(ma_q[i] && !tap_i.ma[i]));
        rise_q[i] <= !tap_i.start[i] && !tap_i.stop &&
                     (rise_q[i] ? !tap_i.ma[i] : fall_q[i] && ma_q[i] && !tap_i.ma[i]);
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tag1_q <= '0;
      tag2_q <= '0;
    end else begin
      if (latch[0]) tag1_q <= {tag1_q[TAG_W-1:64] + 32'd1, now};
      if (latch[1]) tag2_q <= {tag2_q[TAG_W-1:64] + 32'd1, now};
    end
  end

  // ---- words ------------------------------------------------------------------------------------

  // The words of one line end at least two clocks apart.
  assign tag_wr   = tap_i.done != 2'b00 || late_q;
  assign tag_addr = tap_i.done[0] ? {regs.banks.eng, tap_i.slave[2:0]}
                                  : late_q ? late_addr_q : {regs.banks.eng, tap_i.slave[5:3]};

  enc_ram #(.Width(TAG_W), .AddrW(4)) u_tags (
    .wr_clk_i  (clk_i),
    .wr_en_i   (tag_wr),
    .wr_addr_i (tag_addr),
    .wr_data_i (tap_i.done[0] ? tag1_q : tag2_q),
    .rd_clk_i  (clk_i),
    .rd_en_i   (rd_en_o),
    .rd_addr_i ({regs.banks.host, page_i.channel}),
    .rd_data_o (tag)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      late_q      <= 1'b0;
      late_addr_q <= '0;
      tagged_q    <= '0;
      has_tag_q   <= 1'b0;
    end else begin
      late_q <= tap_i.done == 2'b11;
      late_addr_q <= {regs.banks.eng, tap_i.slave[5:3]};
      if (tag_wr) tagged_q[tag_addr] <= 1'b1;
      has_tag_q <= tagged_q[{regs.banks.host, page_i.channel}];
    end
  end

  // ---- copy -------------------------------------------------------------------------------------

  assign hit[0] = (tap_i.wr[0] || tap_i.done[0]) && tap_i.slave[2:0] == page_i.channel;
  assign hit[1] = (tap_i.wr[1] || tap_i.done[1]) && tap_i.slave[5:3] == page_i.channel;
  // The memory and SVALID change one clock after tap_i tells it: the copy begins again once more,
  // which is no further try.
  assign disturbed = regs.banks.host != host_q || !tap_i.ready || late_q ||
                     (regs.banks.host == regs.banks.eng && hit != 2'b00);
  assign again     = disturbed || (regs.banks.host == regs.banks.eng && hit_q != 2'b00);

  assign last      = &tries_q;

  assign rd_en_o   = state_q == COPY && !step_q[3];
  assign rd_addr_o = {page_i.channel[1:0], step_q[2:0]};
  assign pair      = page_i.channel[2] ? regs.hi : regs.lo;
  assign data      = regs.banks.host ? pair[15:8] : pair[7:0];
  assign line2     = page_i.channel[2] && tap_i.slaveloc5;

  always_comb begin
    row_wr   = 1'b0;
    row      = 3'd0;
    row_data = word_q;
    if (state_q == STAMP) begin
      row_wr   = 1'b1;
      row      = {2'b11, step_q[0]};
      row_data = step_q[0] ? word_q : now[31:0];
    end else if (state_q == COPY) begin
      unique case (step_q)
        4'd5: row_wr = 1'b1;
        4'd9: begin
          row_wr = 1'b1;
          row    = 3'd1;
        end
        4'd10: begin
          row_wr   = 1'b1;
          row      = 3'd2;
          row_data = {29'd0, tap_i.swbank_fail, regs.cds[{regs.banks.host, line2}],
                      regs.svalid[{regs.banks.host, page_i.channel}] && !last} &
                     {32{PRESENT[page_i.channel]}};
        end
        4'd11: begin
          row_wr   = 1'b1;
          row      = 3'd3;
          row_data = tag[TAG_W-1:64] & {32{has_tag_q && !last}};
        end
        4'd12: begin
          row_wr   = 1'b1;
          row      = 3'd4;
          row_data = tag[31:0] & {32{has_tag_q && !last}};
        end
        4'd13: begin
          row_wr   = 1'b1;
          row      = 3'd5;
          row_data = tag[63:32] & {32{has_tag_q && !last}};
        end
        default: row_wr = 1'b0;
      endcase
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= REST;
      step_q  <= '0;
      ack_q   <= 1'b0;
      host_q  <= 1'b0;
      hit_q   <= '0;
      word_q  <= '0;
      tries_q <= '0;
    end else begin
      host_q <= regs.banks.host;
      hit_q  <= hit;
      step_q <= step_q + 4'd1;
      word_q <= state_q == STAMP ? now[63:32] : {data, word_q[31:8]};
      unique case (state_q)
        REST: begin
          // The bus has asked for nothing.
          step_q  <= 4'd0;
          tries_q <= 3'd0;
          if (req != ack_q) state_q <= SETTLE;
        end
        SETTLE: begin
          // Writes to 0xF4 from before the request take effect.
          if (step_q == 4'd15) state_q <= page_i.stamp ? STAMP : COPY;
        end
        COPY: begin
          // The bytes of the word, then its flags and its tag.
          if (again && !last) begin
            step_q <= 4'd0;
            if (disturbed) tries_q <= tries_q + 3'd1;
          end else if (step_q == 4'd13) begin
            state_q <= REST;
            ack_q   <= req;
          end
        end
        STAMP: begin
          // Both halves of the time are of the first clock.
          if (step_q[0]) begin
            state_q <= REST;
            ack_q   <= req;
          end
        end
        default: state_q <= REST;
      endcase
    end
  end

  enc_ram #(.Width(32), .AddrW(6)) u_shadow (
    .wr_clk_i  (clk_i),
    .wr_en_i   (row_wr),
    .wr_addr_i ({page_i.channel & {3{!page_i.stamp}}, row}),
    .wr_data_i (row_data),
    .rd_clk_i  (shadow_clk_i),
    .rd_en_i   (shadow_en_i),
    .rd_addr_i (shadow_addr_i),
    .rd_data_o (shadow_data_o)
  );

  // ---- events -----------------------------------------------------------------------------------

  assign good = {ner, tap_i.good};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      good_q    <= '1;
      regend_q  <= 1'b0;
      getsens_q <= 1'b0;
      blind_q   <= 2'd3;
    end else begin
      blind_q   <= blind_q - {1'b0, blind_q != 2'd0};
      good_q    <= good;
      regend_q  <= tap_i.regend;
      getsens_q <= getsens;
    end
  end

  // A level that a pin has at the end of a reset is no event.
  assign pins    = blind_q == 2'd0;
  assign event_o = {tap_i.lost, getsens && !getsens_q && pins, tap_i.regend && !regend_q,
                    (good_q & ~good & {pins, 4'hF}) != 5'd0, tap_i.frame_end};
  assign ack_o   = ack_q;
  assign beat_o  = now[3];

  assign unused = regs.empty;

endmodule
