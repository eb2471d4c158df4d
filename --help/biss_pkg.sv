

  
  typedef logic [1:0] biss_pkg_protocol_e; localparam logic [1:0] biss_pkg_BISS_B = 2'd0, biss_pkg_BISS_C = 2'd1, biss_pkg_SSI    = 2'd2, biss_pkg_UNUSED = 2'd3;

  
  localparam logic [1:0] biss_pkg_SL_FLOPS   = 2'd0;
  localparam logic [1:0] biss_pkg_SL_ICE40   = 2'd1;
  localparam logic [1:0] biss_pkg_SL_ECP5    = 2'd2;
  localparam logic [1:0] biss_pkg_SL_XILINX7 = 2'd3;

  
  typedef struct packed {
    logic [5:0]  data_last;  
    logic        crc_on;
    logic [3:0]  crc_last;   
    logic [7:0]  crc_poly;   
    logic [7:0]  crc_top;    
    logic [15:0] crc_start;
    logic        crc_store;  
    logic        gray;       
    logic        actuator;   
    logic        stop;       
  } biss_pkg_word_t;

  
  typedef struct packed {
    logic        any;        
    logic        last;       
    logic [2:0]  slave;      
    biss_pkg_word_t       word;
  } biss_pkg_offer_t;

  
  typedef struct packed {
    biss_pkg_protocol_e   protocol;
    logic        mo_en;      
    logic [7:0]  mo_busy;    
    logic        hold_cdm;   
    logic        forced;     
    logic        force_level;
    logic        mo_low;     
  } biss_pkg_line_cmd_t;

  
  typedef struct packed {
    logic        start;      
    logic        init;       
    logic        register_access; 
    logic        reduced;    
    logic        mo_return;  
    logic        stop;       
  } biss_pkg_line_go_t;

  
  typedef struct packed {
    logic        takes_part;
    logic        cdm0;       
    logic        cdm1;       
  } biss_pkg_line_start_t;

  
  typedef struct packed {
    logic        level;      
    logic        ends;       
  } biss_pkg_register_ma_t;

  
  typedef struct packed {
    logic        a;          
    logic        b;          
    logic        b_neg;      
  } biss_pkg_sample_t;

  
  typedef struct packed {
    logic        rd_en;
    logic [2:0]  slave;
    logic [2:0]  place;      
  } biss_pkg_mo_read_t;

  
  typedef struct packed {
    logic        idle;       
    logic        timeout;    
    logic        cds;        
    logic        cdm;        
    logic        sl;         
  } biss_pkg_line_status_t;

  
  typedef struct packed {
    logic        frame_end;  
    logic        init_done;  
    logic        init_fail;  
  } biss_pkg_line_event_t;

  
  typedef struct packed {
    logic [2:0]  slave;      
    logic        wr_en;      
    logic [2:0]  wr_byte;    
    logic [7:0]  wr_data;
    logic        first;      
    logic        open;       
    logic        done;       
    logic        ok;         
  } biss_pkg_rx_t;

  
  typedef struct packed {
    biss_pkg_rx_t         rx;
    logic        cds;        
    logic        delay_en;   
    logic [7:0]  delay;      
  } biss_pkg_line_data_t;

  
  typedef struct packed {
    logic        cts;        
    logic        wnr;        
    logic [6:0]  regadr;
    logic [5:0]  regnum;     
    logic [2:0]  slaveid;    
  } biss_pkg_access_t;

  
  typedef struct packed {
    logic        wr_en;
    logic [5:0]  addr;
    logic [7:0]  wr_data;
  } biss_pkg_access_byte_t;

  
  typedef struct packed {
    logic        ends;
    logic        reg_error;   
    logic        delay_error; 
    logic [5:0]  good_bytes;
  } biss_pkg_access_end_t;

  
  
  
  localparam logic [5:0] biss_pkg_SLOT_START        = 6'd0;
  localparam logic [5:0] biss_pkg_SLOT_CTS          = 6'd1;
  localparam logic [5:0] biss_pkg_SLOT_HEADER       = 6'd1;   
  localparam logic [5:0] biss_pkg_SLOT_CRC          = 6'd12;
  localparam logic [5:0] biss_pkg_SLOT_READ         = 6'd16;  
  localparam logic [5:0] biss_pkg_SLOT_WRITE        = 6'd17;  
  localparam logic [5:0] biss_pkg_SLOT_BYTE         = 6'd18;  
  localparam logic [5:0] biss_pkg_SLOT_WAIT         = 6'd19;  
  localparam logic [5:0] biss_pkg_SLOT_DATA_CRC     = 6'd27;
  localparam logic [5:0] biss_pkg_SLOT_STOP         = 6'd31;
  localparam logic [5:0] biss_pkg_SLOT_NEXT         = 6'd32;  
  localparam logic [5:0] biss_pkg_SLOT_IDA          = 6'd17;  
  localparam logic [5:0] biss_pkg_SLOT_STOP_COMMAND = 6'd17;
  localparam logic [5:0] biss_pkg_SLOT_EX_TESTED    = 6'd24;  
  localparam logic [5:0] biss_pkg_SLOT_STOP_TESTED  = 6'd25;

  
  localparam logic [3:0] biss_pkg_CONTROL_CRC_POLY = 4'h3;

  
  localparam int biss_pkg_WORD_W        = 47;
  localparam int biss_pkg_OFFER_W       = 52;
  localparam int biss_pkg_LINE_CMD_W    = 15;
  localparam int biss_pkg_LINE_START_W  = 3;
  localparam int biss_pkg_LINE_STATUS_W = 5;
  localparam int biss_pkg_LINE_EVENT_W  = 3;
  localparam int biss_pkg_LINE_DATA_W   = 29;
  localparam int biss_pkg_MO_READ_W     = 7;

