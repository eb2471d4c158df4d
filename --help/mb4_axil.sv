
















module mb4_axil #(
  parameter logic [1:0]  SlCells   = biss_pkg_SL_FLOPS,  
  parameter int WaitLimit = 1024
) (
  
  input  logic        s_axi_aclk,
  input  logic        s_axi_aresetn,
  input  logic        s_axi_awvalid,
  output logic        s_axi_awready,
  input  logic [11:0] s_axi_awaddr,
  input  logic        s_axi_wvalid,
  output logic        s_axi_wready,
  input  logic [31:0] s_axi_wdata,
  input  logic [3:0]  s_axi_wstrb,
  output logic        s_axi_bvalid,
  input  logic        s_axi_bready,
  output logic [1:0]  s_axi_bresp,
  input  logic        s_axi_arvalid,
  output logic        s_axi_arready,
  input  logic [11:0] s_axi_araddr,
  output logic        s_axi_rvalid,
  input  logic        s_axi_rready,
  output logic [31:0] s_axi_rdata,
  output logic [1:0]  s_axi_rresp,
  output logic        irq_o,
  
  input  logic        clk_i,
  input  logic        por_ni,      
  output logic        eot_o,
  output logic        ner_low_o,   
  input  logic        ner_i,       
  output logic        clkeni_o,    
  output logic        paired_o,    
  input  logic        getsens_i,
  
  output logic        ma1_o,
  input  logic        sl1_i,
  output logic        mo1_o,
  output logic        ma2_o,
  input  logic        sl2_i,
  output logic        mo2_o,
  
  input  logic [mb4_pkg_QUIRKS_W-1:0] quirks_i
);

  logic        rst_n;
  logic        word_req, word_write, word_ready, word_error;
  logic [11:2] word_addr;
  logic [31:0] word_wdata, word_rdata;
  logic [3:0]  word_be;
  logic        unused;

  enc_axil #(.AddrW(12)) u_axil (
    .clk_i         (s_axi_aclk),
    .rst_ni        (rst_n),
    .s_axi_awvalid,
    .s_axi_awready,
    .s_axi_awaddr  (s_axi_awaddr[11:2]),
    .s_axi_wvalid,
    .s_axi_wready,
    .s_axi_wdata,
    .s_axi_wstrb,
    .s_axi_bvalid,
    .s_axi_bready,
    .s_axi_bresp,
    .s_axi_arvalid,
    .s_axi_arready,
    .s_axi_araddr  (s_axi_araddr[11:2]),
    .s_axi_rvalid,
    .s_axi_rready,
    .s_axi_rdata,
    .s_axi_rresp,
    .word_req_o    (word_req),
    .word_write_o  (word_write),
    .word_addr_o   (word_addr),
    .word_data_o   (word_wdata),
    .word_be_o     (word_be),
    .word_ready_i  (word_ready),
    .word_data_i   (word_rdata),
    .word_error_i  (word_error)
  );

  mb4_bus #(.SlCells(SlCells), .WaitLimit(WaitLimit)) u_bus (
    .bus_clk_i       (s_axi_aclk),
    .bus_rst_ni      (s_axi_aresetn),
    .bus_rst_sync_no (rst_n),
    .word_req_i      (word_req),
    .word_write_i    (word_write),
    .word_addr_i     (word_addr),
    .word_data_i     (word_wdata),
    .word_be_i       (word_be),
    .word_ready_o    (word_ready),
    .word_data_o     (word_rdata),
    .word_error_o    (word_error),
    .irq_o,
    .clk_i,
    .por_ni,
    .eot_o,
    .ner_low_o,
    .ner_i,
    .clkeni_o,
    .paired_o,
    .getsens_i,
    .ma1_o,
    .sl1_i,
    .mo1_o,
    .ma2_o,
    .sl2_i,
    .mo2_o,
    .quirks_i
  );

  
  assign unused = ^{s_axi_awaddr[1:0], s_axi_araddr[1:0]};

endmodule
