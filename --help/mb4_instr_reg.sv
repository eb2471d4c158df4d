
























module mb4_instr_reg (
  input  logic       hclk_i,
  input  logic       rst_ni,
  
  input  mb4_pkg_host_t host_i,
  output logic [7:0] rd_data_o,
  output logic       pending_o,
  output logic       pending_control_o,  
  
  output mb4_pkg_instr_host_t instr_o,
  input  mb4_pkg_instr_core_t instr_i,
  
  input  logic            base_i,       
  input  logic            newest_i,     
  output logic            bank_o,       
  output logic            kept_o        
);

  logic [7:0] byte_q;
  logic [1:0] count_q;
  logic       kept_q;
  logic       hold_q;     
  logic       base;

  always_ff @(posedge hclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      byte_q  <= '0;
      count_q <= '0;
      kept_q  <= 1'b0;
      hold_q  <= 1'b0;
    end else if (host_i.wr_en && host_i.wr_addr == mb4_regs_pkg_ADDR_INSTR) begin
      byte_q  <= host_i.wr_data | (byte_q & {8{pending_o}} & mb4_regs_pkg_BREAK_MASK);
      if (count_q != ~instr_i.ack) count_q <= {count_q[0], !count_q[1]};
      kept_q  <= host_i.wr_data[mb4_regs_pkg_HOLDBANK_LSB] ? base : newest_i;
      hold_q  <= host_i.wr_data[mb4_regs_pkg_HOLDBANK_LSB] || byte_q[mb4_regs_pkg_HOLDBANK_LSB] ||
                 (pending_o && hold_q);
    end
  end

  assign instr_o   = {count_q, byte_q};
  assign pending_o = count_q != instr_i.ack;
  assign pending_control_o = pending_o &&
      (byte_q[mb4_regs_pkg_INSTR_LSB +: 3] == mb4_regs_pkg_INSTR_CONTROL ||
       byte_q[mb4_regs_pkg_INSTR_LSB +: 3] == mb4_regs_pkg_INSTR_CONTROL_REDUCED);
  assign base      = (pending_o && hold_q) ? kept_q : base_i;
  assign bank_o    = base ^ byte_q[mb4_regs_pkg_SWBANK_LSB];
  assign kept_o    = kept_q;
  assign rd_data_o = pending_o ? (byte_q & ~mb4_regs_pkg_BREAK_MASK) : instr_i.held;

endmodule
