








module biss_cdm_timeout (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic frame_end_i,
  input  logic cdm_i,       
  input  logic clear_i,     
  output logic timeout_o
);

  localparam logic [3:0] ZEROS = 4'd14;

  logic [3:0] zeros_d;
  logic [3:0] zeros_q;

  logic [3:0] zeros_d_shadow; always begin begin
    zeros_d_shadow = zeros_q;
    if (clear_i)                              zeros_d_shadow = 4'd0;
    else if (frame_end_i && cdm_i)            zeros_d_shadow = 4'd0;
    else if (frame_end_i && zeros_q != ZEROS) zeros_d_shadow = zeros_q + 4'd1;
  end zeros_d = zeros_d_shadow; @(cdm_i or clear_i or frame_end_i or zeros_q); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) zeros_q <= '0;
    else         zeros_q <= zeros_d;
  end

  assign timeout_o = zeros_q == ZEROS;

endmodule
