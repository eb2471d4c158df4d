

  

  localparam logic [7:0] mb4_regs_pkg_ADDR_SCDATA = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_ADDR_RDATA = 8'h80;
  localparam logic [7:0] mb4_regs_pkg_ADDR_IDS = 8'h80;
  localparam logic [7:0] mb4_regs_pkg_ADDR_REGADR = 8'hE2;
  localparam logic [7:0] mb4_regs_pkg_ADDR_REGNUM = 8'hE3;
  localparam logic [7:0] mb4_regs_pkg_ADDR_CHSEL = 8'hE4;
  localparam logic [7:0] mb4_regs_pkg_ADDR_CTRL = 8'hE5;
  localparam logic [7:0] mb4_regs_pkg_ADDR_FREQ = 8'hE6;
  localparam logic [7:0] mb4_regs_pkg_ADDR_BANKCFG = 8'hE7;
  localparam logic [7:0] mb4_regs_pkg_ADDR_FREQAGS = 8'hE8;
  localparam logic [7:0] mb4_regs_pkg_ADDR_MO_BUSY = 8'hE9;
  localparam logic [7:0] mb4_regs_pkg_ADDR_REVISION = 8'hEA;
  localparam logic [7:0] mb4_regs_pkg_ADDR_VERSION = 8'hEB;
  localparam logic [7:0] mb4_regs_pkg_ADDR_SLAVELOC5 = 8'hEC;
  localparam logic [7:0] mb4_regs_pkg_ADDR_CFGCH = 8'hED;
  localparam logic [7:0] mb4_regs_pkg_ADDR_ACTNSENS = 8'hEF;
  localparam logic [7:0] mb4_regs_pkg_ADDR_STATUS0 = 8'hF0;
  localparam logic [7:0] mb4_regs_pkg_ADDR_SVALID_LO = 8'hF1;
  localparam logic [7:0] mb4_regs_pkg_ADDR_SVALID_HI = 8'hF2;
  localparam logic [7:0] mb4_regs_pkg_ADDR_STATUS3 = 8'hF3;
  localparam logic [7:0] mb4_regs_pkg_ADDR_INSTR = 8'hF4;
  localparam logic [7:0] mb4_regs_pkg_ADDR_IFACE = 8'hF5;
  localparam logic [7:0] mb4_regs_pkg_ADDR_STATUS8 = 8'hF8;
  localparam logic [7:0] mb4_regs_pkg_ADDR_STATUS9 = 8'hF9;
  localparam logic [7:0] mb4_regs_pkg_ADDR_SWBANKFAIL = 8'hFB;
  localparam logic [7:0] mb4_regs_pkg_ADDR_SLAVE_CFG = 8'hC0;
  localparam logic [7:0] mb4_regs_pkg_SLAVE_CFG_LENGTH_OFFSET = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_SLAVE_CFG_CRC_OFFSET = 8'h01;
  localparam logic [7:0] mb4_regs_pkg_SLAVE_CFG_CRCSTART_LO_OFFSET = 8'h02;
  localparam logic [7:0] mb4_regs_pkg_SLAVE_CFG_CRCSTART_HI_OFFSET = 8'h03;

  localparam logic [7:0] mb4_regs_pkg_SCDATA_STRIDE = 8'h08;
  localparam logic [7:0] mb4_regs_pkg_SCDATA_COUNT = 8'h08;
  localparam logic [7:0] mb4_regs_pkg_RDATA_COUNT = 8'h40;
  localparam logic [7:0] mb4_regs_pkg_SLAVE_CFG_STRIDE = 8'h04;
  localparam logic [7:0] mb4_regs_pkg_SLAVE_CFG_COUNT = 8'h08;
  localparam logic [31:0] mb4_regs_pkg_SLAVES = 32'd8;  
  localparam logic [31:0] mb4_regs_pkg_CHANNELS = 32'd2;  

  

  localparam logic [7:0] mb4_regs_pkg_RESET_SCDATA = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SCDATA = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_SCDATA = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_RDATA = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_RDATA = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_RDATA = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_SLAVE_CFG_LENGTH = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SLAVE_CFG_LENGTH = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_SLAVE_CFG_LENGTH = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_SLAVE_CFG_CRC = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SLAVE_CFG_CRC = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_SLAVE_CFG_CRC = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_SLAVE_CFG_CRCSTART_LO = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SLAVE_CFG_CRCSTART_LO = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_SLAVE_CFG_CRCSTART_LO = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_SLAVE_CFG_CRCSTART_HI = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SLAVE_CFG_CRCSTART_HI = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_SLAVE_CFG_CRCSTART_HI = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_REGADR = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_REGADR = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_REGADR = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_REGNUM = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_REGNUM = 8'h3F;
  localparam logic [7:0] mb4_regs_pkg_CONST_REGNUM = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_CHSEL = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_CHSEL = 8'h03;
  localparam logic [7:0] mb4_regs_pkg_CONST_CHSEL = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_CTRL = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_CTRL = 8'hFB;
  localparam logic [7:0] mb4_regs_pkg_CONST_CTRL = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_FREQ = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_FREQ = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_FREQ = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_BANKCFG = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_BANKCFG = 8'h03;
  localparam logic [7:0] mb4_regs_pkg_CONST_BANKCFG = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_FREQAGS = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_FREQAGS = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_FREQAGS = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_MO_BUSY = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_MO_BUSY = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_MO_BUSY = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_REVISION = 8'h20;
  localparam logic [7:0] mb4_regs_pkg_WMASK_REVISION = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_CONST_REVISION = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_VERSION = 8'h84;
  localparam logic [7:0] mb4_regs_pkg_WMASK_VERSION = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_CONST_VERSION = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_SLAVELOC5 = 8'h01;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SLAVELOC5 = 8'h10;
  localparam logic [7:0] mb4_regs_pkg_CONST_SLAVELOC5 = 8'hEF;
  localparam logic [7:0] mb4_regs_pkg_RESET_CFGCH = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_CFGCH = 8'h0F;
  localparam logic [7:0] mb4_regs_pkg_CONST_CFGCH = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_ACTNSENS = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_ACTNSENS = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_ACTNSENS = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_STATUS0 = 8'hFB;
  localparam logic [7:0] mb4_regs_pkg_WMASK_STATUS0 = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_CONST_STATUS0 = 8'h02;
  localparam logic [7:0] mb4_regs_pkg_RESET_SVALID_LO = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SVALID_LO = 8'hAA;
  localparam logic [7:0] mb4_regs_pkg_CONST_SVALID_LO = 8'h55;
  localparam logic [7:0] mb4_regs_pkg_RESET_SVALID_HI = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SVALID_HI = 8'hAA;
  localparam logic [7:0] mb4_regs_pkg_CONST_SVALID_HI = 8'h55;
  localparam logic [7:0] mb4_regs_pkg_RESET_STATUS3 = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_STATUS3 = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_CONST_STATUS3 = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_INSTR = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_INSTR = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_INSTR = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_IFACE = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_IFACE = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_CONST_IFACE = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_RESET_STATUS8 = 8'h55;
  localparam logic [7:0] mb4_regs_pkg_WMASK_STATUS8 = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_CONST_STATUS8 = 8'hF0;
  localparam logic [7:0] mb4_regs_pkg_RESET_STATUS9 = 8'h55;
  localparam logic [7:0] mb4_regs_pkg_WMASK_STATUS9 = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_CONST_STATUS9 = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_RESET_SWBANKFAIL = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_WMASK_SWBANKFAIL = 8'h00;
  localparam logic [7:0] mb4_regs_pkg_CONST_SWBANKFAIL = 8'h00;

  

  
  localparam logic [7:0] mb4_regs_pkg_RDATA_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_RDATA_STRIDE = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_RDATA_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_RDATA_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_RDATA_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_RDATA_W = 32'd8;
  localparam logic [7:0] mb4_regs_pkg_RDATA_RESET = 8'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_GRAYS_ADDR = 8'hC0;
  localparam logic [31:0] mb4_regs_pkg_GRAYS_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_GRAYS_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_GRAYS_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_GRAYS_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_GRAYS_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_GRAYS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_LSTOP_ADDR = 8'hC0;
  localparam logic [31:0] mb4_regs_pkg_LSTOP_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_LSTOP_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_LSTOP_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_LSTOP_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_LSTOP_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_LSTOP_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_ENSCD_ADDR = 8'hC0;
  localparam logic [31:0] mb4_regs_pkg_ENSCD_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_ENSCD_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_ENSCD_LSB = 32'd6;
  localparam logic [31:0] mb4_regs_pkg_ENSCD_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_ENSCD_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_ENSCD_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SCDLEN_ADDR = 8'hC0;
  localparam logic [31:0] mb4_regs_pkg_SCDLEN_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SCDLEN_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SCDLEN_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCDLEN_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCDLEN_W = 32'd6;
  localparam logic [5:0] mb4_regs_pkg_SCDLEN_RESET = 6'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SELCRCS_ADDR = 8'hC1;
  localparam logic [31:0] mb4_regs_pkg_SELCRCS_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SELCRCS_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SELCRCS_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_SELCRCS_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SELCRCS_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_SELCRCS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SCRCLEN_ADDR = 8'hC1;
  localparam logic [31:0] mb4_regs_pkg_SCRCLEN_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SCRCLEN_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SCRCLEN_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCLEN_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCLEN_W = 32'd7;
  localparam logic [6:0] mb4_regs_pkg_SCRCLEN_RESET = 7'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_SCRCPOLY_ADDR = 8'hC1;
  localparam logic [31:0] mb4_regs_pkg_SCRCPOLY_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SCRCPOLY_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SCRCPOLY_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCPOLY_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCPOLY_W = 32'd7;
  localparam logic [6:0] mb4_regs_pkg_SCRCPOLY_RESET = 7'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SCRCSTART_LO_ADDR = 8'hC2;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_LO_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_LO_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_LO_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_LO_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_LO_W = 32'd8;
  localparam logic [7:0] mb4_regs_pkg_SCRCSTART_LO_RESET = 8'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SCRCSTART_HI_ADDR = 8'hC3;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_HI_STRIDE = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_HI_PER_REG = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_HI_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_HI_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SCRCSTART_HI_W = 32'd8;
  localparam logic [7:0] mb4_regs_pkg_SCRCSTART_HI_RESET = 8'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CFGCH_ADDR = 8'hED;
  localparam logic [31:0] mb4_regs_pkg_CFGCH_STRIDE = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_CFGCH_PER_REG = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_CFGCH_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_CFGCH_LSB_STEP = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_CFGCH_W = 32'd2;
  localparam logic [1:0] mb4_regs_pkg_CFGCH_RESET = 2'd0;

  
  localparam logic [7:0] mb4_regs_pkg_ACTNSENS_ADDR = 8'hEF;
  localparam logic [31:0] mb4_regs_pkg_ACTNSENS_STRIDE = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_ACTNSENS_PER_REG = 32'd8;
  localparam logic [31:0] mb4_regs_pkg_ACTNSENS_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_ACTNSENS_LSB_STEP = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_ACTNSENS_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_ACTNSENS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SVALID_ADDR = 8'hF1;
  localparam logic [31:0] mb4_regs_pkg_SVALID_STRIDE = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SVALID_PER_REG = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SVALID_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_SVALID_LSB_STEP = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_SVALID_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_SVALID_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CDS_ADDR = 8'hF8;
  localparam logic [31:0] mb4_regs_pkg_CDS_STRIDE = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_CDS_PER_REG = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_CDS_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_CDS_LSB_STEP = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_CDS_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_CDS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SL_ADDR = 8'hF8;
  localparam logic [31:0] mb4_regs_pkg_SL_STRIDE = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SL_PER_REG = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_SL_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SL_LSB_STEP = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_SL_W = 32'd1;
  localparam logic [0:0] mb4_regs_pkg_SL_RESET = 1'd1;

  

  
  localparam logic [7:0] mb4_regs_pkg_WNR_ADDR = 8'hE2;
  localparam logic [31:0] mb4_regs_pkg_WNR_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_WNR_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_WNR_MASK = 8'h80;
  localparam logic [0:0] mb4_regs_pkg_WNR_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_REGADR_ADDR = 8'hE2;
  localparam logic [31:0] mb4_regs_pkg_REGADR_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_REGADR_W = 32'd7;
  localparam logic [7:0] mb4_regs_pkg_REGADR_MASK = 8'h7F;
  localparam logic [6:0] mb4_regs_pkg_REGADR_RESET = 7'd0;

  
  localparam logic [7:0] mb4_regs_pkg_REGNUM_ADDR = 8'hE3;
  localparam logic [31:0] mb4_regs_pkg_REGNUM_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_REGNUM_W = 32'd6;
  localparam logic [7:0] mb4_regs_pkg_REGNUM_MASK = 8'h3F;
  localparam logic [5:0] mb4_regs_pkg_REGNUM_RESET = 6'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CHSEL2_ADDR = 8'hE4;
  localparam logic [31:0] mb4_regs_pkg_CHSEL2_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_CHSEL2_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_CHSEL2_MASK = 8'h02;
  localparam logic [0:0] mb4_regs_pkg_CHSEL2_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CHSEL1_ADDR = 8'hE4;
  localparam logic [31:0] mb4_regs_pkg_CHSEL1_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_CHSEL1_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_CHSEL1_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_CHSEL1_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CTS_ADDR = 8'hE5;
  localparam logic [31:0] mb4_regs_pkg_CTS_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_CTS_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_CTS_MASK = 8'h80;
  localparam logic [0:0] mb4_regs_pkg_CTS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_REGVERS_ADDR = 8'hE5;
  localparam logic [31:0] mb4_regs_pkg_REGVERS_LSB = 32'd6;
  localparam logic [31:0] mb4_regs_pkg_REGVERS_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_REGVERS_MASK = 8'h40;
  localparam logic [0:0] mb4_regs_pkg_REGVERS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SLAVEID_ADDR = 8'hE5;
  localparam logic [31:0] mb4_regs_pkg_SLAVEID_LSB = 32'd3;
  localparam logic [31:0] mb4_regs_pkg_SLAVEID_W = 32'd3;
  localparam logic [7:0] mb4_regs_pkg_SLAVEID_MASK = 8'h38;
  localparam logic [2:0] mb4_regs_pkg_SLAVEID_RESET = 3'd0;

  
  localparam logic [7:0] mb4_regs_pkg_EN_MO_ADDR = 8'hE5;
  localparam logic [31:0] mb4_regs_pkg_EN_MO_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_EN_MO_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_EN_MO_MASK = 8'h02;
  localparam logic [0:0] mb4_regs_pkg_EN_MO_RESET = 1'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_HOLDCDM_ADDR = 8'hE5;
  localparam logic [31:0] mb4_regs_pkg_HOLDCDM_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_HOLDCDM_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_HOLDCDM_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_HOLDCDM_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_FREQR_ADDR = 8'hE6;
  localparam logic [31:0] mb4_regs_pkg_FREQR_LSB = 32'd5;
  localparam logic [31:0] mb4_regs_pkg_FREQR_W = 32'd3;
  localparam logic [7:0] mb4_regs_pkg_FREQR_MASK = 8'hE0;
  localparam logic [2:0] mb4_regs_pkg_FREQR_RESET = 3'd0;

  
  localparam logic [7:0] mb4_regs_pkg_FREQS_ADDR = 8'hE6;
  localparam logic [31:0] mb4_regs_pkg_FREQS_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_FREQS_W = 32'd5;
  localparam logic [7:0] mb4_regs_pkg_FREQS_MASK = 8'h1F;
  localparam logic [4:0] mb4_regs_pkg_FREQS_RESET = 5'd0;

  
  localparam logic [7:0] mb4_regs_pkg_NOCRC_ADDR = 8'hE7;
  localparam logic [31:0] mb4_regs_pkg_NOCRC_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_NOCRC_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_NOCRC_MASK = 8'h02;
  localparam logic [0:0] mb4_regs_pkg_NOCRC_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SINGLEBANK_ADDR = 8'hE7;
  localparam logic [31:0] mb4_regs_pkg_SINGLEBANK_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SINGLEBANK_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_SINGLEBANK_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_SINGLEBANK_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_FREQAGS_ADDR = 8'hE8;
  localparam logic [31:0] mb4_regs_pkg_FREQAGS_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_FREQAGS_W = 32'd8;
  localparam logic [7:0] mb4_regs_pkg_FREQAGS_MASK = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_FREQAGS_RESET = 8'd0;

  
  localparam logic [7:0] mb4_regs_pkg_MO_BUSY_ADDR = 8'hE9;
  localparam logic [31:0] mb4_regs_pkg_MO_BUSY_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_MO_BUSY_W = 32'd8;
  localparam logic [7:0] mb4_regs_pkg_MO_BUSY_MASK = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_MO_BUSY_RESET = 8'd0;

  
  localparam logic [7:0] mb4_regs_pkg_REVISION_ADDR = 8'hEA;
  localparam logic [31:0] mb4_regs_pkg_REVISION_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_REVISION_W = 32'd8;
  localparam logic [7:0] mb4_regs_pkg_REVISION_MASK = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_REVISION_RESET = 8'd32;

  
  localparam logic [7:0] mb4_regs_pkg_VERSION_ADDR = 8'hEB;
  localparam logic [31:0] mb4_regs_pkg_VERSION_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_VERSION_W = 32'd8;
  localparam logic [7:0] mb4_regs_pkg_VERSION_MASK = 8'hFF;
  localparam logic [7:0] mb4_regs_pkg_VERSION_RESET = 8'd132;

  
  localparam logic [7:0] mb4_regs_pkg_SLAVELOC5_ADDR = 8'hEC;
  localparam logic [31:0] mb4_regs_pkg_SLAVELOC5_LSB = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_SLAVELOC5_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_SLAVELOC5_MASK = 8'h10;
  localparam logic [0:0] mb4_regs_pkg_SLAVELOC5_RESET = 1'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_NERR_ADDR = 8'hF0;
  localparam logic [31:0] mb4_regs_pkg_NERR_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_NERR_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_NERR_MASK = 8'h80;
  localparam logic [0:0] mb4_regs_pkg_NERR_RESET = 1'd1;

  
  localparam logic [7:0] mb4_regs_pkg_NAGSERR_ADDR = 8'hF0;
  localparam logic [31:0] mb4_regs_pkg_NAGSERR_LSB = 32'd6;
  localparam logic [31:0] mb4_regs_pkg_NAGSERR_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_NAGSERR_MASK = 8'h40;
  localparam logic [0:0] mb4_regs_pkg_NAGSERR_RESET = 1'd1;

  
  localparam logic [7:0] mb4_regs_pkg_NDELAYERR_ADDR = 8'hF0;
  localparam logic [31:0] mb4_regs_pkg_NDELAYERR_LSB = 32'd5;
  localparam logic [31:0] mb4_regs_pkg_NDELAYERR_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_NDELAYERR_MASK = 8'h20;
  localparam logic [0:0] mb4_regs_pkg_NDELAYERR_RESET = 1'd1;

  
  localparam logic [7:0] mb4_regs_pkg_NSCDERR_ADDR = 8'hF0;
  localparam logic [31:0] mb4_regs_pkg_NSCDERR_LSB = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_NSCDERR_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_NSCDERR_MASK = 8'h10;
  localparam logic [0:0] mb4_regs_pkg_NSCDERR_RESET = 1'd1;

  
  localparam logic [7:0] mb4_regs_pkg_NREGERR_ADDR = 8'hF0;
  localparam logic [31:0] mb4_regs_pkg_NREGERR_LSB = 32'd3;
  localparam logic [31:0] mb4_regs_pkg_NREGERR_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_NREGERR_MASK = 8'h08;
  localparam logic [0:0] mb4_regs_pkg_NREGERR_RESET = 1'd1;

  
  localparam logic [7:0] mb4_regs_pkg_REGEND_ADDR = 8'hF0;
  localparam logic [31:0] mb4_regs_pkg_REGEND_LSB = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_REGEND_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_REGEND_MASK = 8'h04;
  localparam logic [0:0] mb4_regs_pkg_REGEND_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_EOT_ADDR = 8'hF0;
  localparam logic [31:0] mb4_regs_pkg_EOT_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_EOT_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_EOT_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_EOT_RESET = 1'd1;

  
  localparam logic [7:0] mb4_regs_pkg_CDMTIMEOUT_ADDR = 8'hF3;
  localparam logic [31:0] mb4_regs_pkg_CDMTIMEOUT_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_CDMTIMEOUT_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_CDMTIMEOUT_MASK = 8'h80;
  localparam logic [0:0] mb4_regs_pkg_CDMTIMEOUT_RESET = 1'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_CDSSEL_ADDR = 8'hF3;
  localparam logic [31:0] mb4_regs_pkg_CDSSEL_LSB = 32'd6;
  localparam logic [31:0] mb4_regs_pkg_CDSSEL_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_CDSSEL_MASK = 8'h40;
  localparam logic [0:0] mb4_regs_pkg_CDSSEL_RESET = 1'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_REGBYTES_ADDR = 8'hF3;
  localparam logic [31:0] mb4_regs_pkg_REGBYTES_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_REGBYTES_W = 32'd6;
  localparam logic [7:0] mb4_regs_pkg_REGBYTES_MASK = 8'h3F;
  localparam logic [5:0] mb4_regs_pkg_REGBYTES_RESET = 6'd0;

  
  localparam logic [7:0] mb4_regs_pkg_BREAK_ADDR = 8'hF4;
  localparam logic [31:0] mb4_regs_pkg_BREAK_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_BREAK_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_BREAK_MASK = 8'h80;
  localparam logic [0:0] mb4_regs_pkg_BREAK_RESET = 1'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_HOLDBANK_ADDR = 8'hF4;
  localparam logic [31:0] mb4_regs_pkg_HOLDBANK_LSB = 32'd6;
  localparam logic [31:0] mb4_regs_pkg_HOLDBANK_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_HOLDBANK_MASK = 8'h40;
  localparam logic [0:0] mb4_regs_pkg_HOLDBANK_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SWBANK_ADDR = 8'hF4;
  localparam logic [31:0] mb4_regs_pkg_SWBANK_LSB = 32'd5;
  localparam logic [31:0] mb4_regs_pkg_SWBANK_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_SWBANK_MASK = 8'h20;
  localparam logic [0:0] mb4_regs_pkg_SWBANK_RESET = 1'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_INIT_ADDR = 8'hF4;
  localparam logic [31:0] mb4_regs_pkg_INIT_LSB = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_INIT_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_INIT_MASK = 8'h10;
  localparam logic [0:0] mb4_regs_pkg_INIT_RESET = 1'd0;

  
  
  localparam logic [7:0] mb4_regs_pkg_INSTR_ADDR = 8'hF4;
  localparam logic [31:0] mb4_regs_pkg_INSTR_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_INSTR_W = 32'd3;
  localparam logic [7:0] mb4_regs_pkg_INSTR_MASK = 8'h0E;
  localparam logic [2:0] mb4_regs_pkg_INSTR_RESET = 3'd0;

  
  localparam logic [7:0] mb4_regs_pkg_AGS_ADDR = 8'hF4;
  localparam logic [31:0] mb4_regs_pkg_AGS_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_AGS_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_AGS_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_AGS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_MAVO_ADDR = 8'hF5;
  localparam logic [31:0] mb4_regs_pkg_MAVO_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_MAVO_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_MAVO_MASK = 8'h80;
  localparam logic [0:0] mb4_regs_pkg_MAVO_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_MAFO_ADDR = 8'hF5;
  localparam logic [31:0] mb4_regs_pkg_MAFO_LSB = 32'd6;
  localparam logic [31:0] mb4_regs_pkg_MAFO_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_MAFO_MASK = 8'h40;
  localparam logic [0:0] mb4_regs_pkg_MAFO_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_MAVS_ADDR = 8'hF5;
  localparam logic [31:0] mb4_regs_pkg_MAVS_LSB = 32'd5;
  localparam logic [31:0] mb4_regs_pkg_MAVS_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_MAVS_MASK = 8'h20;
  localparam logic [0:0] mb4_regs_pkg_MAVS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_MAFS_ADDR = 8'hF5;
  localparam logic [31:0] mb4_regs_pkg_MAFS_LSB = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_MAFS_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_MAFS_MASK = 8'h10;
  localparam logic [0:0] mb4_regs_pkg_MAFS_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CFGIF_ADDR = 8'hF5;
  localparam logic [31:0] mb4_regs_pkg_CFGIF_LSB = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_CFGIF_W = 32'd2;
  localparam logic [7:0] mb4_regs_pkg_CFGIF_MASK = 8'h0C;
  localparam logic [1:0] mb4_regs_pkg_CFGIF_RESET = 2'd0;

  
  localparam logic [7:0] mb4_regs_pkg_ENTEST_ADDR = 8'hF5;
  localparam logic [31:0] mb4_regs_pkg_ENTEST_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_ENTEST_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_ENTEST_MASK = 8'h02;
  localparam logic [0:0] mb4_regs_pkg_ENTEST_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CLKENI_ADDR = 8'hF5;
  localparam logic [31:0] mb4_regs_pkg_CLKENI_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_CLKENI_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_CLKENI_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_CLKENI_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_SWBANKFAIL_ADDR = 8'hFB;
  localparam logic [31:0] mb4_regs_pkg_SWBANKFAIL_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_SWBANKFAIL_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_SWBANKFAIL_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_SWBANKFAIL_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS0_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS0_LSB = 32'd7;
  localparam logic [31:0] mb4_regs_pkg_IDS0_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS0_MASK = 8'h80;
  localparam logic [0:0] mb4_regs_pkg_IDS0_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS1_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS1_LSB = 32'd6;
  localparam logic [31:0] mb4_regs_pkg_IDS1_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS1_MASK = 8'h40;
  localparam logic [0:0] mb4_regs_pkg_IDS1_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS2_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS2_LSB = 32'd5;
  localparam logic [31:0] mb4_regs_pkg_IDS2_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS2_MASK = 8'h20;
  localparam logic [0:0] mb4_regs_pkg_IDS2_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS3_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS3_LSB = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_IDS3_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS3_MASK = 8'h10;
  localparam logic [0:0] mb4_regs_pkg_IDS3_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS4_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS4_LSB = 32'd3;
  localparam logic [31:0] mb4_regs_pkg_IDS4_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS4_MASK = 8'h08;
  localparam logic [0:0] mb4_regs_pkg_IDS4_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS5_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS5_LSB = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_IDS5_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS5_MASK = 8'h04;
  localparam logic [0:0] mb4_regs_pkg_IDS5_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS6_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS6_LSB = 32'd1;
  localparam logic [31:0] mb4_regs_pkg_IDS6_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS6_MASK = 8'h02;
  localparam logic [0:0] mb4_regs_pkg_IDS6_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDS7_ADDR = 8'h80;
  localparam logic [31:0] mb4_regs_pkg_IDS7_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_IDS7_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDS7_MASK = 8'h01;
  localparam logic [0:0] mb4_regs_pkg_IDS7_RESET = 1'd0;

  
  localparam logic [7:0] mb4_regs_pkg_CMD_ADDR = 8'hE5;
  localparam logic [31:0] mb4_regs_pkg_CMD_LSB = 32'd4;
  localparam logic [31:0] mb4_regs_pkg_CMD_W = 32'd2;
  localparam logic [7:0] mb4_regs_pkg_CMD_MASK = 8'h30;
  localparam logic [1:0] mb4_regs_pkg_CMD_RESET = 2'd0;

  
  localparam logic [7:0] mb4_regs_pkg_IDA_TEST_ADDR = 8'hE5;
  localparam logic [31:0] mb4_regs_pkg_IDA_TEST_LSB = 32'd3;
  localparam logic [31:0] mb4_regs_pkg_IDA_TEST_W = 32'd1;
  localparam logic [7:0] mb4_regs_pkg_IDA_TEST_MASK = 8'h08;
  localparam logic [0:0] mb4_regs_pkg_IDA_TEST_RESET = 1'd0;

  
  localparam logic [31:0] mb4_regs_pkg_IDS_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_IDS_W = 32'd8;
  localparam logic [31:0] mb4_regs_pkg_CHSEL_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_CHSEL_W = 32'd2;
  localparam logic [31:0] mb4_regs_pkg_ACTNSENS_ALL_LSB = 32'd0;
  localparam logic [31:0] mb4_regs_pkg_ACTNSENS_ALL_W = 32'd8;

  

  
  localparam logic [0:0] mb4_regs_pkg_SCD_AVAILABLE_NO = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_SCD_AVAILABLE_YES = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_SSI_CODE_BINARY = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_SSI_CODE_GRAY = 1'h1;

  
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_NONE = 7'h0;
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_CRC3 = 7'h3;
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_CRC4 = 7'h4;
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_CRC5 = 7'h5;
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_CRC6 = 7'h6;
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_CRC7 = 7'h7;
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_CRC8 = 7'h8;
  localparam logic [6:0] mb4_regs_pkg_CRC_LENGTH_CRC16 = 7'h10;

  
  localparam logic [0:0] mb4_regs_pkg_CRC_SELECT_BY_LENGTH = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_CRC_SELECT_BY_POLYNOMIAL = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_REGISTER_DIRECTION_READ = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_REGISTER_DIRECTION_WRITE = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_CHANNEL_SELECT_NOT_USED = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_CHANNEL_SELECT_USED = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_CDM_HOLD_RELEASE = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_CDM_HOLD_HOLD = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_MO_OUTPUT_LOW = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_MO_OUTPUT_DATA = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_REGISTER_PROTOCOL_BISS_B = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_REGISTER_PROTOCOL_BISS_C = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_CONTROL_TYPE_COMMAND = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_CONTROL_TYPE_REGISTER_ACCESS = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_BANK_MODE_TWO_BANKS = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_BANK_MODE_ONE_BANK = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_CRC_STORAGE_STORED = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_CRC_STORAGE_DROPPED = 1'h1;

  
  localparam logic [7:0] mb4_regs_pkg_AGS_RATE_AGS_MIN = 8'h7C;
  localparam logic [7:0] mb4_regs_pkg_AGS_RATE_AGS_INFINITE = 8'h7D;

  
  localparam logic [7:0] mb4_regs_pkg_DEVICE_REVISION_Z = 8'h10;
  localparam logic [7:0] mb4_regs_pkg_DEVICE_REVISION_Z1 = 8'h11;
  localparam logic [7:0] mb4_regs_pkg_DEVICE_REVISION_Y = 8'h20;

  
  localparam logic [7:0] mb4_regs_pkg_DEVICE_VERSION_IC_MB3 = 8'h83;
  localparam logic [7:0] mb4_regs_pkg_DEVICE_VERSION_IC_MB4 = 8'h84;

  
  localparam logic [0:0] mb4_regs_pkg_SLAVE_LOCATION_ALL_ON_CHANNEL1 = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_SLAVE_LOCATION_SPLIT = 1'h1;

  
  localparam logic [1:0] mb4_regs_pkg_PROTOCOL_BISS_B = 2'h0;
  localparam logic [1:0] mb4_regs_pkg_PROTOCOL_BISS_C = 2'h1;
  localparam logic [1:0] mb4_regs_pkg_PROTOCOL_SSI = 2'h2;
  localparam logic [1:0] mb4_regs_pkg_PROTOCOL_UNUSED = 2'h3;

  
  localparam logic [0:0] mb4_regs_pkg_SLAVE_KIND_SENSOR = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_SLAVE_KIND_ACTUATOR = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_EOT_ACTIVE = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_EOT_IDLE = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_REGEND_PENDING = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_REGEND_DONE = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_ERROR_FLAG_ERROR = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_ERROR_FLAG_GOOD = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_VALIDITY_INVALID = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_VALIDITY_VALID = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_LEVEL_LOW = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_LEVEL_HIGH = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_CDM_TIMEOUT_NOT_REACHED = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_CDM_TIMEOUT_REACHED = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_AGS_OFF = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_AGS_ON = 1'h1;

  
  localparam logic [2:0] mb4_regs_pkg_INSTR_NONE = 3'h0;
  localparam logic [2:0] mb4_regs_pkg_INSTR_CDM1 = 3'h1;
  localparam logic [2:0] mb4_regs_pkg_INSTR_CDM0 = 3'h2;
  localparam logic [2:0] mb4_regs_pkg_INSTR_CDM_NOT_CDSSEL = 3'h3;
  localparam logic [2:0] mb4_regs_pkg_INSTR_CONTROL = 3'h4;
  localparam logic [2:0] mb4_regs_pkg_INSTR_CONTROL_REDUCED = 3'h7;

  
  localparam logic [0:0] mb4_regs_pkg_INIT_NONE = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_INIT_START = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_BANK_HOLD_PERMITTED = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_BANK_HOLD_PREVENTED = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_BREAK_NONE = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_BREAK_ABORT = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_CLOCK_SOURCE_EXTERNAL = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_CLOCK_SOURCE_INTERNAL = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_FACTORY_TEST_NORMAL = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_FACTORY_TEST_NOT_PERMITTED = 1'h1;

  
  localparam logic [1:0] mb4_regs_pkg_LINE_INTERFACE_TTL = 2'h0;
  localparam logic [1:0] mb4_regs_pkg_LINE_INTERFACE_CMOS = 2'h1;
  localparam logic [1:0] mb4_regs_pkg_LINE_INTERFACE_RS422 = 2'h2;
  localparam logic [1:0] mb4_regs_pkg_LINE_INTERFACE_LVDS = 2'h3;

  
  localparam logic [0:0] mb4_regs_pkg_MA_FORCE_FREE = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_MA_FORCE_FORCED = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_BANK_SWITCH_SWITCHED = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_BANK_SWITCH_FAILED = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_SLAVE_ADDRESSED_NO = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_SLAVE_ADDRESSED_YES = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_LEAD_STOP_WITHOUT = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_LEAD_STOP_WITH = 1'h1;

  
  localparam logic [0:0] mb4_regs_pkg_COMMAND_EXECUTION_IMMEDIATE = 1'h0;
  localparam logic [0:0] mb4_regs_pkg_COMMAND_EXECUTION_TESTED = 1'h1;

  
  localparam logic [7:0] mb4_regs_pkg_SPI_OPCODE_WRITE_REGISTERS = 8'h02;
  localparam logic [7:0] mb4_regs_pkg_SPI_OPCODE_READ_REGISTERS = 8'h03;
  localparam logic [7:0] mb4_regs_pkg_SPI_OPCODE_READ_STATUS = 8'h05;
  localparam logic [7:0] mb4_regs_pkg_SPI_OPCODE_WRITE_INSTRUCTION = 8'h07;
  localparam logic [7:0] mb4_regs_pkg_SPI_OPCODE_READ_REGISTERS0 = 8'h09;
  localparam logic [7:0] mb4_regs_pkg_SPI_OPCODE_WRITE_REGISTERS0 = 8'h0B;


