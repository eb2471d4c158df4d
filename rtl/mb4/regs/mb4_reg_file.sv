// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that has an address: configuration, instruction register, data memories with their
// banks, validity flags, and the read side. The file connects these modules and decodes the
// addresses of posted writes; it has no flops of its own.
//
// Clock domains: host (wr_clk_i writes, rd_clk_i reads, rst_ni) and core (clk_i, rst_core_ni).
// wr_clk_i and rd_clk_i are one clock, or two strobes of which one rests while the other has edges.
// SCDATA, RDATA and SVALID are in the core domain: host writes to them are posted and wait for a
// running core clock. All other registers work without it. With Port2 there is one more read port
// for SCDATA5..8 with its own clock (rd2_clk_i).
// Vectors: bit i of a vector {2, 1} is for line i + 1.
// Datasheet: pages 21..36. Crossings: docs/crossings.md.

module mb4_reg_file #(
  parameter bit Port2 = 1'b0,
  parameter bit Tap   = 1'b0,    // the second read port reads SCDATA1..4 too, for tap_o
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic       clk_i,
  input  logic       rst_ni,          // host domain
  input  logic       rst_core_ni,     // core domain
  // host byte bus, sampled at the rising edge of wr_clk_i and rd_clk_i
  input  logic       wr_clk_i,
  input  logic       rd_clk_i,
  input  mb4_pkg::host_t host_i,
  output logic [7:0] rd_data_o,
  // second read port
  input  logic       rd2_clk_i,
  input  mb4_pkg::mem_rd_t rd2_i,
  output logic [7:0] rd2_data_o,
  // configuration, host domain, quasi-static
  output mb4_pkg::cfg_t    cfg_o,
  output logic [7:0]       enscd_o,
  // data channels' configuration, read by four word lists in the core clock
  input  logic [3:0]       cfg_en_i,
  input  logic [11:0]      cfg_slave_i,
  output logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg_o,
  // instruction register
  output mb4_pkg::instr_host_t instr_o,
  input  mb4_pkg::instr_core_t instr_i,
  // status, core domain, without SVALID and CDS
  input  mb4_pkg::status_t status_i,
  input  logic [1:0]       revision_sel_i,
  // memories and banks
  input  mb4_pkg::bank_cmd_t bank_i,
  output mb4_pkg::mem_state_t mem_o,
  output mb4_pkg::bank_event_t bank_event_o,
  // control communication
  input  mb4_pkg::rdata_cmd_t rdata_i,
  output logic [7:0] rdata_o,
  output logic       post_busy_o,    // bytes from the host are on their way to the memories
  // received bytes and words of lines {2, 1}
  input  logic [2*biss_pkg::LINE_DATA_W-1:0] data_i,
  output logic [1:0]  word_bad_o,      // a word ends: its CRC is wrong, or it is split
  // actuator data for MO of lines {2, 1}
  input  logic [2*biss_pkg::MO_READ_W-1:0] mo_read_i,
  output logic [15:0] mo_data_o,
  // for bus tops
  output mb4_pkg::reg_tap_t tap_o
);

  localparam bit TWO_LINES = Features[mb4_pkg::TWO_LINES_LSB];
  localparam bit TWO_BANKS = Features[mb4_pkg::TWO_BANKS_LSB];
  localparam bit CONTROL   = Features[mb4_pkg::CONTROL_LSB];
  localparam logic [7:0] PRESENT =
      mb4_pkg::channels(TWO_LINES, Features[mb4_pkg::SLAVES_LSB +: 4]);

  mb4_pkg::mem_rd_t rd;
  mb4_pkg::mem_wr_t clear, rdata_post;
  mb4_pkg::banks_t  banks;           // core domain
  logic [15:0] cfg_data;
  logic [7:0]  slave_data;
  logic [7:0]  instr_data;
  logic        instr_pending, control_pending;
  logic        post_wr;
  logic        post_valid, post_ready;
  mb4_pkg::posted_t to_post, posted;
  logic        post_empty, mark, marked, recent_hit;
  logic [7:0]  recent_data;
  logic        post_rdata, ready_scd, ready_rdata, bank_pending;
  logic [15:0] scd_lo_data, scd_hi_data, scd2_data, scd2_lo_data, rdata_data, rdata2_data, svalid;
  logic [3:0]  cds;
  logic        base, newest;          // core domain: bases of banks (mb4_bank_ctrl)
  logic        bank_seen, base_kept;  // host domain: bank it has, base it keeps
  biss_pkg::line_data_t data1, data2;
  logic        unused;

  assign data1 = data_i[0 +: biss_pkg::LINE_DATA_W];
  assign data2 = data_i[biss_pkg::LINE_DATA_W +: biss_pkg::LINE_DATA_W];
  assign rd.en   = host_i.rd_en;
  assign rd.addr = host_i.rd_addr[5:0];
  assign mem_o.clears  = clear.en;
  assign mem_o.pending = bank_pending;

  // ---- registers ----------------------------------------------------------------------------

  mb4_cfg_regs #(.Features(Features)) u_cfg (
    .wr_clk_i,
    .rst_ni,
    .host_i,
    .rd_data_o   (cfg_data),
    .cfg_o
  );

  mb4_slave_cfg #(
    .Channels(PRESENT), .FreeCrc(Features[mb4_pkg::FREE_CRC_LSB])
  ) u_slave_cfg (
    .wr_clk_i,
    .rst_ni,
    .host_i,
    .rd_clk_i,
    .rd_data_o    (slave_data),
    .clk_i,
    .enscd_o,
    .list_en_i    (cfg_en_i),
    .list_slave_i (cfg_slave_i),
    .list_cfg_o   (slave_cfg_o)
  );

  mb4_instr_reg #(.TwoBanks(TWO_BANKS)) u_instr (
    .wr_clk_i,
    .rst_ni,
    .host_i,
    .rd_data_o   (instr_data),
    .pending_o   (instr_pending),
    .pending_control_o (control_pending),
    .instr_o,
    .instr_i,
    .base_i      (base),
    .newest_i    (newest),
    .bank_o      (bank_seen),
    .kept_o      (base_kept)
  );

  mb4_host_read #(.Features(Features)) u_read (
    .rd_clk_i,
    .rst_ni,
    .host_i,
    .rd_data_o,
    .ram_ready_i     (!clear.en),
    .bank_i          (bank_seen),
    .scd_lo_data_i   (scd_lo_data),
    .scd_hi_data_i   (scd_hi_data),
    .rdata_data_i    (rdata_data[7:0]),
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
    .cdssel2_i       (cfg_o.access.chsel == 2'b10),
    .revision_sel_i
  );

  mb4_read_port2 u_read2 (
    .rd_clk_i    (rd2_clk_i),
    .rst_ni,
    .rd_en_i     (rd2_i.en),
    .rd_data_o   (rd2_data_o),
    .ram_ready_i (!clear.en && Port2),
    .bank_i      (bank_seen),
    .data_i      (scd2_data)
  );

  // ---- memories -----------------------------------------------------------------------------

  // SCDATA, RDATA and SVALID are in the core domain; writes to them are posted. Only addresses of
  // SCDATA and RDATA have bit 6 = 0. Bytes of SCDATA and SVALID carry the bank that the host has.
  assign post_wr = host_i.wr_en && (mb4_pkg::in_memory(host_i.wr_addr[7:3], PRESENT, CONTROL) ||
                                    host_i.wr_addr == mb4_regs_pkg::ADDR_SVALID_LO ||
                                    host_i.wr_addr == mb4_regs_pkg::ADDR_SVALID_HI);

  assign to_post.elsewhere = host_i.wr_addr[7];
  assign to_post.select    = host_i.wr_addr[6] || (!host_i.wr_addr[7] && bank_seen);
  assign to_post.addr      = {host_i.wr_addr[6] ? bank_seen : host_i.wr_addr[5],
                              host_i.wr_addr[4:0]};
  assign to_post.data      = host_i.wr_data;

  enc_posted #(.Width(16)) u_posted (
    .wr_clk_i,
    .wr_rst_ni (rst_ni),
    .wr_en_i   (post_wr),
    .wr_data_i (to_post),
    .clk_i,
    .rst_ni    (rst_core_ni),
    .valid_o   (post_valid),
    .data_o    (posted),
    .ready_i   (post_ready),
    .busy_o    (post_busy_o),
    .empty_o   (post_empty),
    .mark_i    (mark),
    .mark_o    (marked)
  );

  // Answers reads of bytes of SCDATA and RDATA that have not arrived, and of registers without a
  // reserved bit.
  mb4_recent #(.Features(Features)) u_recent (
    .wr_clk_i,
    .rst_ni,
    .rd_clk_i,
    .host_i,
    .bank_i    (bank_seen),
    .hit_o     (recent_hit),
    .data_o    (recent_data),
    .empty_i   (post_empty),
    .mark_o    (mark),
    .marked_i  (marked)
  );

  assign post_rdata = CONTROL && post_valid && posted.elsewhere && !posted.select;
  assign post_ready = ready_scd && (ready_rdata || !post_rdata);

  mb4_ram_clear u_clear (
    .clk_i,
    .rst_ni (rst_core_ni),
    .clear_o (clear)
  );

  mb4_scd_store #(.Port2(Port2), .Tap(Tap), .Features(Features)) u_scd (
    .clk_i,
    .rst_ni (rst_core_ni),
    .slaveloc5_i  (cfg_o.slaveloc5),
    .banks_i      (banks),
    .bank_i,
    .clear_i      (clear),
    .post_valid_i (post_valid),
    .post_i       (posted),
    .post_ready_o (ready_scd),
    .rd_clk_i,
    .rd_i         (rd),
    .rd_lo_data_o (scd_lo_data),
    .rd_hi_data_o (scd_hi_data),
    .rd2_clk_i,
    .rd2_i,
    .rd2_data_o   (scd2_data),
    .rd2_lo_data_o (scd2_lo_data),
    .svalid_o     (svalid),
    .data_i,
    .word_bad_o,
    .mo_read_i,
    .mo_data_o
  );

  assign rdata_post.en   = post_rdata;
  assign rdata_post.addr = posted.addr;
  assign rdata_post.data = posted.data;

  mb4_memory #(.Banks(1'b0)) u_rdata (
    .clk_i,
    .clear_i      (clear),
    .eng_wr_i     (rdata_i.wr),
    .eng_rd_i     (rdata_i.rd),
    .eng_data_o   (rdata_o),
    .host_wr_i    (rdata_post),
    .host_ready_o (ready_rdata),
    .rd_clk_i,
    .rd_i         (rd),
    .rd_data_o    (rdata_data),
    .rd2_clk_i    (1'b0),
    .rd2_i        (7'd0),
    .rd2_data_o   (rdata2_data)
  );

  mb4_bank_ctrl #(.TwoBanks(TWO_BANKS)) u_bank (
    .clk_i,
    .rst_ni (rst_core_ni),
    .singlebank_i   (cfg_o.singlebank),
    .holdbank_i     (instr_i.held.holdbank),
    .kept_i         (base_kept),
    .bank_i,
    .pending_o      (bank_pending),
    .event_o        (bank_event_o),
    .base_o         (base),
    .newest_o       (newest),
    .banks_o        (banks)
  );

  mb4_cds_bank #(.TwoLines(TWO_LINES), .TwoBanks(TWO_BANKS)) u_cds (
    .clk_i,
    .rst_ni (rst_core_ni),
    .banks_i     (banks),
    .bank_i,
    .holdbank_i  (instr_i.held.holdbank),
    .cds_i       ({data2.cds, data1.cds}),
    .cds_o       (cds)
  );

  assign tap_o.empty  = post_empty;
  assign tap_o.banks  = banks;
  assign tap_o.svalid = svalid;
  assign tap_o.cds    = cds;
  assign tap_o.hi     = scd2_data;
  assign tap_o.lo     = scd2_lo_data;

  // RDATA has no banks and no second read port.
  assign unused = ^{rdata_data[15:8], rdata2_data};

endmodule
