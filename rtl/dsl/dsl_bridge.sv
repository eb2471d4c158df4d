// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A word bus from the bus's clock to the core's, one access at a time. Request and answer are
// toggles; address, data and strobes stand still between them.
//
// Clock domains: bus_clk_i for bus_*, clk_i for core_*. They need no relation. With SameClock = 1
// they are one clock, and an access goes straight through.
// Latency: an access takes 3 clocks of the core and 3 of the bus more than the core needs.
// Without an answer within WaitLimit clocks of the bus the access ends with bus_error_o and data of
// 0. The core still does it when its clock runs again; until then further accesses end so too, and
// its answer is dropped.
// Reset: rst_ni is asserted with bus_rst_ni and released with clk_i. The core's own reset does not
// touch the crossing: an access waits until the core is there again, or for the limit; core_data_i
// of one that is done stays.
// Misuse: a request that falls before bus_ready_o gets no answer, and may have been done.
// Constraint: bus_*_q and core_data_i are stable when the other side takes them: maximum delay of
// one period of the taking clock; false paths to the first flops of enc_sync_bit.
// Source: docs/crossings.md.

module dsl_bridge #(
  parameter bit          SameClock = 1'b0,
  parameter int unsigned WaitLimit = 1024
) (
  // bus
  input  logic        bus_clk_i,
  input  logic        bus_rst_ni,
  input  logic        bus_req_i,
  input  logic        bus_write_i,
  input  logic [11:2] bus_addr_i,
  input  logic [31:0] bus_data_i,
  input  logic [3:0]  bus_be_i,
  output logic        bus_ready_o,
  output logic [31:0] bus_data_o,
  output logic        bus_error_o,
  output logic        bus_irq_o,
  // core
  input  logic        clk_i,
  input  logic        rst_ni,
  output logic        core_req_o,
  output logic        core_write_o,
  output logic [11:2] core_addr_o,
  output logic [31:0] core_data_o,
  output logic [3:0]  core_be_o,
  input  logic        core_ready_i,
  input  logic [31:0] core_data_i,
  input  logic        core_irq_i
);

  if (SameClock) begin : gen_same
    logic unused;

    assign core_req_o   = bus_req_i;
    assign core_write_o = bus_write_i;
    assign core_addr_o  = bus_addr_i;
    assign core_data_o  = bus_data_i;
    assign core_be_o    = bus_be_i;
    assign bus_ready_o  = core_ready_i;
    assign bus_data_o   = core_data_i;
    assign bus_error_o  = 1'b0;
    assign bus_irq_o    = core_irq_i;
    assign unused       = ^{bus_clk_i, bus_rst_ni, clk_i, rst_ni};
  end else begin : gen_cross
    localparam int unsigned W = $clog2(WaitLimit);

    // bus
    logic         req_q;       // toggle
    logic         ack;
    logic         flies;       // the core has an access
    logic         mine_q;      // ... it is the one that waits here
    logic         write_q;
    logic [11:2]  addr_q;
    logic [31:0]  data_q;
    logic [3:0]   be_q;
    logic [W-1:0] wait_q;
    logic         last;
    logic         starts;
    logic         done;
    // core
    logic         req;
    logic         ack_q;       // toggle

    enc_sync_bit u_ack (
      .clk_i  (bus_clk_i),
      .rst_ni (bus_rst_ni),
      .data_i (ack_q),
      .data_o (ack)
    );

    enc_sync_bit u_irq (
      .clk_i  (bus_clk_i),
      .rst_ni (bus_rst_ni),
      .data_i (core_irq_i),
      .data_o (bus_irq_o)
    );

    assign flies  = req_q != ack;
    assign last   = wait_q == W'(WaitLimit - 1);
    assign starts = bus_req_i && !flies && !mine_q && !last;
    assign done   = mine_q && !flies;

    assign bus_ready_o = bus_req_i && (done || last);
    assign bus_error_o = !done;
    assign bus_data_o  = core_data_i & {32{done}};

    always_ff @(posedge bus_clk_i or negedge bus_rst_ni) begin
      if (!bus_rst_ni) begin
        req_q   <= 1'b0;
        mine_q  <= 1'b0;
        write_q <= 1'b0;
        addr_q  <= '0;
        data_q  <= '0;
        be_q    <= '0;
        wait_q  <= '0;
      end else begin
        req_q  <= req_q ^ starts;
        mine_q <= (mine_q || starts) && bus_req_i && !bus_ready_o;
        wait_q <= bus_req_i && !bus_ready_o ? wait_q + W'(1) : '0;
        if (starts) begin
          write_q <= bus_write_i;
          addr_q  <= bus_addr_i;
          data_q  <= bus_data_i;
          be_q    <= bus_be_i;
        end
      end
    end

    enc_sync_bit u_req (
      .clk_i,
      .rst_ni,
      .data_i (req_q),
      .data_o (req)
    );

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni)                         ack_q <= 1'b0;
      else if (core_req_o && core_ready_i) ack_q <= req;
    end

    assign core_req_o   = req != ack_q;
    assign core_write_o = write_q;
    assign core_addr_o  = addr_q;
    assign core_data_o  = data_q;
    assign core_be_o    = be_q;
  end

endmodule
