// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the BiSS C master has beyond its document, as far as it is no part of a channel: the page,
// counters, line delays, register access, last words, eyes. Extras says which of them there are;
// without any nothing is built, and start_o is start_i. EXTRA_ALIGN acts without EXTRA_PAGE, the
// others do not.
//
// Clock domain: core. Latency and misuse: see the modules.
// Source: regmap/axi.rdl; docs/axi.md.

module axi_extras #(
  parameter int unsigned Channels = 1,
  parameter logic [axi_pkg::EXTRAS_W-1:0] Extras = '0
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  axi_pkg::switch_t switches_i,
  input  logic        clear_i,         // soft reset
  input  axi_pkg::bus_t bus_i,
  input  logic [3:0]  index_i,         // channel of the words for each channel
  output logic [31:0] data_o,
  output axi_pkg::page_t page_o,
  // frames
  input  logic        start_i,
  input  logic        skip_i,
  input  logic        done_i,
  input  logic        sense_i,
  input  logic        overrun_i,
  input  logic        check_i,         // of the CRC of this frame
  input  logic [Channels-1:0] enabled_i,
  input  logic [Channels-1:0] good_i,
  input  logic [Channels*axi_pkg::EVENT_W-1:0]  events_i,
  input  logic [Channels*axi_pkg::RESULT_W-1:0] results_i,
  input  logic [Channels*axi_pkg::WORD_W-1:0]   words_i,
  input  logic [Channels*axi_pkg::MORE_W-1:0]   mores_i,
  input  logic [Channels*axi_pkg::EYE_W-1:0]    eyes_i,
  input  logic [Channels-1:0] ma_shift_i,
  output logic [Channels-1:0] start_o,
  output logic [Channels-1:0] pending_o,   // a shifted start is to come
  output logic        measuring_o,         // results must stay
  output logic [Channels*2-1:0] cdm_o,
  // time base
  input  logic        tick_i,
  input  logic        half_next_i,
  output logic        irq_o
);

  localparam bit WATCH = Extras[axi_pkg::EXTRA_ALARM];
  // A single channel has nothing to be aligned to.
  localparam bit ALIGN = Extras[axi_pkg::EXTRA_ALIGN] && Channels > 1;

  logic [31:0] page_data, counter_data, delay_data, access_data, last_data, eye_data;
  logic        delay_alarm, eye_alarm, access_end;
  logic        unused;

  if (Extras[axi_pkg::EXTRA_PAGE]) begin : gen_page
    axi_page #(.Channels(Channels), .Extras(Extras)) u_page (
      .clk_i,
      .rst_ni,
      .switches_i,
      .clear_i,
      .bus_i,
      .data_o       (page_data),
      .page_o,
      .start_i,
      .skip_i,
      .done_i,
      .bad_i        ((enabled_i & ~good_i) != '0),
      .alarm_i      (delay_alarm || eye_alarm),
      .access_end_i (access_end),
      .sense_i,
      .overrun_i,
      .tick_i,
      .half_next_i,
      .irq_o
    );
  end else begin : gen_no_page
    assign page_data = '0;
    assign page_o    = '0;
    assign irq_o     = 1'b0;
  end

  if (Extras[axi_pkg::EXTRA_COUNTERS]) begin : gen_counters
    axi_counters #(.Channels(Channels)) u_counters (
      .clk_i,
      .rst_ni,
      .clear_i,
      .bus_i,
      .index_i,
      .events_i,
      .data_o   (counter_data)
    );
  end else begin : gen_no_counters
    assign counter_data = '0;
  end

  if (WATCH || ALIGN) begin : gen_delays
    axi_delays #(.Channels(Channels), .Watch(WATCH), .Align(ALIGN)) u_delays (
      .clk_i,
      .rst_ni,
      .clear_i,
      .bus_i,
      .index_i,
      .data_o    (delay_data),
      .done_i,
      .enabled_i,
      .results_i,
      .shift_i   (ma_shift_i & {Channels{switches_i.align_latch}}),
      .start_i,
      .start_o,
      .pending_o,
      .busy_o    (measuring_o),
      .alarm_o   (delay_alarm)
    );
  end else begin : gen_no_delays
    assign delay_data  = '0;
    assign start_o     = {Channels{start_i}};
    assign pending_o   = '0;
    assign measuring_o = 1'b0;
    assign delay_alarm = 1'b0;
  end

  if (Extras[axi_pkg::EXTRA_ACCESS]) begin : gen_access
    axi_access #(.Channels(Channels)) u_access (
      .clk_i,
      .rst_ni,
      .clear_i,
      .bus_i,
      .data_o   (access_data),
      .events_i,
      .cdm_o,
      .end_o    (access_end)
    );
  end else begin : gen_no_access
    assign access_data = '0;
    assign cdm_o       = '0;
    assign access_end  = 1'b0;
  end

  if (Extras[axi_pkg::EXTRA_LAST]) begin : gen_last
    axi_last #(.Channels(Channels), .Wide(Extras[axi_pkg::EXTRA_WIDE])) u_last (
      .clk_i,
      .rst_ni,
      .clear_i,
      .bus_i,
      .index_i,
      .data_o    (last_data),
      .start_i,
      .check_i,
      .enabled_i,
      .events_i,
      .words_i,
      .mores_i
    );
  end else begin : gen_no_last
    assign last_data = '0;
  end

  if (Extras[axi_pkg::EXTRA_FRAME_SAMPLER]) begin : gen_eye
    axi_eye #(.Channels(Channels)) u_eye (
      .clk_i,
      .rst_ni,
      .clear_i,
      .bus_i,
      .index_i,
      .data_o   (eye_data),
      .events_i,
      .eyes_i,
      .alarm_o  (eye_alarm)
    );
  end else begin : gen_no_eye
    assign eye_data  = '0;
    assign eye_alarm = 1'b0;
  end

  assign data_o = page_data | counter_data | delay_data | access_data | last_data | eye_data;
  assign unused = (^switches_i) ^ (^bus_i) ^ (^index_i) ^ (^events_i) ^ (^results_i) ^
                  (^words_i) ^ (^mores_i) ^ (^eyes_i) ^ check_i ^
                  (^ma_shift_i) ^ (^enabled_i) ^ (^good_i) ^ skip_i ^ done_i ^ sense_i ^ overrun_i ^
                  clear_i ^ clk_i ^ rst_ni ^ tick_i ^ half_next_i ^ delay_alarm ^ eye_alarm ^
                  access_end;

endmodule
