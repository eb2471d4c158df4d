// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// DDR input cells as their vendors describe them, for check_cells.py; the iCE40's comes with Yosys.

// Xilinx UG471, OPPOSITE_EDGE: each output follows its own edge.
module IDDR (input C, CE, D, R, S, output reg Q1, Q2);
  parameter DDR_CLK_EDGE = "OPPOSITE_EDGE";
  parameter INIT_Q1 = 1'b0;
  parameter INIT_Q2 = 1'b0;
  initial begin
    Q1 = INIT_Q1;
    Q2 = INIT_Q2;
    if (DDR_CLK_EDGE != "OPPOSITE_EDGE") $fatal(1, "IDDR: no model of %s", DDR_CLK_EDGE);
  end
  always @(posedge C) if (CE) Q1 <= D;
  always @(negedge C) if (CE) Q2 <= D;
endmodule

// Lattice FPGA-TN-02035: both outputs change at the rising edge, a clock after the samples.
module IDDRX1F (input D, SCLK, RST, output reg Q0, Q1);
  reg pos, neg;
  always @(posedge SCLK or posedge RST) begin
    if (RST) {Q0, Q1, pos} <= 3'b000;
    else     {Q0, Q1, pos} <= {pos, neg, D};
  end
  always @(negedge SCLK or posedge RST) begin
    if (RST) neg <= 1'b0;
    else     neg <= D;
  end
endmodule

// The four choices of biss_sl_capture side by side, SL with edges anywhere but at those of the clock.
module bench;
  reg clk = 1'b0, rst_n = 1'b0, sl = 1'b1;
  wire [3:0] pos, neg;
  integer clocks, seed = 1, changes = 0, differences = 0;

  capture_0 u_flops (.clk_i(clk), .rst_ni(rst_n), .sl_i(sl), .pos_o(pos[0]), .neg_o(neg[0]));
  capture_1 u_ice40 (.clk_i(clk), .rst_ni(rst_n), .sl_i(sl), .pos_o(pos[1]), .neg_o(neg[1]));
  capture_2 u_ecp5 (.clk_i(clk), .rst_ni(rst_n), .sl_i(sl), .pos_o(pos[2]), .neg_o(neg[2]));
  capture_3 u_xilinx7 (.clk_i(clk), .rst_ni(rst_n), .sl_i(sl), .pos_o(pos[3]), .neg_o(neg[3]));

  // A quarter of a clock is 10.
  task half(input level);
    begin
      clk = level;
      #5 if ($random(seed) % 3 == 0) sl = !sl;
      #15;
    end
  endtask

  initial begin
    for (clocks = 0; clocks < 10000; clocks = clocks + 1) begin
      half(1'b1);
      // The first clocks do not count: a reset leaves different values in the second stages.
      if (clocks > 4) begin
        if (pos !== {4{pos[0]}} || neg !== {4{neg[0]}} || ^{pos, neg} === 1'bx)
          differences = differences + 1;
        if (pos[0] != neg[0]) changes = changes + 1;
      end
      half(1'b0);
      if (clocks == 2) rst_n = 1'b1;
    end
    if (differences == 0 && changes > 1000) $display("passed");
    else $display("FAILED: %0d differences, %0d changes in half a clock", differences, changes);
    $finish;
  end
endmodule
