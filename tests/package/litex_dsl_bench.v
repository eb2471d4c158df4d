// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SoC of examples/litex with dsl_axil in Icarus, as a PC sees it: words over its serial port, and the pins of its
// line, on which nobody answers. PLL and flops of the device are models. The parameters are addresses and words that
// litex_test.py knows. It prints "good", or what is wrong.
`timescale 1ns / 1ps

module EHXPLLL (
  input  CLKI, RST, CLKFB, PHASESEL1, PHASESEL0, PHASEDIR, PHASESTEP, PHASELOADREG, STDBY, PLLWAKESYNC,
  input  ENCLKOP, ENCLKOS, ENCLKOS2, ENCLKOS3,
  output CLKOP, CLKOS, CLKOS2, CLKOS3, CLKINTFB, LOCK, REFCLK, INTLOCK
);
  reg clk = 0, lock = 0;
  always #6.667 clk = ~clk;
  initial #500 lock = 1;
  assign {CLKOP, CLKOS, CLKOS2, CLKOS3} = {4{clk}};
  assign {LOCK, CLKINTFB, REFCLK, INTLOCK} = {4{lock}};
endmodule

module FD1S3BX (
  input PD, D, CK,
  output reg Q = 1
);
  always @(posedge CK or posedge PD) Q <= PD ? 1'b1 : D;
endmodule

module litex_bench;
  parameter [31:0] Origin = 0, EvStatus = 0, Identity = 0, Features = 0;
`include "litex_serial.vh"
  wire out, en;

  soc u_soc (
    .clk         (clk),
    .rst         (1'b0),
    .serial_tx   (tx),
    .serial_rx   (rx),
    .encoder_out (out),
    .encoder_en  (en),
    .encoder_in_ (sl)
  );

  // Bits of 8 clocks while the driver is on, and how long it is on.
  integer changes = 0;
  time    on = 0, began = 0;
  always @(out) if (en) changes = changes + 1;
  always @(en) begin
    if (en) began = $time;
    else on = on + $time - began;
  end
  assign ma = 1'b1;

  initial begin
    #10000;
    expect_word(Origin + 32'h180, 32'hFFFFFFFF, Identity);
    expect_word(Origin + 32'h188, 32'hFFFFFFFF, Features);
    // OEN keeps the driver off; without it frames go out, and none brings a link.
    write(Origin, 32'h00000001);
    changes = 0;
    on = 0;
    #50000;
    if (changes != 0 || on != 0 || en) begin
      $display("the driver is on in spite of OEN");
      $finish;
    end
    write(Origin, 32'h00000000);
    #100000;
    if (changes < 50 || on < 5000) begin
      $display("%0d edges, the driver on for %0d ns", changes, on);
      $finish;
    end
    expect_word(EvStatus, 32'h00000001, 32'h00000000);
    write(Origin + 32'h190, 32'h00000013);
    expect_word(Origin + 32'h190, 32'hFFFFFFFF, 32'h00000013);
    expect_word(EvStatus, 32'h00000001, 32'h00000000);  // no frame of a link has ended
    $display("good");
    $finish;
  end
endmodule
