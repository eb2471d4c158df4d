













module mb4_lines #(
  parameter logic [1:0] SlCells = biss_pkg_SL_FLOPS
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        por_ni,
  
  input  mb4_pkg_cfg_t cfg_i,
  input  logic [7:0]  enscd_i,
  output logic [3:0]  cfg_en_o,    
  output logic [11:0] cfg_slave_o,
  input  logic [4*mb4_pkg_SLAVE_CFG_W-1:0] slave_cfg_i,
  
  input  logic [2*biss_pkg_LINE_CMD_W-1:0] cmd_i,
  input  biss_pkg_line_go_t go_i,
  input  logic [2*biss_pkg_LINE_START_W-1:0] start_i,
  input  biss_pkg_register_ma_t register_ma_i,
  input  logic        time_run_i,     
  input  logic        time_restart_i, 
  output logic        tick_o,
  output logic [2*biss_pkg_LINE_STATUS_W-1:0] status_o,
  output logic [2*biss_pkg_LINE_EVENT_W-1:0]  event_o,
  output logic [2*biss_pkg_LINE_DATA_W-1:0]   data_o,
  
  output logic [2*biss_pkg_MO_READ_W-1:0] mo_read_o,
  input  logic [15:0] mo_data_i,
  
  output logic [1:0]  ma_o,
  output logic [1:0]  mo_o,
  input  logic [1:0]  sl_i
);

  localparam int CFG_W    = mb4_pkg_SLAVE_CFG_W;
  localparam int OFFER_W  = biss_pkg_OFFER_W;
  localparam int START_W  = biss_pkg_LINE_START_W;
  localparam int CMD_W    = biss_pkg_LINE_CMD_W;
  localparam int STATUS_W = biss_pkg_LINE_STATUS_W;
  localparam int EVENT_W  = biss_pkg_LINE_EVENT_W;
  localparam int DATA_W   = biss_pkg_LINE_DATA_W;
  localparam int READ_W   = biss_pkg_MO_READ_W;

  biss_pkg_line_status_t status1, status2;
  biss_pkg_sample_t sample;
  logic [7:0]  half_len;
  logic        half_next, sample_half, idle;
  logic [1:0]  ssi;
  
  logic [3:0]  next, actuator, len_valid;
  logic [27:0] len;
  logic [4*OFFER_W-1:0] offer;
  logic        unused;

  assign {status2, status1} = status_o;
  assign idle = status1.idle && status2.idle;

  mb4_freqs_dec u_freqs (
    .freqs_i    (cfg_i.freqs),
    .half_len_o (half_len)
  );

  
  
  
  biss_timebase u_timebase (
    .clk_i,
    .rst_ni      (por_ni),
    .half_len_i  (half_len),
    .run_i       (!idle || time_run_i),
    .restart_i   (go_i.start || (idle && time_restart_i)),
    .tick_o,
    .half_next_o (half_next),
    .sample_o    (sample),
    .sample_half_o (sample_half)
  );

  for (genvar k = 0; k < 4; k++) begin : gen_list
    localparam int LINE  = k % 2;
    localparam logic [7:0]  UPPER = 8'hF0;   

    mb4_word_list #(.Sum(k >= 2)) u_list (
      .clk_i,
      .rst_ni,
      .enscd_i     (enscd_i & (LINE == 0 ? ~(UPPER & {8{cfg_i.slaveloc5}})
                                          : UPPER & {8{cfg_i.slaveloc5}})),
      .actnsens_i  (cfg_i.actnsens),
      .ssi_i       (ssi[LINE]),
      .nocrc_i     (cfg_i.nocrc),
      .start_i     (go_i.start),
      .next_i      (next[k]),
      .cfg_en_o    (cfg_en_o[k]),
      .cfg_slave_o (cfg_slave_o[k*3 +: 3]),
      .cfg_i       (slave_cfg_i[k*CFG_W +: CFG_W]),
      .actuator_o  (actuator[k]),
      .len_valid_o (len_valid[k]),
      .len_o       (len[k*7 +: 7]),
      .offer_o     (offer[k*OFFER_W +: OFFER_W])
    );
  end

  for (genvar i = 0; i < 2; i++) begin : gen_line
    biss_line #(.SlCells(SlCells)) u_line (
      .clk_i,
      .rst_ni,
      .por_ni,
      .cmd_i       (cmd_i[i*CMD_W +: CMD_W]),
      .go_i,
      .start_i     (start_i[i*START_W +: START_W]),
      .register_ma_i,
      .status_o    (status_o[i*STATUS_W +: STATUS_W]),
      .event_o     (event_o[i*EVENT_W +: EVENT_W]),
      .data_o      (data_o[i*DATA_W +: DATA_W]),
      .tick_i      (tick_o),
      .half_next_i (half_next),
      .sample_i    (sample),
      .sample_half_i (sample_half),
      .ssi_o       (ssi[i]),
      .len_valid_i (len_valid[2 + i]),
      .len_i       (len[(2 + i)*7 +: 7]),
      .rx_offer_i  (offer[i*OFFER_W +: OFFER_W]),
      .rx_next_o   (next[i]),
      .mo_bus_i    (actuator[2 + i] && cfg_i.en_mo),
      .mo_offer_i  (offer[(2 + i)*OFFER_W +: OFFER_W]),
      .mo_next_o   (next[2 + i]),
      .mo_read_o   (mo_read_o[i*READ_W +: READ_W]),
      .mo_data_i   (mo_data_i[i*8 +: 8]),
      .ma_o        (ma_o[i]),
      .mo_o        (mo_o[i]),
      .sl_i        (sl_i[i])
    );
  end

  
  assign unused = ^{actuator[1:0], len_valid[1:0], len[13:0]};

endmodule
