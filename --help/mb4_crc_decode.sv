









module mb4_crc_decode (
  input  logic [7:0] poly_i,      
  output logic       crc_on_o,
  output logic [3:0] crc_last_o,  
  output logic [7:0] crc_poly_o,
  output logic [7:0] crc_top_o
);

  logic [7:0] top;
  logic       crc16;

  assign crc16    = poly_i[7] && poly_i[6];
  assign crc_on_o = poly_i != 8'h00;

  
  
  assign crc_poly_o = {poly_i[6:0], 1'b1};

  logic [7:0] top_shadow; always begin begin
    top_shadow = 8'h00;
    for (int i = 0; i < 8; i++) begin
      if (poly_i[i]) top_shadow = 8'h01 << i;
    end
  end top = top_shadow; @(poly_i); end

  assign crc_top_o  = crc16 ? 8'h00 : top;
  assign crc_last_o = {crc16, top[7:4] != 4'h0, {top[7:6], top[3:2]} != 4'h0,
                       {top[7], top[5], top[3], top[1]} != 4'h0};

endmodule
