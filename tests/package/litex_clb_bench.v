// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SoC of examples/litex with biss_clb in Icarus, as a PC sees it: words over its serial port, and the pins of its
// line. The parameters are addresses and words that litex_test.py knows. It prints "good", or what is wrong.
`timescale 1ns / 1ps

module litex_bench;
  parameter [31:0] Origin = 0, EvStatus = 0, Identity = 0, Features = 0;
`include "litex_serial.vh"

  soc u_soc (
    .clk        (clk),
    .rst        (1'b0),
    .serial_tx  (tx),
    .serial_rx  (rx),
    .encoder_ma (ma),
    .encoder_sl (sl)
  );

  initial begin
    #10000;
    expect_word(Origin + 32'h200, 32'hFFFFFFFF, Identity);
    expect_word(Origin + 32'h208, 32'hFFFFFFFF, Features);
    write(Origin + 32'h010, 32'h00000ABC);
    expect_word(Origin + 32'h010, 32'hFFFFFFFF, 32'h00000ABC);
    // SL is bit 2 of STATE.
    expect_word(Origin + 32'h0C8, 32'h00000004, 32'h00000004);
    sl = 0;
    #2000;
    expect_word(Origin + 32'h0C8, 32'h00000004, 32'h00000000);
    sl = 1;
    // A frame of 10 MA clocks from START on, in a word of 12 bits, MA of 3.125 MHz: the word is an interrupt.
    expect_word(EvStatus, 32'h00000001, 32'h00000000);
    write(Origin + 32'h210, 32'h00000001);
    write(Origin + 32'h010, 32'd3);
    write(Origin + 32'h014, 32'd3);
    write(Origin + 32'h020, 32'd7);
    write(Origin + 32'h024, 32'd7);
    write(Origin + 32'h100, 32'h0000008B);
    write(Origin + 32'h104, 32'h00002021);
    write(Origin + 32'h098, 32'd12);
    write(Origin + 32'h0B0, 32'd10);
    write(Origin + 32'h044, 32'h00000002);
    write(Origin + 32'h0C4, 32'h00000002);
    write(Origin + 32'h0C0, 32'h00000080);
    write(Origin + 32'h000, 32'd3);
    edges = 0;
    write(Origin + 32'h0C0, 32'h00000081);
    write(Origin + 32'h040, 32'h00000001);
    #50000;
    if (edges < 20) begin
      $display("MA has %0d edges", edges);
      $finish;
    end
    expect_word(EvStatus, 32'h00000001, 32'h00000001);
    expect_word(Origin + 32'h108, 32'hFFFFFFFF, 32'h00000800);  // START, then zeros
    write(Origin + 32'h20C, 32'hFFFFFFFF);
    expect_word(EvStatus, 32'h00000001, 32'h00000000);
    $display("good");
    $finish;
  end
endmodule
