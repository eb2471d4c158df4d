// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SPI neither loses nor doubles a byte, at any phase of its pins: each byte that the master has
// sent arrives once, at its address; each byte read goes out on MISO bit by bit. MISO is never
// driven while NCS is high. Expected: the opcodes of datasheet pages 17..19, Table 3.
//
// claim: every byte once and at its address; MISO is the byte read; not driven with NCS = 1
// clocks: many
// depth: 20
// cover: 21
// unbounded: induction 3
// look: dut_bit = u_dut.u_shift.bit_q
// look: dut_shift = u_dut.u_shift.shift_q
// look: dut_out = u_dut.u_shift.out_q
// look: dut_state = u_dut.u_cmd.state_q
// look: dut_addr = u_dut.u_cmd.addr_q
// look: dut_open = u_dut.open_q
// mutation: mb4/host/mb4_spi_shift.sv | bit_q + 3'd1 | bit_q + 3'd1 + {2'b00, &bit_q}
// mutation: mb4/host/mb4_spi.sv | assign miso_oe_o = !cs_ni; | assign miso_oe_o = open_q;
// mutation: mb4/host/mb4_spi_shift.sv | {out_q, 1'b0} | {miso_q, out_q}
// mutation: mb4/host/mb4_spi_cmd.sv | addr_d  = fixed; | addr_d  = addr_q;

