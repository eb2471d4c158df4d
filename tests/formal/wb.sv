// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Wishbone slave (enc_wb), classic and pipelined, between any master and any word bus. The
// master keeps STB with its payload until the request is taken: until ACK or ERR in a classic
// cycle (B4, 3.1.3 and 3.2), until STALL = 0 in a pipelined one (3.1.3.2). It may end its cycle at
// any clock, and STB may be 1 without CYC. The claim on time holds for a word bus that waits at most
// three clocks, the other claims for any.
//
// claim: every request of a cycle that goes on has one access and one ACK or ERR, with its data; an
//   ended cycle is never answered; classic and pipelined; no request waits for more than 5 clocks
//   while the word bus waits at most three
// clocks: one
// depth: 24
// cover: 16
// unbounded: reachability
// mutation: common/enc_wb.sv | busy_q   <= strobe && !done; | busy_q   <= strobe;
// mutation: common/enc_wb.sv | Pipelined ? accept_q && strobe && !error_q
//   | Pipelined ? accept_q && !error_q
// mutation: common/enc_wb.sv | done && !word_error_i; | word_ready_i && !word_error_i;
// mutation: common/enc_wb.sv | wb_stall_o = !accept_q; | wb_stall_o = 1'b0;
// mutation: common/enc_wb.sv | Pipelined ? accept_q && strobe && error_q
//   | Pipelined ? accept_q && strobe && word_error_i
// mutation: common/enc_wb.sv | word_req_o   = busy_q && strobe; | word_req_o   = busy_q;
// mutation: common/enc_wb.sv | {4{!wb_we_i}}; | {4{wb_we_i}};
// mutation: common/enc_wb.sv | strobe = wb_cyc_i && wb_stb_i; | strobe = wb_stb_i;
// mutation: common/enc_wb.sv | ack_q && wb_cyc_i | ack_q
// mutation: common/enc_wb.sv | word_req_o   = busy_q && strobe;
//   | word_req_o   = (busy_q || (ack_q && word_ready_i)) && strobe;

