// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip without pins: SPI host, registers, control, two lines (instances and glue only). This
// is what an FPGA design instantiates.
//
// Clock domains: sclk_i (host) and clk_i (core). Registers 0xC0..0xFB are written and read with no
// core clock; frames, data memories and instructions need it. rst_ni is asynchronous: it reaches
// the host domain as it is, because SCLK stands still while a reset ends, and the core
// synchronised. por_ni resets MA and its time base at power-on: with rst_ni alone MA ends the level
// that it has. In this version a line takes part in frames if its CFGCH is BiSS C, line 2 only with
// SLAVELOC5 = 1; other protocols, MO and the MA force bits are not there yet.
// Datasheet: pages 15..36. Crossings: docs/crossings.md.

module mb4_core (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,      // power-on reset; asserted together with rst_ni
  // SPI
  input  logic       sclk_i,
  input  logic       cs_ni,
  input  logic       mosi_i,
  output logic       miso_o,
  output logic       miso_oe_o,
  // status
  output logic       eot_o,
  output logic       ner_low_o,   // an error flag is set: pull NER low
  input  logic       ner_i,       // level at NER
  output logic       clkeni_o,    // 1 = internal oscillator
  input  logic       getsens_i,
  // lines
  output logic       ma1_o,
  input  logic       sl1_i,
  output logic       ma2_o,
  input  logic       sl2_i,
  // constants
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i
);

  logic       rst_core_n;
  logic       por_core_n;

  // host byte bus
  logic       wr_en;
  logic [7:0] wr_addr;
  logic [7:0] wr_data;
  logic       rd_en;
  logic [7:0] rd_addr;
  logic [7:0] rd_data;

  // registers
  logic [mb4_pkg::NUM_SLAVES*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg;
  mb4_pkg::cfg_t    cfg;
  mb4_pkg::instr_t  written;
  mb4_pkg::instr_t  held;
  mb4_pkg::status_t status;
  logic       instr_toggle;
  logic       instr_ack;

  // memories and banks
  logic mem_busy;
  logic bank_pending, bank_swapped, frame_done, reduced, bank_end, holdbank;
  logic swbank_pulse;
  logic       rdata_rd_en, rdata_wr_en;
  logic [5:0] rdata_addr;
  logic [7:0] rdata, rdata_wr_data;

  // control
  logic [7:0] half_len;
  logic       tick;
  logic       start, init, abort, keep_time;
  logic [1:0] in_use;
  logic [1:0] idle, timeout, sl;
  logic [1:0] frame_end;
  logic [1:0] word_begin, word_done, word_ok;
  logic [1:0] init_done, init_fail;
  logic [1:0] cds, cds_host, cdm0, cdm1, cdm;

  // words of the two lines; slices of flat vectors, one slice a line
  localparam int unsigned WORD_W = mb4_pkg::WORD_CFG_W;
  logic [1:0]          len_valid;
  logic [13:0]         len;
  logic [1:0]          any_word;
  logic [1:0]          last_word;
  logic [5:0]          slave;
  logic [2*WORD_W-1:0] word;
  logic [15:0]         mine;
  logic [1:0]          line_wr_en;
  logic [5:0]          line_wr_byte;
  logic [15:0]         line_wr_data;
  logic [15:0]         quarters;

  mb4_reset_sync u_reset (
    .clk_i,
    .rst_ni,
    .rst_sync_no (rst_core_n)
  );

  mb4_reset_sync u_por (
    .clk_i,
    .rst_ni      (por_ni),
    .rst_sync_no (por_core_n)
  );

  // ---- host ---------------------------------------------------------------------------------

  mb4_spi u_spi (
    .rst_ni,
    .sclk_i,
    .cs_ni,
    .mosi_i,
    .miso_o,
    .miso_oe_o,
    .wr_en_o   (wr_en),
    .wr_addr_o (wr_addr),
    .wr_data_o (wr_data),
    .rd_en_o   (rd_en),
    .rd_addr_o (rd_addr),
    .rd_data_i (rd_data)
  );

  // ---- registers ----------------------------------------------------------------------------

  mb4_reg_file u_regs (
    .clk_i,
    .rst_ni         (rst_core_n),
    .hclk_i         (sclk_i),
    .hrst_ni        (rst_ni),
    .wr_en_i        (wr_en),
    .wr_addr_i      (wr_addr),
    .wr_data_i      (wr_data),
    .rd_en_i        (rd_en),
    .rd_addr_i      (rd_addr),
    .rd_data_o      (rd_data),
    .slave_cfg_o    (slave_cfg),
    .cfg_o          (cfg),
    .written_o      (written),
    .toggle_o       (instr_toggle),
    .ack_i          (instr_ack),
    .held_i         (held),
    .status_i       (status),
    .revision_sel_i (quirks_i[mb4_pkg::QUIRK_REVISION_LSB +: 2]),
    .mem_busy_o     (mem_busy),
    .holdbank_i     (holdbank),
    .swbank_pulse_i (swbank_pulse),
    .frame_end_i    (frame_done),
    .reduced_i      (reduced),
    .bank_end_i     (bank_end),
    .cds_i          (cds),
    .cds_o          (cds_host),
    .bank_pending_o (bank_pending),
    .bank_swapped_o (bank_swapped),
    .rdata_rd_en_i  (rdata_rd_en),
    .rdata_addr_i   (rdata_addr),
    .rdata_o        (rdata),
    .rdata_wr_en_i  (rdata_wr_en),
    .rdata_wr_data_i (rdata_wr_data),
    .wr_line_i      (line_wr_en),
    .wr_byte_i      (line_wr_byte),
    .wr_line_data_i (line_wr_data),
    .slave_i        (slave),
    .word_begin_i   (word_begin),
    .word_done_i    (word_done),
    .word_ok_i      (word_ok),
    .delay_en_i     (init_done),
    .delay_i        (quarters)
  );

  // ---- control ------------------------------------------------------------------------------

  assign in_use = {cfg.cfgch2 == mb4_regs_pkg::PROTOCOL_BISS_C && cfg.slaveloc5,
                   cfg.cfgch1 == mb4_regs_pkg::PROTOCOL_BISS_C};

  mb4_control u_control (
    .clk_i,
    .rst_ni         (rst_core_n),
    .written_i      (written),
    .toggle_i       (instr_toggle),
    .ack_o          (instr_ack),
    .held_o         (held),
    .cfg_i          (cfg),
    .quirks_i,
    .getsens_i,
    .eot_o,
    .ner_low_o,
    .mem_busy_i     (mem_busy),
    .bank_pending_i (bank_pending),
    .bank_swapped_i (bank_swapped),
    .frame_end_o    (frame_done),
    .bank_end_o     (bank_end),
    .reduced_o      (reduced),
    .holdbank_o     (holdbank),
    .swbank_pulse_o (swbank_pulse),
    .rdata_rd_en_o  (rdata_rd_en),
    .rdata_addr_o   (rdata_addr),
    .rdata_i        (rdata),
    .rdata_wr_en_o  (rdata_wr_en),
    .rdata_wr_data_o (rdata_wr_data),
    .use_i          (in_use),
    .half_len_o     (half_len),
    .start_o        (start),
    .init_o         (init),
    .cdm0_o         (cdm0),
    .cdm1_o         (cdm1),
    .abort_o        (abort),
    .time_o         (keep_time),
    .tick_i         (tick),
    .cds_i          (cds),
    .cdm_i          (cdm),
    .idle_i         (idle),
    .timeout_i      (timeout),
    .sl_i           (sl),
    .line_end_i     (frame_end),
    .word_done_i    (word_done),
    .word_ok_i      (word_ok),
    .init_done_i    (init_done),
    .init_fail_i    (init_fail),
    .n_scderr_o     (status.n_scderr),
    .n_agserr_o     (status.n_agserr),
    .n_regerr_o     (status.n_regerr),
    .n_delayerr_o   (status.n_delayerr),
    .regend_o       (status.regend),
    .regbytes_o     (status.regbytes),
    .swbank_fail_o  (status.swbank_fail),
    .cdm_timeout_o  (status.cdm_timeout)
  );

  // ---- lines --------------------------------------------------------------------------------

  assign mine = cfg.slaveloc5 ? 16'hF00F : 16'h00FF;

  for (genvar i = 0; i < 2; i++) begin : gen_line
    mb4_word_list u_words (
      .clk_i,
      .rst_ni      (rst_core_n),
      .slave_cfg_i (slave_cfg),
      .mine_i      (mine[i*8 +: 8]),
      .nocrc_i     (cfg.nocrc),
      .start_i     (start),
      .next_i      (word_done[i]),
      .len_valid_o (len_valid[i]),
      .len_o       (len[i*7 +: 7]),
      .any_o       (any_word[i]),
      .last_o      (last_word[i]),
      .slave_o     (slave[i*3 +: 3]),
      .word_o      (word[i*WORD_W +: WORD_W])
    );
  end

  mb4_lines u_lines (
    .clk_i,
    .rst_ni       (rst_core_n),
    .por_ni       (por_core_n),
    .half_len_i   (half_len),
    .start_i      (start),
    .use_i        (in_use),
    .init_i       (init),
    .cdm0_i       (cdm0),
    .cdm1_i       (cdm1),
    .reduced_i    (reduced),
    .hold_cdm_i   (cfg.holdcdm),
    .abort_i      (abort),
    .time_i       (keep_time),
    .tick_o       (tick),
    .len_valid_i  (len_valid),
    .len_i        (len),
    .any_word_i   (any_word),
    .last_word_i  (last_word),
    .word_i       (word),
    .wr_en_o      (line_wr_en),
    .wr_byte_o    (line_wr_byte),
    .wr_data_o    (line_wr_data),
    .word_begin_o (word_begin),
    .word_done_o  (word_done),
    .word_ok_o    (word_ok),
    .cds_o        (cds),
    .cdm_o        (cdm),
    .frame_end_o  (frame_end),
    .init_done_o  (init_done),
    .init_fail_o  (init_fail),
    .quarters_o   (quarters),
    .idle_o       (idle),
    .timeout_o    (timeout),
    .sl_o         (sl),
    .ma_o         ({ma2_o, ma1_o}),
    .sl_i         ({sl2_i, sl1_i})
  );

  // ---- status -------------------------------------------------------------------------------

  assign status.eot         = eot_o;
  assign status.n_err       = ner_i && !ner_low_o;
  assign status.cdssel      = (cfg.chsel == 2'b10) ? cds_host[1] : cds_host[0];
  assign status.cds1        = cds_host[0];
  assign status.cds2        = cds_host[1];
  assign status.sl1         = sl1_i;
  assign status.sl2         = sl2_i;
  assign clkeni_o           = cfg.clkeni;

endmodule
