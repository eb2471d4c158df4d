

  
  
  localparam int mb4_pkg_NUM_SLAVES  = 8;
  localparam int mb4_pkg_SLAVE_CFG_W = 32;

  
  typedef struct packed {
    logic [15:0] crc_start;  
    logic [7:0]  crc_poly;   
    logic        gray_lstop; 
    logic        enscd;      
    logic [5:0]  scdlen;     
  } mb4_pkg_slave_cfg_t;

  
  typedef struct packed {
    logic [1:0] chsel;
    logic       wnr;
    logic [6:0] regadr;
    logic [5:0] regnum;
    logic       cts;
    logic       regvers;
    logic [2:0] slaveid;     
  } mb4_pkg_access_t;

  
  typedef struct packed {
    mb4_pkg_access_t    access;
    logic       en_mo;
    logic       holdcdm;
    logic [2:0] freqr;
    logic [4:0] freqs;
    logic       nocrc;
    logic       singlebank;
    logic [7:0] freqags;
    logic [7:0] mo_busy;
    logic       slaveloc5;
    logic [1:0] cfgch2;
    logic [1:0] cfgch1;
    logic [7:0] actnsens;
    logic       mavo;
    logic       mafo;
    logic       mavs;
    logic       mafs;
    logic [1:0] cfgif;
    logic       entest;
    logic       clkeni;
  } mb4_pkg_cfg_t;

  
  typedef struct packed {
    logic       brk;
    logic       holdbank;
    logic       swbank;
    logic       init;
    logic [2:0] instr;
    logic       ags;
  } mb4_pkg_instr_t;

  
  typedef struct packed {
    logic       wr_en;
    logic [7:0] wr_addr;
    logic [7:0] wr_data;
    logic       rd_en;
    logic [7:0] rd_addr;
  } mb4_pkg_host_t;

  
  typedef struct packed {
    logic       en;
    logic [5:0] addr;
    logic [7:0] data;
  } mb4_pkg_mem_wr_t;

  typedef struct packed {
    logic       en;
    logic [5:0] addr;
  } mb4_pkg_mem_rd_t;

  
  typedef struct packed {
    logic [1:0] count;       
    mb4_pkg_instr_t     written;
  } mb4_pkg_instr_host_t;

  
  typedef struct packed {
    logic [1:0] ack;         
    mb4_pkg_instr_t     held;
  } mb4_pkg_instr_core_t;

  
  typedef struct packed {
    logic [1:0] in_use;      
    logic [1:0] ssi;         
    logic [1:0] manual;      
    logic [1:0] select;      
    logic [1:0] frame_use;   
    logic [1:0] init_use;    
    logic       is_frame;    
    logic       is_control;  
    logic       is_register; 
    logic       is_void;     
  } mb4_pkg_kind_t;

  
  typedef struct packed {
    logic       busy;        
    logic       clear;       
    logic       scd_en;      
    logic       scd_bad;
    logic       ags_error;   
    logic       bank_fail;   
  } mb4_pkg_frame_flags_t;

  
  typedef struct packed {
    logic       run;         
    logic       frame_end;   
    logic       data_end;    
    logic       reduced;     
    logic       swap;        
    logic       clear;       
  } mb4_pkg_bank_cmd_t;

  
  typedef struct packed {
    logic       clears;      
    logic       pending;     
  } mb4_pkg_mem_state_t;

  
  typedef struct packed {
    logic       swapped;     
    logic       lost;        
  } mb4_pkg_bank_event_t;

  
  typedef struct packed {
    logic       host;
    logic       eng;
  } mb4_pkg_banks_t;

  
  typedef struct packed {
    mb4_pkg_mem_wr_t    wr;
    mb4_pkg_mem_rd_t    rd;
  } mb4_pkg_rdata_cmd_t;

  
  typedef struct packed {
    logic       due;         
    logic       agsmin;      
    logic       infinite;    
  } mb4_pkg_request_t;

  
  typedef struct packed {
    logic       begins;
    logic       ends;
    logic       reg_error;   
    logic       delay_error; 
  } mb4_pkg_access_event_t;

  
  typedef struct packed {
    logic       cdm_timeout;
    logic [5:0] good_bytes;
  } mb4_pkg_access_state_t;

  
  typedef struct packed {
    logic       n_agserr;
    logic       n_delayerr;
    logic       n_scderr;
    logic       n_regerr;
    logic       regend;
    logic       eot;
    logic       swbank_fail;
    logic       cdm_timeout;
    logic [5:0] regbytes;
  } mb4_pkg_flags_t;

  
  typedef struct packed {
    mb4_pkg_flags_t     flags;
    logic       n_err;
    logic       sl2;
    logic       sl1;
  } mb4_pkg_status_t;

  
  typedef struct packed {
    logic        empty;      
    mb4_pkg_banks_t      banks;
    logic [15:0] svalid;     
    logic [3:0]  cds;        
    logic [15:0] hi;         
    logic [15:0] lo;         
  } mb4_pkg_reg_tap_t;

  
  typedef struct packed {
    logic        empty;      
    mb4_pkg_banks_t      banks;
    logic [15:0] svalid;
    logic [3:0]  cds;
    logic [15:0] hi;
    logic [15:0] lo;
    logic        ready;      
    logic        slaveloc5;
    logic [1:0]  ssi;        
    logic [1:0]  start;      
    logic        stop;       
    logic [1:0]  ma;
    logic [1:0]  wr;         
    logic [1:0]  done;       
    logic [5:0]  slave;      
    logic        frame_end;
    logic        lost;       
    logic [3:0]  good;       
    logic        regend;
    logic        swbank_fail;
  } mb4_pkg_tap_t;

  
  typedef struct packed {
    logic        req;        
    logic        stamp;      
    logic [2:0]  channel;
  } mb4_pkg_page_req_t;

  
  localparam int mb4_pkg_QUIRKS_W                   = 6;
  localparam int mb4_pkg_QUIRK_IDA_TEST_INVERT      = 0;
  localparam int mb4_pkg_QUIRK_AGSERR_ON_INSTR_WR   = 1;
  localparam int mb4_pkg_QUIRK_AGSERR_ON_HOLDBANK   = 2;
  localparam int mb4_pkg_QUIRK_AGS_CLEARED_ON_ERROR = 3;
  localparam int mb4_pkg_QUIRK_REVISION_LSB         = 4;  
  localparam logic [5:0]  mb4_pkg_QUIRKS_DEFAULT             = 6'b000000;

