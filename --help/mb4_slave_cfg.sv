
















module mb4_slave_cfg #(
  parameter int Lists = 4
) (
  
  input  logic        hclk_i,
  input  logic        rst_ni,
  input  mb4_pkg_host_t host_i,
  input  logic        rclk_i,
  output logic [7:0]  rd_data_o,
  
  input  logic        clk_i,
  output logic [mb4_pkg_NUM_SLAVES-1:0]        enscd_o,
  input  logic [Lists-1:0]                      list_en_i,
  input  logic [3*Lists-1:0]                    list_slave_i,
  output logic [mb4_pkg_SLAVE_CFG_W*Lists-1:0] list_cfg_o
);

  logic        write;
  logic [7:0]  rows_q;
  logic [7:0]  enscd_q;
  logic [2:0]  row;
  logic [3:0]  byte_en;
  logic [3:0]  wr_en;
  logic [31:0] wr_data;
  logic [31:0] rd_data;
  logic [7:0]  crc_byte;
  logic [7:0]  crc_poly;  
  logic [3:0]  sel_q;     

  assign write   = host_i.wr_en && host_i.wr_addr[7:5] == mb4_regs_pkg_ADDR_SLAVE_CFG[7:5];
  assign row     = host_i.wr_addr[4:2];
  assign byte_en = 4'b0001 << host_i.wr_addr[1:0];
  assign wr_en   = write ? byte_en | {4{!rows_q[row]}} : 4'b0000;
  assign wr_data = {4{host_i.wr_data}} & {{8{byte_en[3]}}, {8{byte_en[2]}},
                                          {8{byte_en[1]}}, {8{byte_en[0]}}};

  assign crc_byte = wr_data[32'd8 * 32'(mb4_regs_pkg_SLAVE_CFG_CRC_OFFSET) +: 8];

  always_ff @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rows_q  <= '0;
      enscd_q <= '0;
    end else if (write) begin
      rows_q[row] <= 1'b1;
      if (byte_en[mb4_regs_pkg_SLAVE_CFG_LENGTH_OFFSET[1:0]]) begin
        enscd_q[row] <= host_i.wr_data[mb4_regs_pkg_ENSCD_LSB];
      end
    end
  end

  mb4_crc_code u_code (
    .selcrc_i (crc_byte[mb4_regs_pkg_SELCRCS_LSB]),
    .code_i   (crc_byte[mb4_regs_pkg_SCRCLEN_LSB +: mb4_regs_pkg_SCRCLEN_W]),
    .poly_o   (crc_poly)
  );

  enc_ram_row u_host (
    .wclk_i    (hclk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i (row),
    .wr_data_i (wr_data),
    .rclk_i,
    .rd_en_i   (host_i.rd_en),
    .rd_addr_i (host_i.rd_addr[4:2]),
    .rd_data_o (rd_data)
  );

  
  always_ff @(posedge rclk_i or negedge rst_ni) begin
    if (!rst_ni) sel_q <= '0;
    else if (host_i.rd_en) begin
      sel_q <= {4{rows_q[host_i.rd_addr[4:2]]}} & (4'b0001 << host_i.rd_addr[1:0]);
    end
  end

  assign rd_data_o = (rd_data[7:0]   & {8{sel_q[0]}}) | (rd_data[15:8]  & {8{sel_q[1]}}) |
                     (rd_data[23:16] & {8{sel_q[2]}}) | (rd_data[31:24] & {8{sel_q[3]}});

  for (genvar i = 0; i < Lists; i++) begin : gen_list
    enc_ram_row u_list (
      .wclk_i    (hclk_i),
      .wr_en_i   (wr_en),
      .wr_addr_i (row),
      .wr_data_i ({wr_data[31:16], crc_poly, wr_data[7:0]}),
      .rclk_i    (clk_i),
      .rd_en_i   (list_en_i[i]),
      .rd_addr_i (list_slave_i[3*i +: 3]),
      .rd_data_o (list_cfg_o[mb4_pkg_SLAVE_CFG_W*i +: mb4_pkg_SLAVE_CFG_W])
    );
  end

  assign enscd_o = enscd_q;

endmodule
