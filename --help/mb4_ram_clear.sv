








module mb4_ram_clear (
  input  logic       clk_i,
  input  logic       rst_ni,
  output mb4_pkg_mem_wr_t clear_o
);

  logic       done_q;
  logic [5:0] addr_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      done_q <= 1'b0;
      addr_q <= '0;
    end else if (!done_q) begin
      done_q <= addr_q == 6'h3F;
      addr_q <= addr_q + 6'd1;
    end
  end

  assign clear_o = {!done_q, addr_q, 8'h00};

endmodule
