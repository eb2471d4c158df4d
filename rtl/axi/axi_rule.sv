// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CRC and timeout of a frame: constants, or what the registers of the page say when a frame starts.
//
// Clock domain: core. rule_o follows take_i after one clock and then stays. crc_bits_o is of the
// registers, without latency.
//
// A polynomial of degree 0 acts as 0x43, a limit of 0 as TimeoutLimit.
// Source: docs/axi.md.

module axi_rule #(
  parameter int unsigned TimeoutLimit = 4000,  // clocks, 1 to 1048575
  parameter bit          AnyCrc       = 1'b0,
  parameter bit          Timeout      = 1'b0
) (
  input  logic           clk_i,
  input  logic           rst_ni,
  input  axi_pkg::page_t page_i,
  input  logic           take_i,
  output axi_pkg::rule_t rule_o,
  output logic [4:0]     crc_bits_o
);

  localparam logic [19:0] LIMIT_LAST = 20'(TimeoutLimit - 1);

  logic unused;

  if (AnyCrc) begin : gen_any_crc
    logic [16:0] polynomial;
    logic [15:0] top;
    logic [3:0]  last;
    logic [15:0] poly_q;
    logic [15:0] top_q;
    logic [15:0] start_q;
    logic [3:0]  last_q;

    assign polynomial = page_i.crc_polynomial[16:1] == 16'd0 ? 17'h43 : page_i.crc_polynomial;

    // The highest power wins.
    always_comb begin
      top  = '0;
      last = '0;
      for (int unsigned i = 0; i < 16; i++) begin
        if (polynomial[i+1]) begin
          top  = 16'd1 << i;
          last = 4'(i);
        end
      end
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        poly_q  <= '0;
        top_q   <= '0;
        start_q <= '0;
        last_q  <= '0;
      end else if (take_i) begin
        poly_q  <= polynomial[15:0] & ~{top[14:0], 1'b0};
        top_q   <= top;
        start_q <= page_i.crc_start;
        last_q  <= last;
      end
    end

    assign rule_o.crc_poly  = poly_q;
    assign rule_o.crc_top   = top_q;
    assign rule_o.crc_start = start_q;
    assign rule_o.crc_last  = last_q;
    assign crc_bits_o       = {1'b0, last} + 5'd1;
  end else begin : gen_crc6
    assign rule_o.crc_poly  = 16'h0003;
    assign rule_o.crc_top   = 16'h0020;
    assign rule_o.crc_start = 16'h0000;
    assign rule_o.crc_last  = 4'd5;
    assign crc_bits_o       = 5'd6;
  end

  if (Timeout) begin : gen_timeout
    logic        fixed_q;
    logic [19:0] last_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        fixed_q <= 1'b0;
        last_q  <= LIMIT_LAST;
      end else if (take_i) begin
        fixed_q <= page_i.timeout_fixed;
        last_q  <= page_i.timeout_limit == 20'd0 ? LIMIT_LAST : page_i.timeout_limit - 20'd1;
      end
    end

    assign rule_o.fixed        = fixed_q;
    assign rule_o.timeout_last = last_q;
  end else begin : gen_constant
    assign rule_o.fixed        = 1'b0;
    assign rule_o.timeout_last = LIMIT_LAST;
  end

  assign unused = (^page_i) ^ take_i ^ clk_i ^ rst_ni;

endmodule
