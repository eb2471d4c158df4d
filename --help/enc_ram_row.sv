










module enc_ram_row #(
  parameter int AddrW = 3
) (
  input  logic             wclk_i,
  input  logic [3:0]       wr_en_i,    
  input  logic [AddrW-1:0] wr_addr_i,
  input  logic [31:0]      wr_data_i,
  input  logic             rclk_i,
  input  logic             rd_en_i,
  input  logic [AddrW-1:0] rd_addr_i,
  output logic [31:0]      rd_data_o
);

  logic [31:0] mem [0:(1 << AddrW)-1];
  logic [31:0] rd_data_q;

  always_ff @(posedge wclk_i) begin
    if (wr_en_i[0]) mem[wr_addr_i][7:0]   <= wr_data_i[7:0];
    if (wr_en_i[1]) mem[wr_addr_i][15:8]  <= wr_data_i[15:8];
    if (wr_en_i[2]) mem[wr_addr_i][23:16] <= wr_data_i[23:16];
    if (wr_en_i[3]) mem[wr_addr_i][31:24] <= wr_data_i[31:24];
  end

  always_ff @(posedge rclk_i) begin
    if (rd_en_i) rd_data_q <= mem[rd_addr_i];
  end

  assign rd_data_o = rd_data_q;

endmodule
