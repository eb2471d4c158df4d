// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The lines with their word lists, and the time base that they share: one frame start, and the
// same phase of MA on both. Each line has one list for the words on SL and one for the words on MO;
// the MO list also counts the bits of the frame. Without MO, and with few enough words, the list
// for SL counts them, and there is no other one.
//
// Clock domain: core. Latency, misuse and datasheet sections: biss_timebase, mb4_word_list and
// biss_line. With SLAVELOC5 = 1 line 2 has the data channels 5..8, otherwise line 1 has all eight.
// Features leaves out a line, data channels and protocols (decision 44). Without line 2 its outputs
// are those of a line that rests: MA is 1 and MO is 0.
// Reset: por_ni is asserted together with rst_ni at power-on. With rst_ni alone, an MA that is low
// stays low to the end of its half period.
// Vectors: bit i of a vector {2, 1} is for line i + 1; wider fields are slices.
// Datasheet: pages 15, 16, 23..26, Tables 10, 17.

module mb4_lines #(
  parameter logic [1:0] SlCells = biss_pkg::SL_FLOPS,
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        por_ni,
  // configuration
  input  mb4_pkg::cfg_t cfg_i,
  input  logic [7:0]  enscd_i,
  output logic [3:0]  cfg_en_o,    // lists {MO 2, MO 1, SL 2, SL 1}
  output logic [11:0] cfg_slave_o,
  input  logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_i,
  // frames
  input  logic [2*biss_pkg::LINE_CMD_W-1:0] cmd_i,
  input  biss_pkg::line_go_t go_i,
  input  logic [2*biss_pkg::LINE_START_W-1:0] start_i,
  input  biss_pkg::register_ma_t register_ma_i,
  input  logic        time_run_i,     // the time base runs between frames too
  input  logic        time_restart_i, // ... and begins a half period, if no frame runs
  output logic        tick_o,
  output logic [2*biss_pkg::LINE_STATUS_W-1:0] status_o,
  output logic [2*biss_pkg::LINE_EVENT_W-1:0]  event_o,
  output logic [2*biss_pkg::LINE_DATA_W-1:0]   data_o,
  // data for MO
  output logic [2*biss_pkg::MO_READ_W-1:0] mo_read_o,
  input  logic [15:0] mo_data_i,
  // pins
  output logic [1:0]  ma_o,
  output logic [1:0]  mo_o,
  input  logic [1:0]  sl_i
);

  localparam int unsigned CFG_W    = mb4_pkg::SLAVE_CFG_W;
  localparam int unsigned OFFER_W  = biss_pkg::OFFER_W;
  localparam int unsigned START_W  = biss_pkg::LINE_START_W;
  localparam int unsigned CMD_W    = biss_pkg::LINE_CMD_W;
  localparam int unsigned STATUS_W = biss_pkg::LINE_STATUS_W;
  localparam int unsigned EVENT_W  = biss_pkg::LINE_EVENT_W;
  localparam int unsigned DATA_W   = biss_pkg::LINE_DATA_W;
  localparam int unsigned READ_W   = biss_pkg::MO_READ_W;

  localparam bit TWO_LINES = Features[mb4_pkg::TWO_LINES_LSB];
  localparam bit SSI       = Features[mb4_pkg::SSI_LSB];
  localparam bit MO        = Features[mb4_pkg::MO_LSB];
  localparam logic [3:0] SLAVES = Features[mb4_pkg::SLAVES_LSB +: 4];
  localparam logic [7:0] PRESENT = mb4_pkg::channels(TWO_LINES, SLAVES);

  // Data channels that line 2 has, and those that line 1 can have.
  localparam logic [7:0] UPPER = 8'hF0;
  localparam logic [7:0] LOWER = (TWO_LINES && !SLAVES[3]) ? ~UPPER : 8'hFF;

  // The walk of a list takes a clock for each word. The first word of SSI begins earlier than that
  // of BiSS.
  localparam bit          ONE_LIST = !MO && (SLAVES == 4'd1 || (!SSI && SLAVES <= 4'd4));
  localparam int unsigned NUM_SLAVES = 32'(SLAVES);
  localparam int unsigned LINES    = TWO_LINES ? 2 : 1;
  localparam int unsigned LISTS    = ONE_LIST ? 2 : 4;
  localparam int unsigned SUM      = ONE_LIST ? 0 : 2;  // list of line 1 that counts the bits

  biss_pkg::line_status_t status1, status2, no_line_status;
  biss_pkg::line_event_t  no_line_event;
  biss_pkg::sample_t sample;
  logic        half_next, sample_half, idle;
  logic [1:0]  ssi;
  // word lists {MO 2, MO 1, SL 2, SL 1}
  logic [3:0]  next, actuator, len_valid;
  logic [1:0]  bus_q;
  logic [27:0] len_last;
  logic [4*OFFER_W-1:0] offer;
  logic        unused;

  assign status1 = status_o[0 +: STATUS_W];
  assign status2 = status_o[STATUS_W +: STATUS_W];
  assign idle = status1.idle && status2.idle;

  // What a line that is left out tells: it is idle, SL is 1, and its part of a frame has ended.
  assign no_line_status.idle     = 1'b1;
  assign no_line_status.timeout  = 1'b0;
  assign no_line_status.cds      = 1'b0;
  assign no_line_status.cdm      = 1'b0;
  assign no_line_status.sl       = 1'b1;
  assign no_line_event.line_end  = 1'b1;
  assign no_line_event.init_done = 1'b0;
  assign no_line_event.init_fail = 1'b0;

  // The time base also runs between frames, for forced levels, which last whole half periods, and
  // for time limits. It restarts when they begin. Only por_ni resets it, so that after a reset a
  // low level of MA ends at its normal time.
  biss_timebase u_timebase (
    .clk_i,
    .rst_ni      (por_ni),
    .last_i      (cfg_i.freqs[3:0]),
    .tens_i      (cfg_i.freqs[4]),
    .run_i       (!idle || time_run_i),
    .restart_i   (go_i.start || (idle && time_restart_i)),
    .tick_o,
    .half_next_o (half_next),
    .sample_o    (sample),
    .sample_half_o (sample_half)
  );

  for (genvar k = 0; k < LISTS; k = k + (3 - LINES)) begin : gen_list
    localparam int unsigned LINE = k % 2;
    localparam logic [7:0]  OWN  = PRESENT & (LINE == 0 ? LOWER : UPPER);

    mb4_word_list #(.Sum(ONE_LIST || k >= 2), .Channels(OWN)) u_list (
      .clk_i,
      .rst_ni,
      .enscd_i     (enscd_i & OWN & (LINE == 0 ? ~(UPPER & {8{cfg_i.slaveloc5}})
                                                : UPPER & {8{cfg_i.slaveloc5}})),
      .actnsens_i  (cfg_i.actnsens),
      .ssi_i       (ssi[LINE]),
      .nocrc_i     (cfg_i.nocrc),
      .idle_i      (idle),
      .start_i     (go_i.start),
      .next_i      (next[k]),
      .cfg_en_o    (cfg_en_o[k]),
      .cfg_slave_o (cfg_slave_o[k*3 +: 3]),
      .cfg_i       (slave_cfg_i[k*CFG_W +: CFG_W]),
      .actuator_o  (actuator[k]),
      .len_valid_o (len_valid[k]),
      .len_last_o  (len_last[k*7 +: 7]),
      .offer_o     (offer[k*OFFER_W +: OFFER_W])
    );
  end

  for (genvar k = 0; k < 4; k++) begin : gen_no_list
    if (k >= LISTS || k % 2 >= LINES) begin : gen_outputs
      assign cfg_en_o[k] = 1'b0;
      assign {cfg_slave_o[k*3 +: 3], actuator[k], len_valid[k], len_last[k*7 +: 7]} = '0;
      assign offer[k*OFFER_W +: OFFER_W] = '0;
    end
  end

  // As the protocol in cmd_i, from one flop.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) bus_q <= '0;
    else         bus_q <= actuator[3:2] & {2{cfg_i.en_mo}};
  end

  for (genvar i = 0; i < LINES; i++) begin : gen_line
    biss_line #(
      .SlCells(SlCells),
      .BissB(Features[mb4_pkg::BISS_B_LSB]),
      .Ssi(SSI),
      .Mo(MO),
      .FreeCrc(Features[mb4_pkg::FREE_CRC_LSB]),
      .Gray(Features[mb4_pkg::GRAY_LSB]),
      .Slaves(NUM_SLAVES)
    ) u_line (
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
      .len_valid_i (len_valid[SUM + i]),
      .len_last_i  (len_last[(SUM + i)*7 +: 7]),
      .rx_offer_i  (offer[i*OFFER_W +: OFFER_W]),
      .rx_next_o   (next[i]),
      .mo_bus_i    (bus_q[i]),
      .mo_offer_i  (offer[(2 + i)*OFFER_W +: OFFER_W]),
      .mo_next_o   (next[2 + i]),
      .mo_read_o   (mo_read_o[i*READ_W +: READ_W]),
      .mo_data_i   (mo_data_i[i*8 +: 8]),
      .ma_o        (ma_o[i]),
      .mo_o        (mo_o[i]),
      .sl_i        (sl_i[i])
    );
  end

  if (!TWO_LINES) begin : gen_one_line
    assign status_o[STATUS_W +: STATUS_W] = no_line_status;
    assign event_o[EVENT_W +: EVENT_W]    = no_line_event;
    assign data_o[DATA_W +: DATA_W]       = '0;
    assign mo_read_o[READ_W +: READ_W]    = '0;
    assign {ssi[1], next[3], next[1]}     = 3'b000;
    assign ma_o[1] = 1'b1;
    assign mo_o[1] = 1'b0;
  end

  // Only one list of each line counts bits. A line that is left out uses none of the rest.
  assign unused = ^{actuator, bus_q, len_valid, len_last, next, ssi, offer, cmd_i, start_i,
                    slave_cfg_i, mo_data_i, sl_i, no_line_status, no_line_event};

endmodule
