// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bridge from words to bytes (mb4_bridge) between any word bus and any core. The word bus keeps
// a request with its payload until it is ready. The core takes posted bytes and answers requests
// when it likes, or never. Here the limit is 4 clocks and the queue has room for 8 bytes.
//
// claim: every access ends; with a core that gives no sign within 3 limits, and with an error only
//   if the core gave none for a whole limit; the queue never overflows; memories are read only when
//   the core has taken all bytes; the enabled bytes of a write act once, that of 0xF4 last
// clocks: one
// depth: 26
// cover: 26
// unbounded: reachability
// keep: mb4/host/mb4_bridge.sv | parameter int unsigned WaitLimit = 1024 | parameter int unsigned WaitLimit = 4
// keep: mb4/host/mb4_bridge.sv | localparam logic [7:0]  ROOM    = 8'd124; | localparam logic [7:0]  ROOM    = 8'd4;
// mutation: mb4/host/mb4_bridge.sv | posts && posted_q > ROOM | posts && posted_q > ROOM + 8'd3
// mutation: mb4/host/mb4_bridge.sv | (empty && fresh_q == 2'd0 && !post) | (empty && !post)
// mutation: mb4/host/mb4_bridge.sv | : (memory || word_low) && | : word_low &&
// mutation: mb4/host/mb4_bridge.sv | {1'b0, instr && word_write_i}; | {1'b0, instr && !word_write_i};
// mutation: mb4/host/mb4_bridge.sv | if (waits && expired) begin | if (waits && expired && !time_low) begin
// mutation: mb4/host/mb4_bridge.sv | (!waits || beat != beat_q) ? '0 | !waits ? '0
// mutation: mb4/host/mb4_bridge.sv | word_write_i && word_be_i[place]; | word_write_i;
// mutation: mb4/host/mb4_bridge.sv | word_ready_o = state_q == READY; | word_ready_o = state_q == FETCH;

module proof (
  input logic        clk_i,
  input logic        rst_ni,
  input logic        req_i,
  input logic        write_i,
  input logic [11:2] addr_i,
  input logic [3:0]  be_i,
  input logic        take_i,     // the core takes a posted byte
  input logic        answer_i,   // the core answers
  input logic        beat_i
);

  logic        ready, error, ack_q;
  logic [31:0] data;
  mb4_pkg::host_t host;
  mb4_pkg::page_req_t page;
  logic        shadow_en, status_we, enable_we;
  logic [5:0]  shadow_addr;
  logic [4:0]  irq_data;
  logic [4:0]  held_q;    // bytes in the queue

  mb4_bridge u_dut (
    .clk_i, .rst_ni,
    .word_req_i(req_i), .word_write_i(write_i), .word_addr_i(addr_i), .word_data_i(32'h44332211),
    .word_be_i(be_i), .word_ready_o(ready), .word_data_o(data), .word_error_o(error),
    .host_o(host), .rd_data_i(8'h5A), .empty_i(held_q == 5'd0),
    .page_o(page), .ack_i(ack_q), .beat_i(beat_i),
    .shadow_en_o(shadow_en), .shadow_addr_o(shadow_addr), .shadow_data_i(32'd0),
    .status_we_o(status_we), .enable_we_o(enable_we), .irq_data_o(irq_data),
    .status_i(5'd0), .enable_i(5'd0), .features_i(32'd0)
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* begin
    if (!started) assume (!rst_ni);
    if (started) assume (rst_ni);
    if (!rst_ni) assume (!req_i);
  end

  // The word bus: a request stays; after ready it pauses for a clock.
  logic        wait_q, ready_q, write_q;
  logic [11:2] addr_q;
  logic [3:0]  be_q;
  always @(posedge clk_i) begin
    wait_q  <= req_i && !ready && rst_ni;
    ready_q <= req_i && ready;
    {write_q, addr_q, be_q} <= {write_i, addr_i, be_i};
  end
  always @* begin
    if (wait_q) assume (req_i && write_i == write_q && addr_i == addr_q && be_i == be_q);
    if (started && ready_q) assume (!req_i);
  end

  // The core.
  wire posts = host.wr_en && (!host.wr_addr[6] || host.wr_addr == 8'hF1 || host.wr_addr == 8'hF2);
  always @(posedge clk_i) begin
    held_q <= held_q + {4'd0, posts} - {4'd0, take_i && held_q != 5'd0};
    if (answer_i) ack_q <= page.req;
    if (!rst_ni) {held_q, ack_q} <= '0;
  end

  // Clocks since the core's last sign, and clocks of the access.
  logic [2:0] beat_n;   // history: three clocks go by in the synchroniser
  logic [4:0] quiet_n, quiet_q;
  logic [5:0] access_n;
  (* anyconst *) logic dead;
  always @* if (dead) assume (!beat_i && !take_i && !answer_i);
  always @(posedge clk_i) begin
    beat_n   <= {beat_n[1:0], beat_i};
    quiet_n  <= beat_n[2] != beat_n[1] ? 5'd0 : quiet_n + {4'd0, quiet_n != 5'd31};
    quiet_q  <= quiet_n;   // when the access ended
    access_n <= req_i && !ready ? access_n + {5'd0, access_n != 6'd63} : 6'd0;
    if (!rst_ni) {beat_n, quiet_n, access_n} <= '0;
  end

  // Bytes of this access that were written, and those of the word that were read.
  logic [3:0] done_q;
  logic       memory;
  assign memory = addr_i[11:8] == 4'd0 && !addr_i[6];
  always @(posedge clk_i) begin
    if (!req_i || ready) done_q <= '0;
    else if (host.wr_en) done_q[host.wr_addr[1:0]] <= 1'b1;
    if (!rst_ni) done_q <= '0;
  end

  always @* if (rst_ni && started) begin
    Room_A:   assert (held_q <= 5'd8);
    if (dead) Bound_A: assert (access_n < 6'd24);
    if (req_i && ready && error) Error_A: assert (quiet_q >= 5'd4);
    if (host.wr_en) begin
      Once_A:   assert (req_i && write_i && be_i[host.wr_addr[1:0]] && !done_q[host.wr_addr[1:0]]);
      Place_A:  assert (addr_i[11:8] == 4'd0 && host.wr_addr[7:2] == addr_i[7:2]);
      Data_A:   assert (host.wr_data == {5'd0, 3'd1} * 8'h11 + 8'h11 * {6'd0, host.wr_addr[1:0]});
      if (host.wr_addr == 8'hF4) Last_A: assert (done_q[3:1] == be_i[3:1]);
      else Order_A: assert ((done_q & ~((4'd1 << host.wr_addr[1:0]) - 4'd1)) == 4'd0);
    end
    if (req_i && ready && write_i && !error && addr_i[11:8] == 4'd0) All_A: assert (done_q == be_i);
    if (req_i && ready && error) None_A: assert (done_q == 4'd0 && (write_i || data == 32'd0));
    if (host.rd_en) Read_A: assert (req_i && !write_i && addr_i[11:8] == 4'd0 &&
                                    host.rd_addr[7:2] == addr_i[7:2] &&
                                    (!memory || held_q == 5'd0));
    if (req_i && ready && !write_i && !error && addr_i[11:8] == 4'd0)
      Bytes_A: assert (data == 32'h5A5A5A5A);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Full_C:  cover (held_q == 5'd8);
    Error_C: cover (req_i && ready && error && !write_i);
    Good_C:  cover (req_i && ready && !error && shadow_addr[2:0] == 3'd6 && access_n > 6'd6);
  end

endmodule