module one_kind #(
  parameter bit Pipelined = 1'b0
) (
  input logic        clk_i,
  input logic        rst_ni,
  input logic        cyc_i,
  input logic        stb_i,
  input logic        we_i,
  input logic [3:2]  adr_i,
  input logic [31:0] dat_i,
  input logic [3:0]  sel_i,
  input logic        word_ready_i,
  input logic [31:0] word_data_i,
  input logic        word_error_i
);

  logic        ack, err, stall;
  logic [31:0] dat;
  logic        req, write;
  logic [3:2]  addr;
  logic [31:0] data;
  logic [3:0]  be;

  enc_wb #(.AddrW(4), .Pipelined(Pipelined)) u_dut (
    .clk_i, .rst_ni, .wb_cyc_i(cyc_i), .wb_stb_i(stb_i), .wb_we_i(we_i), .wb_adr_i(adr_i),
    .wb_dat_i(dat_i), .wb_sel_i(sel_i), .wb_dat_o(dat), .wb_ack_o(ack), .wb_err_o(err),
    .wb_stall_o(stall), .word_req_o(req), .word_write_o(write), .word_addr_o(addr),
    .word_data_o(data), .word_be_o(be), .word_ready_i, .word_data_i, .word_error_i
  );

  // The master.
  logic        taken, answer, strobe;
  logic        keep_q, we_q, cyc_q;
  logic [3:2]  adr_q;
  logic [31:0] dat_q;
  logic [3:0]  sel_q;
  assign strobe = cyc_i && stb_i;
  assign answer = ack || err;
  assign taken  = strobe && (Pipelined ? !stall : answer);
  always @(posedge clk_i) begin
    keep_q <= strobe && !taken && rst_ni;
    cyc_q  <= cyc_i && rst_ni;
    {we_q, adr_q, dat_q, sel_q} <= {we_i, adr_i, dat_i, sel_i};
  end
  always @* begin
    if (keep_q && cyc_i) assume (stb_i && {we_i, adr_i, dat_i, sel_i} ==
                                 {we_q, adr_q, dat_q, sel_q});
  end

  // The word bus.
  (* anyconst *) logic limited;
  logic [1:0] word_n;
  always @(posedge clk_i) begin
    word_n <= rst_ni && req && !word_ready_i ? word_n + {1'b0, word_n != 2'd3}
                                             : 2'd0;
  end
  always @* if (limited && word_n == 2'd3) assume (word_ready_i);

  // An access done for the request at the pins; a request taken and not yet answered (pipelined).
  logic        done, done_q, due_q, error_q;
  logic [31:0] data_q;
  logic [2:0]  wait_n;
  assign done = req && word_ready_i;
  always @(posedge clk_i) begin
    done_q <= rst_ni && done;
    due_q  <= rst_ni && Pipelined && taken;
    wait_n <= rst_ni && strobe && !taken ? wait_n + {2'd0, wait_n != 3'd7} : 3'd0;
    if (done) {error_q, data_q} <= {word_error_i, word_data_i};
  end

  logic wait_q, out_we_q;
  logic [37:0] out_q;
  always @(posedge clk_i) begin
    wait_q <= req && !word_ready_i && rst_ni;
    {out_we_q, out_q} <= {write, addr, be, data};
  end

  always @* if (rst_ni) begin
    One_A:   assert (!(ack && err));
    // A request is taken in the clock after its access and in no other.
    if (taken) Access_A: assert (done_q);
    if (taken) Once_A: assert (!done);
    if (done_q && strobe) Taken_A: assert (taken);
    // Answers: classic with the request, pipelined in the clock after it.
    if (Pipelined) Answer_A: assert (answer == (due_q && cyc_i));
    else           Classic_A: assert (answer == (done_q && strobe));
    if (answer) Data_A: assert (err == error_q && dat == data_q);
    if (!cyc_i || !cyc_q) Ended_A: assert (!answer);
    if (req) Payload_A: assert (strobe && write == we_i && addr == adr_i && data == dat_i &&
                                be == (sel_i | {4{!we_i}}));
    if (wait_q && cyc_i) Stable_A: assert (req && write == out_we_q &&
                                           {addr, be, data} == out_q);
    if (limited) Time_A: assert (wait_n < 3'd6);
  end else begin
    Reset_A: assert (!ack && !err && !req);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Slow_C:   cover (taken && wait_n == 3'd5);
    Error_C:  cover (err && cyc_i);
    Ended_C:  cover (done_q && !cyc_i);
    Next_C:   cover (answer && strobe);
  end

endmodule

module proof (
  input logic        clk_i,
  input logic        rst_ni,
  input logic        classic_cyc_i,
  input logic        classic_stb_i,
  input logic        pipe_cyc_i,
  input logic        pipe_stb_i,
  input logic        classic_we_i,
  input logic        pipe_we_i,
  input logic [3:2]  classic_adr_i,
  input logic [3:2]  pipe_adr_i,
  input logic [31:0] classic_dat_i,
  input logic [31:0] pipe_dat_i,
  input logic [3:0]  classic_sel_i,
  input logic [3:0]  pipe_sel_i,
  input logic        classic_ready_i,
  input logic        pipe_ready_i,
  input logic [31:0] word_data_i,
  input logic        word_error_i
);

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* if (!started) assume (!rst_ni);

  one_kind #(.Pipelined(1'b0)) u_classic (
    .clk_i, .rst_ni, .cyc_i(classic_cyc_i), .stb_i(classic_stb_i), .we_i(classic_we_i),
    .adr_i(classic_adr_i), .dat_i(classic_dat_i), .sel_i(classic_sel_i),
    .word_ready_i(classic_ready_i), .word_data_i, .word_error_i
  );
  one_kind #(.Pipelined(1'b1)) u_pipe (
    .clk_i, .rst_ni, .cyc_i(pipe_cyc_i), .stb_i(pipe_stb_i), .we_i(pipe_we_i),
    .adr_i(pipe_adr_i), .dat_i(pipe_dat_i), .sel_i(pipe_sel_i),
    .word_ready_i(pipe_ready_i), .word_data_i, .word_error_i
  );

endmodule
