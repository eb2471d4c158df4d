









module mb4_read_port2 (
  input  logic        rclk_i,
  input  logic        rst_ni,
  input  logic        rd_en_i,
  output logic [7:0]  rd_data_o,
  input  logic        ram_ready_i,
  input  logic        bank_i,
  input  logic [15:0] data_i       
);

  logic bank_q;
  logic ready_q;

  always_ff @(posedge rclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank_q  <= 1'b0;
      ready_q <= 1'b0;
    end else if (rd_en_i) begin
      bank_q  <= bank_i;
      ready_q <= ram_ready_i;
    end
  end

  assign rd_data_o = !ready_q ? 8'h00 : bank_q ? data_i[15:8] : data_i[7:0];

endmodule
