







module enc_time (
  input  logic        clk_i,
  input  logic        rst_ni,
  output logic [63:0] time_o
);

  logic [31:0] low_q;
  logic [31:0] high_q;
  logic        carry_q;   

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      low_q   <= '0;
      high_q  <= '0;
      carry_q <= 1'b0;
    end else begin
      low_q   <= low_q + 32'd1;
      carry_q <= low_q == 32'hFFFF_FFFE;
      if (carry_q) high_q <= high_q + 32'd1;
    end
  end

  assign time_o = {high_q, low_q};

endmodule
