// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// First flops of one SL input, on both clock edges: ordinary flops, or the DDR input cell of the
// pin. The outputs are the same for every choice: pos_o is the level at the rising edge before the
// last one, neg_o the level at the falling edge between these two. Both have passed two flops.
//
// Clock domain: core; SL is asynchronous.
// Latency: one clock after the first flops.
// Reset: the DDR cells have no reset to 1. They show the line before enc_reset_sync releases the
// logic behind them.
//
// Misuse: with a DDR cell sl_i must come directly from a pin; on an iCE40 no other logic can read
// that pin. A cell of another FPGA family is an unknown module in synthesis.
// Cells: SB_IO (Lattice FPGA-TN-02026), IDDRX1F (Lattice FPGA-TN-02035), IDDR (Xilinx UG471).

`include "enc_sync.svh"

module biss_sl_capture #(
  parameter logic [1:0] SlCells = biss_pkg::SL_FLOPS
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic sl_i,    // pin
  output logic pos_o,
  output logic neg_o
);

  `ENC_SYNC_FLOPS
  logic pos1_q;
  `ENC_SYNC_FLOPS
  logic neg1_q;

  if (SlCells == biss_pkg::SL_ICE40) begin : gen_ice40
    SB_IO #(.PIN_TYPE(6'b0000_00)) u_cell (
      .PACKAGE_PIN  (sl_i),
      .CLOCK_ENABLE (1'b1),
      .INPUT_CLK    (clk_i),
      .D_IN_0       (pos1_q),
      .D_IN_1       (neg1_q)
    );
  end else if (SlCells == biss_pkg::SL_ECP5) begin : gen_ecp5
    IDDRX1F u_cell (
      .D    (sl_i),
      .SCLK (clk_i),
      .RST  (1'b0),
      .Q0   (pos1_q),
      .Q1   (neg1_q)
    );
  end else if (SlCells == biss_pkg::SL_XILINX7) begin : gen_xilinx7
    IDDR #(.DDR_CLK_EDGE("OPPOSITE_EDGE"), .INIT_Q1(1'b1), .INIT_Q2(1'b1)) u_cell (
      .D  (sl_i),
      .C  (clk_i),
      .CE (1'b1),
      .R  (1'b0),
      .S  (1'b0),
      .Q1 (pos1_q),
      .Q2 (neg1_q)
    );
  end else begin : gen_flops
    always_ff @(negedge clk_i or negedge rst_ni) begin
      if (!rst_ni) neg1_q <= 1'b1;
      else         neg1_q <= sl_i;
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) pos1_q <= 1'b1;
      else         pos1_q <= sl_i;
    end
  end

  if (SlCells == biss_pkg::SL_ECP5) begin : gen_cell_has_both
    assign pos_o = pos1_q;
    assign neg_o = neg1_q;
  end else begin : gen_second
    `ENC_SYNC_FLOPS
    logic pos2_q;
    `ENC_SYNC_FLOPS
    logic neg2_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        pos2_q <= 1'b1;
        neg2_q <= 1'b1;
      end else begin
        pos2_q <= pos1_q;
        neg2_q <= neg1_q;
      end
    end

    assign pos_o = pos2_q;
    assign neg_o = neg2_q;
  end

endmodule
