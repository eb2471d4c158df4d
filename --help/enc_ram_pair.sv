










module enc_ram_pair #(
  parameter int AddrW = 5
) (
  input  logic             wclk_i,
  input  logic             wr_en_i,
  input  logic             wr_side_i,
  input  logic [AddrW-1:0] wr_addr_i,
  input  logic [7:0]       wr_data_i,
  input  logic             rclk_i,
  input  logic             rd_en_i,
  input  logic [AddrW-1:0] rd_addr_i,
  output logic [15:0]      rd_data_o   
);

  logic [15:0] mem [0:(1 << AddrW)-1];
  logic [15:0] rd_data_q;

  always_ff @(posedge wclk_i) begin
    if (wr_en_i && !wr_side_i) mem[wr_addr_i][7:0]  <= wr_data_i;
    if (wr_en_i && wr_side_i)  mem[wr_addr_i][15:8] <= wr_data_i;
  end

  always_ff @(posedge rclk_i) begin
    if (rd_en_i) rd_data_q <= mem[rd_addr_i];
  end

  assign rd_data_o = rd_data_q;

endmodule
