















module mb4_svalid (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       eng_bank_i,
  
  input  logic       begin_i,      
  input  logic       set_en_i,     
  input  logic [1:0] set_slave_i,  
  input  logic       set_valid_i,
  input  logic       split_i,      
  input  logic       clear_i,
  
  input  logic       keep_en_i,
  input  logic [3:0] keep_i,
  input  logic       keep_bank_i,  
  output logic [7:0] svalid_o    
);

  logic [3:0] bank0_q;
  logic [3:0] bank1_q;
  logic [3:0] bank0_d;
  logic [3:0] bank1_d;

  logic [3:0] bank0_d_shadow; logic [3:0] bank1_d_shadow; always begin begin
    bank0_d_shadow = bank0_q;
    bank1_d_shadow = bank1_q;
    if (keep_en_i) begin
      if (keep_bank_i) bank1_d_shadow = bank1_q & keep_i;
      else             bank0_d_shadow = bank0_q & keep_i;
    end
    if (set_en_i || begin_i) begin
      if (eng_bank_i) bank1_d_shadow[set_slave_i] = set_en_i && set_valid_i;
      else            bank0_d_shadow[set_slave_i] = set_en_i && set_valid_i;
    end
    if (split_i) begin
      bank0_d_shadow[set_slave_i] = 1'b0;
      bank1_d_shadow[set_slave_i] = 1'b0;
    end
    if (clear_i) begin
      bank0_d_shadow = '0;
      bank1_d_shadow = '0;
    end
  end bank0_d = bank0_d_shadow; bank1_d = bank1_d_shadow; @(bank0_q or bank1_q or begin_i or clear_i or eng_bank_i or keep_bank_i or keep_en_i or keep_i or set_en_i or set_slave_i or set_valid_i or split_i); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank0_q <= '0;
      bank1_q <= '0;
    end else begin
      bank0_q <= bank0_d;
      bank1_q <= bank1_d;
    end
  end

  assign svalid_o = {bank1_q, bank0_q};

endmodule
