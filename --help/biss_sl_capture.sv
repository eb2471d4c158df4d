















module biss_sl_capture #(
  parameter logic [1:0] SlCells = biss_pkg_SL_FLOPS
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic sl_i,    
  output logic pos_o,
  output logic neg_o
);

  logic pos1_q;
  logic neg1_q;

  if (SlCells == biss_pkg_SL_ICE40) begin : gen_ice40
    SB_IO #(.PIN_TYPE(6'b0000_00)) u_cell (
      .PACKAGE_PIN  (sl_i),
      .CLOCK_ENABLE (1'b1),
      .INPUT_CLK    (clk_i),
      .D_IN_0       (pos1_q),
      .D_IN_1       (neg1_q)
    );
  end else if (SlCells == biss_pkg_SL_ECP5) begin : gen_ecp5
    IDDRX1F u_cell (
      .D    (sl_i),
      .SCLK (clk_i),
      .RST  (1'b0),
      .Q0   (pos1_q),
      .Q1   (neg1_q)
    );
  end else if (SlCells == biss_pkg_SL_XILINX7) begin : gen_xilinx7
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

  if (SlCells == biss_pkg_SL_ECP5) begin : gen_cell_has_both
    assign pos_o = pos1_q;
    assign neg_o = neg1_q;
  end else begin : gen_second
    logic pos2_q;
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
