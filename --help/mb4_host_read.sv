















module mb4_host_read (
  input  logic       rclk_i,
  input  logic       rst_ni,
  
  input  mb4_pkg_host_t host_i,
  output logic [7:0] rd_data_o,
  
  input  logic        ram_ready_i,   
  input  logic        bank_i,        
  input  logic [15:0] scd_lo_data_i, 
  input  logic [15:0] scd_hi_data_i, 
  input  logic [7:0] rdata_data_i,
  input  logic       recent_hit_i,   
  input  logic [7:0] recent_data_i,
  input  logic [7:0] slave_data_i,   
  input  logic [7:0] cfg_data_i,     
  input  logic [7:0] instr_data_i,
  input  logic       instr_pending_i,
  input  logic       control_pending_i,
  input  mb4_pkg_status_t status_i,
  input  logic [15:0] svalid_i,      
  input  logic [3:0] cds_i,          
  input  logic       cdssel2_i,      
  input  logic [1:0] revision_sel_i
);

  logic [7:0] rd_addr;
  
  logic       reg_sel_d, reg_sel_q;
  logic       slave_sel_d, slave_sel_q;
  logic       lo_sel_d, lo_sel_q;
  logic       hi_sel_d, hi_sel_q;
  logic       rdata_sel_d, rdata_sel_q;
  logic [7:0] reg_data;
  logic [7:0] ram_data;
  logic [7:0] reg_d;
  logic [7:0] reg_q;
  logic [7:0] status0, status3, status8;
  logic [7:0] svalid_lo, svalid_hi;
  logic [3:0] flags_d;   
  logic [3:0] flags_q;
  logic       bank_q;
  logic       ready_q;

  assign rd_addr     = host_i.rd_addr;
  assign lo_sel_d    = rd_addr[7:5] == mb4_regs_pkg_ADDR_SCDATA[7:5];
  assign hi_sel_d    = rd_addr[7:5] == mb4_regs_pkg_ADDR_SCDATA[7:5] + 3'd1;
  assign rdata_sel_d = rd_addr[7:6] == mb4_regs_pkg_ADDR_RDATA[7:6];
  assign slave_sel_d = rd_addr[7:5] == mb4_regs_pkg_ADDR_SLAVE_CFG[7:5];
  assign reg_sel_d   = !(lo_sel_d || hi_sel_d || rdata_sel_d || slave_sel_d);

  logic [7:0] status0_shadow; logic [7:0] status3_shadow; logic [7:0] status8_shadow; logic [7:0] svalid_hi_shadow; logic [7:0] svalid_lo_shadow; always begin begin
    status0_shadow = mb4_regs_pkg_RESET_STATUS0 & mb4_regs_pkg_CONST_STATUS0;
    status0_shadow[mb4_regs_pkg_NERR_LSB]      = status_i.n_err;
    status0_shadow[mb4_regs_pkg_NAGSERR_LSB]   = status_i.flags.n_agserr;
    status0_shadow[mb4_regs_pkg_NDELAYERR_LSB] = status_i.flags.n_delayerr;
    status0_shadow[mb4_regs_pkg_NSCDERR_LSB]   = status_i.flags.n_scderr;
    status0_shadow[mb4_regs_pkg_NREGERR_LSB]   = status_i.flags.n_regerr;
    status0_shadow[mb4_regs_pkg_REGEND_LSB]    = status_i.flags.regend && !control_pending_i;
    status0_shadow[mb4_regs_pkg_EOT_LSB]       = status_i.flags.eot && !instr_pending_i;
    status3_shadow = mb4_regs_pkg_RESET_STATUS3 & mb4_regs_pkg_CONST_STATUS3;
    status3_shadow[mb4_regs_pkg_CDMTIMEOUT_LSB] = status_i.flags.cdm_timeout;
    status3_shadow[mb4_regs_pkg_CDSSEL_LSB]     = cds_i[{bank_i, cdssel2_i}];
    status3_shadow[mb4_regs_pkg_REGBYTES_LSB +: mb4_regs_pkg_REGBYTES_W] = status_i.flags.regbytes;
    status8_shadow = mb4_regs_pkg_RESET_STATUS8 & mb4_regs_pkg_CONST_STATUS8;
    status8_shadow[mb4_regs_pkg_CDS_LSB]                              = cds_i[0];
    status8_shadow[mb4_regs_pkg_CDS_LSB + mb4_regs_pkg_CDS_LSB_STEP] = cds_i[1];
    status8_shadow[mb4_regs_pkg_SL_LSB]                               = status_i.sl1;
    status8_shadow[mb4_regs_pkg_SL_LSB + mb4_regs_pkg_SL_LSB_STEP]   = status_i.sl2;
    svalid_lo_shadow = mb4_regs_pkg_RESET_SVALID_LO & mb4_regs_pkg_CONST_SVALID_LO;
    svalid_hi_shadow = mb4_regs_pkg_RESET_SVALID_HI & mb4_regs_pkg_CONST_SVALID_HI;
    for (int i = 0; i < 4; i++) begin
      svalid_lo_shadow[mb4_regs_pkg_SVALID_LSB + mb4_regs_pkg_SVALID_LSB_STEP * i] = svalid_i[i];
      svalid_hi_shadow[mb4_regs_pkg_SVALID_LSB + mb4_regs_pkg_SVALID_LSB_STEP * i] = svalid_i[4+i];
    end
  end status0 = status0_shadow; status3 = status3_shadow; status8 = status8_shadow; svalid_hi = svalid_hi_shadow; svalid_lo = svalid_lo_shadow; @(bank_i or cds_i or cdssel2_i or control_pending_i or instr_pending_i or status_i or svalid_i); end

  logic [7:0] reg_d_shadow; always begin begin
    case (rd_addr)
      mb4_regs_pkg_ADDR_REVISION:
        case (revision_sel_i)
          2'd1:    reg_d_shadow = mb4_regs_pkg_DEVICE_REVISION_Z;
          2'd2:    reg_d_shadow = mb4_regs_pkg_DEVICE_REVISION_Z1;
          default: reg_d_shadow = mb4_regs_pkg_RESET_REVISION;
        endcase
      mb4_regs_pkg_ADDR_VERSION:
        reg_d_shadow = mb4_regs_pkg_RESET_VERSION;
      mb4_regs_pkg_ADDR_STATUS0:
        reg_d_shadow = status0;
      mb4_regs_pkg_ADDR_SVALID_LO:
        reg_d_shadow = svalid_lo;
      mb4_regs_pkg_ADDR_SVALID_HI:
        reg_d_shadow = svalid_hi;
      mb4_regs_pkg_ADDR_STATUS3:
        reg_d_shadow = status3;
      mb4_regs_pkg_ADDR_INSTR:
        reg_d_shadow = instr_data_i;
      mb4_regs_pkg_ADDR_STATUS8:
        reg_d_shadow = status8;
      mb4_regs_pkg_ADDR_STATUS9:
        reg_d_shadow = mb4_regs_pkg_RESET_STATUS9;
      mb4_regs_pkg_ADDR_SWBANKFAIL:
        reg_d_shadow = (8'd0 | status_i.flags.swbank_fail) << mb4_regs_pkg_SWBANKFAIL_LSB;
      default:
        reg_d_shadow = cfg_data_i;
    endcase
  end reg_d = reg_d_shadow; @(cfg_data_i or instr_data_i or rd_addr or revision_sel_i or status0 or status3 or status8 or status_i or svalid_hi or svalid_lo); end

  logic [3:0] flags_d_shadow; always begin begin
    case (rd_addr)
      mb4_regs_pkg_ADDR_SVALID_LO: flags_d_shadow = svalid_i[11:8];
      mb4_regs_pkg_ADDR_SVALID_HI: flags_d_shadow = svalid_i[15:12];
      mb4_regs_pkg_ADDR_STATUS8:   flags_d_shadow = {reg_d[7], reg_d[5], cds_i[3:2]};
      default: begin
        for (int i = 0; i < 4; i++) begin
          flags_d_shadow[i] = reg_d[mb4_regs_pkg_SVALID_LSB + mb4_regs_pkg_SVALID_LSB_STEP * i];
        end
      end
    endcase
  end flags_d = flags_d_shadow; @(cds_i or rd_addr or reg_d or svalid_i); end

  always_ff @(posedge rclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      reg_sel_q   <= 1'b0;
      slave_sel_q <= 1'b0;
      lo_sel_q    <= 1'b0;
      hi_sel_q    <= 1'b0;
      rdata_sel_q <= 1'b0;
      reg_q    <= '0;
      flags_q  <= '0;
      bank_q   <= 1'b0;
      ready_q  <= 1'b0;
    end else if (host_i.rd_en) begin
      reg_sel_q   <= reg_sel_d;
      slave_sel_q <= slave_sel_d;
      lo_sel_q    <= lo_sel_d;
      hi_sel_q    <= hi_sel_d;
      rdata_sel_q <= rdata_sel_d;
      reg_q    <= reg_d;
      flags_q  <= flags_d;
      bank_q   <= bank_i;
      ready_q  <= ram_ready_i;
    end
  end

  logic [7:0] reg_data_shadow; always begin begin
    reg_data_shadow = reg_q;
    for (int i = 0; i < 4; i++) begin
      if (bank_q) begin
        reg_data_shadow[mb4_regs_pkg_SVALID_LSB + mb4_regs_pkg_SVALID_LSB_STEP * i] = flags_q[i];
      end
    end
  end reg_data = reg_data_shadow; @(bank_q or flags_q or reg_q); end

  
  assign ram_data =
      ((bank_q ? scd_lo_data_i[15:8] : scd_lo_data_i[7:0]) & {8{lo_sel_q}}) |
      ((bank_q ? scd_hi_data_i[15:8] : scd_hi_data_i[7:0]) & {8{hi_sel_q}}) |
      (rdata_data_i & {8{rdata_sel_q}});

  assign rd_data_o = (ram_data & {8{ready_q && !recent_hit_i}}) |
                     (recent_data_i & {8{recent_hit_i}}) |
                     (slave_data_i & {8{slave_sel_q}}) | (reg_data & {8{reg_sel_q}});

endmodule
