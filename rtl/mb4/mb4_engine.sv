// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip behind its host interface: registers, control, two lines. Its host side is a byte bus
// with its own clocks, so that any interface fits: mb4_core puts SPI in front of it, mb4_chip puts
// all host interfaces of the 28-pin device in front of it.
//
// Clock domains: wr_clk_i and rd_clk_i (host), rd2_clk_i (second reader, with Port2) and clk_i
// (core). While the core clock stands still the host can read all registers 0xC0..0xFB, and write
// all but SVALID and 0xF4: these writes wait for it, as do those to the data memories. SWBANK and
// HOLDBANK in 0xF4 need no core clock: they choose at once the bank that the host reads. Frames
// need the core clock.
// Latency: a rising edge of wr_clk_i or rd_clk_i samples an access. Read data are valid after this
// edge until the next read.
// Reset: rst_ni is asynchronous. It goes unchanged to the host domain, because the host clocks
// stand still while a reset ends, and synchronised to the core. por_ni resets MA and its time base
// at power-on. With rst_ni alone MA first ends its present level.
//
// What the parameters leave out costs nothing and behaves as decision 44 rules. Without line 2 SL2
// is not looked at, and register 0xF8 shows it as 1, as with an open pin.
//
// Misuse: wr_clk_i and rd_clk_i may be one clock. If they are two clocks, one must stand still
// while the other has edges; otherwise the data of a read are undefined. So are those of a read at
// the edge that writes the same byte.
// Datasheet: pages 15..36. Crossings: docs/crossings.md.

