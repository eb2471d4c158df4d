// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time as a count of clocks since the reset, 64 bits, a byte a clock: eight clocks are a turn, in
// which an adder of eight bits makes the time of the next one. Two memories keep the time of a
// frame's edge and what the host has asked for.
//
// Clock domain: core. edge_data_o is byte `index` of the time of the last clock with edge_i, the
// lowest one first: 0 after edge_i, one more after each edge_next_i. It is right 17 clocks behind
// edge_i, and two clocks behind edge_next_i.
// copy_i is kept up to copied_o, 8 to 16 clocks later: then the host's bytes are those of a clock
// in between. host_data_o is byte host_address_i of them, one clock later. Before the first copy
// they are 0, from the ninth clock behind the reset on; a copy that was asked for earlier is 0 too.
// Misuse: edge_i less than 17 clocks behind another one spoils its time.

module dsl_time (
  input  logic       clk_i,
  input  logic       rst_ni,
  // edge of a frame
  input  logic       edge_i,
  input  logic       edge_next_i,
  output logic [7:0] edge_data_o,
  // host
  input  logic       copy_i,
  output logic       copied_o,
  input  logic [2:0] host_address_i,
  output logic [7:0] host_data_o
);

  localparam logic [2:0] LAST_BYTE = 3'd7;
  localparam logic [7:0] TURN      = 8'd8;

  logic [2:0]  byte_q;        // of the turn: the lowest bits of the time too
  logic [63:0] before_q;      // the time at which the turn before this one began
  logic        carry_q;
  logic [7:0]  sum;
  logic        carry;
  logic        unused;
  logic        last;
  logic [2:0]  phase_q;       // of the edge
  logic        waits_q;       // ... it has been in this turn
  logic        edge_q;        // ... its time is written
  logic        host_q;        // the host's is
  logic [2:0]  index_q;
  logic [7:0]  edge_data;

  assign last         = byte_q == LAST_BYTE;
  // One chain: the carry enters by a bit below the lowest one.
  assign {carry, sum, unused} = {1'b0, before_q[7:0], 1'b1}
                             + {1'b0, byte_q == 3'd0 ? TURN : 8'd0, carry_q};

  always_comb begin
    edge_data = before_q[7:0];
    if (byte_q == 3'd0) edge_data[2:0] = phase_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      byte_q   <= '0;
      before_q <= -64'd8;
      carry_q  <= 1'b0;
      phase_q  <= '0;
      waits_q  <= 1'b0;
      edge_q   <= 1'b0;
      host_q   <= 1'b1;
      index_q  <= '0;
    end else begin
      byte_q   <= byte_q + 3'd1;
      before_q <= {sum, before_q[63:8]};
      carry_q  <= carry && !last;
      if (edge_i) phase_q <= byte_q;
      waits_q  <= (waits_q || edge_i) && !last;
      if (last) begin
        edge_q <= waits_q || edge_i;
        host_q <= copy_i && !host_q;
      end
      if (edge_i)           index_q <= '0;
      else if (edge_next_i) index_q <= index_q + 3'd1;
    end
  end

  // With eight bytes the tools would make flops of them.
  enc_ram #(.Width(8), .AddrW(4)) u_edge (
    .wr_clk_i  (clk_i),
    .wr_en_i   (edge_q),
    .wr_addr_i ({1'b0, byte_q}),
    .wr_data_i (edge_data),
    .rd_clk_i  (clk_i),
    .rd_en_i   (1'b1),
    .rd_addr_i ({1'b0, index_q}),
    .rd_data_o (edge_data_o)
  );

  enc_ram #(.Width(8), .AddrW(4)) u_host (
    .wr_clk_i  (clk_i),
    .wr_en_i   (host_q),
    .wr_addr_i ({1'b0, byte_q}),
    .wr_data_i (sum),
    .rd_clk_i  (clk_i),
    .rd_en_i   (1'b1),
    .rd_addr_i ({1'b0, host_address_i}),
    .rd_data_o (host_data_o)
  );

  assign copied_o = host_q && last;

endmodule
