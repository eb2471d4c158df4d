// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The eye of each line: how many clocks of a bit were without an edge in the last frame, the
// smallest of them since the register was read, and an alarm below a limit. EYE shows the channel
// of index_i.
//
// Clock domain: core. An access never waits. Reading EYE begins the smallest width anew, with the
// last frame if that has a width; so does a soft reset. A frame without a width leaves it, and EYE
// shows it again behind the next one that has one. EYE_ALARM looks at each frame once, two clocks
// after its end; alarm_o is high for this clock. A frame without a width sets no alarm.
//
// Misuse: an index beyond the last channel reads 0.
// Source: regmap/axi.rdl; docs/samplers.md.

module axi_eye #(
  parameter int unsigned Channels = 1
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,      // soft reset
  input  axi_pkg::bus_t bus_i,
  input  logic [3:0]  index_i,
  output logic [31:0] data_o,
  input  logic [Channels*axi_pkg::EVENT_W-1:0] events_i,
  input  logic [Channels*axi_pkg::EYE_W-1:0]   eyes_i,
  output logic        alarm_o
);

  localparam logic [4:0] NONE = 5'd31;

  logic [4:0]          limit_q;
  logic [Channels-1:0] narrow;        // alarm_o by channels
  logic [Channels-1:0] alarms;
  logic [Channels*5-1:0] smallests;
  logic                rd_eye, wr_alarm;
  axi_pkg::eye_t       eye;           // of the channel of index_i
  logic [4:0]          smallest;
  logic                unused;

  assign rd_eye   = bus_i.rd && bus_i.addr == axi_regs_pkg::ADDR_EYE;
  assign wr_alarm = bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_EYE_ALARM;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                                                   limit_q <= '0;
    else if (bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_EYE_LIMIT) limit_q <= bus_i.data[4:0];
  end

  for (genvar i = 0; i < Channels; i++) begin : gen_channel
    logic       valid;
    logic [4:0] width;
    logic       less;
    logic       ended_q;
    logic       alarm_q;
    logic [4:0] smallest_q;

    assign valid = eyes_i[i*axi_pkg::EYE_W + axi_pkg::EYE_VALID];
    assign width = eyes_i[i*axi_pkg::EYE_W + axi_pkg::EYE_WIDTH +: 5];

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        ended_q    <= 1'b0;
        alarm_q    <= 1'b0;
        smallest_q <= NONE;
      end else begin
        ended_q <= events_i[i*axi_pkg::EVENT_W + axi_pkg::EVENT_ENDED];
        alarm_q <= !clear_i && (narrow[i] || (alarm_q && !(wr_alarm && bus_i.data[i])));
        if (clear_i)                         smallest_q <= NONE;
        else if (rd_eye && index_i == 4'(i)) smallest_q <= valid ? width : NONE;
        else if (less)                       smallest_q <= width;
      end
    end

    assign narrow[i]          = ended_q && valid && width < limit_q;
    assign alarms[i]          = alarm_q;
    assign less                = valid && width < smallest_q;
    assign smallests[i*5 +: 5] = less ? width : smallest_q;
  end

  always_comb begin
    eye      = '0;
    smallest = '0;
    for (int unsigned i = 0; i < Channels; i++) begin
      if (index_i == 4'(i)) begin
        eye      = eyes_i[i*axi_pkg::EYE_W +: axi_pkg::EYE_W];
        smallest = smallests[i*5 +: 5];
      end
    end
  end

  // The sampling point is in the middle, or half a clock before it.
  always_comb begin
    data_o = '0;
    unique case (bus_i.addr)
      axi_regs_pkg::ADDR_EYE: begin
        data_o[31]    = eye.valid;
        data_o[30]    = eye.used;
        if (eye.valid) begin
          data_o[28:25] = eye.width[4:1];
          data_o[24:21] = eye.width[4:1] - 4'(!eye.width[0]);
          data_o[20:16] = smallest;
          data_o[12:8]  = eye.point;
          data_o[4:0]   = eye.width;
        end
      end
      axi_regs_pkg::ADDR_EYE_LIMIT: data_o[4:0]          = limit_q;
      axi_regs_pkg::ADDR_EYE_ALARM: data_o[Channels-1:0] = alarms;
      default:                      data_o               = '0;
    endcase
  end

  assign alarm_o = |narrow;
  assign unused  = (^events_i) ^ (^bus_i);

endmodule
