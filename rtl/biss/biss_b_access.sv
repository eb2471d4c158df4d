// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS B register access and initialisation, master side. One module serves all lines; it drives
// the lines that start_use_i names with start_i.
//
// Clock domain: core. ma_o tells the level of MA from the next tick on. The parts of an access:
//
// - Hand-over: MA is high, then low until all slaves answer with SL = 0. In an access with
//   mo_i MA is low for half a register clock instead, with any SL. INIT ends here.
// - Cells: a cell lasts one register clock, 2^(cell_shift_i + 1) MA periods. It begins with a
//   rising edge. MA is high for a quarter of it (bit 0), three quarters (bit 1), a half (read-out).
// - SL is taken at the rising edges. In a write it repeats the bit of two cells before; in a read
//   it brings the bits of the slave.
// - End: after the last stop bit MA stays at 1. The access ends two register clocks later: by then
//   SL has shown the stop bit over any cable (I405), so the next 1 on SL is the slave's timeout.
// - A wrong bit ends the access too: in a write after a stop bit, in a read at the end of the byte.
//
// ma_o.ends tells the end of an access and of INIT, end_o only that of an access. mo_low_o asks for
// MO = 0: in an access from its first clock on, in INIT from the falling edge of MA on.
//
// Misuse: the configuration must be stable while active_o is high.
// Datasheet: pages 13, 16, 30, 34, Figures 9, 14..16, Table 36; decisions 6, 7.

