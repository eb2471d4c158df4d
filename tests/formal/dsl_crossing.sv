// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The crossing of the DSL master's bus (dsl_bridge) between any word bus and any core, at any phase
// and ratio of the clocks. The word bus keeps a request with its payload until it is ready. The
// core takes an access when it likes, or never (it is in reset), and its answer stays until the next
// one. Both halves leave their reset in any order. Here the limit is 8 clocks. One access is watched:
// its payload holds ones, that of the others zeros.
//
// claim: each access ends within the limit; one without an error has been done by the core, a write
//   exactly once, and brings the core's answer to it; one with an error brings 0 and is done at most
//   once; the core never sees the payload of two accesses; any clocks
// clocks: many
// depth: 34
// cover: 40
// unbounded: reachability
// mutation: dsl/dsl_bridge.sv | bus_req_i && !flies && !mine_q && !last; | bus_req_i && !mine_q && !last;
// mutation: dsl/dsl_bridge.sv | done   = mine_q && !flies; | done   = !flies;
// mutation: dsl/dsl_bridge.sv | bus_ready_o = bus_req_i && (done || last); | bus_ready_o = bus_req_i && done;
// mutation: dsl/dsl_bridge.sv | req_q  <= req_q ^ starts; | req_q  <= req_q ^ bus_req_i;
// mutation: dsl/dsl_bridge.sv | core_data_i & {32{done}}; | core_data_i;

module proof (
  input logic bus_clk_i,
  input logic clk_i,
  input logic bus_rst_ni,
  input logic rst_ni,
  input logic req_i,
  input logic write_i,
  input logic chosen_i,   // this access is the one that is watched
  input logic ready_i,    // the core takes an access
  input logic answer_i
);

  localparam logic [3:0] LIMIT = 4'd8;

  (* gclk *) logic gclk;
  logic started = 1'b0;
  logic bus_clk_q, clk_q, bus_rst_q, rst_q;
  always @(posedge gclk) {started, bus_clk_q, clk_q, bus_rst_q, rst_q} <=
    {1'b1, bus_clk_i, clk_i, bus_rst_ni, rst_ni};
  always @* begin
    if (!started) assume (!bus_rst_ni && !bus_clk_i && !clk_i);
    if (started && bus_rst_q) assume (bus_rst_ni);
    if (started && rst_q) assume (rst_ni);
    if (!bus_rst_ni) assume (!rst_ni && !req_i);
    if (started) assume ({2'd0, bus_clk_i != bus_clk_q} + {2'd0, clk_i != clk_q} +
                         {2'd0, bus_rst_ni != bus_rst_q} + {2'd0, rst_ni != rst_q} < 3'd2);
  end

  // ---- The bus ------------------------------------------------------------------------------

  logic        ready, error, irq;
  logic [31:0] data;
  logic        busy_q, tag_q, write_q;   // an access waits, its payload
  logic        used_q;                   // the watched access has begun
  logic [3:0]  waits_q;
  logic        req_q, req_write_q, req_tag_q;
  logic        tag;

  assign tag = busy_q ? tag_q : chosen_i && !used_q;

  // What the bus drives changes with its clock only.
  always @(posedge gclk) {req_q, req_write_q, req_tag_q} <= {req_i, write_i, tag};
  always @* if (started && !(bus_clk_i && !bus_clk_q) && bus_rst_q)
    assume ({req_i, write_i, tag} == {req_q, req_write_q, req_tag_q});
  always @* if (busy_q) assume (req_i && write_i == write_q);

  always @(posedge bus_clk_i or negedge bus_rst_ni) begin
    if (!bus_rst_ni) begin
      {busy_q, tag_q, write_q, used_q} <= '0;
      waits_q <= '0;
    end else begin
      busy_q  <= req_i && !ready;
      tag_q   <= tag;
      write_q <= write_i;
      used_q  <= used_q || (req_i && tag);
      waits_q <= req_i && !ready ? waits_q + 4'd1 : 4'd0;
    end
  end

  // ---- The core -----------------------------------------------------------------------------

  logic        core_req, core_write;
  logic [11:2] core_addr;
  logic [31:0] core_data;
  logic [3:0]  core_be;
  logic        answer_q;
  logic        did_q;      // the watched access
  logic        value_q;    // what the core answered to it
  logic        written_q, twice_q;

  initial {did_q, value_q, written_q, twice_q} = '0;
  always @(posedge clk_i) begin
    if (rst_ni && core_req && ready_i) begin
      answer_q <= answer_i;
      if (core_data[0]) begin
        did_q   <= 1'b1;
        value_q <= answer_i;
        if (core_write) {written_q, twice_q} <= {1'b1, written_q};
      end
    end
  end

  dsl_bridge #(.WaitLimit(8)) u_dut (
    .bus_clk_i, .bus_rst_ni, .bus_req_i(req_i), .bus_write_i(write_i), .bus_addr_i({10{tag}}),
    .bus_data_i({32{tag}}), .bus_be_i({4{tag}}), .bus_ready_o(ready), .bus_data_o(data),
    .bus_error_o(error), .bus_irq_o(irq),
    .clk_i, .rst_ni, .core_req_o(core_req), .core_write_o(core_write), .core_addr_o(core_addr),
    .core_data_o(core_data), .core_be_o(core_be), .core_ready_i(ready_i),
    .core_data_i({32{answer_q}}), .core_irq_i(1'b0)
  );

  always @* if (started && bus_rst_ni) begin
    Bound_A: assert (waits_q < LIMIT);
    Twice_A: assert (!twice_q);
    if (core_req) Whole_A: assert (core_addr == {10{core_data[0]}} && core_be == {4{core_data[0]}}
                                   && core_data == {32{core_data[0]}});
    if (req_i && ready) begin
      if (error) Zero_A: assert (data == 32'd0);
      if (!error && tag) begin
        Done_A:  assert (did_q);
        Value_A: assert (data == {32{value_q}});
        if (write_i) Written_A: assert (written_q);
      end
      Good_C:  cover (!error && tag && write_i);
      Error_C: cover (error && tag);
      Read_C:  cover (!error && tag && !write_i && data != 32'd0);
    end
  end

endmodule
