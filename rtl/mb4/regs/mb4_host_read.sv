// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Host read side: chooses the source of every address and holds the byte for the host interface.
//
// Clock domain: host reads (rd_clk_i).
// Latency: rd_data_o is valid after the edge with host_i.rd_en, until the next read.
//
// The status bits of the core and the bank that the host owns are asynchronous here. One flop (the
// read register) samples each of them. It does so half an SCLK period before the first of them
// reaches MISO, or 23 ns before the data bus must be stable. The same edge takes data and SVALID of
// both banks. The choice between the banks comes after the flops, so all bits of a byte are of one
// bank. CDSSEL is chosen before its flop, because it is the only bit of its byte that has banks.
// A core that does not have all features tells it at 0x7F, and memories that it does not have read
// 0 (decision 44).
// Misuse: reserved addresses read 0 (decision 13).
// Datasheet: pages 21, 22, 34..36, Tables 6, 41, 42, 54..67.

module mb4_host_read #(
  parameter logic [31:0] Features = mb4_pkg::FEATURES_FULL
) (
  input  logic       rd_clk_i,
  input  logic       rst_ni,
  // host byte bus
  input  mb4_pkg::host_t host_i,
  output logic [7:0] rd_data_o,
  // sources
  input  logic        ram_ready_i,   // core: the memories are cleared
  input  logic        bank_i,        // bank that the host reads
  input  logic [15:0] scd_lo_data_i, // read registers of the memories, of the edge
  input  logic [15:0] scd_hi_data_i, // with host_i.rd_en; bank 1 in the upper byte
  input  logic [7:0] rdata_data_i,
  input  logic       recent_hit_i,   // same edge: mb4_recent answers
  input  logic [7:0] recent_data_i,
  input  logic [7:0] slave_data_i,   // configuration of the data channels, same edge; else 0
  input  logic [15:0] cfg_data_i,    // of an odd and an even address, from host_i.rd_addr(4:1)
  input  logic [7:0] instr_data_i,
  input  logic       instr_pending_i,
  input  logic       control_pending_i,
  input  mb4_pkg::status_t status_i,
  input  logic [15:0] svalid_i,      // bank 1 in the upper byte
  input  logic [3:0] cds_i,          // of lines {2, 1}, bank 1 in the upper half
  input  logic       cdssel2_i,      // CDSSEL is that of line 2
  input  logic [1:0] revision_sel_i
);

  localparam logic [7:0] PRESENT = mb4_pkg::channels(Features[mb4_pkg::TWO_LINES_LSB],
                                                     Features[mb4_pkg::SLAVES_LSB +: 4]);
  localparam bit CONTROL = Features[mb4_pkg::CONTROL_LSB];
  localparam logic [7:0] FEATURES = Features == mb4_pkg::FEATURES_FULL
                                        ? 8'h00 : {1'b1, Features[6:0]};

  // Bits of flags that may differ from those of pair: SVALID and CDS.
  localparam logic [7:0] BANKED = {PRESENT[3:0], PRESENT[7:4] |
                                   {2'b00, Features[mb4_pkg::TWO_LINES_LSB], 1'b1}};

  localparam logic [2:0] TOP = mb4_regs_pkg::ADDR_REGADR[7:5];  // 0xE0 to 0xFF

  logic [7:0] rd_addr;
  // One select bit for each source. The three memories read 0 until they are cleared.
  logic [1:0] reg_sel_d, reg_sel_q;   // odd and even address
  logic       lo_sel_d, lo_sel_q;
  logic       hi_sel_d, hi_sel_q;
  logic       rdata_sel_d, rdata_sel_q;
  logic [15:0] reg_pair;
  logic [2:0] ram_sel;     // of the memories: RDATA, upper and lower half of SCDATA
  logic [7:0] ram_data;
  logic [15:0] pair, pair_q;   // registers of an odd and an even address
  logic [7:0] flags, flags_q;  // bits of both at the places of SVALID and CDS, from bank 1
  logic [7:0] status0, status3, status8;
  logic [7:0] svalid_lo, svalid_hi;
  logic       bank_q;
  logic       ready_q;

  assign rd_addr     = host_i.rd_addr;
  assign lo_sel_d    = rd_addr[7:5] == mb4_regs_pkg::ADDR_SCDATA[7:5] &&
                       PRESENT[{1'b0, rd_addr[4:3]}];
  assign hi_sel_d    = rd_addr[7:5] == mb4_regs_pkg::ADDR_SCDATA[7:5] + 3'd1 &&
                       PRESENT[{1'b1, rd_addr[4:3]}];
  assign rdata_sel_d = rd_addr[7:6] == mb4_regs_pkg::ADDR_RDATA[7:6] && CONTROL;
  assign reg_sel_d   = {rd_addr[0], !rd_addr[0]} &
                       {2{rd_addr[7:5] == TOP ||
                          (Features != mb4_pkg::FEATURES_FULL &&
                           rd_addr[7:1] == mb4_pkg::ADDR_FEATURES[7:1])}};

  always_comb begin
    status0 = mb4_regs_pkg::RESET_STATUS0 & mb4_regs_pkg::CONST_STATUS0;
    status0[mb4_regs_pkg::NERR_LSB]      = status_i.n_err;
    status0[mb4_regs_pkg::NAGSERR_LSB]   = status_i.flags.n_agserr;
    status0[mb4_regs_pkg::NDELAYERR_LSB] = status_i.flags.n_delayerr;
    status0[mb4_regs_pkg::NSCDERR_LSB]   = status_i.flags.n_scderr;
    status0[mb4_regs_pkg::NREGERR_LSB]   = status_i.flags.n_regerr;
    status0[mb4_regs_pkg::REGEND_LSB]    = status_i.flags.regend && !control_pending_i;
    status0[mb4_regs_pkg::EOT_LSB]       = status_i.flags.eot && !instr_pending_i;
    status3 = mb4_regs_pkg::RESET_STATUS3 & mb4_regs_pkg::CONST_STATUS3;
    status3[mb4_regs_pkg::CDMTIMEOUT_LSB] = status_i.flags.cdm_timeout;
    status3[mb4_regs_pkg::CDSSEL_LSB]     = cds_i[{bank_i, cdssel2_i}];
    status3[mb4_regs_pkg::REGBYTES_LSB +: mb4_regs_pkg::REGBYTES_W] = status_i.flags.regbytes;
    status8 = mb4_regs_pkg::RESET_STATUS8 & mb4_regs_pkg::CONST_STATUS8;
    status8[mb4_regs_pkg::CDS_LSB]                              = cds_i[0];
    status8[mb4_regs_pkg::CDS_LSB + mb4_regs_pkg::CDS_LSB_STEP] = cds_i[1];
    status8[mb4_regs_pkg::SL_LSB]                               = status_i.sl1;
    status8[mb4_regs_pkg::SL_LSB + mb4_regs_pkg::SL_LSB_STEP]   = status_i.sl2;
    svalid_lo = mb4_regs_pkg::RESET_SVALID_LO & mb4_regs_pkg::CONST_SVALID_LO;
    svalid_hi = mb4_regs_pkg::RESET_SVALID_HI & mb4_regs_pkg::CONST_SVALID_HI;
    for (int unsigned i = 0; i < 4; i++) begin
      svalid_lo[mb4_regs_pkg::SVALID_LSB + mb4_regs_pkg::SVALID_LSB_STEP * i] = svalid_i[i];
      svalid_hi[mb4_regs_pkg::SVALID_LSB + mb4_regs_pkg::SVALID_LSB_STEP * i] = svalid_i[4+i];
    end
  end

  // Bit 0 of the address comes late over SPI. So the registers of both addresses are taken, and the
  // choice between them comes after the flops.
  always_comb begin
    for (int unsigned k = 0; k < 2; k++) begin
      unique case ({TOP, rd_addr[4:1], 1'(k)})
        mb4_regs_pkg::ADDR_REVISION:
          unique case (revision_sel_i)
            2'd1:    pair[8*k +: 8] = mb4_regs_pkg::DEVICE_REVISION_Z;
            2'd2:    pair[8*k +: 8] = mb4_regs_pkg::DEVICE_REVISION_Z1;
            default: pair[8*k +: 8] = mb4_regs_pkg::RESET_REVISION;
          endcase
        mb4_regs_pkg::ADDR_VERSION:    pair[8*k +: 8] = mb4_regs_pkg::RESET_VERSION;
        mb4_regs_pkg::ADDR_STATUS0:    pair[8*k +: 8] = status0;
        mb4_regs_pkg::ADDR_SVALID_LO:  pair[8*k +: 8] = svalid_lo;
        mb4_regs_pkg::ADDR_SVALID_HI:  pair[8*k +: 8] = svalid_hi;
        mb4_regs_pkg::ADDR_STATUS3:    pair[8*k +: 8] = status3;
        mb4_regs_pkg::ADDR_INSTR:      pair[8*k +: 8] = instr_data_i;
        mb4_regs_pkg::ADDR_STATUS8:    pair[8*k +: 8] = status8;
        mb4_regs_pkg::ADDR_STATUS9:    pair[8*k +: 8] = mb4_regs_pkg::RESET_STATUS9;
        mb4_regs_pkg::ADDR_SWBANKFAIL:
          pair[8*k +: 8] = 8'(status_i.flags.swbank_fail) << mb4_regs_pkg::SWBANKFAIL_LSB;
        {TOP, mb4_pkg::ADDR_FEATURES[4:0]}:   // and 0xFF, which reads 0
          pair[8*k +: 8] = FEATURES & {8{!rd_addr[7]}};
        default:                       pair[8*k +: 8] = cfg_data_i[8*k +: 8];
      endcase
      unique case ({TOP, rd_addr[4:1], 1'(k)})
        mb4_regs_pkg::ADDR_SVALID_LO: flags[4*k +: 4] = svalid_i[11:8];
        mb4_regs_pkg::ADDR_SVALID_HI: flags[4*k +: 4] = svalid_i[15:12];
        mb4_regs_pkg::ADDR_STATUS8:   flags[4*k +: 4] = {pair[8*k + 7], pair[8*k + 5], cds_i[3:2]};
        default: begin
          for (int unsigned i = 0; i < 4; i++) begin
            flags[4*k + i] = pair[8*k + mb4_regs_pkg::SVALID_LSB + mb4_regs_pkg::SVALID_LSB_STEP*i];
          end
        end
      endcase
    end
  end

  always_ff @(posedge rd_clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      reg_sel_q   <= '0;
      lo_sel_q    <= 1'b0;
      hi_sel_q    <= 1'b0;
      rdata_sel_q <= 1'b0;
      pair_q   <= '0;
      flags_q  <= '0;
      bank_q   <= 1'b0;
      ready_q  <= 1'b0;
    end else if (host_i.rd_en) begin
      reg_sel_q   <= reg_sel_d;
      lo_sel_q    <= lo_sel_d;
      hi_sel_q    <= hi_sel_d;
      rdata_sel_q <= rdata_sel_d;
      pair_q   <= pair;
      flags_q  <= flags;
      bank_q   <= bank_i;
      ready_q  <= ram_ready_i;
    end
  end

  always_comb begin
    reg_pair = pair_q;
    for (int unsigned k = 0; k < 2; k++) begin
      for (int unsigned i = 0; i < 4; i++) begin
        if (bank_q && BANKED[4*k + i]) begin
          reg_pair[8*k + mb4_regs_pkg::SVALID_LSB + mb4_regs_pkg::SVALID_LSB_STEP*i] =
              flags_q[4*k + i];
        end
      end
    end
  end

  // The memories answer once they are cleared, unless mb4_recent has the byte. An AND-OR choice
  // is short: half an SCLK period is left for the path to MISO.
  assign ram_sel = {rdata_sel_q, hi_sel_q, lo_sel_q} & {3{ready_q && !recent_hit_i}};
  assign ram_data =
      ((bank_q ? scd_lo_data_i[15:8] : scd_lo_data_i[7:0]) & {8{ram_sel[0]}}) |
      ((bank_q ? scd_hi_data_i[15:8] : scd_hi_data_i[7:0]) & {8{ram_sel[1]}}) |
      (rdata_data_i & {8{ram_sel[2]}});

  assign rd_data_o = ram_data | (recent_data_i & {8{recent_hit_i}}) | slave_data_i |
                     (reg_pair[15:8] & {8{reg_sel_q[1]}}) | (reg_pair[7:0] & {8{reg_sel_q[0]}});

endmodule
