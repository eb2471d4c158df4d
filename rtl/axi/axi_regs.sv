// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers of the BiSS C master with N channels, on a word bus.
//
// Clock domain: core. An access never waits and is done in the clock of word_req_i. Bits that a
// register does not have read 0. Words for each channel show the channel of CHANNEL_INDEX; an index
// beyond the last channel reads 0. page_data_i is what the page answers, 0 for other addresses.
//
// Misuse: addresses without a register read 0 and ignore writes.
// Source: regmap/axi.rdl; hello-fpga BiSS-C master manual 2.4.

module axi_regs #(
  parameter int unsigned Channels = 1   // 1 to 16
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  // word bus
  input  logic        word_req_i,
  input  logic        word_write_i,
  input  logic [7:2]  word_addr_i,
  input  logic [31:0] word_data_i,
  input  logic [3:0]  word_be_i,
  output logic [31:0] word_data_o,
  // configuration
  output axi_pkg::cfg_t         cfg_o,
  output logic [Channels-1:0]   enable_o,        // as written
  output logic [Channels-1:0]   ma_shift_o,
  output logic [3:0]            index_o,
  // page
  input  logic [31:0]           page_data_i,
  // results
  input  logic [Channels-1:0]   single_valid_i,
  input  logic [Channels*axi_pkg::RESULT_W-1:0] results_i,
  input  logic [Channels*axi_pkg::MORE_W-1:0]   mores_i
);

  localparam int unsigned INDEX_W = Channels > 1 ? $clog2(Channels) : 1;
  localparam logic [15:0] PRESENT = 16'((32'd1 << Channels) - 32'd1);

  logic [7:0]          addr;
  logic                wr;
  logic                wr0;       // the write reaches bits 7..0
  axi_pkg::cfg_t       cfg_q;
  logic [15:0]         enable_q;
  logic [15:0]         ma_shift_q;
  logic [INDEX_W-1:0]  index_q;
  axi_pkg::result_t    result;
  axi_pkg::more_t      more;
  logic                unused;
  logic [31:0]         rdata;

  assign addr = {word_addr_i, 2'b00};
  assign wr   = word_req_i && word_write_i;
  assign wr0  = wr && word_be_i[0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      cfg_q      <= '0;
      enable_q   <= '0;
      ma_shift_q <= '0;
      index_q    <= '0;
    end else begin
      if (wr0 && addr == axi_regs_pkg::ADDR_SOFT_RESET)    cfg_q.soft_reset     <= word_data_i[0];
      if (wr0 && addr == axi_regs_pkg::ADDR_SAMPLE_CLOCK)  cfg_q.external_clock <= word_data_i[0];
      if (wr0 && addr == axi_regs_pkg::ADDR_MODE)          cfg_q.single_point   <= word_data_i[0];
      if (wr0 && addr == axi_regs_pkg::ADDR_REQUEST)       cfg_q.request        <= word_data_i[0];
      if (wr0 && addr == axi_regs_pkg::ADDR_MA_DIVIDER)    cfg_q.ma_divider     <= word_data_i[7:0];
      if (wr0 && addr == axi_regs_pkg::ADDR_POSITION_BITS) cfg_q.position_bits  <= word_data_i[7:0];
      if (wr0 && addr == axi_regs_pkg::ADDR_CRC_CHECK)     cfg_q.crc_check      <= word_data_i[0];
      if (wr0 && addr == axi_regs_pkg::ADDR_CHANNEL_INDEX) index_q <= word_data_i[INDEX_W-1:0];
      if (wr && addr == axi_regs_pkg::ADDR_SAMPLE_DIVIDER) begin
        if (word_be_i[0]) cfg_q.sample_divider[7:0]   <= word_data_i[7:0];
        if (word_be_i[1]) cfg_q.sample_divider[15:8]  <= word_data_i[15:8];
        if (word_be_i[2]) cfg_q.sample_divider[23:16] <= word_data_i[23:16];
        if (word_be_i[3]) cfg_q.sample_divider[27:24] <= word_data_i[27:24];
      end
      if (wr && addr == axi_regs_pkg::ADDR_CHANNEL_ENABLE) begin
        if (word_be_i[0]) enable_q[7:0]  <= word_data_i[7:0]  & PRESENT[7:0];
        if (word_be_i[1]) enable_q[15:8] <= word_data_i[15:8] & PRESENT[15:8];
      end
      if (wr && addr == axi_regs_pkg::ADDR_MA_SHIFT) begin
        if (word_be_i[0]) ma_shift_q[7:0]  <= word_data_i[7:0]  & PRESENT[7:0];
        if (word_be_i[1]) ma_shift_q[15:8] <= word_data_i[15:8] & PRESENT[15:8];
      end
    end
  end

  always_comb begin
    result = '0;
    more   = '0;
    for (int unsigned i = 0; i < Channels; i++) begin
      if (index_q == INDEX_W'(i)) begin
        result = results_i[i*axi_pkg::RESULT_W +: axi_pkg::RESULT_W];
        more   = mores_i[i*axi_pkg::MORE_W +: axi_pkg::MORE_W];
      end
    end
  end

  always_comb begin
    rdata = '0;
    unique case (addr)
      axi_regs_pkg::ADDR_SOFT_RESET:         rdata[0]    = cfg_q.soft_reset;
      axi_regs_pkg::ADDR_SAMPLE_CLOCK:       rdata[0]    = cfg_q.external_clock;
      axi_regs_pkg::ADDR_MODE:               rdata[0]    = cfg_q.single_point;
      axi_regs_pkg::ADDR_REQUEST:            rdata[0]    = cfg_q.request;
      axi_regs_pkg::ADDR_SAMPLE_DIVIDER:     rdata[27:0] = cfg_q.sample_divider;
      axi_regs_pkg::ADDR_MA_DIVIDER:         rdata[7:0]  = cfg_q.ma_divider;
      axi_regs_pkg::ADDR_POSITION_BITS:      rdata[7:0]  = cfg_q.position_bits;
      axi_regs_pkg::ADDR_CRC_CHECK:          rdata[0]    = cfg_q.crc_check;
      axi_regs_pkg::ADDR_CHANNEL_ENABLE:     rdata[15:0] = enable_q;
      axi_regs_pkg::ADDR_CHANNEL_INDEX:      rdata[INDEX_W-1:0] = index_q;
      axi_regs_pkg::ADDR_MA_SHIFT:           rdata[15:0] = ma_shift_q;
      axi_regs_pkg::ADDR_RECEIVED_CRC:
        rdata[15:0] = {more.received_high, result.received};
      axi_regs_pkg::ADDR_CALCULATED_CRC:
        rdata[15:0] = {more.calculated_high, result.calculated};
      axi_regs_pkg::ADDR_SINGLE_POINT_VALID: rdata[Channels-1:0] = single_valid_i;
      axi_regs_pkg::ADDR_SINGLE_POINT_DATA:  rdata       = result.single;
      axi_regs_pkg::ADDR_LINE_DELAY:         rdata[9:0]  = result.delay;
      axi_regs_pkg::ADDR_POSITION_HIGH:      rdata       = more.single_high;
      default:                               rdata       = '0;
    endcase
  end

  assign word_data_o = rdata | page_data_i;
  assign cfg_o       = cfg_q;
  assign index_o     = 4'(index_q);
  assign unused      = ^more;
  assign enable_o    = enable_q[Channels-1:0];
  assign ma_shift_o  = ma_shift_q[Channels-1:0];

endmodule
