// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SPI slave in front of a word bus of 32 bits, in modes 0 and 3. The pins are sampled by clk_i.
//
// Frame, 7 bytes, each with its highest bit first:
//
//   MOSI   opcode  address  any                4 bytes to write, or any
//   MISO   0       0        answer: 0101sv0r   4 bytes read, else 0
//
//   opcode 02 writes a word, 03 reads one, 04 clears s and v. The address is that of a byte; its
//   bits 1..0 do not count.
//   r  1: the frame was understood, and after opcode 03 the word read follows. 0: no word follows.
//   s  sticky: an access came too late for its frame, or a write was still waiting when a frame
//      began.
//   v  sticky: a frame was void, or there was a reset.
//   A void frame has another number of bits or r = 0. It writes nothing and clears nothing. A frame
//   of no bits is none.
//
// A word is read after the last bit of its address. A write and a clear are done when cs_ni rises
// after exactly 56 bits.
//
// Word bus: word_req_o asks for one access. Its address, data and byte enables stay until the clock
// with word_ready_i = 1; this clock does the access, and word_data_i and word_error_i are valid in
// it. While word_ready_i = 0 the access waits. A read is taken back if its frame ends or needs the
// answer before. word_error_i makes the frame of its access void: r = 0 for a read, v for a write.
//
// Clock domain: clk_i; sclk_i, cs_ni and mosi_i are asynchronous. MOSI is taken 0 to 1 clocks after
// the rising edge of SCLK; MISO changes 2 to 3 clocks after it, whatever the falling edge does.
// Latency: word_req_o follows the edge of a pin that asks for it by 3 to 4 clocks. A read must be
// answered in the time of 7 bits, less a clock.
//
// Misuse: a high or low phase of SCLK of less than a clock, or a high phase of cs_ni of less than
// two clocks, may be missed. The frame is then void, or it joins the next one and both are.
// Constraint: false path to the first flop of each pin; cs_ni to miso_oe_o is combinational.

`include "enc_check.svh"

module enc_spi #(
  parameter int unsigned AddrW = 8     // bits of an address, 3 to 8
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  // SPI
  input  logic             sclk_i,
  input  logic             cs_ni,
  input  logic             mosi_i,
  output logic             miso_o,
  output logic             miso_oe_o,
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

  localparam logic [7:0] OPCODE_WRITE = 8'h02;
  localparam logic [7:0] OPCODE_READ  = 8'h03;
  localparam logic [7:0] OPCODE_CLEAR = 8'h04;
  localparam logic [5:0] LAST_ADDRESS = 6'd15;   // bits before the one that ends the address
  localparam logic [5:0] LAST_ANSWER  = 6'd22;   // bits before the last moment of an answer
  localparam logic [5:0] FRAME_BITS   = 6'd56;

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (AddrW < 3 || AddrW > 8) begin : gen_limits
    $error("AddrW is 3 to 8");
  end
`endif

  logic        sclk, cs_n, mosi;
  logic        sclk_q;
  logic        cs_nq;
  logic        rise;       // of SCLK, in a frame
  logic        frame_end;
  logic [5:0]  count_q;    // bits of the frame; 63: more than count
  logic        hold;       // the answer has the shift register
  logic        address_end;
  logic        waits;      // a write of the frame before
  logic        blocked_q;  // it was there when the frame began
  logic        req_q;
  logic        write_q;    // opcode
  logic        clear_q;    // opcode
  logic        got_q;      // the shift register has the word read
  logic        late_q;
  logic        void_q;
  logic [AddrW-1:2] addr_q;
  logic [31:0] shift_q;    // bits of MOSI, or the word read
  logic [7:0]  opcode;
  logic        too_late;
  logic        accept;     // the frame ends and has its effect
  logic        ready;      // bit r of the answer
  logic        answer;     // bit of MISO in the turn byte
  logic        miso_q;

  // cs_ni counts as low until the pin has been seen: a frame that a reset cuts stays void.
  enc_sync_bit u_sclk (.clk_i, .rst_ni, .data_i(sclk_i), .data_o(sclk));
  enc_sync_bit u_cs   (.clk_i, .rst_ni, .data_i(cs_ni),  .data_o(cs_n));
  enc_sync_bit u_mosi (.clk_i, .rst_ni, .data_i(mosi_i), .data_o(mosi));

  assign rise        = !cs_n && sclk && !sclk_q;
  assign frame_end   = cs_n && !cs_nq;
  assign hold        = count_q[5:3] == 3'd2 && count_q[2:0] != 3'd7;
  assign address_end = rise && count_q == LAST_ADDRESS && !blocked_q;
  assign opcode      = shift_q[14:7];
  assign waits       = req_q && write_q;
  assign too_late    = rise && count_q == LAST_ANSWER;
  assign ready       = (got_q || write_q || clear_q) && !blocked_q;
  assign accept      = frame_end && count_q == FRAME_BITS && ready;

  always_comb begin
    unique case (count_q[2:0])
      3'd0:    answer = 1'b1;
      3'd2:    answer = 1'b1;
      3'd3:    answer = late_q;
      3'd4:    answer = void_q;
      3'd6:    answer = ready;
      default: answer = 1'b0;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sclk_q    <= 1'b0;
      cs_nq     <= 1'b0;
      count_q   <= 6'h3F;
      blocked_q <= 1'b0;
      req_q     <= 1'b0;
      write_q   <= 1'b0;
      clear_q   <= 1'b0;
      got_q     <= 1'b0;
      late_q    <= 1'b0;
      void_q    <= 1'b0;
      addr_q    <= '0;
      shift_q   <= '0;
      miso_q    <= 1'b0;
    end else begin
      sclk_q    <= sclk;
      cs_nq     <= cs_n;
      if (cs_n) count_q <= '0;
      else      count_q <= count_q + 6'(rise && count_q != 6'h3F);
      blocked_q <= !cs_n && (blocked_q || (rise && waits));
      // A write stays until it is done, a read until its frame cannot use it any more.
      req_q     <= (req_q && !word_ready_i && (write_q || !(cs_n || too_late))) ||
                   (address_end && opcode == OPCODE_READ) || (accept && write_q);
      if (address_end) begin
        write_q <= opcode == OPCODE_WRITE;
        clear_q <= opcode == OPCODE_CLEAR;
        addr_q  <= shift_q[AddrW-2:1];
      end
      got_q     <= !address_end && (got_q || (req_q && !write_q && word_ready_i && !too_late &&
                                              !word_error_i));
      late_q    <= (late_q && !(accept && clear_q)) || (rise && waits) ||
                   (too_late && req_q && !write_q);
      void_q    <= (void_q && !(accept && clear_q)) || (frame_end && count_q != '0 && !accept) ||
                   (waits && word_ready_i && word_error_i);
      if (req_q ? !write_q && word_ready_i : rise && !hold && !blocked_q)
        shift_q <= req_q ? word_data_i : {shift_q[30:0], mosi};
      if (rise) miso_q <= hold ? answer : got_q && count_q[5:4] != 2'd0 && shift_q[31];
    end
  end

  assign miso_o       = miso_q;
  assign miso_oe_o    = !cs_ni;
  assign word_req_o   = req_q;
  assign word_write_o = write_q;
  assign word_addr_o  = addr_q;
  assign word_data_o  = shift_q;
  assign word_be_o    = 4'hF;

endmodule
