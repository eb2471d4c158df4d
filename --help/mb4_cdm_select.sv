









module mb4_cdm_select (
  input  logic [1:0] manual_i,    
  input  logic [2:0] instr_i,
  input  logic       active_i,    
  input  logic [1:0] control0_i,  
  input  logic [1:0] control1_i,
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o
);

  logic [1:0] cdm0_o_shadow; logic [1:0] cdm1_o_shadow; always begin begin
    cdm0_o_shadow = 2'b00;
    cdm1_o_shadow = 2'b00;
    if (active_i) begin
      cdm0_o_shadow = control0_i;
      cdm1_o_shadow = control1_i;
    end else if (instr_i == mb4_regs_pkg_INSTR_CDM1) begin
      cdm0_o_shadow = manual_i;
      cdm1_o_shadow = manual_i;
    end else if (instr_i == mb4_regs_pkg_INSTR_CDM_NOT_CDSSEL) begin
      cdm0_o_shadow = manual_i;
    end
  end cdm0_o = cdm0_o_shadow; cdm1_o = cdm1_o_shadow; @(active_i or control0_i or control1_i or instr_i or manual_i); end

endmodule
