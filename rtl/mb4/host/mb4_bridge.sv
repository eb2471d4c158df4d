// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// From a word bus of 32 bits (enc_axil, enc_wb) to the byte bus of mb4_engine and to the page at
// 0x100 (regmap/mb4_page.rdl).
//
//   0x000..0x0FF  byte map, four bytes to a word, little endian. The enabled bytes of a write act
//                 in ascending order. In the word of 0xF4 this byte is the last one.
//   0x100..0x1DF  page
//   others        read 0, ignore writes
//
// Clock domain: clk_i (bus). empty_i, ack_i and beat_i are asynchronous.
// Latency: an access of the byte map that does not wait is ready 6 clocks after word_req_i (a read
// 7), one of the page 1 clock after it, a shadowed word 3. An access waits
//
// - at a write to SCDATA, RDATA or SVALID, while the posted queue may not have room for a word,
// - at a read of SCDATA, RDATA or a snapshot, until the core has taken all posted bytes,
// - at the low word of the time or of a snapshot, until the core has filled its shadow.
//
// While the core's clock runs (beat_i), each of these waits ends. If the clock has not moved for
// WaitLimit clocks of the bus, the access ends with word_error_o: a write is not done, a read gives
// 0. An answer that the core gives later is dropped. beat_i changes every 8 clocks of the core, so
// a core clock above 8 / WaitLimit of the bus clock counts as running.
//
// Misuse: a request that falls before it is ready ends the access; some bytes of a write may then
// have been written.
// Source: decisions 36, 45.

