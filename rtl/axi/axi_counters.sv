// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Counters of each channel: frames that have ended, good or not (32 bits), CRC errors and late
// starts (16 bits each). They wrap. The words show the channel of index_i.
//
// Clock domain: core. A counter moves one clock after its event. clear_i sets all to 0.
//
// Misuse: an index beyond the last channel reads 0.
// Source: regmap/axi.rdl.

module axi_counters #(
  parameter int unsigned Channels = 1
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,
  input  axi_pkg::bus_t bus_i,
  input  logic [3:0]  index_i,
  input  logic [Channels*axi_pkg::EVENT_W-1:0] events_i,
  output logic [31:0] data_o
);

  localparam int unsigned W = 64;

  logic [Channels*W-1:0] counts;   // frames, CRC errors, late starts of each channel
  logic [W-1:0]          shown;
  logic                  unused;

  for (genvar i = 0; i < Channels; i++) begin : gen_channel
    localparam int unsigned AT = i * axi_pkg::EVENT_W;
    logic [31:0] frames_q;
    logic [15:0] crc_errors_q;
    logic [15:0] lates_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        frames_q     <= '0;
        crc_errors_q <= '0;
        lates_q      <= '0;
      end else if (clear_i) begin
        frames_q     <= '0;
        crc_errors_q <= '0;
        lates_q      <= '0;
      end else begin
        frames_q     <= frames_q + 32'(events_i[AT + axi_pkg::EVENT_ENDED] ||
                                       events_i[AT + axi_pkg::EVENT_FAILED]);
        crc_errors_q <= crc_errors_q + 16'(events_i[AT + axi_pkg::EVENT_CRC_ERROR]);
        lates_q      <= lates_q + 16'(events_i[AT + axi_pkg::EVENT_LATE]);
      end
    end

    assign counts[i*W +: W] = {frames_q, crc_errors_q, lates_q};
  end

  always_comb begin
    shown = '0;
    for (int unsigned i = 0; i < Channels; i++)
      if (index_i == 4'(i)) shown = counts[i*W +: W];
  end

  always_comb begin
    data_o = '0;
    unique case (bus_i.addr)
      axi_regs_pkg::ADDR_FRAME_COUNT:     data_o       = shown[63:32];
      axi_regs_pkg::ADDR_CRC_ERROR_COUNT: data_o[15:0] = shown[31:16];
      axi_regs_pkg::ADDR_LATE_COUNT:      data_o[15:0] = shown[15:0];
      default:                            data_o       = '0;
    endcase
  end

  assign unused = (^events_i) ^ bus_i.rd ^ bus_i.wr ^ (^bus_i.data);

endmodule
