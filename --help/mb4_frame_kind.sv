
















module mb4_frame_kind (
  input  logic [2:0] instr_i,
  input  mb4_pkg_access_t access_i,
  input  logic       slaveloc5_i,
  input  logic [1:0] cfgch1_i,
  input  logic [1:0] cfgch2_i,
  output mb4_pkg_kind_t kind_o
);

  logic [1:0] ssi;
  logic [1:0] biss_b;
  logic [1:0] manual;
  logic [1:0] select;
  logic [1:0] fits;
  logic [1:0] in_use;
  logic       control;
  logic       is_control;
  logic       is_register;
  logic       is_frame;

  assign in_use  = {cfgch2_i != mb4_regs_pkg_PROTOCOL_UNUSED && slaveloc5_i,
                   cfgch1_i != mb4_regs_pkg_PROTOCOL_UNUSED};
  assign ssi  = {cfgch2_i == mb4_regs_pkg_PROTOCOL_SSI, cfgch1_i == mb4_regs_pkg_PROTOCOL_SSI};
  assign biss_b = {cfgch2_i == mb4_regs_pkg_PROTOCOL_BISS_B,
                   cfgch1_i == mb4_regs_pkg_PROTOCOL_BISS_B};

  assign manual = access_i.chsel == 2'b00 ? 2'b01 : access_i.chsel;
  assign fits     = manual & in_use & (access_i.regvers ? ~biss_b : biss_b);
  assign select = {fits[1] && !(fits[0] && access_i.cts && access_i.regvers), fits[0]};

  assign control = instr_i == mb4_regs_pkg_INSTR_CONTROL ||
                   instr_i == mb4_regs_pkg_INSTR_CONTROL_REDUCED;

  assign is_register = control && fits != 2'b00 && !access_i.regvers;
  assign is_control  = control && fits != 2'b00 && access_i.regvers;
  assign is_frame    = is_control || is_register || (instr_i != 3'b000 && !instr_i[2]);
  assign kind_o      = {in_use, ssi, manual, select, is_register ? select : in_use, in_use & ~ssi,
                        is_frame, is_control, is_register, control && fits == 2'b00};

endmodule