`include "enc_check.svh"

module mb4_bridge #(
  parameter int unsigned WaitLimit = 1024
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // word bus
  input  logic        word_req_i,
  input  logic        word_write_i,
  input  logic [11:2] word_addr_i,
  input  logic [31:0] word_data_i,
  input  logic [3:0]  word_be_i,
  output logic        word_ready_o,
  output logic [31:0] word_data_o,
  output logic        word_error_o,
  // host byte bus, sampled at the rising edge of clk_i
  output mb4_pkg::host_t host_o,
  input  logic [7:0]  rd_data_i,    // valid after that edge
  input  logic        empty_i,      // the core has taken all posted bytes
  // core: time and snapshots (mb4_page)
  output mb4_pkg::page_req_t page_o,
  input  logic        ack_i,        // follows page_o.req when the shadow is filled
  input  logic        beat_i,
  output logic        shadow_en_o,
  output logic [5:0]  shadow_addr_o,
  input  logic [31:0] shadow_data_i,
  // interrupts (enc_irq)
  output logic        status_we_o,
  output logic        enable_we_o,
  output logic [4:0]  irq_data_o,
  input  logic [4:0]  status_i,
  input  logic [4:0]  enable_i,
  // constants
  input  logic [31:0] features_i
);

  // The queue holds 128 bytes; with more than this many a word may not fit.
  localparam logic [7:0]  ROOM    = 8'd124;
  localparam int unsigned LIMIT_W = $clog2(WaitLimit + 1);

  typedef enum logic [2:0] {
    IDLE,
    QUEUE,
    BYTES,
    ASK,
    ANSWER,
    SHADOW,
    FETCH,
    READY
  } state_e;

  state_e      state_d;
  state_e      state_q;
  // address
  logic        map, page, instr, posts, memory, time_low, time_high, word_low, channel_word;
  logic [2:0]  channel;
  logic [2:0]  row;
  logic [5:0]  index;        // of a word of the page
  logic [31:0] page_data;
  // bytes
  logic [2:0]  count_d, count_q;
  logic [1:0]  place;        // of the byte in the word
  logic        wr_en;
  logic [7:0]  posted_d, posted_q;  // bytes that may wait in the queue
  logic [1:0]  fresh_d, fresh_q;    // clocks until empty knows of the last one
  logic        post;
  logic        empty;
  logic        blocked;      // the access waits for the queue
  // core
  logic        ack, beat, beat_q;
  logic        free;         // the core has answered all requests
  logic        ask;
  logic [3:0]  shadow;            // of channel 1..8, or the time
  logic [8:0]  shown_d, shown_q;  // shadows that hold an answer
  mb4_pkg::page_req_t page_q;
  logic [LIMIT_W-1:0] limit_d, limit_q;
  logic        waits, expired;
  // answer
  logic [31:0] data_d, data_q;
  logic        error_d, error_q;

  enc_sync_bit u_empty (
    .clk_i,
    .rst_ni,
    .data_i (empty_i),
    .data_o (empty)
  );

  enc_sync_bit u_ack (
    .clk_i,
    .rst_ni,
    .data_i (ack_i),
    .data_o (ack)
  );

  enc_sync_bit u_beat (
    .clk_i,
    .rst_ni,
    .data_i (beat_i),
    .data_o (beat)
  );

  // ---- address ----------------------------------------------------------------------------------

  assign map       = word_addr_i[11:8] == 4'd0;
  assign page      = word_addr_i[11:8] == mb4_page_regs_pkg::ADDR_ID[11:8];
  assign index     = word_addr_i[7:2];
  assign instr     = map && {index, 2'b00} == mb4_regs_pkg::ADDR_INSTR;
  assign memory    = map && !word_addr_i[6];               // SCDATA and RDATA
  assign posts     = memory || (map && {index, 2'b00} == mb4_regs_pkg::ADDR_STATUS0);
  assign time_low  = page && index == mb4_page_regs_pkg::ADDR_TIME_LOW[7:2];
  assign time_high = page && index == mb4_page_regs_pkg::ADDR_TIME_HIGH[7:2];

  always_comb begin
    channel      = 3'd0;
    row          = 3'd0;
    channel_word = 1'b0;
    for (int unsigned i = 0; i < 8; i++) begin
      if (page && index >= 6'(8 + 6 * i) && index < 6'(14 + 6 * i)) begin
        channel      = 3'(i);
        row          = 3'(index - 6'(8 + 6 * i));
        channel_word = 1'b1;
      end
    end
    if (time_low || time_high) row = {2'b11, time_high};
  end

  assign shadow   = (time_low || time_high) ? 4'd8 : {1'b0, channel};
  assign word_low = channel_word && row == 3'd0;

  always_comb begin
    page_data = 32'd0;
    if (page) begin
      unique case ({index, 2'b00})
        mb4_page_regs_pkg::ADDR_ID[7:0]:         page_data = mb4_page_regs_pkg::RESET_ID;
        mb4_page_regs_pkg::ADDR_VERSION[7:0]:    page_data = mb4_page_regs_pkg::RESET_VERSION;
        mb4_page_regs_pkg::ADDR_FEATURES[7:0]:   page_data = features_i;
        mb4_page_regs_pkg::ADDR_IRQ_STATUS[7:0]: page_data = {27'd0, status_i};
        mb4_page_regs_pkg::ADDR_IRQ_ENABLE[7:0]: page_data = {27'd0, enable_i};
        default:                                 page_data = 32'd0;
      endcase
    end
  end

  // ---- bytes ------------------------------------------------------------------------------------

  // 0xF4 comes after the three bytes above it.
  assign place  = count_q[1:0] + {1'b0, instr && word_write_i};
  assign wr_en  = state_q == BYTES && word_req_i && word_write_i && word_be_i[place];
  assign host_o.wr_en   = wr_en;
  assign host_o.wr_addr = {index, place};
  assign host_o.wr_data = word_data_i[{place, 3'b000} +: 8];
  assign host_o.rd_en   = state_q == BYTES && !word_write_i && !count_q[2];
  assign host_o.rd_addr = {index, place};
  assign post   = wr_en && (memory || (posts && (place == 2'd1 || place == 2'd2)));

  assign blocked = word_write_i ? posts && posted_q > ROOM
                                : (memory || word_low) && posted_q != 8'd0;

  // ---- sequence ---------------------------------------------------------------------------------

  assign free    = ack == page_q.req;
  assign waits   = (state_q == QUEUE && blocked) || (state_q == ASK && !free) ||
                   (state_q == ANSWER && !free);
  assign expired = limit_q == LIMIT_W'(WaitLimit);

  assign posted_d = (empty && fresh_q == 2'd0 && !post) ? 8'd0 : posted_q + 8'(post);
  assign fresh_d  = post ? 2'd3 : fresh_q - {1'b0, fresh_q != 2'd0};
  assign limit_d  = (!waits || beat != beat_q) ? '0 : limit_q + LIMIT_W'(!expired);

  always_comb begin
    state_d = state_q;
    count_d = 3'd0;
    ask     = 1'b0;
    shown_d = shown_q;
    data_d  = data_q;
    error_d = error_q;

    unique case (state_q)
      IDLE: begin
        // No access runs. One that needs neither bytes nor the core is ready in the next clock.
        error_d = 1'b0;
        data_d  = page_data;
        if (word_req_i) begin
          state_d = READY;
          if (map || (!word_write_i && (time_low || word_low))) state_d = QUEUE;
          if (!word_write_i && (time_high || (channel_word && !word_low))) state_d = SHADOW;
        end
      end
      QUEUE: begin
        // The access waits for the queue of posted bytes.
        if (!blocked) state_d = map ? BYTES : ASK;
      end
      BYTES: begin
        // A byte a clock; a byte that is read comes one clock later.
        count_d = count_q + 3'd1;
        if (count_q == (word_write_i ? 3'd3 : 3'd4)) state_d = READY;
        data_d  = {rd_data_i, data_q[31:8]};
      end
      ASK: begin
        // The core may still have to answer a request that was given up.
        if (free && word_req_i) begin
          state_d = ANSWER;
          ask     = 1'b1;
          shown_d[shadow] = 1'b0;
        end
      end
      ANSWER: begin
        // The core fills the shadow. Without the request word_addr_i, and so shadow, may be another
        // one's.
        if (free && word_req_i) begin
          state_d = SHADOW;
          shown_d[shadow] = 1'b1;
        end
      end
      SHADOW: begin
        // The shadow is read.
        state_d = FETCH;
      end
      FETCH: begin
        // A shadow that was never filled reads 0.
        state_d = READY;
        data_d  = shadow_data_i & {32{shown_q[shadow]}};
      end
      READY: begin
        // The access is done in this clock.
        state_d = IDLE;
      end
      default: state_d = IDLE;
    endcase

    if (waits && expired) begin
      state_d = READY;
      error_d = 1'b1;
      data_d  = 32'd0;
    end
    if (!word_req_i) state_d = IDLE;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= IDLE;
      count_q  <= '0;
      posted_q <= '0;
      fresh_q  <= '0;
      beat_q   <= 1'b0;
      shown_q  <= '0;
      page_q   <= '0;
      limit_q  <= '0;
      data_q   <= '0;
      error_q  <= 1'b0;
    end else begin
      state_q  <= state_d;
      count_q  <= count_d;
      posted_q <= posted_d;
      fresh_q  <= fresh_d;
      beat_q   <= beat;
      shown_q  <= shown_d;
      if (ask) begin
        page_q.req     <= !page_q.req;
        page_q.stamp   <= time_low;
        page_q.channel <= channel;
      end
      limit_q  <= limit_d;
      data_q   <= data_d;
      error_q  <= error_d;
    end
  end

  assign page_o        = page_q;
  assign shadow_en_o   = state_q == SHADOW;
  assign shadow_addr_o = {channel, row};

  assign word_ready_o = state_q == READY;
  assign word_data_o  = data_q;
  assign word_error_o = error_q;

  assign status_we_o = word_ready_o && word_req_i && word_write_i && word_be_i[0] && page &&
                       {index, 2'b00} == mb4_page_regs_pkg::ADDR_IRQ_STATUS[7:0];
  assign enable_we_o = word_ready_o && word_req_i && word_write_i && word_be_i[0] && page &&
                       {index, 2'b00} == mb4_page_regs_pkg::ADDR_IRQ_ENABLE[7:0];
  assign irq_data_o  = word_data_i[4:0];

  `ENC_ASSERT(QueueNeverOverflows_A, clk_i, rst_ni, posted_q <= 8'd128)

endmodule
