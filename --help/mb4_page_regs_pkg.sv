

  

  localparam logic [11:0] mb4_page_regs_pkg_ADDR_ID = 12'h100;
  localparam logic [11:0] mb4_page_regs_pkg_ADDR_VERSION = 12'h104;
  localparam logic [11:0] mb4_page_regs_pkg_ADDR_FEATURES = 12'h108;
  localparam logic [11:0] mb4_page_regs_pkg_ADDR_IRQ_STATUS = 12'h10C;
  localparam logic [11:0] mb4_page_regs_pkg_ADDR_IRQ_ENABLE = 12'h110;
  localparam logic [11:0] mb4_page_regs_pkg_ADDR_TIME_LOW = 12'h114;
  localparam logic [11:0] mb4_page_regs_pkg_ADDR_TIME_HIGH = 12'h118;
  localparam logic [11:0] mb4_page_regs_pkg_ADDR_SNAPSHOT = 12'h120;
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_LOW_OFFSET = 12'h000;
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_HIGH_OFFSET = 12'h004;
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_FLAGS_OFFSET = 12'h008;
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_FRAME_OFFSET = 12'h00C;
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_TIME_LOW_OFFSET = 12'h010;
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_TIME_HIGH_OFFSET = 12'h014;

  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_STRIDE = 12'h018;
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_COUNT = 12'h008;
  localparam logic [31:0] mb4_page_regs_pkg_NUM_SNAPSHOTS = 32'd8;  

  

  localparam logic [31:0] mb4_page_regs_pkg_RESET_ID = 32'h454E4301;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_ID = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_ID = 32'hFFFFFFFF;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_VERSION = 32'h00010000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_VERSION = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_VERSION = 32'hFFFFFFFF;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_FEATURES = 32'h000083FF;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_FEATURES = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_FEATURES = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_IRQ_STATUS = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_IRQ_STATUS = 32'h0000001F;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_IRQ_STATUS = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_IRQ_ENABLE = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_IRQ_ENABLE = 32'h0000001F;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_IRQ_ENABLE = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_TIME_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_TIME_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_TIME_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_TIME_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_TIME_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_TIME_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_SNAPSHOT_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_SNAPSHOT_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_SNAPSHOT_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_SNAPSHOT_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_SNAPSHOT_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_SNAPSHOT_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_SNAPSHOT_FLAGS = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_SNAPSHOT_FLAGS = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_SNAPSHOT_FLAGS = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_SNAPSHOT_FRAME = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_SNAPSHOT_FRAME = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_SNAPSHOT_FRAME = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_SNAPSHOT_TIME_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_SNAPSHOT_TIME_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_SNAPSHOT_TIME_LOW = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_RESET_SNAPSHOT_TIME_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_WMASK_SNAPSHOT_TIME_HIGH = 32'h00000000;
  localparam logic [31:0] mb4_page_regs_pkg_CONST_SNAPSHOT_TIME_HIGH = 32'h00000000;

  

  
  localparam logic [11:0] mb4_page_regs_pkg_DATA_LOW_ADDR = 12'h120;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_LOW_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_LOW_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_LOW_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_LOW_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_LOW_W = 32'd32;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_LOW_RESET = 32'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_DATA_HIGH_ADDR = 12'h124;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_HIGH_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_HIGH_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_HIGH_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_HIGH_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_HIGH_W = 32'd32;
  localparam logic [31:0] mb4_page_regs_pkg_DATA_HIGH_RESET = 32'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_BANK_FAIL_ADDR = 12'h128;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_BANK_FAIL_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_BANK_FAIL_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_BANK_FAIL_LSB = 32'd2;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_BANK_FAIL_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_BANK_FAIL_W = 32'd1;
  localparam logic [0:0] mb4_page_regs_pkg_SNAPSHOT_BANK_FAIL_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_CDS_ADDR = 12'h128;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_CDS_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_CDS_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_CDS_LSB = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_CDS_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_CDS_W = 32'd1;
  localparam logic [0:0] mb4_page_regs_pkg_SNAPSHOT_CDS_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_SNAPSHOT_VALID_ADDR = 12'h128;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_VALID_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_VALID_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_VALID_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_VALID_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_SNAPSHOT_VALID_W = 32'd1;
  localparam logic [0:0] mb4_page_regs_pkg_SNAPSHOT_VALID_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_FRAME_NUMBER_ADDR = 12'h12C;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_NUMBER_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_NUMBER_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_NUMBER_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_NUMBER_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_NUMBER_W = 32'd32;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_NUMBER_RESET = 32'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_FRAME_TIME_LOW_ADDR = 12'h130;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_LOW_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_LOW_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_LOW_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_LOW_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_LOW_W = 32'd32;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_LOW_RESET = 32'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_FRAME_TIME_HIGH_ADDR = 12'h134;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_HIGH_STRIDE = 32'd24;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_HIGH_PER_REG = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_HIGH_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_HIGH_LSB_STEP = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_HIGH_W = 32'd32;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_TIME_HIGH_RESET = 32'd0;

  

  
  localparam logic [11:0] mb4_page_regs_pkg_SLAVES_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_SLAVES_LSB = 32'd12;
  localparam logic [31:0] mb4_page_regs_pkg_SLAVES_W = 32'd4;
  localparam logic [31:0] mb4_page_regs_pkg_SLAVES_MASK = 32'h0000F000;
  localparam logic [3:0] mb4_page_regs_pkg_SLAVES_RESET = 4'd8;

  
  localparam logic [11:0] mb4_page_regs_pkg_TWO_BANKS_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_TWO_BANKS_LSB = 32'd9;
  localparam logic [31:0] mb4_page_regs_pkg_TWO_BANKS_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_TWO_BANKS_MASK = 32'h00000200;
  localparam logic [0:0] mb4_page_regs_pkg_TWO_BANKS_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_FORCE_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_FORCE_LSB = 32'd8;
  localparam logic [31:0] mb4_page_regs_pkg_FORCE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_FORCE_MASK = 32'h00000100;
  localparam logic [0:0] mb4_page_regs_pkg_FORCE_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_GRAY_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_GRAY_LSB = 32'd7;
  localparam logic [31:0] mb4_page_regs_pkg_GRAY_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_GRAY_MASK = 32'h00000080;
  localparam logic [0:0] mb4_page_regs_pkg_GRAY_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_TWO_LINES_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_TWO_LINES_LSB = 32'd6;
  localparam logic [31:0] mb4_page_regs_pkg_TWO_LINES_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_TWO_LINES_MASK = 32'h00000040;
  localparam logic [0:0] mb4_page_regs_pkg_TWO_LINES_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_BISS_B_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_BISS_B_LSB = 32'd5;
  localparam logic [31:0] mb4_page_regs_pkg_BISS_B_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_BISS_B_MASK = 32'h00000020;
  localparam logic [0:0] mb4_page_regs_pkg_BISS_B_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_SSI_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_SSI_LSB = 32'd4;
  localparam logic [31:0] mb4_page_regs_pkg_SSI_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SSI_MASK = 32'h00000010;
  localparam logic [0:0] mb4_page_regs_pkg_SSI_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_MO_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_MO_LSB = 32'd3;
  localparam logic [31:0] mb4_page_regs_pkg_MO_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_MO_MASK = 32'h00000008;
  localparam logic [0:0] mb4_page_regs_pkg_MO_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_CONTROL_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_CONTROL_LSB = 32'd2;
  localparam logic [31:0] mb4_page_regs_pkg_CONTROL_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_CONTROL_MASK = 32'h00000004;
  localparam logic [0:0] mb4_page_regs_pkg_CONTROL_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_SLAVES_ON_LINE_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_SLAVES_ON_LINE_LSB = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SLAVES_ON_LINE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SLAVES_ON_LINE_MASK = 32'h00000002;
  localparam logic [0:0] mb4_page_regs_pkg_SLAVES_ON_LINE_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_FREE_CRC_ADDR = 12'h108;
  localparam logic [31:0] mb4_page_regs_pkg_FREE_CRC_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FREE_CRC_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_FREE_CRC_MASK = 32'h00000001;
  localparam logic [0:0] mb4_page_regs_pkg_FREE_CRC_RESET = 1'd1;

  
  localparam logic [11:0] mb4_page_regs_pkg_LOST_ADDR = 12'h10C;
  localparam logic [31:0] mb4_page_regs_pkg_LOST_LSB = 32'd4;
  localparam logic [31:0] mb4_page_regs_pkg_LOST_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_LOST_MASK = 32'h00000010;
  localparam logic [0:0] mb4_page_regs_pkg_LOST_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_SENSE_ADDR = 12'h10C;
  localparam logic [31:0] mb4_page_regs_pkg_SENSE_LSB = 32'd3;
  localparam logic [31:0] mb4_page_regs_pkg_SENSE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SENSE_MASK = 32'h00000008;
  localparam logic [0:0] mb4_page_regs_pkg_SENSE_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_REGISTER_END_ADDR = 12'h10C;
  localparam logic [31:0] mb4_page_regs_pkg_REGISTER_END_LSB = 32'd2;
  localparam logic [31:0] mb4_page_regs_pkg_REGISTER_END_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_REGISTER_END_MASK = 32'h00000004;
  localparam logic [0:0] mb4_page_regs_pkg_REGISTER_END_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_ERROR_ADDR = 12'h10C;
  localparam logic [31:0] mb4_page_regs_pkg_ERROR_LSB = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_ERROR_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_ERROR_MASK = 32'h00000002;
  localparam logic [0:0] mb4_page_regs_pkg_ERROR_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_FRAME_ADDR = 12'h10C;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_MASK = 32'h00000001;
  localparam logic [0:0] mb4_page_regs_pkg_FRAME_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_LOST_ENABLE_ADDR = 12'h110;
  localparam logic [31:0] mb4_page_regs_pkg_LOST_ENABLE_LSB = 32'd4;
  localparam logic [31:0] mb4_page_regs_pkg_LOST_ENABLE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_LOST_ENABLE_MASK = 32'h00000010;
  localparam logic [0:0] mb4_page_regs_pkg_LOST_ENABLE_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_SENSE_ENABLE_ADDR = 12'h110;
  localparam logic [31:0] mb4_page_regs_pkg_SENSE_ENABLE_LSB = 32'd3;
  localparam logic [31:0] mb4_page_regs_pkg_SENSE_ENABLE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_SENSE_ENABLE_MASK = 32'h00000008;
  localparam logic [0:0] mb4_page_regs_pkg_SENSE_ENABLE_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_REGISTER_END_ENABLE_ADDR = 12'h110;
  localparam logic [31:0] mb4_page_regs_pkg_REGISTER_END_ENABLE_LSB = 32'd2;
  localparam logic [31:0] mb4_page_regs_pkg_REGISTER_END_ENABLE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_REGISTER_END_ENABLE_MASK = 32'h00000004;
  localparam logic [0:0] mb4_page_regs_pkg_REGISTER_END_ENABLE_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_ERROR_ENABLE_ADDR = 12'h110;
  localparam logic [31:0] mb4_page_regs_pkg_ERROR_ENABLE_LSB = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_ERROR_ENABLE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_ERROR_ENABLE_MASK = 32'h00000002;
  localparam logic [0:0] mb4_page_regs_pkg_ERROR_ENABLE_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_FRAME_ENABLE_ADDR = 12'h110;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_ENABLE_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_ENABLE_W = 32'd1;
  localparam logic [31:0] mb4_page_regs_pkg_FRAME_ENABLE_MASK = 32'h00000001;
  localparam logic [0:0] mb4_page_regs_pkg_FRAME_ENABLE_RESET = 1'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_TIME_LOW_ADDR = 12'h114;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_LOW_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_LOW_W = 32'd32;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_LOW_MASK = 32'hFFFFFFFF;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_LOW_RESET = 32'd0;

  
  localparam logic [11:0] mb4_page_regs_pkg_TIME_HIGH_ADDR = 12'h118;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_HIGH_LSB = 32'd0;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_HIGH_W = 32'd32;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_HIGH_MASK = 32'hFFFFFFFF;
  localparam logic [31:0] mb4_page_regs_pkg_TIME_HIGH_RESET = 32'd0;


