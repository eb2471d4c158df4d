// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Posted writes from the host domain into the core domain. The bytes wait in a dual-clock memory;
// the Gray-coded write count is the only signal that crosses with them.
//
// Clock domains: wr_clk_i for wr_* and mark_i; clk_i for the rest.
// Latency: a byte is offered 2..3 clk_i periods after it was written, if no other byte waits before
// it. ready_i takes it. Waiting bytes follow one a clock.
//
//   busy_o   1 while any byte waits, one clock late
//   empty_o  1 while the core has taken all bytes; it changes with either clock and needs a flop
//   mark_o   follows a change of mark_i when all bytes written before that change have been taken
//
// While the core clock stands still, or the core does not take bytes, up to 2^AddrW bytes wait.
// They take effect when the core goes on.
// Misuse: with more than 2^AddrW waiting bytes the queue wraps and bytes are lost.
// Constraint: false path to the first flops of the count; the bits of the count must arrive within
// one wr_clk_i period of each other. A byte is in the memory before the count that announces it.

module enc_posted #(
  parameter int unsigned Width = 16,
  parameter int unsigned AddrW = 7
) (
  // host domain
  input  logic             wr_clk_i,
  input  logic             wr_rst_ni,
  input  logic             wr_en_i,
  input  logic [Width-1:0] wr_data_i,
  output logic             empty_o,
  input  logic             mark_i,
  output logic             mark_o,
  // core domain
  input  logic             clk_i,
  input  logic             rst_ni,
  output logic             valid_o,
  output logic [Width-1:0] data_o,
  input  logic             ready_i,
  output logic             busy_o
);

  logic [AddrW:0] wr_d;
  logic [AddrW:0] wr_q;
  logic [AddrW:0] wr_gray_q;
  logic [AddrW:0] wr_sync;
  logic [AddrW:0] rd_d;
  logic [AddrW:0] rd_q;
  logic [AddrW:0] rd_gray;
  logic           valid_d;
  logic           valid_q;
  logic           busy_d;
  logic           busy_q;
  logic [AddrW:0] taken_d;
  logic [AddrW:0] taken_q;    // Gray count of the bytes taken
  logic [AddrW:0] target_d;
  logic [AddrW:0] target_q;   // Gray count of the bytes written before the mark
  logic           mark;
  logic           mark_q;
  logic           seek_d;
  logic           seek_q;     // target_q is valid, the mark has not been reached yet
  logic           marked_d;
  logic           marked_q;
  logic           fetch;
  logic           free;       // no byte is offered, or the core takes it

  assign wr_d = wr_q + (AddrW+1)'(1);

  always_ff @(posedge wr_clk_i or negedge wr_rst_ni) begin
    if (!wr_rst_ni) begin
      wr_q      <= '0;
      wr_gray_q <= '0;
    end else if (wr_en_i) begin
      wr_q      <= wr_d;
      wr_gray_q <= wr_d ^ {1'b0, wr_d[AddrW:1]};
    end
  end

  for (genvar i = 0; i <= AddrW; i++) begin : gen_sync
    enc_sync_bit u_sync (
      .clk_i,
      .rst_ni,
      .data_i (wr_gray_q[i]),
      .data_o (wr_sync[i])
    );
  end

  enc_sync_bit u_mark (
    .clk_i,
    .rst_ni,
    .data_i (mark_i),
    .data_o (mark)
  );

  assign rd_gray = rd_q ^ {1'b0, rd_q[AddrW:1]};
  assign free    = !valid_q || ready_i;
  assign fetch   = wr_sync != rd_gray && free;

  enc_ram #(.Width(Width), .AddrW(AddrW)) u_ram (
    .wr_clk_i,
    .wr_en_i,
    .wr_addr_i (wr_q[AddrW-1:0]),
    .wr_data_i,
    .rd_clk_i  (clk_i),
    .rd_en_i   (fetch),
    .rd_addr_i (rd_q[AddrW-1:0]),
    .rd_data_o (data_o)
  );

  assign rd_d     = rd_q + (AddrW+1)'(fetch);
  assign valid_d  = fetch || !free;
  assign busy_d   = valid_q || wr_sync != rd_gray;
  assign taken_d  = free ? rd_gray : taken_q;
  // mark_q comes one clock after the mark: the count has crossed by then as well.
  assign seek_d   = seek_q ? taken_q != target_q : mark_q != marked_q;
  assign target_d = (!seek_q && mark_q != marked_q) ? wr_sync : target_q;
  assign marked_d = (seek_q && taken_q == target_q) ? mark_q : marked_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rd_q     <= '0;
      valid_q  <= 1'b0;
      busy_q   <= 1'b0;
      taken_q  <= '0;
      target_q <= '0;
      mark_q   <= 1'b0;
      seek_q   <= 1'b0;
      marked_q <= 1'b0;
    end else begin
      rd_q     <= rd_d;
      valid_q  <= valid_d;
      busy_q   <= busy_d;
      taken_q  <= taken_d;
      target_q <= target_d;
      mark_q   <= mark;
      seek_q   <= seek_d;
      marked_q <= marked_d;
    end
  end

  assign valid_o = valid_q;
  assign busy_o  = busy_q;
  assign empty_o = wr_gray_q == taken_q;
  assign mark_o  = marked_q;

endmodule
