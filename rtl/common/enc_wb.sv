// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Wishbone B4 slave in front of a word bus of 32 bits: classic cycles, or pipelined ones.
//
// Word bus: word_req_o asks for one access. Its address, data and byte enables stay until the clock
// with word_ready_i = 1; this clock does the access, and word_data_i and word_error_i are valid in
// it. While word_ready_i = 0 the access waits. Byte enables are 1111 at a read. A request can fall
// before its ready (see Misuse): then its answer is not used.
//
// Clock domain: clk_i. Outputs of the Wishbone side are flops. Only ACK and ERR fall with CYC
// (classic: and STB), so that a cycle which has ended is never answered.
// Latency: a classic access that does not wait is acknowledged 2 clocks after its STB, a pipelined
// one 3 clocks after it; a clock less directly after another access. One access runs at a time.
// With Pipelined the module stalls until the access is done, so address and data need no registers
// here.
// wb_err_o takes the place of wb_ack_o after an access with word_error_i.
//
// Misuse: a master may end its cycle (CYC = 0) or take back STB before the access is done. This
// takes back word_req_o in the same clock, and no answer comes; a write may then have been done or
// not. A master that changes address or data under STB changes them on the word bus too.
// Source: Wishbone B4, sections 3.1.3 to 3.2.

module enc_wb #(
  parameter int unsigned AddrW = 12,
  parameter bit Pipelined = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  // Wishbone
  input  logic             wb_cyc_i,
  input  logic             wb_stb_i,
  input  logic             wb_we_i,
  input  logic [AddrW-1:2] wb_adr_i,
  input  logic [31:0]      wb_dat_i,
  input  logic [3:0]       wb_sel_i,
  output logic [31:0]      wb_dat_o,
  output logic             wb_ack_o,
  output logic             wb_err_o,
  output logic             wb_stall_o,   // of pipelined cycles; classic masters leave it open
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

  logic        busy_q;      // STB was there a clock ago and still waits
  logic        accept_q;    // the access is done: this clock takes STB
  logic        ack_q;
  logic        err_q;
  logic        error_q;
  logic [31:0] data_q;
  logic        strobe;
  logic        done;

  assign strobe = wb_cyc_i && wb_stb_i;

  assign word_req_o   = busy_q && strobe;
  assign word_write_o = wb_we_i;
  assign word_addr_o  = wb_adr_i;
  assign word_data_o  = wb_dat_i;
  assign word_be_o    = wb_sel_i | {4{!wb_we_i}};
  assign done         = word_req_o && word_ready_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q   <= 1'b0;
      accept_q <= 1'b0;
      ack_q    <= 1'b0;
      err_q    <= 1'b0;
      error_q  <= 1'b0;
      data_q   <= '0;
    end else begin
      busy_q   <= strobe && !done;
      accept_q <= done;
      ack_q    <= Pipelined ? accept_q && strobe && !error_q : done && !word_error_i;
      err_q    <= Pipelined ? accept_q && strobe && error_q : done && word_error_i;
      if (done) begin
        error_q <= word_error_i;
        data_q  <= word_data_i;
      end
    end
  end

  assign wb_dat_o   = data_q;
  assign wb_ack_o   = ack_q && wb_cyc_i && (Pipelined || wb_stb_i);
  assign wb_err_o   = err_q && wb_cyc_i && (Pipelined || wb_stb_i);
  assign wb_stall_o = !accept_q;

endmodule
