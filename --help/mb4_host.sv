










module mb4_host (
  input  logic       rst_ni,
  
  input  logic       cfgspi_i,    
  input  logic       int_nmot_i,  
  
  input  logic       ncs_i,
  input  logic       ale_i,       
  input  logic       nrd_rnw_i,
  input  logic       nwr_e_i,     
  input  logic [7:0] db_i,        
  output logic [7:0] db_o,        
  output logic [7:0] db_oe_o,
  
  output logic       wr_clk_o,
  output logic       rd_clk_o,
  output mb4_pkg_host_t host_o,
  input  logic [7:0] rd_data_i,
  
  output logic       rd2_clk_o,
  output mb4_pkg_mem_rd_t read2_o,
  input  logic [7:0] rd2_data_i
);

  mb4_pkg_host_t spi;
  logic       miso, miso_oe, miso2, miso2_oe;
  logic       par_wr_clk, par_rd_clk, par_oe;
  logic [7:0] par_addr;

  mb4_spi u_spi (
    .rst_ni,
    .sclk_i    (ale_i),
    .cs_ni     (ncs_i || !cfgspi_i),
    .mosi_i    (db_i[0]),
    .miso_o    (miso),
    .miso_oe_o (miso_oe),
    .host_o    (spi),
    .rd_data_i
  );

  mb4_spi2 u_spi2 (
    .rst_ni,
    .sclk_i    (db_i[5]),
    .cs_ni     (db_i[4] || nwr_e_i || !cfgspi_i),
    .mosi_i    (db_i[6]),
    .miso_o    (miso2),
    .miso_oe_o (miso2_oe),
    .read_o    (read2_o),
    .rd_data_i (rd2_data_i)
  );

  mb4_par_bus u_par_bus (
    .rst_ni,
    .enable_i   (!cfgspi_i),
    .int_nmot_i,
    .cs_ni      (ncs_i),
    .ale_i,
    .nrd_rnw_i,
    .nwr_e_i,
    .db_i,
    .wr_clk_o   (par_wr_clk),
    .rd_clk_o   (par_rd_clk),
    .addr_o     (par_addr),
    .db_oe_o    (par_oe)
  );

  assign wr_clk_o  = cfgspi_i ? ale_i : par_wr_clk;
  assign rd_clk_o  = cfgspi_i ? ale_i : par_rd_clk;
  assign host_o    = cfgspi_i ? spi : {1'b1, par_addr, db_i, 1'b1, par_addr};
  assign rd2_clk_o = db_i[5];

  assign db_o    = cfgspi_i ? {miso2, 5'b00000, miso, 1'b0} : rd_data_i;
  assign db_oe_o = cfgspi_i ? {miso2_oe, 5'b00000, miso_oe, 1'b0} : {8{par_oe}};

endmodule
