














module enc_crc #(
  parameter bit Free = 1'b1      
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        crc16_i,
  input  logic [7:0]  poly_i,    
  input  logic [7:0]  top_i,     
  input  logic [15:0] start_i,
  input  logic        load_i,
  input  logic        shift_i,
  input  logic        feed_i,
  input  logic        bit_i,
  output logic        top_o
);

  localparam logic [7:0] POLY16_UPPER = 8'h90;
  localparam logic [7:0] POLY16_LOWER = 8'hD9;
  localparam logic [7:0] POLY6        = 8'h43;

  logic [7:0]  poly;
  logic [15:0] rem_d;
  logic [15:0] rem_q;
  logic        top;
  logic        divide;

  assign poly   = Free ? poly_i : crc16_i ? POLY16_LOWER : POLY6;
  assign top    = Free ? (rem_q[7:0] & top_i) != 8'h00 || (crc16_i && rem_q[15])
                       : crc16_i ? rem_q[15] : rem_q[5];
  assign divide = feed_i & (bit_i ^ top);

  logic [15:0] rem_d_shadow; always begin begin
    rem_d_shadow = {rem_q[14:0], 1'b0} ^ ({POLY16_UPPER, poly} & {16{divide}});
    if (load_i) rem_d_shadow = start_i;
  end rem_d = rem_d_shadow; @(divide or load_i or poly or rem_q or start_i); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                rem_q <= '0;
    else if (load_i || shift_i) rem_q <= rem_d;
  end

  assign top_o = top;

endmodule
