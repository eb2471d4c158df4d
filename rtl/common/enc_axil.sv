// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// AXI4-Lite subordinate in front of a word bus of 32 bits.
//
// Word bus: word_req_o asks for one access. Its address, data and byte enables stay until the clock
// with word_ready_i = 1; this clock does the access, and word_data_i and word_error_i are valid in
// it. While word_ready_i = 0 the access waits. Byte enables are 1111 at a read. A request can fall
// before its ready (see Misuse): then its answer is not used.
//
// Clock domain: clk_i. Every output of the AXI side is a flop (IHI0022, A3.1.1).
// Latency: an access that does not wait answers 3 clocks after its valid; the next one can begin 2
// clocks after the answer is taken. One access runs at a time. If a write and a read wait, the two
// kinds take turns.
// A write begins when its address and its data are both there. AWREADY, WREADY and ARREADY rise
// only after the access is done, so address and data need no registers here.
// Responses: OKAY, or SLVERR with word_error_i. AWPROT and ARPROT do not exist here: they would
// change nothing.
//
// Misuse: a manager that takes back AWVALID, WVALID or ARVALID before its ready takes back
// word_req_o in the same clock and gets no answer; a write may then have been done or not. Address
// bits 1..0 do not exist here: the word that holds the byte is accessed. A manager that changes its
// payload under VALID changes it on the word bus too.
// Source: AMBA AXI and ACE protocol specification (IHI0022), part B1, and A3.

module enc_axil #(
  parameter int unsigned AddrW = 12
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  // AXI4-Lite
  input  logic             s_axi_awvalid,
  output logic             s_axi_awready,
  input  logic [AddrW-1:2] s_axi_awaddr,
  input  logic             s_axi_wvalid,
  output logic             s_axi_wready,
  input  logic [31:0]      s_axi_wdata,
  input  logic [3:0]       s_axi_wstrb,
  output logic             s_axi_bvalid,
  input  logic             s_axi_bready,
  output logic [1:0]       s_axi_bresp,
  input  logic             s_axi_arvalid,
  output logic             s_axi_arready,
  input  logic [AddrW-1:2] s_axi_araddr,
  output logic             s_axi_rvalid,
  input  logic             s_axi_rready,
  output logic [31:0]      s_axi_rdata,
  output logic [1:0]       s_axi_rresp,
  // word bus
  output logic             word_req_o,
  output logic             word_write_o,
  output logic [AddrW-1:2] word_addr_o,
  output logic [31:0]      word_data_o,
  output logic [3:0]       word_be_o,
  input  logic             word_ready_i,
  input  logic [31:0]      word_data_i,
  input  logic             word_error_i
);

  logic        busy_d, busy_q;        // an access runs, of the kind write_q
  logic        write_d, write_q;      // the access that runs is a write
  logic        awready_d, awready_q;  // also WREADY
  logic        arready_d, arready_q;
  logic        bvalid_d, bvalid_q;
  logic        rvalid_d, rvalid_q;
  logic        error_q;
  logic [31:0] data_q;
  logic        write, read;
  logic        rest;
  logic        done;

  assign write = s_axi_awvalid && s_axi_wvalid;
  assign read  = s_axi_arvalid;
  assign rest  = !(busy_q || awready_q || arready_q || bvalid_q || rvalid_q);

  assign word_req_o   = busy_q && (write_q ? write : read);
  assign word_write_o = write_q;
  assign word_addr_o  = write_q ? s_axi_awaddr : s_axi_araddr;
  assign word_data_o  = s_axi_wdata;
  assign word_be_o    = s_axi_wstrb | {4{!write_q}};
  assign done         = word_req_o && word_ready_i;

  assign write_d   = rest ? write && !(read && write_q) : write_q;
  assign busy_d    = rest ? write || read : word_req_o && !word_ready_i;
  assign awready_d = done && write_q;
  assign arready_d = done && !write_q;
  assign bvalid_d  = (awready_q && write) || (bvalid_q && !s_axi_bready);
  assign rvalid_d  = (arready_q && read) || (rvalid_q && !s_axi_rready);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q    <= 1'b0;
      write_q   <= 1'b0;
      awready_q <= 1'b0;
      arready_q <= 1'b0;
      bvalid_q  <= 1'b0;
      rvalid_q  <= 1'b0;
      error_q   <= 1'b0;
      data_q    <= '0;
    end else begin
      busy_q    <= busy_d;
      write_q   <= write_d;
      awready_q <= awready_d;
      arready_q <= arready_d;
      bvalid_q  <= bvalid_d;
      rvalid_q  <= rvalid_d;
      if (done) begin
        error_q <= word_error_i;
        data_q  <= word_data_i;
      end
    end
  end

  assign s_axi_awready = awready_q;
  assign s_axi_wready  = awready_q;
  assign s_axi_bvalid  = bvalid_q;
  assign s_axi_bresp   = {error_q, 1'b0};
  assign s_axi_arready = arready_q;
  assign s_axi_rvalid  = rvalid_q;
  assign s_axi_rdata   = data_q;
  assign s_axi_rresp   = {error_q, 1'b0};

endmodule
