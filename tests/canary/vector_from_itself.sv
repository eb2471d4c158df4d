// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
module vector_from_itself (input logic [1:0] a_i, output logic [2:0] y_o);
  logic [2:0] c;
  assign c[0] = a_i[0];
  assign c[1] = c[0] ^ a_i[1];
  assign c[2] = c[1];
  assign y_o = c;
endmodule
