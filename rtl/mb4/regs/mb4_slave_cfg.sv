// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Configuration of the eight data channels, 0xC0..0xDF, in rows of four bytes. The host reads one
// copy of it; rd_data_o is 0 after a read of another address, and with one data channel, where
// mb4_recent reads the row back. Each word list reads a copy of its own, in which the CRC choice is
// decoded (mb4_crc_code, mb4_crc_decode): the host's write does it once for all of them.
//
// Clock domains: host (wr_clk_i writes, rd_clk_i reads); the word lists read in the core clock.
// Only the word lists need the core clock.
// Latency: read data are valid after the edge with the enable, until the next read.
//
// A reset does not clear a memory. rows_q tells which rows have been written since the reset; the
// first byte that is written to a row clears the other three. A word list uses only rows whose
// ENSCDx is set, so it never uses a row that has not been written. Like mb4_cfg_regs the rows are
// quasi-static for the core.
// Data channels that are not in Channels read 0, and they are never enabled.
// Datasheet: pages 23..26, Tables 11..19.

module mb4_slave_cfg #(
  parameter int unsigned Lists = 4,
  parameter logic [7:0]  Channels = 8'hFF,
  parameter bit          FreeCrc  = 1'b1    // 0: only the CRCs 0x43 and 16 bits (biss_rx_word)
) (
  // host
  input  logic        wr_clk_i,
  input  logic        rst_ni,
  input  mb4_pkg::host_t host_i,
  input  logic        rd_clk_i,
  output logic [7:0]  rd_data_o,
  // word lists, one slice for each
  input  logic        clk_i,
  output logic [mb4_pkg::NUM_SLAVES-1:0]        enscd_o,
  input  logic [Lists-1:0]                      list_en_i,
  input  logic [3*Lists-1:0]                    list_slave_i,
  output logic [mb4_pkg::SLAVE_CFG_W*Lists-1:0] list_cfg_o
);

  localparam bit ONE = Channels == 8'h01;   // one row
  localparam int unsigned CODES = ONE ? 1 : 2;
  localparam logic [7:0]  CODE_CRC6 = 8'h21;   // mb4_crc_code
  localparam int unsigned CFG_W = mb4_pkg::SLAVE_CFG_W;

  logic        write;
  logic [2:0]  row;
  logic [3:0]  byte_en;
  logic [7:0]  crc_byte;
  // crc_byte decoded for both values of its bit 0. Kept, because that bit comes late over SPI.
  (* keep *) logic [12*CODES-1:0] crc;

  logic [CODES-1:0] ends;
  logic        unused;

  assign unused  = ^{list_slave_i, ends, host_i, rd_clk_i};   // one row needs less

  assign write   = host_i.wr_en && host_i.wr_addr[7:5] == mb4_regs_pkg::ADDR_SLAVE_CFG[7:5];
  assign row     = host_i.wr_addr[4:2];
  assign byte_en = 4'b0001 << host_i.wr_addr[1:0];

  // Bit 0 of a byte comes late over SPI. So the memories get the row of one of its two values.
  for (genvar k = 0; k < CODES; k++) begin : gen_code
    logic       bit0;
    logic       on;
    logic [3:0] last;
    logic [7:0] code, poly;

    assign bit0 = ONE ? crc_byte[0]
                      : k != 0 && byte_en[mb4_regs_pkg::SLAVE_CFG_CRC_OFFSET[1:0]];

    mb4_crc_code u_code (
      .selcrc_i (crc_byte[mb4_regs_pkg::SELCRCS_LSB]),
      .code_i   ({crc_byte[6:1], bit0}),
      .poly_o   (code)
    );

    mb4_crc_decode u_decode (
      .poly_i     (code),
      .crc_on_o   (on),
      .crc_last_o (last),
      .crc_poly_o (poly)
    );

    // Every polynomial ends in 1. Without FreeCrc enc_crc needs no polynomial, and biss_rx_word
    // only tells the one of six bits from others.
    assign ends[k] = poly[0];
    assign crc[12*k +: 12] = {on, last, FreeCrc || code == CODE_CRC6 ? poly[7:1] : 7'd0};
  end

  if (ONE) begin : gen_row
    // A single row is four registers.
    logic [31:0] row_q;

    always_ff @(posedge wr_clk_i or negedge rst_ni) begin
      if (!rst_ni) row_q <= '0;
      else if (write && row == 3'd0) begin
        if (byte_en[0]) row_q[7:0]   <= host_i.wr_data;
        if (byte_en[1]) row_q[15:8]  <= host_i.wr_data;
        if (byte_en[2]) row_q[23:16] <= host_i.wr_data;
        if (byte_en[3]) row_q[31:24] <= host_i.wr_data;
      end
    end

    assign crc_byte  = row_q[32'd8 * 32'(mb4_regs_pkg::SLAVE_CFG_CRC_OFFSET) +: 8];
    assign rd_data_o = '0;   // mb4_recent has the bytes
    assign enscd_o   = {7'd0, row_q[32'd8 * 32'(mb4_regs_pkg::SLAVE_CFG_LENGTH_OFFSET) +
                                 mb4_regs_pkg::ENSCD_LSB]};

    // A word list keeps the row from the clock in which it reads it, as from a memory.
    for (genvar i = 0; i < Lists; i++) begin : gen_list
      logic [CFG_W-1:0] cfg_q;

      always_ff @(posedge clk_i) begin
        if (list_en_i[i]) begin
          cfg_q <= {row_q[31:16], crc, row_q[7:0]};
        end
      end

      assign list_cfg_o[CFG_W*i +: CFG_W] = cfg_q;
    end
  end else begin : gen_rows
    logic [7:0]  rows_q;
    logic [7:0]  enscd_q;
    logic [3:0]  wr_en;
    logic [31:0] wr_data;
    logic [31:0] rd_data;
    logic [3:0]  sel_q;     // byte of the row that the host reads; 0: another address, not written

    assign wr_en   = write ? byte_en | {4{!rows_q[row]}} : 4'b0000;
    assign wr_data = {4{host_i.wr_data}} & {{8{byte_en[3]}}, {8{byte_en[2]}},
                                            {8{byte_en[1]}}, {8{byte_en[0]}}};

    assign crc_byte = wr_data[32'd8 * 32'(mb4_regs_pkg::SLAVE_CFG_CRC_OFFSET) +: 8];

    always_ff @(posedge wr_clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        rows_q  <= '0;
        enscd_q <= '0;
      end else if (write) begin
        rows_q[row] <= 1'b1;
        if (byte_en[mb4_regs_pkg::SLAVE_CFG_LENGTH_OFFSET[1:0]]) begin
          enscd_q[row] <= host_i.wr_data[mb4_regs_pkg::ENSCD_LSB];
        end
      end
    end

    enc_ram_row u_host (
      .wr_clk_i,
      .wr_en_i   (wr_en),
      .wr_addr_i (row),
      .wr_data_i (wr_data),
      .rd_clk_i,
      .rd_en_i   (host_i.rd_en),
      .rd_addr_i (host_i.rd_addr[4:2]),
      .rd_data_o (rd_data)
    );

    // One select bit for each byte: half an SCLK period is left for the path to MISO.
    always_ff @(posedge rd_clk_i or negedge rst_ni) begin
      if (!rst_ni) sel_q <= '0;
      else if (host_i.rd_en) begin
        sel_q <= 4'(host_i.rd_addr[7:5] == mb4_regs_pkg::ADDR_SLAVE_CFG[7:5] &&
                    rows_q[host_i.rd_addr[4:2]] && Channels[host_i.rd_addr[4:2]])
                 << host_i.rd_addr[1:0];
      end
    end

    assign rd_data_o = (rd_data[7:0]   & {8{sel_q[0]}}) | (rd_data[15:8]  & {8{sel_q[1]}}) |
                       (rd_data[23:16] & {8{sel_q[2]}}) | (rd_data[31:24] & {8{sel_q[3]}});

    for (genvar i = 0; i < Lists; i++) begin : gen_list
      enc_ram_row #(.Field1(12)) u_list (
        .wr_clk_i,
        .wr_en_i   (wr_en),
        .wr_addr_i (row),
        .wr_data_i ({wr_data[31:16], host_i.wr_data[0] ? crc[12*(CODES-1) +: 12] : crc[11:0],
                     wr_data[7:0]}),
        .rd_clk_i  (clk_i),
        .rd_en_i   (list_en_i[i]),
        .rd_addr_i (list_slave_i[3*i +: 3]),
        .rd_data_o (list_cfg_o[CFG_W*i +: CFG_W])
      );
    end

    assign enscd_o = enscd_q & Channels;
  end

endmodule
