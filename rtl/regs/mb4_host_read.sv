// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Host read side: chooses the source of every address and holds the byte for the host interface.
//
// Clock domain: host reads (rclk_i).
// Latency: rd_data_o is valid after the edge with rd_en_i, until the next read.
//
// The status bits of the core and the bank that the host owns are asynchronous here. One flop (the
// read register) samples each of them. It does so half an SCLK period before the first of them
// reaches MISO, or 23 ns before the data bus must be stable. The same edge takes data and SVALID of
// both banks. The choice between the banks comes after the flops, so all bits of a byte are of one
// bank.
// Misuse: reserved addresses read 0 (decision 13).
// Datasheet: pages 21, 22, 34..36, Tables 6, 41, 42, 54..67.

module mb4_host_read (
  input  logic       rclk_i,
  input  logic       rst_ni,
  // host byte bus
  input  logic       rd_en_i,
  input  logic [7:0] rd_addr_i,
  output logic [7:0] rd_data_o,
  // sources
  input  logic        ram_ready_i,   // core: the memories are cleared
  input  logic        bank_i,        // bank that the host reads
  input  logic [15:0] scd_lo_data_i, // read registers of the memories, of the edge
  input  logic [15:0] scd_hi_data_i, // with rd_en_i; bank 1 in the upper byte
  input  logic [7:0] rdata_data_i,
  input  logic       recent_hit_i,   // same edge: the byte of the host is still on its way
  input  logic [7:0] recent_data_i,
  input  logic [7:0] slave_data_i,   // configuration of the data channels, same edge
  input  logic [7:0] cfg_data_i,     // combinational from rd_addr_i
  input  logic [7:0] instr_data_i,
  input  logic       instr_pending_i,
  input  logic       control_pending_i,
  input  mb4_pkg::status_t status_i,
  input  logic [15:0] svalid_i,      // bank 1 in the upper byte
  input  logic [1:0] revision_sel_i
);

  // One select bit for each source. The three memories read 0 until they are cleared.
  logic       reg_sel_d, reg_sel_q;
  logic       slave_sel_d, slave_sel_q;
  logic       lo_sel_d, lo_sel_q;
  logic       hi_sel_d, hi_sel_q;
  logic       rdata_sel_d, rdata_sel_q;
  logic [7:0] reg_data;
  logic [7:0] ram_data;
  logic [7:0] reg_d;
  logic [7:0] reg_q;
  logic [3:0] flags_d;   // bits 7, 5, 3, 1 of the register, from bank 1
  logic [3:0] flags_q;
  logic       bank_q;
  logic       ready_q;

  assign lo_sel_d    = rd_addr_i[7:5] == mb4_regs_pkg::ADDR_SCDATA[7:5];
  assign hi_sel_d    = rd_addr_i[7:5] == mb4_regs_pkg::ADDR_SCDATA[7:5] + 3'd1;
  assign rdata_sel_d = rd_addr_i[7:6] == mb4_regs_pkg::ADDR_RDATA[7:6];
  assign slave_sel_d = rd_addr_i[7:5] == mb4_regs_pkg::ADDR_SLAVE_CFG[7:5];
  assign reg_sel_d   = !(lo_sel_d || hi_sel_d || rdata_sel_d || slave_sel_d);

  always_comb begin
    unique case (rd_addr_i)
      mb4_regs_pkg::ADDR_REVISION:
        unique case (revision_sel_i)
          2'd1:    reg_d = 8'h10;
          2'd2:    reg_d = 8'h11;
          default: reg_d = mb4_regs_pkg::RESET_REVISION;
        endcase
      mb4_regs_pkg::ADDR_VERSION:
        reg_d = mb4_regs_pkg::RESET_VERSION;
      mb4_regs_pkg::ADDR_STATUS0:
        reg_d = {status_i.n_err, status_i.flags.n_agserr, status_i.flags.n_delayerr,
                 status_i.flags.n_scderr, status_i.flags.n_regerr,
                 status_i.flags.regend && !control_pending_i, 1'b1,
                 status_i.flags.eot && !instr_pending_i};
      mb4_regs_pkg::ADDR_SVALID_LO:
        reg_d = {svalid_i[3], 1'b0, svalid_i[2], 1'b0,
                 svalid_i[1], 1'b0, svalid_i[0], 1'b0};
      mb4_regs_pkg::ADDR_SVALID_HI:
        reg_d = {svalid_i[7], 1'b0, svalid_i[6], 1'b0,
                 svalid_i[5], 1'b0, svalid_i[4], 1'b0};
      mb4_regs_pkg::ADDR_STATUS3:
        reg_d = {status_i.flags.cdm_timeout, status_i.cdssel, status_i.flags.regbytes};
      mb4_regs_pkg::ADDR_INSTR:
        reg_d = instr_data_i;
      mb4_regs_pkg::ADDR_STATUS8:
        reg_d = {4'b0101, status_i.cds2, status_i.sl2, status_i.cds1, status_i.sl1};
      mb4_regs_pkg::ADDR_STATUS9:
        reg_d = mb4_regs_pkg::RESET_STATUS9;
      mb4_regs_pkg::ADDR_SWBANKFAIL:
        reg_d = {7'b0000000, status_i.flags.swbank_fail};
      default:
        reg_d = cfg_data_i;
    endcase
  end

  always_comb begin
    unique case (rd_addr_i)
      mb4_regs_pkg::ADDR_SVALID_LO: flags_d = svalid_i[11:8];
      mb4_regs_pkg::ADDR_SVALID_HI: flags_d = svalid_i[15:12];
      default:                      flags_d = {reg_d[7], reg_d[5], reg_d[3], reg_d[1]};
    endcase
  end

  always_ff @(posedge rclk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      reg_sel_q   <= 1'b0;
      slave_sel_q <= 1'b0;
      lo_sel_q    <= 1'b0;
      hi_sel_q    <= 1'b0;
      rdata_sel_q <= 1'b0;
      reg_q    <= '0;
      flags_q  <= '0;
      bank_q   <= 1'b0;
      ready_q  <= 1'b0;
    end else if (rd_en_i) begin
      reg_sel_q   <= reg_sel_d;
      slave_sel_q <= slave_sel_d;
      lo_sel_q    <= lo_sel_d;
      hi_sel_q    <= hi_sel_d;
      rdata_sel_q <= rdata_sel_d;
      reg_q    <= reg_d;
      flags_q  <= flags_d;
      bank_q   <= bank_i;
      ready_q  <= ram_ready_i;
    end
  end

  assign reg_data = bank_q ? {flags_q[3], reg_q[6], flags_q[2], reg_q[4],
                              flags_q[1], reg_q[2], flags_q[0], reg_q[0]} : reg_q;

  // An AND-OR choice is short: half an SCLK period is left for the path to MISO.
  assign ram_data =
      ((bank_q ? scd_lo_data_i[15:8] : scd_lo_data_i[7:0]) & {8{lo_sel_q}}) |
      ((bank_q ? scd_hi_data_i[15:8] : scd_hi_data_i[7:0]) & {8{hi_sel_q}}) |
      (rdata_data_i & {8{rdata_sel_q}});

  assign rd_data_o = (ram_data & {8{ready_q && !recent_hit_i}}) |
                     (recent_data_i & {8{recent_hit_i}}) |
                     (slave_data_i & {8{slave_sel_q}}) | (reg_data & {8{reg_sel_q}});

endmodule
