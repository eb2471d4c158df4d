// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The AXI4-Lite subordinate (enc_axil) between any manager and any word bus. The manager keeps
// each valid with its payload until its ready (IHI0022, A3.2.1), and holds its valids low in reset
// (A3.1.2). The claim on time holds for a manager that takes an answer within three clocks and a word
// bus that waits at most three clocks, the other claims for any.
//
// claim: every handshake of a request has one access before it and one answer after it, with its
//   data and its error; requests and answers are stable; no request waits for more than 19 clocks
//   while word bus and manager wait at most three
// clocks: one
// depth: 30
// cover: 20
// unbounded: reachability
// look: dut_rest = u_dut.rest
// look: dut_done = u_dut.done
// mutation: common/enc_axil.sv | rest ? write && !(read && write_q) : write_q;
//   | rest ? write : write_q;
// mutation: common/enc_axil.sv | rest ? write || read : word_req_o && !word_ready_i;
//   | rest ? write || read : word_req_o;
// mutation: common/enc_axil.sv | busy_q || awready_q || arready_q || bvalid_q || rvalid_q
//   | busy_q || awready_q || arready_q || bvalid_q
// mutation: common/enc_axil.sv | write_q ? s_axi_awaddr : s_axi_araddr;
//   | write ? s_axi_awaddr : s_axi_araddr;
// mutation: common/enc_axil.sv | assign write = s_axi_awvalid && s_axi_wvalid;
//   | assign write = s_axi_awvalid;
// mutation: common/enc_axil.sv | (bvalid_q && !s_axi_bready); | (bvalid_q && s_axi_wvalid);
// mutation: common/enc_axil.sv | if (done) begin | if (word_ready_i) begin
// mutation: common/enc_axil.sv | {4{!write_q}}; | {4{write_q}};
// mutation: common/enc_axil.sv | s_axi_bresp   = {error_q, 1'b0}; | s_axi_bresp   = {word_error_i, 1'b0};
// mutation: common/enc_axil.sv | s_axi_wready  = awready_q; | s_axi_wready  = arready_q;

