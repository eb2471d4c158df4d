

















module mb4_par_bus (
  input  logic       rst_ni,
  input  logic       enable_i,    
  input  logic       int_nmot_i,  
  
  input  logic       cs_ni,
  input  logic       ale_i,
  input  logic       nrd_rnw_i,
  input  logic       nwr_e_i,
  input  logic [7:0] db_i,
  
  output logic       wr_clk_o,
  output logic       rd_clk_o,
  output logic [7:0] addr_o,
  
  output logic       db_oe_o      
);

  logic       cs;
  logic       read, write;
  logic [7:0] addr_q;

  assign cs    = enable_i && !cs_ni;
  assign read  = cs && nwr_e_i && (int_nmot_i ? !nrd_rnw_i : nrd_rnw_i);
  assign write = cs && (int_nmot_i ? !nwr_e_i : nwr_e_i && !nrd_rnw_i);

  always_ff @(negedge ale_i or negedge rst_ni) begin
    if (!rst_ni) addr_q <= '0;
    else if (cs) addr_q <= db_i;
  end

  assign wr_clk_o = !write;
  assign rd_clk_o = read;
  assign addr_o   = addr_q;
  assign db_oe_o  = read;

endmodule
