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

  logic [AddrW:0] wr_q;
  logic [AddrW:0] wr_d;
  logic [AddrW:0] wr_gray_q;
  logic [AddrW:0] wr_sync;
  logic [AddrW:0] rd_q;
  logic [AddrW:0] rd_gray;
  logic           valid_q;
  logic           busy_q;
  logic [AddrW:0] taken_q;    // Gray count of the bytes taken
  logic [AddrW:0] target_q;   // Gray count of the bytes written before the mark
  logic           mark;
  logic           mark_q;
  logic           seek_q;     // target_q is valid, the mark has not been reached yet
  logic           marked_q;
  logic           fetch;

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
  assign fetch   = wr_sync != rd_gray && (!valid_q || ready_i);

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
      if (fetch) rd_q <= rd_q + (AddrW+1)'(1);
      valid_q <= fetch || (valid_q && !ready_i);
      busy_q  <= valid_q || wr_sync != rd_gray;
      if (!valid_q || ready_i) taken_q <= rd_gray;
      // One clock after the mark: the count has crossed by then as well.
      mark_q  <= mark;
      if (seek_q) begin
        seek_q <= taken_q != target_q;
        if (taken_q == target_q) marked_q <= mark_q;
      end else if (mark_q != marked_q) begin
        seek_q   <= 1'b1;
        target_q <= wr_sync;
      end
    end
  end

  assign valid_o = valid_q;
  assign busy_o  = busy_q;
  assign empty_o = wr_gray_q == taken_q;
  assign mark_o  = marked_q;

endmodule
