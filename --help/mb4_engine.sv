




















module mb4_engine #(
  parameter bit Port2 = 1'b0,    
  parameter bit Tap   = 1'b0,    
  parameter logic [1:0] SlCells = biss_pkg_SL_FLOPS  
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,      
  
  input  logic       wr_clk_i,
  input  logic       wr_en_i,
  input  logic [7:0] wr_addr_i,
  input  logic [7:0] wr_data_i,
  input  logic       rd_clk_i,
  input  logic       rd_en_i,
  input  logic [7:0] rd_addr_i,
  output logic [7:0] rd_data_o,
  
  input  logic       rd2_clk_i,
  input  logic       rd2_en_i,
  input  logic [4:0] rd2_addr_i,
  output logic [7:0] rd2_data_o,
  
  output logic       eot_o,
  output logic       ner_low_o,   
  input  logic       ner_i,       
  output logic       clkeni_o,    
  output logic       paired_o,    
  input  logic       getsens_i,
  
  output logic       ma1_o,
  input  logic       sl1_i,
  output logic       mo1_o,
  output logic       ma2_o,
  input  logic       sl2_i,
  output logic       mo2_o,
  
  output mb4_pkg_tap_t tap_o,
  
  input  logic [mb4_pkg_QUIRKS_W-1:0] quirks_i
);

  logic       rst_core_n;
  logic       por_core_n;
  logic [mb4_pkg_QUIRKS_W-1:0] quirks_q;

  
  logic [3:0]       cfg_en;       
  logic [11:0]      cfg_slave;
  logic [4*mb4_pkg_SLAVE_CFG_W-1:0] slave_cfg;
  mb4_pkg_cfg_t    cfg;
  mb4_pkg_instr_host_t instr, instr_seen;
  mb4_pkg_instr_core_t instr_state;
  mb4_pkg_flags_t  flags;
  mb4_pkg_status_t status;

  
  mb4_pkg_bank_cmd_t   bank;
  mb4_pkg_bank_event_t bank_event;
  mb4_pkg_mem_state_t  mem;
  mb4_pkg_rdata_cmd_t  rdata_cmd;
  logic       post_busy;
  logic [7:0] rdata;

  
  logic [7:0]  enscd;
  logic [1:0]  sl_pin, word_bad;
  logic        time_run, time_restart, tick;
  biss_pkg_line_go_t     go;
  biss_pkg_register_ma_t register_ma;
  biss_pkg_line_status_t status1, status2;
  logic [2*biss_pkg_LINE_START_W-1:0]  line_start;
  logic [2*biss_pkg_LINE_CMD_W-1:0]    cmd;
  logic [2*biss_pkg_LINE_STATUS_W-1:0] line_status;
  logic [2*biss_pkg_LINE_EVENT_W-1:0]  line_event;
  logic [2*biss_pkg_LINE_DATA_W-1:0]   line_data;
  logic [2*biss_pkg_MO_READ_W-1:0]     mo_read;
  logic [15:0] mo_data;

  
  mb4_pkg_reg_tap_t      reg_tap;
  biss_pkg_line_data_t   data1, data2;
  logic                   frame_lost, frame_starts;

  
  
  always_ff @(posedge clk_i) quirks_q <= quirks_i;

  enc_reset_sync u_reset (
    .clk_i,
    .rst_ni,
    .rst_sync_no (rst_core_n)
  );

  enc_reset_sync u_por (
    .clk_i,
    .rst_ni      (por_ni),
    .rst_sync_no (por_core_n)
  );

  

  mb4_reg_file #(.Port2(Port2), .Tap(Tap)) u_regs (
    .clk_i,
    .rst_ni         (rst_core_n),
    .hrst_ni        (rst_ni),
    .hclk_i         (wr_clk_i),
    .rclk_i         (rd_clk_i),
    .host_i         ({wr_en_i, wr_addr_i, wr_data_i, rd_en_i, rd_addr_i}),
    .rd_data_o,
    .rd2_clk_i,
    .rd2_i          ({rd2_en_i, 1'b1, rd2_addr_i}),
    .rd2_data_o,
    .enscd_o        (enscd),
    .cfg_en_i       (cfg_en),
    .cfg_slave_i    (cfg_slave),
    .slave_cfg_o    (slave_cfg),
    .cfg_o          (cfg),
    .instr_o        (instr),
    .instr_i        (instr_state),
    .status_i       (status),
    .revision_sel_i (quirks_i[mb4_pkg_QUIRK_REVISION_LSB +: 2]),
    .bank_i         (bank),
    .mem_o          (mem),
    .bank_event_o   (bank_event),
    .rdata_i        (rdata_cmd),
    .rdata_o        (rdata),
    .post_busy_o    (post_busy),
    .data_i         (line_data),
    .word_bad_o     (word_bad),
    .mo_read_i      (mo_read),
    .mo_data_o      (mo_data),
    .tap_o          (reg_tap)
  );

  
  
  if (Tap) begin : gen_late
    logic [5:0] late_q;
    always_ff @(posedge clk_i or negedge rst_core_n) begin
      if (!rst_core_n) late_q <= '0;
      else             late_q <= {late_q[3:0], instr.count};
    end
    assign instr_seen = {late_q[5:4], instr.written};
  end else begin : gen_not_late
    assign instr_seen = instr;
  end

  

  mb4_control u_control (
    .clk_i,
    .rst_ni         (rst_core_n),
    .instr_i        (instr_seen),
    .instr_o        (instr_state),
    .cfg_i          (cfg),
    .quirks_i       (quirks_q),
    .getsens_i,
    .mem_i          (mem),
    .bank_event_i   (bank_event),
    .bank_o         (bank),
    .rdata_o        (rdata_cmd),
    .rdata_i        (rdata),
    .post_busy_i    (post_busy),
    .cmd_o          (cmd),
    .go_o           (go),
    .register_ma_o  (register_ma),
    .start_o        (line_start),
    .time_run_o     (time_run),
    .time_restart_o (time_restart),
    .tick_i         (tick),
    .status_i       (line_status),
    .event_i        (line_event),
    .word_bad_i     (word_bad),
    .flags_o        (flags),
    .ner_low_o,
    .frame_lost_o   (frame_lost)
  );

  

  mb4_lines #(.SlCells(SlCells)) u_lines (
    .clk_i,
    .rst_ni         (rst_core_n),
    .por_ni         (por_core_n),
    .cfg_i          (cfg),
    .enscd_i        (enscd),
    .cfg_en_o       (cfg_en),
    .cfg_slave_o    (cfg_slave),
    .slave_cfg_i    (slave_cfg),
    .cmd_i          (cmd),
    .go_i           (go),
    .register_ma_i  (register_ma),
    .start_i        (line_start),
    .time_run_i     (time_run),
    .time_restart_i (time_restart),
    .tick_o         (tick),
    .status_o       (line_status),
    .event_o        (line_event),
    .data_o         (line_data),
    .mo_read_o      (mo_read),
    .mo_data_i      (mo_data),
    .ma_o           ({ma2_o, ma1_o}),
    .mo_o           ({mo2_o, mo1_o}),
    .sl_i           ({sl2_i, sl1_i})
  );

  

  assign eot_o  = flags.eot;
  
  assign {status2, status1} = line_status;
  assign sl_pin = SlCells == biss_pkg_SL_ICE40 ? {status2.sl, status1.sl} : {sl2_i, sl1_i};
  assign status = {flags, ner_i && !ner_low_o, sl_pin};
  assign {data2, data1} = line_data;
  assign frame_starts   = go.start && !go.init && !go.register_access;
  
  assign tap_o = {reg_tap, !mem.clears, cfg.slaveloc5,
                  cfg.cfgch2 == biss_pkg_SSI, cfg.cfgch1 == biss_pkg_SSI,
                  frame_starts && line_start[2*biss_pkg_LINE_START_W-1],
                  frame_starts && line_start[biss_pkg_LINE_START_W-1], go.stop,
                  ma2_o, ma1_o, data2.rx.wr_en, data1.rx.wr_en, data2.rx.done, data1.rx.done,
                  data2.rx.slave, data1.rx.slave, bank.frame_end, frame_lost,
                  flags.n_agserr, flags.n_delayerr, flags.n_scderr, flags.n_regerr, flags.regend,
                  flags.swbank_fail};

  assign clkeni_o = cfg.clkeni;
  assign paired_o = cfg.cfgif[1];

endmodule
