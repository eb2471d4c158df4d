









module enc_sync_bit #(
  parameter logic ResetValue = 1'b0
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic data_i,
  output logic data_o
);

  logic [1:0] sync_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) sync_q <= {2{ResetValue}};
    else         sync_q <= {sync_q[0], data_i};
  end

  assign data_o = sync_q[1];

endmodule