module proof (
  input logic        clk_i,
  input logic        rst_ni,
  input logic        awvalid_i,
  input logic [3:2]  awaddr_i,
  input logic        wvalid_i,
  input logic [31:0] wdata_i,
  input logic [3:0]  wstrb_i,
  input logic        bready_i,
  input logic        arvalid_i,
  input logic [3:2]  araddr_i,
  input logic        rready_i,
  input logic        word_ready_i,
  input logic [31:0] word_data_i,
  input logic        word_error_i
);

  logic        awready, wready, bvalid, arready, rvalid;
  logic [1:0]  bresp, rresp;
  logic [31:0] rdata;
  logic        req, write;
  logic [3:2]  addr;
  logic [31:0] data;
  logic [3:0]  be;

  enc_axil #(.AddrW(4)) u_dut (
    .clk_i, .rst_ni,
    .s_axi_awvalid(awvalid_i), .s_axi_awready(awready), .s_axi_awaddr(awaddr_i),
    .s_axi_wvalid(wvalid_i), .s_axi_wready(wready), .s_axi_wdata(wdata_i), .s_axi_wstrb(wstrb_i),
    .s_axi_bvalid(bvalid), .s_axi_bready(bready_i), .s_axi_bresp(bresp),
    .s_axi_arvalid(arvalid_i), .s_axi_arready(arready), .s_axi_araddr(araddr_i),
    .s_axi_rvalid(rvalid), .s_axi_rready(rready_i), .s_axi_rdata(rdata), .s_axi_rresp(rresp),
    .word_req_o(req), .word_write_o(write), .word_addr_o(addr), .word_data_o(data), .word_be_o(be),
    .word_ready_i, .word_data_i, .word_error_i
  );

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;
  always @* begin
    if (!started) assume (!rst_ni);
    if (!rst_ni) assume (!awvalid_i && !wvalid_i && !arvalid_i);
  end

  // The manager.
  logic       aw_q, w_q, ar_q;
  logic [3:2] awaddr_q, araddr_q;
  logic [31:0] wdata_q;
  logic [3:0] wstrb_q;
  always @(posedge clk_i) begin
    {aw_q, w_q, ar_q} <= {awvalid_i && !awready, wvalid_i && !wready, arvalid_i && !arready} &
                         {3{rst_ni}};
    {awaddr_q, araddr_q, wdata_q, wstrb_q} <= {awaddr_i, araddr_i, wdata_i, wstrb_i};
  end
  always @* begin
    if (aw_q) assume (awvalid_i && awaddr_i == awaddr_q);
    if (w_q) assume (wvalid_i && wdata_i == wdata_q && wstrb_i == wstrb_q);
    if (ar_q) assume (arvalid_i && araddr_i == araddr_q);
  end

  // Limits of the waits of others.
  (* anyconst *) logic limited;
  logic [1:0] answer_n, word_n;
  always @(posedge clk_i) begin
    answer_n <= (bvalid && !bready_i) || (rvalid && !rready_i) ?
                answer_n + {1'b0, answer_n != 2'd3} : 2'd0;
    word_n   <= req && !word_ready_i ? word_n + {1'b0, word_n != 2'd3} : 2'd0;
    if (!rst_ni) {answer_n, word_n} <= '0;
  end
  always @* begin
    if (limited && answer_n == 2'd3) assume (bready_i && rready_i);
    if (limited && word_n == 2'd3) assume (word_ready_i);
  end

  // What happened: accesses done, not yet handed over; requests handed over, not yet answered.
  logic        wdone_q, rdone_q, bdue_q, rdue_q, error_q;
  logic [31:0] data_q;
  logic        done;
  assign done = req && word_ready_i;
  always @(posedge clk_i) begin
    wdone_q <= (wdone_q && !(awvalid_i && awready)) || (done && write);
    rdone_q <= (rdone_q && !(arvalid_i && arready)) || (done && !write);
    bdue_q  <= (bdue_q && !bready_i) || (awvalid_i && awready);
    rdue_q  <= (rdue_q && !rready_i) || (arvalid_i && arready);
    if (done) {error_q, data_q} <= {word_error_i, word_data_i};
    if (!rst_ni) {wdone_q, rdone_q, bdue_q, rdue_q} <= '0;
  end

  // Requests that wait.
  logic [4:0] wwait_n, rwait_n;
  always @(posedge clk_i) begin
    wwait_n <= awvalid_i && wvalid_i && !awready ? wwait_n + {4'd0, wwait_n != 5'd31} : 5'd0;
    rwait_n <= arvalid_i && !arready ? rwait_n + {4'd0, rwait_n != 5'd31} : 5'd0;
    if (!rst_ni) {wwait_n, rwait_n} <= '0;
  end

  // The word bus as it was, while an access waits.
  logic        wait_q, write_q;
  logic [3:2]  addr_q;
  logic [31:0] out_q;
  logic [3:0]  be_q;
  always @(posedge clk_i) begin
    wait_q <= req && !word_ready_i && rst_ni;
    {write_q, addr_q, out_q, be_q} <= {write, addr, data, be};
  end

  wire dut_rest, dut_done;

  // An access runs from the clock after a rest with a request to its end.
  logic busy_q;
  always @(posedge clk_i) begin
    busy_q <= busy_q ? !done : dut_rest && ((awvalid_i && wvalid_i) || arvalid_i);
    if (!rst_ni) busy_q <= 1'b0;
  end

  always @* if (rst_ni) begin
    // A request is handed over after its access, and only then; a write with both halves.
    Write_A: assert (!awready || (wdone_q && awvalid_i && wvalid_i));
    Both_A:  assert (awready == wready);
    Read_A:  assert (!arready || (rdone_q && arvalid_i));
    // One access for each request.
    Once_A:  assert (!done || !(wdone_q || rdone_q || bdue_q || rdue_q));
    One_A:   assert ({2'd0, wdone_q} + {2'd0, rdone_q} + {2'd0, bdue_q} + {2'd0, rdue_q} < 3'd2);
    // Its answer follows, and no other.
    Answer_A: assert (bvalid == bdue_q && rvalid == rdue_q);
    if (bvalid) Bresp_A: assert (bresp == {error_q, 1'b0});
    if (rvalid) Rresp_A: assert (rresp == {error_q, 1'b0} && rdata == data_q);
    // What the word bus sees.
    if (req && write) Payload_A: assert (awvalid_i && wvalid_i && addr == awaddr_i &&
                                         data == wdata_i && be == wstrb_i);
    if (req && !write) Address_A: assert (arvalid_i && addr == araddr_i && be == 4'hF);
    if (wait_q) Stable_A: assert (req && write == write_q && addr == addr_q && be == be_q &&
                                  (!write || data == out_q));
    // Time.
    if (limited) Time_A: assert (wwait_n < 5'd20 && rwait_n < 5'd20);
    // Where a request stands, for the induction.
    Rest_A: assert (dut_rest == !(busy_q || wdone_q || rdone_q || bdue_q || rdue_q));
    Next_A: assert (wdone_q == awready && rdone_q == arready);
    Done_A: assert (dut_done == done);
  end else begin
    Reset_A: assert (!awready && !wready && !bvalid && !arready && !rvalid && !req);
  end

  always @* if (rst_ni) begin
    Busy_A: assert (req == busy_q);
    if (busy_q) Alone_A: assert (!(wdone_q || rdone_q || bdue_q || rdue_q));
  end

  always @(posedge clk_i) if (rst_ni) begin
    Turns_C: cover (done && write && wwait_n > 5'd8);
    Error_C: cover (rvalid && rready_i && rresp[1] && wwait_n != 5'd0);
    Slow_C:  cover (bvalid && answer_n == 2'd3);
  end

endmodule
