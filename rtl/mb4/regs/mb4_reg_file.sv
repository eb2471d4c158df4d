// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that has an address: configuration, instruction register, data memories with their
// banks, validity flags, and the read side. The file connects these modules and decodes the
// addresses of posted writes; it has no flops of its own.
//
// Clock domains: host (hclk_i writes, rclk_i reads) and core (clk_i). hclk_i and rclk_i are one
// clock, or two strobes of which one rests while the other has edges. SCDATA, RDATA and SVALID are
// in the core domain: host writes to them are posted and wait for a running core clock. All other
// registers work without it. With Port2 there is one more read port for SCDATA5..8 with its own
// clock (rd2_clk_i).
// Vectors: bit i of a vector {2, 1} is for line i + 1.
// Datasheet: pages 21..36. Crossings: docs/crossings.md.

module mb4_reg_file #(
  parameter bit Port2 = 1'b0
) (
  input  logic       clk_i,
  input  logic       rst_ni,          // core domain
  input  logic       hrst_ni,         // host domain
  // host byte bus, sampled at the rising edge of hclk_i and rclk_i
  input  logic       hclk_i,
  input  logic       wr_en_i,
  input  logic [7:0] wr_addr_i,
  input  logic [7:0] wr_data_i,
  input  logic       rclk_i,
  input  logic       rd_en_i,
  input  logic [7:0] rd_addr_i,
  output logic [7:0] rd_data_o,
  // second read port
  input  logic       rd2_clk_i,
  input  logic       rd2_en_i,
  input  logic [4:0] rd2_addr_i,
  output logic [7:0] rd2_data_o,
  // configuration, host domain, quasi-static
  output mb4_pkg::cfg_t    cfg_o,
  output logic [7:0]       enscd_o,
  // data channels' configuration, read by four word lists in the core clock
  input  logic [3:0]       cfg_en_i,
  input  logic [11:0]      cfg_slave_i,
  output logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_o,
  // instruction register
  output mb4_pkg::instr_t  written_o,
  output logic [1:0]       count_o,
  input  logic [1:0]       ack_i,
  input  mb4_pkg::instr_t  held_i,
  // status, core domain, without SVALID and CDS
  input  mb4_pkg::status_t status_i,
  input  logic [1:0]       revision_sel_i,
  // memories and banks
  output logic       mem_busy_o,
  input  logic       holdbank_i,
  input  mb4_pkg::bank_cmd_t bank_i,
  output logic       bank_pending_o,
  output logic       bank_swapped_o,
  output logic       bank_lost_o,
  // control communication
  input  mb4_pkg::rdata_cmd_t rdata_i,
  output logic [7:0] rdata_o,
  output logic       post_busy_o,    // bytes from the host are on their way to the memories
  // received bytes and words of lines {2, 1}
  input  logic [2*biss_pkg::LINE_DATA_W-1:0] data_i,
  output logic [1:0]  word_ok_o,       // CRC is good and all of the word is in one bank
  input  logic        svalid_clear_i,  // INIT of BiSS C begins
  // actuator data for MO of lines {2, 1}
  input  logic        mo_rd_en_i,
  input  logic [11:0] mo_addr_i,
  output logic [15:0] mo_data_o
);

  logic [7:0]  cfg_data;
  logic [7:0]  slave_data;
  logic [7:0]  instr_data;
  logic        instr_pending, control_pending;
  logic        clear_busy;
  logic [5:0]  clear_addr;
  logic        post_wr;
  logic        post_valid, post_ready;
  logic [15:0] post_data;
  logic        post_empty, mark, marked, recent_hit;
  logic [7:0]  recent_data;
  logic        post_rdata, ready_scd, ready_rdata;
  logic [7:0]  rdata_data;
  logic [15:0] scd_lo_data, scd_hi_data, scd2_data, svalid;
  logic [3:0]  cds;
  logic        host_bank, eng_bank;   // core domain
  logic        base, newest;          // core domain: bases of banks (mb4_bank_ctrl)
  logic        bank_seen, base_kept;  // host domain: bank it has, base it keeps
  logic [1:0]  word_split;
  biss_pkg::line_data_t data1, data2;

  assign {data2, data1} = data_i;

  // ---- registers ----------------------------------------------------------------------------

  mb4_cfg_regs u_cfg (
    .hclk_i,
    .rst_ni (hrst_ni),
    .wr_en_i,
    .wr_addr_i,
    .wr_data_i,
    .rd_addr_i,
    .rd_data_o   (cfg_data),
    .cfg_o
  );

  mb4_slave_cfg u_slave_cfg (
    .hclk_i,
    .rst_ni       (hrst_ni),
    .wr_en_i      (wr_en_i && wr_addr_i[7:5] == mb4_regs_pkg::ADDR_SLAVE_CFG[7:5]),
    .wr_addr_i    (wr_addr_i[4:0]),
    .wr_data_i,
    .rclk_i,
    .rd_en_i,
    .rd_addr_i    (rd_addr_i[4:0]),
    .rd_data_o    (slave_data),
    .clk_i,
    .enscd_o,
    .list_en_i    (cfg_en_i),
    .list_slave_i (cfg_slave_i),
    .list_cfg_o   (slave_cfg_o)
  );

  mb4_instr_reg u_instr (
    .hclk_i,
    .rst_ni (hrst_ni),
    .wr_en_i,
    .wr_addr_i,
    .wr_data_i,
    .rd_data_o (instr_data),
    .pending_o (instr_pending),
    .pending_control_o (control_pending),
    .written_o,
    .count_o,
    .ack_i,
    .held_i,
    .base_i      (base),
    .newest_i    (newest),
    .bank_o      (bank_seen),
    .kept_o      (base_kept)
  );

  mb4_host_read u_read (
    .rclk_i,
    .rst_ni (hrst_ni),
    .rd_en_i,
    .rd_addr_i,
    .rd_data_o,
    .ram_ready_i     (!clear_busy),
    .bank_i          (bank_seen),
    .scd_lo_data_i   (scd_lo_data),
    .scd_hi_data_i   (scd_hi_data),
    .rdata_data_i    (rdata_data),
    .recent_hit_i    (recent_hit),
    .recent_data_i   (recent_data),
    .slave_data_i    (slave_data),
    .cfg_data_i      (cfg_data),
    .instr_data_i    (instr_data),
    .instr_pending_i (instr_pending),
    .control_pending_i (control_pending),
    .status_i,
    .svalid_i        (svalid),
    .cds_i           (cds),
    .cdssel2_i       (cfg_o.chsel == 2'b10),
    .revision_sel_i
  );

  mb4_read_port2 u_read2 (
    .rclk_i      (rd2_clk_i),
    .rst_ni      (hrst_ni),
    .rd_en_i     (rd2_en_i),
    .rd_data_o   (rd2_data_o),
    .ram_ready_i (!clear_busy && Port2),
    .bank_i      (bank_seen),
    .data_i      (scd2_data)
  );

  // ---- memories -----------------------------------------------------------------------------

  // SCDATA, RDATA and SVALID are in the core domain; writes to them are posted. Only addresses of
  // SCDATA and RDATA have bit 6 = 0. Bytes of SCDATA and SVALID carry the bank that the host has:
  //   SCDATA 0, bank, address 5..0;   RDATA 1, 0, address 5..0;   SVALID 1, 1, bank, address 4..0
  assign post_wr = wr_en_i && (!wr_addr_i[6] ||
                             wr_addr_i == mb4_regs_pkg::ADDR_SVALID_LO ||
                             wr_addr_i == mb4_regs_pkg::ADDR_SVALID_HI);

  enc_posted #(.Width(16)) u_posted (
    .hclk_i,
    .hrst_ni,
    .wr_en_i   (post_wr),
    .wr_data_i ({wr_addr_i[7], wr_addr_i[6] || (!wr_addr_i[7] && bank_seen),
                 wr_addr_i[6] ? bank_seen : wr_addr_i[5], wr_addr_i[4:0], wr_data_i}),
    .clk_i,
    .rst_ni,
    .valid_o   (post_valid),
    .data_o    (post_data),
    .ready_i   (post_ready),
    .busy_o    (post_busy_o),
    .empty_o   (post_empty),
    .mark_i    (mark),
    .mark_o    (marked)
  );

  // Until posted bytes of SCDATA and RDATA have arrived, reads of them are answered here.
  mb4_recent u_recent (
    .hclk_i,
    .rst_ni    (hrst_ni),
    .wr_en_i   (wr_en_i && !wr_addr_i[6]),
    .wr_addr_i ({wr_addr_i[7], !wr_addr_i[7] && bank_seen, wr_addr_i[5:0]}),
    .wr_data_i,
    .rclk_i,
    .rd_en_i,
    .rd_addr_i ({rd_addr_i[7], !rd_addr_i[7] && bank_seen, rd_addr_i[5:0]}),
    .rd_mem_i  (!rd_addr_i[6]),
    .hit_o     (recent_hit),
    .data_o    (recent_data),
    .empty_i   (post_empty),
    .mark_o    (mark),
    .marked_i  (marked)
  );

  assign post_rdata = post_valid && post_data[15:14] == 2'b10;
  assign post_ready = ready_scd && (ready_rdata || !post_rdata);

  assign mem_busy_o = clear_busy;
  mb4_ram_clear u_clear (
    .clk_i,
    .rst_ni,
    .busy_o (clear_busy),
    .addr_o (clear_addr)
  );

  mb4_scd_store #(.Port2(Port2)) u_scd (
    .clk_i,
    .rst_ni,
    .slaveloc5_i  (cfg_o.slaveloc5),
    .host_bank_i  (host_bank),
    .eng_bank_i   (eng_bank),
    .clear_i      (clear_busy),
    .clear_addr_i (clear_addr),
    .post_valid_i (post_valid),
    .post_i       (post_data),
    .post_ready_o (ready_scd),
    .rclk_i,
    .rd_en_i,
    .rd_addr_i    (rd_addr_i[4:0]),
    .rd_lo_data_o (scd_lo_data),
    .rd_hi_data_o (scd_hi_data),
    .rd2_clk_i,
    .rd2_en_i,
    .rd2_addr_i,
    .rd2_data_o   (scd2_data),
    .svalid_o     (svalid),
    .wr_line_i      ({data2.wr_en, data1.wr_en}),
    .wr_byte_i      ({data2.wr_byte, data1.wr_byte}),
    .wr_line_data_i ({data2.wr_data, data1.wr_data}),
    .slave_i        ({data2.slave, data1.slave}),
    .word_begin_i   ({data2.word_begin, data1.word_begin}),
    .word_done_i    ({data2.word_done, data1.word_done}),
    .word_ok_i      (word_ok_o),
    .word_split_i   (word_split),
    .svalid_clear_i,
    .delay_en_i     ({data2.delay_en, data1.delay_en}),
    .delay_i        ({data2.delay, data1.delay}),
    .mo_rd_en_i,
    .mo_addr_i,
    .mo_data_o
  );

  mb4_rdata_buf u_rdata (
    .clk_i,
    .clear_i        (clear_busy),
    .clear_addr_i   (clear_addr),
    .eng_wr_en_i    (rdata_i.wr_en),
    .eng_addr_i     (rdata_i.addr),
    .eng_wr_data_i  (rdata_i.wr_data),
    .eng_rd_en_i    (rdata_i.rd_en),
    .eng_rd_data_o  (rdata_o),
    .host_wr_en_i   (post_rdata),
    .host_wr_addr_i (post_data[13:8]),
    .host_wr_data_i (post_data[7:0]),
    .host_ready_o   (ready_rdata),
    .rclk_i,
    .rd_en_i,
    .rd_addr_i      (rd_addr_i[5:0]),
    .rd_data_o      (rdata_data)
  );

  mb4_bank_ctrl u_bank (
    .clk_i,
    .rst_ni,
    .singlebank_i   (cfg_o.singlebank),
    .holdbank_i,
    .kept_i         (base_kept),
    .swbank_pulse_i (bank_i.swap),
    .frame_end_i    (bank_i.data_end),
    .frame_run_i    (bank_i.run),
    .pending_o      (bank_pending_o),
    .swapped_o      (bank_swapped_o),
    .lost_o         (bank_lost_o),
    .base_o         (base),
    .newest_o       (newest),
    .host_bank_o    (host_bank),
    .eng_bank_o     (eng_bank)
  );

  mb4_word_split u_split (
    .clk_i,
    .rst_ni,
    .swap_i      (bank_i.swap),
    .word_open_i ({data2.word_open, data1.word_open}),
    .word_ok_i   ({data2.word_ok, data1.word_ok}),
    .split_o     (word_split),
    .word_ok_o
  );

  mb4_cds_bank u_cds (
    .clk_i,
    .rst_ni,
    .host_bank_i (host_bank),
    .eng_bank_i  (eng_bank),
    .frame_end_i (bank_i.frame_end),
    .reduced_i   (bank_i.reduced),
    .holdbank_i,
    .cds_i       ({data2.cds, data1.cds}),
    .cds_o       (cds)
  );

endmodule