module mb4_engine #(
  parameter bit Port2 = 1'b0,    // second read port: SCDATA5..8
  parameter bit Tap   = 1'b0,    // for bus tops: tap_o, and 0xF4 acts later (decision 45)
  parameter logic [1:0] SlCells = biss_pkg::SL_FLOPS, // SL: flops or DDR cells (biss_sl_capture)
  // Features (docs/integration.md, "Features"): a preset, and what differs from it
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL,
  parameter int unsigned Lines   = Features[mb4_pkg::TWO_LINES_LSB] ? 2 : 1,
  parameter int unsigned Slaves  = 32'(Features[mb4_pkg::SLAVES_LSB +: 4]),
  parameter bit          BissB   = Features[mb4_pkg::BISS_B_LSB],
  parameter bit          Ssi     = Features[mb4_pkg::SSI_LSB],
  parameter bit          Mo      = Features[mb4_pkg::MO_LSB],
  parameter bit          Control = Features[mb4_pkg::CONTROL_LSB],
  parameter bit          Gray    = Features[mb4_pkg::GRAY_LSB],
  parameter bit          Force   = Features[mb4_pkg::FORCE_LSB],
  parameter bit          FreeCrc = Features[mb4_pkg::FREE_CRC_LSB],
  parameter int unsigned Banks   = Features[mb4_pkg::TWO_BANKS_LSB] ? 2 : 1
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
  // for bus tops (mb4_page); others leave it open
  output mb4_pkg::tap_t tap_o,
  // constants
  input  logic [mb4_pkg::QUIRKS_W-1:0] quirks_i
);

  localparam logic [31:0] FEATURES =
      mb4_pkg::features(Lines, Slaves, Banks, Force, Gray, BissB, Ssi, Mo, Control, FreeCrc);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (FEATURES[mb4_pkg::SLAVES_LSB +: 4] == 4'd0) begin : gen_range
    $error("Lines is 1 or 2, Banks 1 or 2, Slaves 1 to 8, with two lines 1 to 4 or 8");
  end
  if (mb4_pkg::features(2, 8, 2, 1'b1, 1'b1, 1'b1, 1'b1, 1'b1, 1'b1, 1'b1) !=
      mb4_pkg::FEATURES_FULL) begin : gen_bits
    $error("mb4_pkg::FEATURES_FULL is not that of a chip with all features");
  end
`endif

  logic       rst_core_n;
  logic       por_core_n;
  logic [mb4_pkg::QUIRKS_W-1:0] quirks_q;

  // registers
  logic [3:0]       cfg_en;       // read ports of the word lists
  logic [11:0]      cfg_slave;
  logic [4*mb4_pkg::SLAVE_CFG_W-1:0] slave_cfg;
  mb4_pkg::cfg_t    cfg;
  mb4_pkg::host_t       host;
  mb4_pkg::mem_rd_t     rd2;
  mb4_pkg::instr_host_t instr, instr_seen;
  mb4_pkg::instr_core_t instr_state;
  mb4_pkg::flags_t  flags;
  mb4_pkg::status_t status;

  // memories and banks
  mb4_pkg::bank_cmd_t   bank;
  mb4_pkg::bank_event_t bank_event;
  mb4_pkg::mem_state_t  mem;
  mb4_pkg::rdata_cmd_t  rdata_cmd;
  logic       post_busy;
  logic [7:0] rdata;

  // lines
  logic [7:0]  enscd;
  logic [1:0]  sl_pin, word_bad;
  logic        time_run, time_restart, tick;
  biss_pkg::line_go_t     go;
  biss_pkg::register_ma_t register_ma;
  biss_pkg::line_status_t status1, status2;
  logic [2*biss_pkg::LINE_START_W-1:0]  line_start;
  logic [2*biss_pkg::LINE_CMD_W-1:0]    cmd;
  logic [2*biss_pkg::LINE_STATUS_W-1:0] line_status;
  logic [2*biss_pkg::LINE_EVENT_W-1:0]  line_event;
  logic [2*biss_pkg::LINE_DATA_W-1:0]   line_data;
  logic [2*biss_pkg::MO_READ_W-1:0]     mo_read;
  logic [15:0] mo_data;

  // bus tops
  mb4_pkg::reg_tap_t      reg_tap;
  biss_pkg::line_data_t   data1, data2;
  biss_pkg::line_start_t  start1, start2;
  logic                   frame_lost, frame_starts, unused;

  // quirks_i is static. The flops keep it out of the combinational logic behind the pins. This
  // shortens paths and makes the simulation faster.
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

  // ---- registers ----------------------------------------------------------------------------

  assign host.wr_en   = wr_en_i;
  assign host.wr_addr = wr_addr_i;
  assign host.wr_data = wr_data_i;
  assign host.rd_en   = rd_en_i;
  assign host.rd_addr = rd_addr_i;
  // The second reader sees SCDATA5..8, from address 0x20 on.
  assign rd2.en       = rd2_en_i;
  assign rd2.addr     = {1'b1, rd2_addr_i};

  mb4_reg_file #(.Port2(Port2), .Tap(Tap), .Features(FEATURES)) u_regs (
    .clk_i,
    .rst_ni,
    .rst_core_ni    (rst_core_n),
    .wr_clk_i,
    .rd_clk_i,
    .host_i         (host),
    .rd_data_o,
    .rd2_clk_i,
    .rd2_i          (rd2),
    .rd2_data_o,
    .enscd_o        (enscd),
    .cfg_en_i       (cfg_en),
    .cfg_slave_i    (cfg_slave),
    .slave_cfg_o    (slave_cfg),
    .cfg_o          (cfg),
    .instr_o        (instr),
    .instr_i        (instr_state),
    .status_i       (status),
    .revision_sel_i (quirks_i[mb4_pkg::QUIRK_REVISION_LSB +: 2]),
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

  // A bus may write 0xF4 one clock after the MA force bits, which need up to 5 clocks of the core
  // (mb4_ma_force). The count needs 2 or 3, so it comes 3 clocks later.
  if (Tap) begin : gen_late
    logic [5:0] late_q;
    always_ff @(posedge clk_i or negedge rst_core_n) begin
      if (!rst_core_n) late_q <= '0;
      else             late_q <= {late_q[3:0], instr.count};
    end
    assign instr_seen.count   = late_q[5:4];
    assign instr_seen.written = instr.written;
  end else begin : gen_not_late
    assign instr_seen = instr;
  end

  // ---- control ------------------------------------------------------------------------------

  mb4_control #(.Features(FEATURES)) u_control (
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

  // ---- lines --------------------------------------------------------------------------------

  mb4_lines #(.SlCells(SlCells), .Features(FEATURES)) u_lines (
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

  // ---- status -------------------------------------------------------------------------------

  assign eot_o  = flags.eot;
  // With the DDR cell of an iCE40 no other logic can read the pin.
  assign status1 = line_status[0 +: biss_pkg::LINE_STATUS_W];
  assign status2 = line_status[biss_pkg::LINE_STATUS_W +: biss_pkg::LINE_STATUS_W];
  assign sl_pin = (SlCells == biss_pkg::SL_ICE40 ? {status2.sl, status1.sl} : {sl2_i, sl1_i}) |
                  {Lines == 1, 1'b0};
  assign status.flags = flags;
  assign status.n_err = ner_i && !ner_low_o;
  assign status.sl2   = sl_pin[1];
  assign status.sl1   = sl_pin[0];
  assign data1 = line_data[0 +: biss_pkg::LINE_DATA_W];
  assign data2 = line_data[biss_pkg::LINE_DATA_W +: biss_pkg::LINE_DATA_W];
  assign frame_starts   = go.start && !go.init && !go.register_access;
  assign start1 = line_start[0 +: biss_pkg::LINE_START_W];
  assign start2 = line_start[biss_pkg::LINE_START_W +: biss_pkg::LINE_START_W];
  // The tap shows only which lines take part in a frame.
  assign unused = ^{start1, start2};

  assign tap_o.regs        = reg_tap;
  assign tap_o.ready       = !mem.clears;
  assign tap_o.slaveloc5   = cfg.slaveloc5;
  assign tap_o.ssi         = {2{Ssi}} & {cfg.cfgch2 == biss_pkg::SSI, cfg.cfgch1 == biss_pkg::SSI};
  assign tap_o.start       = {frame_starts && start2.takes_part, frame_starts && start1.takes_part};
  assign tap_o.stop        = go.stop;
  assign tap_o.ma          = {ma2_o, ma1_o};
  assign tap_o.wr          = {data2.rx.wr_en, data1.rx.wr_en};
  assign tap_o.done        = {data2.rx.done, data1.rx.done};
  assign tap_o.slave       = {data2.rx.slave, data1.rx.slave};
  assign tap_o.frame_end   = bank.frame_end;
  assign tap_o.lost        = frame_lost;
  assign tap_o.good        = {flags.n_agserr, flags.n_delayerr, flags.n_scderr, flags.n_regerr};
  assign tap_o.regend      = flags.regend;
  assign tap_o.swbank_fail = flags.swbank_fail;

  assign clkeni_o = cfg.clkeni;
  assign paired_o = cfg.cfgif[1];

endmodule
