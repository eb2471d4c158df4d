















module mb4_cds_bank (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  mb4_pkg_banks_t    banks_i,
  input  mb4_pkg_bank_cmd_t bank_i,
  input  logic       holdbank_i,
  input  logic [1:0] cds_i,        
  output logic [3:0] cds_o         
);

  logic [1:0] bank0_q;
  logic [1:0] bank1_q;
  logic       bank;

  assign bank = (bank_i.reduced && !holdbank_i) ? banks_i.host : banks_i.eng;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank0_q <= '0;
      bank1_q <= '0;
    end else begin
      if (bank_i.frame_end && !bank) bank0_q <= cds_i;
      if (bank_i.frame_end && bank)  bank1_q <= cds_i;
    end
  end

  assign cds_o = {bank1_q, bank0_q};

endmodule
