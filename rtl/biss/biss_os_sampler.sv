// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SL input of one line, sampled eight times an MA period: finds the byte in which the acknowledge
// comes, counts its ones, and takes every bit at the same place of its period. It needs samples
// only, so it goes on after MA has stopped. biss_sl_sampler (four points) and biss_delay_sampler
// (one edge) are the other samplers.
//
// Clock domain: core; SL is asynchronous. sample_i is high in the clock that ends with the edge at
// which the pin is sampled: in the clock in which MA changes for the sample of this instant. The
// sample is used two clocks later, what comes of it follows one clock after that.
//
// - Bytes: eight samples up to the one with last_i, newest in bit 0. A byte ends while search_i is
//   high: byte_o, for one clock. If it is not 0xFF it is the one with the acknowledge: found_o goes
//   to 1, raw_o keeps it.
// - Sample point: place_o is the number of the sample, from the first one of this byte on, that is
//   the fifth low one by the count N of the ones: N + 4. With first_low_i it is the fourth behind
//   the first low one. 8 and above lie in the next byte. It is valid with found_o.
// - Bits: bit k behind the acknowledge (1 is the first one) is sample point_i + 8 k, counted in the
//   same way. bit_valid_o is high for one clock for each bit. point_i is what the user makes of
//   place_o, in the clock after found_o rises at the latest.
//
// Misuse: a sample closer than one clock to the one before is not possible. point_i below 4 needs
// two clocks between two samples at the first one. search_i must not rise while found_o is 1.
// Source: TIDEP0022, 3.2.4.2.5 to 3.2.4.2.7; docs/pru.md.

`include "enc_check.svh"

module biss_os_sampler (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       sl_i,         // pin
  // time base
  input  logic       sample_i,
  input  logic       last_i,       // with sample_i: the last one of a byte
  // frame
  input  logic       clear_i,      // a frame begins
  input  logic       search_i,     // bytes are looked at, by when their last sample is taken
  input  logic       first_low_i,
  input  logic [3:0] point_i,
  // results
  output logic       sl_o,         // synchronised level
  output logic       byte_o,       // a byte has been looked at
  output logic       found_o,
  output logic [7:0] raw_o,
  output logic [3:0] place_o,
  output logic       bit_valid_o,
  output logic       bit_o
);

  // What goes with a sample.
  typedef struct packed {
    logic sample;
    logic last;
    logic search;
  } strobe_t;

  logic       sl;
  strobe_t    strobe_d;
  strobe_t    strobe1_q;
  strobe_t    strobe2_q;    // the sample is in sl
  logic       taken;
  logic       begins_q;     // the next sample is the first one of a byte
  logic [7:0] byte_q;
  logic [2:0] ones_q;       // of the byte so far, or those before its first low sample
  logic       low_q;        // the byte has a low sample
  logic [2:0] ones;
  logic       low;
  logic       ends;         // the sample ends a byte that is looked at
  logic       found_q;
  logic       loads_q;      // first clock of found_o
  logic       byte_end_q;
  logic [3:0] place_q;
  logic [3:0] wait_q;       // samples before the one with the next bit
  logic       early_q;      // that bit is one sample nearer: a sample came in the clock of loads_q
  logic       take;
  logic       bit_valid_q;
  logic       bit_q;

  enc_sync_bit #(.ResetValue(1'b1)) u_sync (
    .clk_i,
    .rst_ni,
    .data_i (sl_i),
    .data_o (sl)
  );

  always_comb begin
    strobe_d.sample = sample_i;
    strobe_d.last   = last_i;
    strobe_d.search = search_i;
  end

  assign taken = strobe2_q.sample;

  // ---- Bytes --------------------------------------------------------------------------------

  // Of the byte so far with this sample. Eight ones are no transition: their count needs no fourth
  // bit.
  assign ones = (begins_q ? 3'd0 : ones_q) + 3'(sl && !(first_low_i && low_q && !begins_q));
  assign low  = !sl || (low_q && !begins_q);
  assign ends = taken && strobe2_q.last && strobe2_q.search && !found_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      strobe1_q  <= '0;
      strobe2_q  <= '0;
      begins_q   <= 1'b1;
      byte_q     <= '0;
      ones_q     <= '0;
      low_q      <= 1'b0;
      found_q    <= 1'b0;
      loads_q    <= 1'b0;
      byte_end_q <= 1'b0;
      place_q    <= '0;
    end else begin
      strobe1_q  <= strobe_d;
      strobe2_q  <= strobe1_q;
      loads_q    <= ends && low && !clear_i;
      byte_end_q <= ends && !clear_i;
      if (clear_i)          found_q <= 1'b0;
      else if (ends && low) found_q <= 1'b1;
      if (taken) begin
        begins_q <= strobe2_q.last;
        ones_q   <= ones;
        low_q    <= low;
      end
      if (taken && !found_q) byte_q  <= {byte_q[6:0], sl};
      if (ends)              place_q <= {1'b0, ones} + 4'd4;
    end
  end

  // ---- Bits ---------------------------------------------------------------------------------

  // The sample behind the byte with the acknowledge has number 8: it holds bit 1 if point_i is 0.
  // That sample comes while wait_q gets point_i if samples follow clock by clock.
  assign take = found_q && !loads_q && taken && wait_q == {3'd0, early_q};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wait_q      <= '0;
      early_q     <= 1'b0;
      bit_valid_q <= 1'b0;
      bit_q       <= 1'b0;
    end else begin
      if (loads_q)   wait_q <= point_i;
      else if (take) wait_q <= 4'd7;
      else           wait_q <= wait_q - 4'(taken);
      early_q     <= loads_q ? taken : early_q && !take;
      bit_valid_q <= take && !clear_i;
      bit_q       <= sl;
    end
  end

  assign sl_o        = sl;
  assign byte_o      = byte_end_q;
  assign found_o     = found_q;
  assign raw_o       = byte_q;
  assign place_o     = place_q;
  assign bit_valid_o = bit_valid_q;
  assign bit_o       = bit_q;

  `ENC_ASSERT_NEXT(FoundIsKept_A, clk_i, rst_ni, found_q && !clear_i, found_q)
  `ENC_ASSERT_IF(OneTransition_A, clk_i, rst_ni, loads_q, byte_q != 8'hFF)

endmodule
