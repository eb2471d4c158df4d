// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SoC of examples/litex in Icarus, as a PC sees it: words over its serial port, and the pins of line 1.
// The parameters are addresses and words that litex_test.py knows. It prints "good", or what is wrong.
`timescale 1ns / 1ps

module litex_bench;
  parameter [31:0] Origin = 0, EvStatus = 0, Identity = 0, Features = 0;
  localparam integer BIT = 200, HALF_CLK = 20;  // ns

  reg clk = 0, rx = 1, sl1 = 1;
  wire tx, ma1, mo1, ma2, mo2;
  always #HALF_CLK clk = ~clk;

  soc u_soc (
    .clk         (clk),
    .rst         (1'b0),
    .serial_tx   (tx),
    .serial_rx   (rx),
    .encoder_ma1 (ma1),
    .encoder_sl1 (sl1),
    .encoder_mo1 (mo1),
    .encoder_ma2 (ma2),
    .encoder_sl2 (1'b1),
    .encoder_mo2 (mo2)
  );

  // Bytes from the SoC.
  reg [31:0] answer = 0;
  integer    got = 0;
  integer    i;
  initial forever begin
    @(negedge tx);
    #(BIT / 2);
    for (i = 0; i < 8; i = i + 1) begin
      #BIT answer[31:0] = i == 0 ? {answer[23:0], tx, 7'd0} :
                          {answer[31:8], tx, answer[7:1]};
    end
    #BIT got = got + 1;
  end

  // A BiSS C encoder: acknowledge with the second rising edge, start bit, then zeros up to its timeout.
  integer edges = 0, rises = 0;
  time    last = 0;
  always @(ma1) begin
    edges = edges + 1;
    last = $time;
    if (ma1) begin
      rises = rises + 1;
      sl1 = rises == 1 || rises == 3;
    end
  end
  always #1000 if (rises > 0 && $time - last > 5000) begin
    rises = 0;
    sl1 = 1;
  end

  task send(input [7:0] data);
    integer k;
    begin
      rx = 0;
      #BIT;
      for (k = 0; k < 8; k = k + 1) begin
        rx = data[k];
        #BIT;
      end
      rx = 1;
      #BIT;
    end
  endtask

  task send_word(input [31:0] data);
    begin
      send(data[31:24]);
      send(data[23:16]);
      send(data[15:8]);
      send(data[7:0]);
    end
  endtask

  task write(input [31:0] address, input [31:0] data);
    begin
      send(8'h01);
      send(8'h01);
      send_word(address >> 2);
      send_word(data);
      #(20 * BIT);
    end
  endtask

  task expect_word(input [31:0] address, input [31:0] mask, input [31:0] data);
    begin
      got = 0;
      send(8'h02);
      send(8'h01);
      send_word(address >> 2);
      #(60 * BIT);
      if (got != 4 || (answer & mask) != data) begin
        $display("%h: %0d bytes, %h, expected %h under %h", address, got, answer, data, mask);
        $finish;
      end
    end
  endtask

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
    sl1 = 0;
    #2000;
    expect_word(Origin + 32'h0F8, 32'h00000001, 32'h00000000);
    sl1 = 1;
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
