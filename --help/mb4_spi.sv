









module mb4_spi #(
  parameter bit         ReadOnly   = 1'b0,                       
  parameter logic [7:0] Registers0 = mb4_regs_pkg_ADDR_SCDATA   
) (
  input  logic       rst_ni,
  
  input  logic       sclk_i,
  input  logic       cs_ni,
  input  logic       mosi_i,
  output logic       miso_o,
  output logic       miso_oe_o,  
  
  output mb4_pkg_host_t host_o,
  input  logic [7:0] rd_data_i   
);

  logic       frame_rst_n;
  logic       byte_valid;
  logic [7:0] rx_byte;
  logic       tx_en;
  logic       open_q;  

  always_ff @(negedge cs_ni or negedge rst_ni) begin
    if (!rst_ni) open_q <= 1'b0;
    else         open_q <= 1'b1;
  end

  assign frame_rst_n = open_q && !cs_ni;

  mb4_spi_shift u_shift (
    .sclk_i,
    .frame_rst_ni (frame_rst_n),
    .mosi_i,
    .miso_o,
    .byte_valid_o (byte_valid),
    .byte_o       (rx_byte),
    .tx_en_i      (tx_en),
    .tx_byte_i    (rd_data_i)
  );

  mb4_spi_cmd #(.ReadOnly(ReadOnly), .Registers0(Registers0)) u_cmd (
    .sclk_i,
    .frame_rst_ni (frame_rst_n),
    .byte_valid_i (byte_valid),
    .byte_i       (rx_byte),
    .tx_en_o      (tx_en),
    .host_o
  );

  assign miso_oe_o = !cs_ni;

endmodule
