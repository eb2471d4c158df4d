

















module mb4_crc_code (
  input  logic       selcrc_i,
  input  logic [6:0] code_i,     
  output logic [7:0] poly_o
);

  logic [7:0] poly_o_shadow; always begin begin
    case (code_i)
      mb4_regs_pkg_CRC_LENGTH_CRC3:  poly_o_shadow = 8'h05;  
      mb4_regs_pkg_CRC_LENGTH_CRC4:  poly_o_shadow = 8'h09;  
      mb4_regs_pkg_CRC_LENGTH_CRC5:  poly_o_shadow = 8'h12;  
      mb4_regs_pkg_CRC_LENGTH_CRC6:  poly_o_shadow = 8'h21;  
      mb4_regs_pkg_CRC_LENGTH_CRC7:  poly_o_shadow = 8'h44;  
      mb4_regs_pkg_CRC_LENGTH_CRC8:  poly_o_shadow = 8'h97;  
      mb4_regs_pkg_CRC_LENGTH_CRC16: poly_o_shadow = 8'hEC;  
      default:                        poly_o_shadow = 8'h00;
    endcase
    if (selcrc_i) poly_o_shadow = {1'b0, code_i};
  end poly_o = poly_o_shadow; @(code_i or selcrc_i); end

endmodule
