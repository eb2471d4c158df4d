


















module mb4_memory #(
  parameter bit Banks = 1'b1,
  parameter bit Port2 = 1'b0
) (
  input  logic       clk_i,
  input  mb4_pkg_mem_wr_t clear_i,
  
  input  mb4_pkg_mem_wr_t eng_wr_i,
  input  mb4_pkg_mem_rd_t eng_rd_i,
  output logic [7:0] eng_data_o,
  
  input  mb4_pkg_mem_wr_t host_wr_i,
  output logic       host_ready_o,
  
  input  logic        rclk_i,
  input  mb4_pkg_mem_rd_t rd_i,
  output logic [15:0] rd_data_o,     
  
  input  logic        rd2_clk_i,
  input  mb4_pkg_mem_rd_t rd2_i,
  output logic [15:0] rd2_data_o
);

  logic       wr_en;
  logic [5:0] wr_addr;
  logic [7:0] wr_data;
  logic       unused;

  assign host_ready_o = !clear_i.en && !eng_wr_i.en;
  assign wr_en   = clear_i.en || eng_wr_i.en || host_wr_i.en;
  assign wr_addr = clear_i.en ? clear_i.addr : eng_wr_i.en ? eng_wr_i.addr : host_wr_i.addr;
  assign wr_data = clear_i.en ? clear_i.data : eng_wr_i.en ? eng_wr_i.data : host_wr_i.data;

  if (Banks) begin : gen_banks
    enc_ram_pair #(.AddrW(5)) u_host (
      .wclk_i    (clk_i),
      .wr_en_i   (wr_en),
      .wr_side_i (wr_addr[5]),
      .wr_addr_i (wr_addr[4:0]),
      .wr_data_i (wr_data),
      .rclk_i,
      .rd_en_i   (rd_i.en),
      .rd_addr_i (rd_i.addr[4:0]),
      .rd_data_o
    );
  end else begin : gen_no_banks
    enc_ram #(.Width(8), .AddrW(6)) u_host (
      .wclk_i    (clk_i),
      .wr_en_i   (wr_en),
      .wr_addr_i (wr_addr),
      .wr_data_i (wr_data),
      .rclk_i,
      .rd_en_i   (rd_i.en),
      .rd_addr_i (rd_i.addr),
      .rd_data_o (rd_data_o[7:0])
    );
    assign rd_data_o[15:8] = 8'h00;
  end

  enc_ram #(.Width(8), .AddrW(6)) u_engine (
    .wclk_i    (clk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i (wr_addr),
    .wr_data_i (wr_data),
    .rclk_i    (clk_i),
    .rd_en_i   (eng_rd_i.en),
    .rd_addr_i (eng_rd_i.addr),
    .rd_data_o (eng_data_o)
  );

  if (Port2) begin : gen_port2
    enc_ram_pair #(.AddrW(5)) u_ram (
      .wclk_i    (clk_i),
      .wr_en_i   (wr_en),
      .wr_side_i (wr_addr[5]),
      .wr_addr_i (wr_addr[4:0]),
      .wr_data_i (wr_data),
      .rclk_i    (rd2_clk_i),
      .rd_en_i   (rd2_i.en),
      .rd_addr_i (rd2_i.addr[4:0]),
      .rd_data_o (rd2_data_o)
    );
  end else begin : gen_no_port2
    assign rd2_data_o = '0;
  end

  assign unused = ^{rd_i, rd2_clk_i, rd2_i};

endmodule
