
























module mb4_recent (
  input  logic       hclk_i,
  input  logic       rst_ni,
  input  logic       rclk_i,
  input  mb4_pkg_host_t host_i,
  input  logic       bank_i,      
  output logic       hit_o,
  output logic [7:0] data_o,
  
  input  logic       empty_i,     
  output logic       mark_o,      
  input  logic       marked_i     
);

  logic        wr_en;
  logic [7:0]  wr_addr, rd_addr;   
  logic [31:0] addr_q;    
  logic [3:0]  valid_q;
  logic [3:0]  old_q;     
  logic [3:0]  drained;   
  logic [3:0]  valid;     
  logic [3:0]  old;
  logic        passed;
  logic        mark_q;
  logic        marked_q;
  logic        empty_q;
  logic        fresh_q;   
  logic        hit_q;
  logic [2:0]  wr_match;
  logic [3:0]  rd_match;
  logic [3:0]  move;      

  
  assign wr_en   = host_i.wr_en && !host_i.wr_addr[6];
  assign wr_addr = {host_i.wr_addr[7], !host_i.wr_addr[7] && bank_i, host_i.wr_addr[5:0]};
  assign rd_addr = {host_i.rd_addr[7], !host_i.rd_addr[7] && bank_i, host_i.rd_addr[5:0]};

  for (genvar i = 0; i < 3; i++) begin : gen_write
    assign wr_match[i] = valid_q[i] && addr_q[8*i +: 8] == wr_addr;
  end

  for (genvar i = 0; i < 4; i++) begin : gen_read
    assign rd_match[i] = valid_q[i] && !drained[i] && !(old_q[i] && marked_i == mark_q) &&
                         addr_q[8*i +: 8] == rd_addr;
  end

  assign move = {wr_match == 3'b000, wr_match[1:0] == 2'b00, !wr_match[0], 1'b1} &
                {4{wr_en}};

  assign passed = marked_q == mark_q;
  assign drained = {{3{empty_q}}, empty_q && !fresh_q};
  assign valid  = valid_q & ~(old_q & {4{passed}}) & ~drained;
  assign old    = old_q | {4{passed}};

  always_ff @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      addr_q   <= '0;
      valid_q  <= '0;
      old_q    <= '0;
      mark_q   <= 1'b0;
      marked_q <= 1'b0;
      empty_q  <= 1'b0;
      fresh_q  <= 1'b0;
    end else begin
      empty_q  <= empty_i;
      fresh_q  <= wr_en;
      if (passed && valid != 4'b0000) mark_q <= !mark_q;
      marked_q <= marked_i;
      if (move[0]) addr_q[7:0]   <= wr_addr;
      if (move[1]) addr_q[15:8]  <= addr_q[7:0];
      if (move[2]) addr_q[23:16] <= addr_q[15:8];
      if (move[3]) addr_q[31:24] <= addr_q[23:16];
      valid_q <= (valid & ~move) | ({valid[2:0], 1'b1} & move);
      old_q   <= (old & ~move) | ({old[2:0], 1'b0} & move);
    end
  end

  enc_ram #(.Width(8), .AddrW(8)) u_ram (
    .wclk_i    (hclk_i),
    .wr_en_i   (wr_en),
    .wr_addr_i (wr_addr),
    .wr_data_i (host_i.wr_data),
    .rclk_i,
    .rd_en_i   (host_i.rd_en),
    .rd_addr_i (rd_addr),
    .rd_data_o (data_o)
  );

  always_ff @(posedge rclk_i or negedge rst_ni) begin
    if (!rst_ni)           hit_q <= 1'b0;
    else if (host_i.rd_en) hit_q <= !host_i.rd_addr[6] && rd_match != 4'b0000 && !empty_i;
  end

  assign hit_o  = hit_q;
  assign mark_o = mark_q;

endmodule
