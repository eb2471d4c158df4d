













module mb4_spi_shift (
  input  logic       sclk_i,
  input  logic       frame_rst_ni,  
  input  logic       mosi_i,
  output logic       miso_o,
  
  output logic       byte_valid_o,
  output logic [7:0] byte_o,
  input  logic       tx_en_i,       
  input  logic [7:0] tx_byte_i
);

  logic [2:0] bit_q;
  logic [6:0] shift_q;
  logic       miso_q;
  logic [6:0] out_q;     

  always_ff @(posedge sclk_i or negedge frame_rst_ni) begin
    if (!frame_rst_ni) begin
      bit_q   <= 3'd0;
      shift_q <= '0;
    end else begin
      bit_q   <= bit_q + 3'd1;
      shift_q <= {shift_q[5:0], mosi_i};
    end
  end

  assign byte_valid_o = bit_q == 3'd7;
  assign byte_o       = {shift_q, mosi_i};

  
  
  
  always_ff @(negedge sclk_i or negedge frame_rst_ni) begin
    if (!frame_rst_ni)      {miso_q, out_q} <= 8'h00;
    else if (bit_q == 3'd0) {miso_q, out_q} <= tx_byte_i & {8{tx_en_i}};
    else                    {miso_q, out_q} <= {out_q, 1'b0};
  end

  assign miso_o = miso_q;

endmodule
