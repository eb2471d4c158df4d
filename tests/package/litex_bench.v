// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SoC of examples/litex in Icarus, as a PC sees it: words over its serial port, and the pins of line 1.
// The parameters are addresses and words that litex_test.py knows. It prints "good", or what is wrong.
`timescale 1ns / 1ps

module litex_bench;
  parameter [31:0] Origin = 0, EvStatus = 0, Identity = 0, Features = 0;
  wire mo1, ma2, mo2;
`include "litex_serial.vh"

  soc u_soc (
    .clk         (clk),
    .rst         (1'b0),
    .serial_tx   (tx),
    .serial_rx   (rx),
    .encoder_ma1 (ma),
    .encoder_sl1 (sl),
    .encoder_mo1 (mo1),
    .encoder_ma2 (ma2),
    .encoder_sl2 (1'b1),
    .encoder_mo2 (mo2)
  );

  initial begin
    #10000;
    expect_word(Origin + 32'h100, 32'hFFFFFFFF, Identity);
    expect_word(Origin + 32'h108, 32'hFFFFFFFF, Features);
    // SCDATA1, and a register of its own.
    write(Origin + 32'h000, 32'h12345678);
    write(Origin + 32'h0E8, 32'h0000007C);
    expect_word(Origin + 32'h000, 32'hFFFFFFFF, 32'h12345678);
    expect_word(Origin + 32'h0E8, 32'h000000FF, 32'h0000007C);
    // SL1 is bit 0 of 0xF8.
    expect_word(Origin + 32'h0F8, 32'h00000001, 32'h00000001);
    sl = 0;
    #2000;
    expect_word(Origin + 32'h0F8, 32'h00000001, 32'h00000000);
    sl = 1;
    // A frame of 8 bits on line 1: its end is an interrupt, and the word is good.
    expect_word(EvStatus, 32'h00000001, 32'h00000000);
    write(Origin + 32'h110, 32'h00000001);
    write(Origin + 32'h0C0, 32'h00000047);
    write(Origin + 32'h0EC, 32'h00000D01);
    edges = 0;
    write(Origin + 32'h0F4, 32'h00000004);
    #50000;
    if (edges < 8) begin
      $display("MA1 has %0d edges", edges);
      $finish;
    end
    expect_word(EvStatus, 32'h00000001, 32'h00000001);
    expect_word(Origin + 32'h120, 32'hFFFFFFFF, 32'h00000000);  // takes the snapshot
    expect_word(Origin + 32'h128, 32'h00000001, 32'h00000001);
    write(Origin + 32'h10C, 32'hFFFFFFFF);
    expect_word(EvStatus, 32'h00000001, 32'h00000000);
    $display("good");
    $finish;
  end
endmodule
