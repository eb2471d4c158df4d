// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Receive shifter of the SPI: bits to words of 1 to 16 bits, the first bit highest.
//
// Clock domain: core. push_o is high for one clock, one clock after the last bit of a word; word_o
// goes with it, right aligned, the other bits 0. clear_i drops the bits of a word that is not
// complete; it is high in the first clock after the reset.
//
// Misuse: last_i must change with clear_i only. A bit in the clock behind the last one of a word is
// lost, and so is a word that ends there.
// Source: the SPI of the C2000 parts.

module clb_receive (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,
  input  logic [3:0]  last_i,    // bits of a word minus 1
  input  logic        take_i,
  input  logic        bit_i,
  output logic        push_o,
  output logic [15:0] word_o
);

  logic [3:0]  bits_q;      // bits of the word so far
  logic        last;
  logic        push_q;
  logic [15:0] word_q;

  assign last = bits_q == last_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bits_q <= '0;
      push_q <= 1'b0;
    end else begin
      push_q <= take_i && last && !clear_i && !push_q;
      if (clear_i)     bits_q <= '0;
      else if (take_i) bits_q <= last ? 4'd0 : bits_q + 4'd1;
    end
  end

  // No reset: clear_i is high during it.
  always_ff @(posedge clk_i) begin
    if (push_q || clear_i) word_q <= '0;
    else if (take_i)       word_q <= {word_q[14:0], bit_i};
  end

  assign push_o = push_q;
  assign word_o = word_q;

endmodule
