// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Check macros in three flavours: concurrent assertions for Verilator (run with --assert),
// immediate ones for formal tools (FORMAL defined), nothing for synthesis.
//   MB4_ASSERT(What_A, clk, rst_n, expression)               always true
//   MB4_ASSERT_IF(What_A, clk, rst_n, condition, expression)  true whenever condition holds
//   MB4_ASSERT_NEXT(What_A, clk, rst_n, condition, expression) true one clock after condition

`ifndef MB4_CHECK_SVH
`define MB4_CHECK_SVH

`ifdef VERILATOR
  `define MB4_ASSERT(name, clk, rst_n, expression) \
    name: assert property (@(posedge clk) disable iff (!(rst_n)) (expression));
  `define MB4_ASSERT_IF(name, clk, rst_n, condition, expression) \
    name: assert property (@(posedge clk) disable iff (!(rst_n)) (condition) |-> (expression));
  `define MB4_ASSERT_NEXT(name, clk, rst_n, condition, expression) \
    name: assert property (@(posedge clk) disable iff (!(rst_n)) (condition) |=> (expression));
`elsif FORMAL
  `define MB4_ASSERT(name, clk, rst_n, expression) \
    always @(posedge clk) if (rst_n) name: assert (expression);
  `define MB4_ASSERT_IF(name, clk, rst_n, condition, expression) \
    always @(posedge clk) if ((rst_n) && (condition)) name: assert (expression);
  `define MB4_ASSERT_NEXT(name, clk, rst_n, condition, expression) \
    always @(posedge clk) if ((rst_n) && $past(rst_n) && $past(condition)) \
      name: assert (expression);
`else
  `define MB4_ASSERT(name, clk, rst_n, expression)
  `define MB4_ASSERT_IF(name, clk, rst_n, condition, expression)
  `define MB4_ASSERT_NEXT(name, clk, rst_n, condition, expression)
`endif

`endif
