// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip behind its host interface: registers, control, two lines. Its host side is a byte bus
// with its own clocks, so that any interface fits: mb4_core puts SPI in front of it, mb4_chip puts
// all host interfaces of the 28-pin device in front of it.
//
// Clock domains: wr_clk_i and rd_clk_i (host), rd2_clk_i (second reader, with Port2) and clk_i
// (core). The host can write and read the registers 0xC0..0xFB while the core clock stands still.
// Frames, data memories and instructions need the core clock.
// Latency: a rising edge of wr_clk_i or rd_clk_i samples an access. Read data are valid after this
// edge until the next read.
// Reset: rst_ni is asynchronous. It goes unchanged to the host domain, because the host clocks
// stand still while a reset ends, and synchronised to the core. por_ni resets MA and its time base
// at power-on. With rst_ni alone MA first ends its present level.
//
// Misuse: wr_clk_i and rd_clk_i may be one clock. If they are two clocks, one must stand still
// while the other has edges; otherwise the data of a read are undefined.
// Datasheet: pages 15..36. Crossings: docs/crossings.md.

module mb4_engine #(
  parameter bit Port2 = 1'b0,    // second read port: SCDATA5..8
  parameter logic [1:0] SlCells = mb4_pkg::SL_FLOPS  // SL: flops or DDR cells (mb4_sl_capture)
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       por_ni,      // power-on reset; asserted together with rst_ni
  // host byte bus
  input  logic       wr_clk_i,
  input  logic       wr_en_i,
  input  logic [7:0] wr_addr_i,
  input  logic [7:0] wr_data_i,
  input  logic       rd_clk_i,
  input  logic       rd_en_i,
  input  logic [7:0] rd_addr_i,
  output logic [7:0] rd_data_o,
  // second read port, address in 0x20..0x3F without its upper bits
  input  logic       rd2_clk_i,
  input  logic       rd2_en_i,
  input  logic [4:0] rd2_addr_i,
  output logic [7:0] rd2_data_o,
  // status
  output logic       eot_o,
  output logic       ner_low_o,   // an error flag is set: pull NER low
  input  logic       ner_i,       // level at NER
  output logic       clkeni_o,    // 1 = internal oscillator
  output logic       paired_o,    // CFGIF: line 1 is differential and takes the pins of line 2
  input  logic       getsens_i,
  // lines
  output logic       ma1_o,
  input  logic       sl1_i,
  output logic       mo1_o,
  output logic       ma2_o,
  input  logic       sl2_i,
  output logic       mo2_o,
  // constants
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i
);

  logic       rst_core_n;
  logic       por_core_n;
  logic [mb4_pkg::QUIRKS_W-1:0] quirks_q;

  // registers
  logic [3:0]       cfg_en;       // read ports of the word lists
  logic [11:0]      cfg_slave;
  logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg;
  mb4_pkg::cfg_t    cfg;
  mb4_pkg::instr_t  written;
  mb4_pkg::instr_t  held;
  mb4_pkg::status_t status;
  logic [1:0] instr_count, instr_ack;

  // memories and banks
  logic mem_busy, swbank_pulse, svalid_clear;
  logic bank_pending, bank_swapped, bank_lost, bank_run, frame_done, reduced, bank_end;
  logic       rdata_rd_en, rdata_wr_en, post_busy;
  logic [5:0] rdata_addr;
  logic [7:0] rdata, rdata_wr_data;

  // control
  logic [7:0] half_len, enscd;
  logic       tick;
  logic       start, init, mo_return, abort, keep_time;
  logic       register_start, register_ma, register_end;
  logic [1:0] start_use, register_mo;
  logic [1:0] ma_force, ma_force_level;
  logic       ma_force_change;
  logic [1:0] idle, timeout, sl, frame_end;
  logic [1:0] word_begin, word_open, word_done, word_ok;
  logic [1:0] crc_ok;
  logic [1:0] init_done, init_fail;
  logic [1:0] cds, cds_host, cdm0, cdm1, cdm;

  // words of the two lines: flat vectors with one slice for each line
  logic [1:0]  ssi, line_wr_en;
  logic [5:0]  slave, line_wr_byte;
  logic [15:0] line_wr_data;
  logic [15:0] quarters;
  logic [11:0] mo_addr;
  logic [15:0] mo_data;

  // quirks_i is static. The flops keep it out of the combinational logic behind the pins. This
  // shortens paths and makes the simulation faster.
  always_ff @(posedge clk_i) quirks_q <= quirks_i;

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

  // ---- registers ----------------------------------------------------------------------------

  mb4_reg_file #(.Port2(Port2)) u_regs (
    .clk_i,
    .rst_ni         (rst_core_n),
    .hrst_ni        (rst_ni),
    .hclk_i         (wr_clk_i),
    .wr_en_i,
    .wr_addr_i,
    .wr_data_i,
    .rclk_i         (rd_clk_i),
    .rd_en_i,
    .rd_addr_i,
    .rd_data_o,
    .rd2_clk_i,
    .rd2_en_i,
    .rd2_addr_i,
    .rd2_data_o,
    .enscd_o        (enscd),
    .cfg_en_i       (cfg_en),
    .cfg_slave_i    (cfg_slave),
    .slave_cfg_o    (slave_cfg),
    .cfg_o          (cfg),
    .written_o      (written),
    .count_o        (instr_count),
    .ack_i          (instr_ack),
    .held_i         (held),
    .status_i       (status),
    .revision_sel_i (quirks_i[mb4_pkg::QUIRK_REVISION_LSB +: 2]),
    .mem_busy_o     (mem_busy),
    .holdbank_i     (held.holdbank),
    .swbank_pulse_i (swbank_pulse),
    .bank_run_i     (bank_run),
    .frame_end_i    (frame_done),
    .reduced_i      (reduced),
    .bank_end_i     (bank_end),
    .cds_i          (cds),
    .cds_o          (cds_host),
    .bank_pending_o (bank_pending),
    .bank_swapped_o (bank_swapped),
    .bank_lost_o    (bank_lost),
    .rdata_rd_en_i  (rdata_rd_en),
    .rdata_addr_i   (rdata_addr),
    .rdata_o        (rdata),
    .post_busy_o    (post_busy),
    .rdata_wr_en_i  (rdata_wr_en),
    .rdata_wr_data_i (rdata_wr_data),
    .wr_line_i      (line_wr_en),
    .wr_byte_i      (line_wr_byte),
    .wr_line_data_i (line_wr_data),
    .slave_i        (slave),
    .word_begin_i   (word_begin),
    .word_open_i    (word_open),
    .word_done_i    (word_done),
    .word_ok_i      (crc_ok),
    .word_ok_o      (word_ok),
    .svalid_clear_i (svalid_clear),
    .delay_en_i     (init_done),
    .delay_i        (quarters),
    .mo_rd_en_i     (cfg.en_mo),
    .mo_addr_i      (mo_addr),
    .mo_data_o      (mo_data)
  );

  // ---- control ------------------------------------------------------------------------------

  mb4_control u_control (
    .clk_i,
    .rst_ni         (rst_core_n),
    .written_i      (written),
    .count_i        (instr_count),
    .ack_o          (instr_ack),
    .held_o         (held),
    .cfg_i          (cfg),
    .quirks_i       (quirks_q),
    .getsens_i,
    .eot_o,
    .ner_low_o,
    .mem_busy_i     (mem_busy),
    .bank_pending_i (bank_pending),
    .bank_swapped_i (bank_swapped),
    .bank_lost_i    (bank_lost),
    .bank_run_o     (bank_run),
    .svalid_clear_o (svalid_clear),
    .frame_end_o    (frame_done),
    .bank_end_o     (bank_end),
    .reduced_o      (reduced),
    .swbank_pulse_o (swbank_pulse),
    .rdata_rd_en_o  (rdata_rd_en),
    .rdata_addr_o   (rdata_addr),
    .rdata_i        (rdata),
    .post_busy_i    (post_busy),
    .rdata_wr_en_o  (rdata_wr_en),
    .rdata_wr_data_o (rdata_wr_data),
    .half_len_o     (half_len),
    .ssi_o          (ssi),
    .start_o        (start),
    .use_o          (start_use),
    .init_o         (init),
    .mo_return_o    (mo_return),
    .register_o     (register_start),
    .register_ma_o  (register_ma),
    .register_end_o (register_end),
    .register_mo_o  (register_mo),
    .force_o        (ma_force),
    .force_level_o  (ma_force_level),
    .force_change_o (ma_force_change),
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

  mb4_channels #(.SlCells(SlCells)) u_channels (
    .clk_i,
    .rst_ni         (rst_core_n),
    .por_ni         (por_core_n),
    .enscd_i        (enscd),
    .cfg_en_o       (cfg_en),
    .cfg_slave_o    (cfg_slave),
    .slave_cfg_i    (slave_cfg),
    .cfg_i          (cfg),
    .half_len_i     (half_len),
    .ssi_i          (ssi),
    .start_i        (start),
    .use_i          (start_use),
    .init_i         (init),
    .mo_return_i    (mo_return),
    .register_i     (register_start),
    .register_ma_i  (register_ma),
    .register_end_i (register_end),
    .register_mo_i  (register_mo),
    .force_i        (ma_force),
    .force_level_i  (ma_force_level),
    .force_change_i (ma_force_change),
    .cdm0_i         (cdm0),
    .cdm1_i         (cdm1),
    .reduced_i      (reduced),
    .abort_i        (abort),
    .time_i         (keep_time),
    .tick_o         (tick),
    .slave_o        (slave),
    .mo_addr_o      (mo_addr),
    .mo_data_i      (mo_data),
    .wr_en_o        (line_wr_en),
    .wr_byte_o      (line_wr_byte),
    .wr_data_o      (line_wr_data),
    .word_begin_o   (word_begin),
    .word_open_o    (word_open),
    .word_done_o    (word_done),
    .word_ok_o      (crc_ok),
    .cds_o          (cds),
    .cdm_o          (cdm),
    .frame_end_o    (frame_end),
    .init_done_o    (init_done),
    .init_fail_o    (init_fail),
    .quarters_o     (quarters),
    .idle_o         (idle),
    .timeout_o      (timeout),
    .sl_o           (sl),
    .ma_o           ({ma2_o, ma1_o}),
    .mo_o           ({mo2_o, mo1_o}),
    .sl_i           ({sl2_i, sl1_i})
  );

  // ---- status -------------------------------------------------------------------------------

  assign status.eot         = eot_o;
  assign status.n_err       = ner_i && !ner_low_o;
  assign status.cdssel      = (cfg.chsel == 2'b10) ? cds_host[1] : cds_host[0];
  assign status.cds1        = cds_host[0];
  assign status.cds2        = cds_host[1];
  // With the DDR cell of an iCE40 no other logic can read the pin.
  assign {status.sl2, status.sl1} = SlCells == mb4_pkg::SL_ICE40 ? sl : {sl2_i, sl1_i};
  assign clkeni_o           = cfg.clkeni;
  assign paired_o           = cfg.cfgif[1];

endmodule
