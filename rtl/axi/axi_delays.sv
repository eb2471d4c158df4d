// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What line delays are good for beside sampling: an alarm for a delay that moves (Watch), and
// starts that are shifted so that all encoders latch at one instant (Align).
//
// Clock domain: core. After done_i the delays are looked at, one channel a clock (with Align two
// times). busy_o is high meanwhile: no start may come, and results must stay.
//
// - Watch: a channel has a reference and a bit that lets it be watched, in DELAY_REFERENCE of the
//   channel of index_i. A frame whose delay differs from it by more than DELAY_TOLERANCE sets the
//   channel's bit of DELAY_ALARM, and alarm_o for one clock. Frames without acknowledge, and starts
//   with SLO = 0, have a delay of 1023. Writing 1 clears a bit of DELAY_ALARM; so does clear_i.
// - Align: a channel with shift_i starts later, by half the difference between the largest delay of
//   all enabled channels and its own delay. The delays are those of the last frame. A channel that
//   got no acknowledge in it is not shifted and does not count. pending_o is high until the shifted
//   channel starts. Without Align start_o is start_i.
//
// Misuse: an index beyond the last channel reads 0 and ignores writes.
// Source: regmap/axi.rdl; docs/axi.md.

module axi_delays #(
  parameter int unsigned Channels = 1,
  parameter bit          Watch    = 1'b0,
  parameter bit          Align    = 1'b0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,                  // soft reset
  input  axi_pkg::bus_t bus_i,
  input  logic [3:0]  index_i,
  output logic [31:0] data_o,
  input  logic        done_i,
  input  logic [Channels-1:0] enabled_i,
  input  logic [Channels*axi_pkg::RESULT_W-1:0] results_i,
  input  logic [Channels-1:0] shift_i,
  input  logic        start_i,
  output logic [Channels-1:0] start_o,
  output logic [Channels-1:0] pending_o,
  output logic        busy_o,
  output logic        alarm_o
);

  localparam int unsigned INDEX_W = Channels > 1 ? $clog2(Channels) : 1;
  localparam logic [9:0]  NO_ACK  = 10'h3FF;

  logic               run_q;
  logic               second_q;    // Align: the second look
  logic [INDEX_W-1:0] place_q;
  logic               last;
  logic [9:0]         delay;       // of channel place_q
  logic               used;        // channel place_q is enabled
  logic               unused;

  assign last = place_q == INDEX_W'(Channels - 1);

  always_comb begin
    delay = '0;
    used  = 1'b0;
    for (int unsigned i = 0; i < Channels; i++) begin
      if (place_q == INDEX_W'(i)) begin
        delay = results_i[i*axi_pkg::RESULT_W + axi_pkg::RESULT_DELAY +: 10];
        used  = enabled_i[i];
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q    <= 1'b0;
      second_q <= 1'b0;
      place_q  <= '0;
    end else begin
      run_q    <= !clear_i && (done_i || (run_q && !(last && (second_q || !Align))));
      second_q <= Align && run_q && (second_q || last);
      place_q  <= (run_q && !last) ? place_q + INDEX_W'(1) : '0;
    end
  end

  assign busy_o = run_q;

  // ---- a delay that moves -------------------------------------------------------------------

  if (Watch) begin : gen_watch
    logic [9:0]             tolerance_q;
    logic [Channels*11-1:0] references;   // watched, reference
    logic [Channels-1:0]    alarms;
    logic [10:0]            reference;    // of channel place_q
    logic [10:0]            shown;        // of channel index_i
    logic [10:0]            more;
    logic [9:0]             less;
    logic                   moved;

    always_comb begin
      reference = '0;
      shown     = '0;
      for (int unsigned i = 0; i < Channels; i++) begin
        if (place_q == INDEX_W'(i)) reference = references[i*11 +: 11];
        if (index_i == 4'(i))       shown     = references[i*11 +: 11];
      end
    end

    // more is negative if the delay is less than the reference.
    assign more  = {1'b0, delay} - {1'b0, reference[9:0]};
    assign less  = reference[9:0] - delay;
    assign moved = run_q && !second_q && used && reference[10] &&
                   (more[10] ? less : more[9:0]) > tolerance_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) tolerance_q <= '0;
      else if (bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_DELAY_TOLERANCE)
        tolerance_q <= bus_i.data[9:0];
    end

    for (genvar i = 0; i < Channels; i++) begin : gen_channel
      logic [10:0] reference_q;
      logic        alarm_q;

      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) begin
          reference_q <= '0;
          alarm_q     <= 1'b0;
        end else begin
          if (bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_DELAY_REFERENCE && index_i == 4'(i))
            reference_q <= {bus_i.data[31], bus_i.data[9:0]};
          alarm_q <= !clear_i &&
                     ((moved && place_q == INDEX_W'(i)) ||
                      (alarm_q && !(bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_DELAY_ALARM &&
                                    bus_i.data[i])));
        end
      end

      assign references[i*11 +: 11] = reference_q;
      assign alarms[i]              = alarm_q;
    end

    always_comb begin
      data_o = '0;
      unique case (bus_i.addr)
        axi_regs_pkg::ADDR_DELAY_TOLERANCE: data_o[9:0] = tolerance_q;
        axi_regs_pkg::ADDR_DELAY_REFERENCE: data_o      = {shown[10], 21'd0, shown[9:0]};
        axi_regs_pkg::ADDR_DELAY_ALARM:     data_o[Channels-1:0] = alarms;
        default:                            data_o      = '0;
      endcase
    end

    assign alarm_o = moved;
  end else begin : gen_no_watch
    assign data_o  = '0;
    assign alarm_o = 1'b0;
  end

  // ---- shifted starts -----------------------------------------------------------------------

  if (Align) begin : gen_align
    logic [9:0] most_q;   // largest delay
    logic       known;
    logic [9:0] behind;   // difference to it

    assign known  = used && delay != NO_ACK;
    assign behind = most_q - delay;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni)                                             most_q <= '0;
      else if (!run_q)                                         most_q <= '0;
      else if (!second_q && known && delay > most_q)           most_q <= delay;
    end

    for (genvar i = 0; i < Channels; i++) begin : gen_channel
      logic [8:0] shift_q;   // clocks
      logic [8:0] left_q;
      logic       wait_q;
      logic       later;

      assign later = shift_i[i] && shift_q != 9'd0;

      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) begin
          shift_q <= '0;
          left_q  <= '0;
          wait_q  <= 1'b0;
        end else begin
          if (second_q && place_q == INDEX_W'(i)) shift_q <= known ? behind[9:1] : 9'd0;
          if (start_i || wait_q) left_q <= start_i ? shift_q - 9'd1 : left_q - 9'd1;
          wait_q <= !clear_i && enabled_i[i] &&
                    ((start_i && later) || (wait_q && left_q != 9'd0));
        end
      end

      assign start_o[i]   = (start_i && !later) || (wait_q && left_q == 9'd0);
      assign pending_o[i] = wait_q;
    end

    assign unused = behind[0];
  end else begin : gen_no_align
    assign start_o   = {Channels{start_i}};
    assign pending_o = '0;
    assign unused    = ^shift_i;
  end

  logic unused_bus;
  assign unused_bus = (^bus_i) ^ (^index_i) ^ (^results_i) ^ (^delay) ^ used;

endmodule
