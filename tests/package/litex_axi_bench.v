// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SoC of examples/litex with biss_axi in Icarus, as a PC sees it: words over its serial port, and the pins of its
// line. The parameters are addresses and words that litex_test.py knows. It prints "good", or what is wrong.
`timescale 1ns / 1ps

module litex_bench;
  parameter [31:0] Origin = 0, EvStatus = 0, Identity = 0, Features = 0;
`include "litex_serial.vh"

  soc u_soc (
    .clk         (clk),
    .rst         (1'b0),
    .serial_tx   (tx),
    .serial_rx   (rx),
    .encoder_ma  (ma),
    .encoder_slo (sl)
  );

  initial begin
    #10000;
    expect_word(Origin + 32'h40, 32'hFFFFFFFF, Identity);
    expect_word(Origin + 32'h48, 32'hFFFFFFFF, Features);
    write(Origin + 32'h08, 32'd1);   // single point
    write(Origin + 32'h14, 32'd5);   // MA of 2.5 MHz
    write(Origin + 32'h18, 32'd12);  // bits
    expect_word(Origin + 32'h18, 32'hFFFFFFFF, 32'd12);
    write(Origin + 32'h20, 32'd1);   // channel 0
    write(Origin + 32'h50, 32'd1);   // interrupt: a frame has ended
    #200000;                         // the reset holds starts back for 160 us
    edges = 0;
    write(Origin + 32'h0C, 32'd1);
    #50000;
    if (edges < 20) begin
      $display("MA has %0d edges", edges);
      $finish;
    end
    expect_word(EvStatus, 32'h00000001, 32'h00000001);
    // A word of zeros; its CRC is not checked.
    expect_word(Origin + 32'h34, 32'hFFFFFFFF, 32'h00000001);
    expect_word(Origin + 32'h38, 32'hFFFFFFFF, 32'h00000000);
    write(Origin + 32'h4C, 32'hFFFFFFFF);
    expect_word(EvStatus, 32'h00000001, 32'h00000000);
    $display("good");
    $finish;
  end
endmodule
