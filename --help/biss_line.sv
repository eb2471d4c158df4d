


















module biss_line #(
  parameter logic [1:0]  SlCells  = biss_pkg_SL_FLOPS,
  parameter bit          BissB    = 1'b1,
  parameter bit          Ssi      = 1'b1,
  parameter bit          Mo       = 1'b1,  
  parameter bit          FreeCrc  = 1'b1,  
  parameter int Slaves   = 8,     
  parameter int DataBits = 64,    
  parameter int DelayW   = 8      
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,
  
  input  biss_pkg_line_cmd_t    cmd_i,
  input  biss_pkg_line_go_t     go_i,
  input  biss_pkg_line_start_t  start_i,
  input  biss_pkg_register_ma_t register_ma_i,
  output biss_pkg_line_status_t status_o,
  output biss_pkg_line_event_t  event_o,
  output biss_pkg_line_data_t   data_o,
  
  input  logic       tick_i,
  input  logic       half_next_i,
  input  biss_pkg_sample_t sample_i,
  input  logic       sample_half_i,
  
  output logic       ssi_o,        
  input  logic       len_valid_i,
  input  logic [6:0] len_i,
  input  biss_pkg_offer_t rx_offer_i,
  output logic       rx_next_o,
  
  input  logic       mo_bus_i,     
  input  biss_pkg_offer_t mo_offer_i,
  output logic       mo_next_o,
  output biss_pkg_mo_read_t mo_read_o,
  input  logic [7:0] mo_data_i,
  
  output logic       ma_o,
  output logic       mo_o,
  input  logic       sl_i
);

  logic armed_a, armed_b, ack, late, sl, bit_valid, sl_bit;
  logic rise, final_rise, ma_clocks, biss_c;
  logic word_bit, word_load, word_run;
  logic [7:0] quarters;
  biss_pkg_rx_t rx;

  biss_frame #(
    .BissB(BissB), .Ssi(Ssi), .Mo(Mo), .Slaves(Slaves), .DataBits(DataBits)
  ) u_frame (
    .clk_i,
    .rst_ni,
    .por_ni,
    .cmd_i,
    .go_i,
    .start_i,
    .bus_i       (mo_bus_i),
    .register_ma_i,
    .tick_i,
    .half_next_i,
    .armed_a_o   (armed_a),
    .armed_b_o   (armed_b),
    .ack_i       (ack),
    .late_i      (late),
    .sl_i        (sl),
    .bit_valid_i (bit_valid),
    .bit_i       (sl_bit),
    .len_valid_i,
    .len_i,
    .offer_i     (rx_offer_i),
    .word_done_i (rx_next_o),
    .word_load_o (word_load),
    .word_bit_o  (word_bit),
    .word_run_o  (word_run),
    .ssi_o,
    .rise_o      (rise),
    .final_o     (final_rise),
    .clocks_o    (ma_clocks),
    .biss_c_o    (biss_c),
    .status_o,
    .event_o,
    .ma_o
  );

  biss_sl_sampler #(.SlCells(SlCells), .DelayW(DelayW)) u_sampler (
    .clk_i,
    .rst_ni,
    .sl_i,
    .sample_i,
    .sample_half_i,
    .clear_i     (go_i.start),
    .ssi_i       (ssi_o),
    .armed_a_i   (armed_a),
    .armed_b_i   (armed_b),
    .sl_o        (sl),
    .ack_o       (ack),
    .quarters_o  (quarters),
    .late_o      (late),
    .bit_valid_o (bit_valid),
    .bit_o       (sl_bit)
  );

  biss_rx_word #(.DataBits(DataBits), .FreeCrc(FreeCrc)) u_word (
    .clk_i,
    .rst_ni,
    .offer_i     (rx_offer_i),
    .run_i       (word_run),
    .load_i      (word_load),
    .bit_valid_i (word_bit),
    .bit_i       (sl_bit),
    .next_o      (rx_next_o),
    .rx_o        (rx)
  );

  assign data_o = {rx, status_o.cds, event_o.init_done, quarters};

  if (Mo) begin : gen_mo
    biss_mo_tx #(.DataBits(DataBits), .FreeCrc(FreeCrc)) u_mo (
      .clk_i,
      .rst_ni,
      .cmd_i,
      .go_i,
      .begin_i     (go_i.start && start_i.takes_part && !go_i.register_access && !ssi_o),
      .rise_i      (rise),
      .final_i     (final_rise),
      .clocks_i    (ma_clocks),
      .biss_c_i    (biss_c),
      .line_idle_i (status_o.idle),
      .offer_i     (mo_offer_i),
      .next_o      (mo_next_o),
      .read_o      (mo_read_o),
      .data_i      (mo_data_i),
      .mo_o
    );
  end else begin : gen_no_mo
    logic unused;
    assign unused    = ^{mo_offer_i, mo_data_i, rise, final_rise, ma_clocks, biss_c};
    assign mo_next_o = 1'b0;
    assign mo_read_o = '0;
    assign mo_o      = 1'b0;
  end

endmodule