module proof (
  input logic       rst_ni,
  input logic       sclk_i,
  input logic       cs_ni,
  input logic       mosi_i,
  input logic [7:0] mem_i    // what the next read finds
);

  (* gclk *) logic gclk;

  logic       miso, miso_oe;
  logic       wr_en, rd_en;
  logic [7:0] wr_addr, wr_data, rd_addr, rd_data_q;
  mb4_pkg::host_t host;
  assign {wr_en, wr_addr, wr_data, rd_en, rd_addr} = host;

  mb4_spi u_dut (
    .rst_ni,
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o    (miso),
    .miso_oe_o (miso_oe),
    .host_o    (host),
    .rd_data_i (rd_data_q)
  );

  always @(posedge sclk_i) if (rd_en) rd_data_q <= mem_i;

  // ---- the pins: reset first, one moves at a time, data are stable around the rising edge ------

  logic started = 1'b0;
  logic rst_q, sclk_q, cs_q, mosi_q;
  logic [7:0] mem_q;

  always @(posedge gclk) begin
    started <= 1'b1;
    rst_q   <= rst_ni;
    sclk_q  <= sclk_i;
    cs_q    <= cs_ni;
    mosi_q  <= mosi_i;
    mem_q   <= mem_i;
  end

  always @* begin
    if (!started) assume (!rst_ni && cs_ni && !sclk_i);
    if (started) begin
      assume ({1'b0, rst_q != rst_ni} + {1'b0, sclk_q != sclk_i} + {1'b0, cs_q != cs_ni} < 2'd2);
      if (sclk_i && !sclk_q) assume (mosi_i == mosi_q && mem_i == mem_q);
    end
  end

  // ---- what the master has sent -----------------------------------------------------------------

  logic       open_q;   // a frame has begun since the reset
  logic       selected;
  logic [2:0] bits_q;
  logic [7:0] bytes_q;  // complete ones, modulo 256
  logic       second_q, third_q;
  logic [7:0] last_q, op_q, addr_q, out_q;
  logic [7:0] now;

  always @(negedge cs_ni or negedge rst_ni) begin
    if (!rst_ni) open_q <= 1'b0;
    else         open_q <= 1'b1;
  end

  assign selected = open_q && !cs_ni;
  assign now      = {last_q[6:0], mosi_i};

  logic full, writes, reads, wr_exp, rd_exp;
  logic [7:0] wr_addr_exp, rd_addr_exp, op;

  assign full   = bits_q == 3'd7;
  assign op     = second_q ? op_q : now;
  assign writes = second_q && (op_q == 8'h07 || op_q == 8'h0B || (op_q == 8'h02 && third_q));
  assign reads  = op == 8'h05 || op == 8'h09 || (op_q == 8'h03 && second_q);
  assign wr_exp = full && writes;
  assign rd_exp = full && reads;
  assign wr_addr_exp = op_q == 8'h07 ? 8'hF4 + bytes_q - 8'd1 :
                       op_q == 8'h0B ? bytes_q - 8'd1 : addr_q + bytes_q - 8'd2;
  assign rd_addr_exp = op == 8'h05 ? 8'hF0 + bytes_q :
                       op == 8'h09 ? bytes_q :
                       third_q ? addr_q + bytes_q - 8'd1 : now;

  always @(posedge sclk_i or negedge selected) begin
    if (!selected) begin
      bits_q   <= '0;
      bytes_q  <= '0;
      second_q <= 1'b0;
      third_q  <= 1'b0;
      last_q   <= '0;
      op_q     <= '0;
      addr_q   <= '0;
      out_q    <= '0;
    end else begin
      bits_q <= bits_q + 3'd1;
      last_q <= now;
      if (full) begin
        bytes_q  <= bytes_q + 8'd1;
        second_q <= 1'b1;
        third_q  <= second_q;
        if (!second_q)             op_q   <= now;
        if (second_q && !third_q)  addr_q <= now;
        out_q <= rd_exp ? mem_i : 8'h00;
      end
    end
  end

  // ---- checks, at the edges at which others sample ----------------------------------------------

  always @(posedge sclk_i) begin
    if (selected) begin
      WriteAsSent_A: assert (wr_en == wr_exp);
      // With some unknown opcodes a byte is read that nobody asked for; it is not sent.
      ReadAsAsked_A: assert (rd_en == (rd_exp || (full && !second_q && !now[1])));
      if (wr_exp) WriteByte_A: assert (wr_addr == wr_addr_exp && wr_data == now);
      if (rd_exp) ReadAddr_A: assert (rd_addr == rd_addr_exp);
      MisoIsTheByte_A: assert (miso == out_q[3'd7 - bits_q]);
      ReadAsked_C: cover (rd_exp && op == 8'h09);
      DataRead_C: cover (miso && op_q == 8'h05);
    end else begin
      NotSelected_A: assert (!wr_en && !rd_en);
    end
  end

  always @* NotDriven_A: assert (!(cs_ni && miso_oe));

  // ---- how the states of block and bench belong together, for the induction ---------------------

  localparam logic [2:0] OPCODE = 3'd0, ADDR_WRITE = 3'd1, ADDR_READ = 3'd2, WRITE = 3'd3,
                         READ = 3'd4, IGNORE = 3'd5;

  wire [2:0] dut_bit, dut_state;
  wire [6:0] dut_shift, dut_out;
  wire [7:0] dut_addr;
  wire       dut_open;
  logic [2:0] state;

  always @* begin
    state = IGNORE;
    if (!second_q)                                    state = OPCODE;
    else if (writes)                                  state = WRITE;
    else if (op_q == 8'h02)                           state = ADDR_WRITE;
    else if (op_q == 8'h03 && !third_q)               state = ADDR_READ;
    else if (reads)                                   state = READ;
  end

  always @* if (started) begin
    SameFrame_A: assert (dut_open == open_q);
    SameBits_A: assert (dut_bit == bits_q && dut_shift == last_q[6:0]);
    SameState_A: assert (dut_state == state);
    Counted_A: assert ((third_q ? second_q : bytes_q == {7'd0, second_q}));
    if (state == WRITE) SameWriteAddr_A: assert (dut_addr == wr_addr_exp);
    if (state == READ) SameReadAddr_A: assert (dut_addr + 8'd1 == rd_addr_exp);
    if (state == READ) SameByte_A: assert (rd_data_q == out_q);
    if (state != READ) NoByte_A: assert (out_q == 8'h00);
    if (selected && !sclk_i) NextMiso_A: assert ({miso, dut_out} == out_q << bits_q);
    if (selected && sclk_i && bits_q != 3'd0)
      Following_A: assert ({miso, dut_out} == out_q << (bits_q - 3'd1));
    if (!selected) AtRest_A: assert (bits_q == 3'd0 && !second_q && !miso);
  end

endmodule
