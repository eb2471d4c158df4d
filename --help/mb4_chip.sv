



















module mb4_chip (
  
  input  logic       clk_i,       
  input  logic       osc_i,       
  input  logic       nres_i,      
  input  logic       npor_i,      
  
  input  logic       cfgspi_i,    
  input  logic       int_nmot_i,  
  
  input  logic       ncs_i,       
  input  logic       ale_i,       
  input  logic       nrd_rnw_i,   
  input  logic       nwr_e_i,     
  input  logic [7:0] db_i,        
  output logic [7:0] db_o,        
  output logic [7:0] db_oe_o,     
  
  output logic       eot_o,       
  input  logic       ner_i,       
  output logic       ner_low_o,   
  input  logic       getsens_i,   
  
  output logic       ma1_o,       
  output logic       ma2_o,       
  output logic       mo1_o,       
  output logic       mo2_o,       
  input  logic       sl1_i,       
  input  logic       sl2_i,       
  
  input  logic [mb4_pkg_QUIRKS_W-1:0] quirks_i
);

  logic clk;
  logic clkeni;
  logic paired;
  logic ma2, mo2;

  mb4_pkg_host_t   host;
  mb4_pkg_mem_rd_t read2;
  logic       wr_clk, rd_clk, rd2_clk;
  logic [7:0] rd_data, rd2_data;
  mb4_pkg_tap_t tap;

  enc_clk_mux u_clk_mux (
    .clk0_i (clk_i),
    .clk1_i (osc_i),
    .rst_ni (nres_i),
    .sel_i  (clkeni),
    .clk_o  (clk)
  );

  mb4_host u_host (
    .rst_ni     (nres_i),
    .cfgspi_i,
    .int_nmot_i,
    .ncs_i,
    .ale_i,
    .nrd_rnw_i,
    .nwr_e_i,
    .db_i,
    .db_o,
    .db_oe_o,
    .wr_clk_o   (wr_clk),
    .rd_clk_o   (rd_clk),
    .host_o     (host),
    .rd_data_i  (rd_data),
    .rd2_clk_o  (rd2_clk),
    .read2_o    (read2),
    .rd2_data_i (rd2_data)
  );

  mb4_engine #(.Port2(1'b1)) u_engine (
    .clk_i      (clk),
    .rst_ni     (nres_i),
    .por_ni     (npor_i),
    .wr_clk_i   (wr_clk),
    .wr_en_i    (host.wr_en),
    .wr_addr_i  (host.wr_addr),
    .wr_data_i  (host.wr_data),
    .rd_clk_i   (rd_clk),
    .rd_en_i    (host.rd_en),
    .rd_addr_i  (host.rd_addr),
    .rd_data_o  (rd_data),
    .rd2_clk_i  (rd2_clk),
    .rd2_en_i   (read2.en),
    .rd2_addr_i (read2.addr[4:0]),
    .rd2_data_o (rd2_data),
    .eot_o,
    .ner_low_o,
    .ner_i,
    .clkeni_o   (clkeni),
    .paired_o   (paired),
    .getsens_i,
    .ma1_o,
    .sl1_i      (sl1_i || (paired && !sl2_i)),
    .mo1_o,
    .ma2_o      (ma2),
    .sl2_i      (sl2_i || paired),
    .mo2_o      (mo2),
    .tap_o      (tap),
    .quirks_i
  );

  
  logic unused;
  assign unused = ^tap;

  assign ma2_o = paired ? !ma1_o : ma2;
  assign mo2_o = paired ? !mo1_o : mo2;

endmodule
