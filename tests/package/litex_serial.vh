// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The body of a bench around a SoC of examples/litex: clock, serial port as a PC sees it, an encoder.

  localparam integer BIT = 200, HALF_CLK = 20;  // ns

  reg clk = 0, rx = 1, sl = 1;
  wire tx, ma;
  always #HALF_CLK clk = ~clk;

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
  always @(ma) begin
    edges = edges + 1;
    last = $time;
    if (ma) begin
      rises = rises + 1;
      sl = rises == 1 || rises == 3;
    end
  end
  always #1000 if (rises > 0 && $time - last > 5000) begin
    rises = 0;
    sl = 1;
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
