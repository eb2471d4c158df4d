// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Check macros. They are active in Verilator (run it with --assert) and in formal tools (FORMAL
// defined), and empty in synthesis.
//   ENC_ASSERT(What_A, clk, rst_n, expression)                 always true
//   ENC_ASSERT_IF(What_A, clk, rst_n, condition, expression)   true while the condition holds
//   ENC_ASSERT_NEXT(What_A, clk, rst_n, condition, expression) true one clock after the condition
// The macros are immediate assertions in a clocked process. They see the values before the edge, as
// concurrent assertions do, but Verilator does not have to copy their signals at each evaluation.

`ifndef ENC_CHECK_SVH
`define ENC_CHECK_SVH

`ifdef VERILATOR
  `define ENC_CHECKED
`elsif FORMAL
  `define ENC_CHECKED
`endif

`ifdef ENC_CHECKED
  `define ENC_ASSERT(name, clk, rst_n, expression) \
    always @(posedge clk) if (rst_n) name: assert (expression);
  `define ENC_ASSERT_IF(name, clk, rst_n, condition, expression) \
    always @(posedge clk) if ((rst_n) && (condition)) name: assert (expression);
  `define ENC_ASSERT_NEXT(name, clk, rst_n, condition, expression) \
    logic name``_before_q; \
    always @(posedge clk or negedge rst_n) \
      if (!rst_n) name``_before_q <= 1'b0; \
      else        name``_before_q <= (condition); \
    always @(posedge clk) if ((rst_n) && name``_before_q) name: assert (expression);
`else
  `define ENC_ASSERT(name, clk, rst_n, expression)
  `define ENC_ASSERT_IF(name, clk, rst_n, condition, expression)
  `define ENC_ASSERT_NEXT(name, clk, rst_n, condition, expression)
`endif

`endif