`include "enc_check.svh"

module biss_b_access (
  input  logic       clk_i,
  input  logic       rst_ni,
  // configuration
  input  logic [2:0] cell_shift_i,   // length of a cell
  input  biss_pkg::access_t access_i,
  input  logic       mo_i,           // the slaves get MO
  // control
  input  logic       start_i,
  input  logic [1:0] start_use_i,    // with start_i: lines {2, 1}; SL of the lower one is read
  input  logic       init_i,         // with start_i: hand-over only
  input  logic       abort_i,
  input  logic       tick_i,
  input  logic       expired_i,      // the wait for SL has lasted too long
  output logic       wait_o,
  output logic       active_o,
  // lines
  input  logic [1:0] sl_i,           // synchronised
  output biss_pkg::register_ma_t ma_o,
  output logic [1:0] mo_low_o,
  // data of the access: the byte is valid one clock after its address
  output biss_pkg::access_byte_t byte_o,
  input  logic [7:0] rdata_i,
  // result
  output logic       ags_error_o,    // no hand-over
  output biss_pkg::access_end_t end_o
);

  typedef enum logic [2:0] {
    IDLE,
    REQUEST,       // MA high
    HAND_OVER,     // MA low
    ADDRESS,
    WRITE,
    READ,
    SETTLE         // MA high
  } state_e;

  // Cell numbers in a part: start bit (0), fields, CRC, stop bit.
  localparam logic [4:0] ADDRESS_CRC  = 5'd12;
  localparam logic [4:0] ADDRESS_STOP = 5'd16;
  localparam logic [4:0] BYTE_CRC     = 5'd9;
  localparam logic [4:0] BYTE_LAST    = 5'd12;   // last bit of the CRC
  localparam logic [4:0] BYTE_STOP    = 5'd13;

  // Cells from `first` to the one before `behind`, one bit for each. A set costs less than two
  // comparisons.
  function automatic logic [31:0] cells(input logic [4:0] first, input logic [4:0] behind);
    cells = (32'd1 << behind) - (32'd1 << first);
  endfunction

  localparam logic [31:0] ADDRESS_FIELDS = cells(5'd1, ADDRESS_CRC);
  localparam logic [31:0] ADDRESS_CRCS   = cells(ADDRESS_CRC, ADDRESS_STOP);
  localparam logic [31:0] BYTE_FIELDS    = cells(5'd1, BYTE_CRC);
  localparam logic [31:0] BYTE_CRCS      = cells(BYTE_CRC, BYTE_STOP);

  state_e      state_d;
  state_e      state_q;
  logic        init_q;
  logic [1:0]  use_q;
  logic        mo_q;
  logic        sl;          // the line that is read
  logic [6:0]  pre_q;       // ticks left in the quarter
  logic [1:0]  phase_q;     // quarter of the cell
  logic [1:0]  phase_next;  // quarter after this clock
  logic [4:0]  cell_d;
  logic [4:0]  cell_q;      // cell of the part; a read waits in cell 0 for the start bit
  logic [10:0] bits_d;
  logic [10:0] bits_q;      // next bit on top; in a read: the bits received
  logic [3:0]  crc_d;
  logic [3:0]  crc_q;
  logic [5:0]  index_d;
  logic [5:0]  index_q;     // good bytes
  logic        fail_d;
  logic        fail_q;      // a bit came back differently, or the CRC is wrong
  logic [1:0]  sent_q;      // bits of the last two cells
  logic [1:0]  check_q;     // ... must come back on SL
  logic [1:0]  sample_q;    // rising edge of MA, delayed two clocks as sl_i is
  logic        fresh_q;     // the read has not clocked the slave yet
  logic        active_q;    // state_q is not IDLE
  logic        begins;      // an access begins; state_d does not tell it
  logic        ma;
  logic        ends;
  logic        wr_en;
  logic        reg_error, delay_error;
  logic        quarter;
  logic        boundary;    // the next cell begins
  logic        in_fields;
  logic        in_crc;
  logic        out;         // bit of this cell
  logic        sample;
  logic        feed;
  logic        divide;
  logic        last;        // this byte is the last one

  assign sl         = use_q[0] ? sl_i[0] : sl_i[1];
  assign quarter    = tick_i && pre_q == 7'd0;
  assign phase_next = phase_q + {1'b0, quarter};
  assign boundary   = quarter && phase_q == 2'd3;
  assign in_fields  = state_q == ADDRESS ? ADDRESS_FIELDS[cell_q] : BYTE_FIELDS[cell_q];
  assign in_crc     = state_q == ADDRESS ? ADDRESS_CRCS[cell_q] : BYTE_CRCS[cell_q];
  assign out        = cell_q == 5'd0 || (in_fields && bits_q[10]) || (in_crc && !crc_q[3]);
  assign sample     = sample_q[1];
  assign last       = index_q == access_i.byte_last;

  // CRC over the fields: bits that are sent count cell by cell, received bits sample by sample.
  assign feed   = in_fields && (state_q == READ ? sample : boundary);
  assign divide = feed && (crc_q[3] ^ (state_q == READ ? sl : bits_q[10]));

  always_comb begin
    crc_d = crc_q;
    if (cell_q == 5'd0)                                        crc_d = 4'h0;
    else if (feed || (in_crc && (state_q == READ ? sample : boundary)))
      crc_d = {crc_q[2:0], 1'b0} ^ (divide ? biss_pkg::CONTROL_CRC_POLY : 4'h0);
  end

  always_comb begin
    state_d         = state_q;
    cell_d          = cell_q;
    bits_d          = bits_q;
    index_d         = index_q;
    fail_d          = fail_q;
    ends           = 1'b0;
    ags_error_o     = 1'b0;
    reg_error     = 1'b0;
    delay_error   = 1'b0;
    wr_en   = 1'b0;

    unique case (state_q)
      IDLE: begin
        // No access. biss_frame drives MA.
        cell_d  = 5'd0;
        fail_d  = 1'b0;
        if (start_i) index_d = 6'd0;
      end
      REQUEST: begin
        // MA is high up to the next tick.
        bits_d = {access_i.id, access_i.addr, access_i.write};
        if (tick_i) state_d = HAND_OVER;
      end
      HAND_OVER: begin
        // MA is low. The slaves change to register mode and answer with SL = 0.
        if (quarter) begin
          if (mo_q && !init_q) begin
            if (phase_q == 2'd1) state_d = ADDRESS;
          end else if ((use_q & sl_i) == 2'b00) begin
            state_d = init_q ? IDLE : ADDRESS;
            ends    = init_q;
          end else if (expired_i) begin
            state_d     = IDLE;
            ends        = 1'b1;
            ags_error_o = 1'b1;
          end
        end
      end
      ADDRESS: begin
        // MA sends start bit, slave ID, address, direction, CRC and stop bit.
        if (boundary) begin
          cell_d = cell_q + 5'd1;
          if (in_fields) bits_d = {bits_q[9:0], 1'b0};
          if (cell_q == ADDRESS_STOP) begin
            cell_d  = 5'd0;
            state_d = access_i.write ? WRITE : READ;
          end
        end
      end
      WRITE: begin
        // MA sends start bit, data, CRC and stop bit of each byte. SL repeats them.
        if (boundary) begin
          cell_d = cell_q == BYTE_STOP ? 5'd0 : fail_q ? BYTE_STOP : cell_q + 5'd1;
          bits_d = cell_q == 5'd0 ? {rdata_i, 3'b000} : {bits_q[9:0], 1'b0};
        end
        if (sample) begin
          fail_d = fail_q || (check_q[1] && sl != sent_q[1]);
          // The last CRC bit of the previous byte has come back.
          if (cell_q == 5'd0 && (check_q[1] || fail_q)) begin
            if (fail_d || last) state_d = SETTLE;
            if (!fail_d) index_d = index_q + 6'd1;
          end
        end
      end
      READ: begin
        // MA clocks. SL brings start bit, data, CRC and stop bit of each byte.
        if (sample && !fresh_q) begin
          if (cell_q != 5'd0 || sl) cell_d = cell_q + 5'd1;
          if (in_fields) bits_d = {bits_q[9:0], sl};
          if (in_crc && sl == crc_q[3]) fail_d = 1'b1;
          if (cell_q == BYTE_LAST) begin
            wr_en = !fail_d;
            if (!fail_d) index_d = index_q + 6'd1;
            if (fail_d || last) state_d = SETTLE;
          end
          if (cell_q == BYTE_STOP || state_d == SETTLE) cell_d = 5'd0;
        end
        if (boundary && cell_q == 5'd0 && expired_i) begin
          state_d     = IDLE;
          ends        = 1'b1;
          delay_error = 1'b1;
        end
      end
      SETTLE: begin
        // MA stays high while the last stop bit travels to SL.
        if (sample) cell_d = 5'd1;
        if (sample && cell_q != 5'd0) begin
          state_d   = IDLE;
          ends      = 1'b1;
          reg_error = fail_q;
        end
      end
      default: state_d = IDLE;
    endcase

    if (abort_i) begin
      state_d = IDLE;
      ends    = 1'b0;
    end
  end

  // start_i comes late, and MA, which is 1 then, does not wait for it.
  assign begins = state_q == IDLE && start_i && !abort_i;

  // Level of MA after the next tick.
  always_comb begin
    ma = 1'b1;
    if (state_d == HAND_OVER) begin
      ma = 1'b0;
    end else if (state_q != HAND_OVER && state_d != SETTLE && state_d != IDLE) begin
      if (phase_next == 2'd1) ma = out || state_q == READ;
      if (phase_next == 2'd2) ma = out && state_q != READ;
      if (phase_next == 2'd3) ma = 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= IDLE;
      active_q <= 1'b0;
      init_q   <= 1'b0;
      use_q    <= '0;
      mo_q     <= 1'b0;
      pre_q    <= '0;
      phase_q  <= '0;
      cell_q   <= '0;
      bits_q   <= '0;
      crc_q    <= '0;
      index_q  <= '0;
      fail_q   <= 1'b0;
      sent_q   <= '0;
      check_q  <= '0;
      sample_q <= '0;
      fresh_q  <= 1'b0;
    end else begin
      state_q  <= begins ? REQUEST : state_d;
      active_q <= begins || state_d != IDLE;
      cell_q   <= cell_d;
      bits_q   <= bits_d;
      crc_q    <= crc_d;
      index_q  <= index_d;
      fail_q   <= fail_d;
      sample_q <= {sample_q[0], boundary};
      if (start_i && state_q == IDLE) {use_q, init_q, mo_q} <= {start_use_i, init_i, mo_i};
      if (state_q == IDLE || state_q == REQUEST || quarter) pre_q <= (7'd1 << cell_shift_i) - 7'd1;
      else if (tick_i)                                      pre_q <= pre_q - 7'd1;
      if (state_q == IDLE || state_q == REQUEST || (state_q == HAND_OVER && state_d == ADDRESS))
        phase_q <= 2'd0;
      else
        phase_q <= phase_next;
      if (boundary) begin
        sent_q  <= {sent_q[0], out};
        check_q <= {check_q[0], state_q == WRITE && cell_q != BYTE_STOP};
        fresh_q <= state_q == ADDRESS;
      end
    end
  end

  assign ma_o.level = ma;
  assign ma_o.ends  = ends;
  assign end_o.ends        = ends && !init_q;
  assign end_o.reg_error   = reg_error;
  assign end_o.delay_error = delay_error;
  assign end_o.good_bytes  = index_q;
  assign byte_o.wr_en   = wr_en;
  assign byte_o.addr    = index_q;
  assign byte_o.wr_data = bits_q[7:0];
  assign mo_low_o = use_q & {2{init_q ? state_q == HAND_OVER : state_q != IDLE}};
  assign active_o = active_q;
  assign wait_o   = (state_q == HAND_OVER && (init_q || !mo_q)) ||
                           (state_q == READ && cell_q == 5'd0);

  `ENC_ASSERT(StateInRange_A, clk_i, rst_ni, state_q <= SETTLE)
  `ENC_ASSERT(CellInRange_A, clk_i, rst_ni, cell_q <= ADDRESS_STOP)

endmodule
