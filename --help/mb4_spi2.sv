










module mb4_spi2 (
  input  logic       rst_ni,
  
  input  logic       sclk_i,
  input  logic       cs_ni,
  input  logic       mosi_i,
  output logic       miso_o,
  output logic       miso_oe_o,  
  
  output mb4_pkg_mem_rd_t read_o,
  input  logic [7:0] rd_data_i   
);

  
  localparam logic [7:0] FIRST = mb4_regs_pkg_ADDR_SCDATA + mb4_regs_pkg_SCDATA_STRIDE * 8'd4;

  mb4_pkg_host_t host;
  logic       inside_q;          

  mb4_spi #(.ReadOnly(1'b1), .Registers0(FIRST)) u_spi (
    .rst_ni,
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o,
    .miso_oe_o,
    .host_o    (host),
    .rd_data_i (inside_q ? rd_data_i : 8'h00)
  );

  always_ff @(posedge sclk_i or negedge rst_ni) begin
    if (!rst_ni)         inside_q <= 1'b0;
    else if (host.rd_en) inside_q <= host.rd_addr[7:5] == FIRST[7:5];
  end

  assign read_o = {host.rd_en, host.rd_addr[5:0]};

  
  logic unused;
  assign unused = ^host;

endmodule
