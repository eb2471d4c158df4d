// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Clears the data memories after a reset: one address of every memory in each clock, 64 clocks.
//
// Clock domain: core. clear_o.en is high from the reset until the last address is cleared. While it
// is high the host reads 0, no frame starts, and posted host writes wait.
// Datasheet: page 22 (all RAM registers are reset to 0).

module mb4_ram_clear (
  input  logic       clk_i,
  input  logic       rst_ni,
  output mb4_pkg::mem_wr_t clear_o
);

  logic [5:0] addr_q;
  logic       done_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)      {done_q, addr_q} <= '0;
    else if (!done_q) {done_q, addr_q} <= 7'(addr_q) + 7'd1;
  end

  assign clear_o.en   = !done_q;
  assign clear_o.addr = addr_q;
  assign clear_o.data = 8'h00;

endmodule
