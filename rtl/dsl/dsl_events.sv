// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Events of the line, of safe channels and of messages: their bits for two hosts with masks, their
// state now, POSTX, and the interrupts.
//
// Clock domain: core. stores_i tells in one clock which byte the host writes; byte_i goes with it.
// Events set their bits with the record of their frame (tell_i), messages, POS and PRST at once.
// Writing 0 clears a bit; a set in the clock of a write wins (R18). A start of a message clears its
// bit FREL or FRES.
// INT and SINT are not bits of their own: they follow events and masks, and rise one clock behind.
// causes_o has one clock for each of the five interrupts of the published master; they set bits of
// the interrupt status. irq_o is 1 while a bit of it is set and enabled.
// Misuse: a write of INT or SINT is ignored. Masks of bits that do not exist have no effect.
// Source: regmap/dsl.rdl, regmap/dsl_page.rdl; docs/dsl.md, "Events".

module dsl_events (
  input  logic                   clk_i,
  input  logic                   rst_ni,
  input  logic                   sdk_map_i,
  // line and position
  input  dsl_pkg::answer_t       answer_i,
  input  logic [3:0]             state_i,      // dsl_pkg::state_e
  input  logic                   low_i,        // the quality is
  input  logic                   ended_i,
  input  logic                   edge_i,       // of SAMPLE
  input  dsl_pkg::told_t         told_i,
  input  logic                   lost_i,
  input  logic                   tell_i,
  input  logic                   record_write_i,
  input  logic [5:0]             record_address_i,
  input  logic [7:0]             record_byte_i,
  input  dsl_pkg::messages_t     messages_i,
  input  dsl_pkg::message_events_t message_events_i,
  input  dsl_pkg::orders_t       orders_i,
  // host
  input  dsl_pkg::event_stores_t stores_i,
  input  logic [7:0]             byte_i,
  output dsl_pkg::event_bytes_t  bytes_o,
  output dsl_pkg::causes_t       causes_o,
  output logic                   irq_o
);

  localparam logic [5:0] SUMMARY_PLACE = 6'd37;   // in the record
  localparam logic [5:0] STATUS2_PLACE = 6'd45;

  logic       gap_q;             // the last state was the gap
  logic       lost_q, linked_q;
  logic       frame_q;           // the record is one of a running frame
  logic       vertical_q;        // ... of the last one in a vertical frame
  logic       summary_q;         // a bit of the record's summary that counts is 1
  logic       any_q;             // a bit of it
  logic       sum2_q;            // TEST2 or ERR2 of its STATUS2
  logic [7:0] record_q;          // the last byte of a record
  logic       is_summary_q, is_status2_q;
  logic       ready;             // the record of a running frame is complete
  logic       whole;             // ... and ends a vertical frame
  logic       falls;             // the position or the link is lost
  logic       linked, low, sce;
  logic       pos, prst, qmlw, vpos;
  logic [7:0] h, l, s;           // events that come
  logic [7:0] h_q, l_q, s_q;
  logic [7:0] mask_h_q, mask_l_q, mask_s_q, mask_sum_q;
  logic [7:0] online_d_h, online_d_l, online_1_h, online_1_l, online_2_h;
  logic       main, main_q, safe, safe_q;   // INT, SINT
  logic [1:0] postx_q;
  logic [6:0] causes, status_q, enable_q;
  logic       unused;

  assign linked = answer_i.linked;
  assign ready  = tell_i && frame_q;
  assign whole  = ready && vertical_q;
  assign falls  = (lost_i && !lost_q) || (linked_q && !linked);
  assign low    = low_i && linked;
  assign sce    = told_i.safe1_error || told_i.safe2_error;
  assign pos    = (lost_i && !lost_q) || (tell_i && lost_i && linked);
  assign prst   = gap_q && state_i != dsl_pkg::GAP_STATE;
  assign qmlw   = ended_i && low_i && (linked || answer_i.running);
  assign vpos   = whole && told_i.checks.marked1;

  // ---- Events -----------------------------------------------------------------------------------

  always_comb begin
    h = '0;
    h[dsl_regs_pkg::SUM_LSB]        = whole && told_i.safe1_valid && summary_q;
    h[dsl_regs_pkg::SCE_LSB]        = whole && sce;
    h[dsl_regs_pkg::POS_LSB]        = pos;
    h[dsl_regs_pkg::VPOS_LSB]       = vpos;
    h[dsl_regs_pkg::EVENT_PRST_LSB] = prst;
    l = '0;
    l[dsl_regs_pkg::MIN_LSB]        = message_events_i.min;
    l[dsl_regs_pkg::ANS_LSB]        = message_events_i.ans;
    l[dsl_regs_pkg::QMLW_LSB]       = qmlw;
    l[dsl_regs_pkg::FREL_LSB]       = message_events_i.frel;
    l[dsl_regs_pkg::FRES_LSB]       = message_events_i.fres;
    s = '0;
    s[dsl_regs_pkg::SSUM_LSB]       = whole && told_i.safe1_valid && any_q;
    s[dsl_regs_pkg::S_SCE_LSB]      = whole && told_i.safe1_error;
    s[dsl_regs_pkg::S_VPOS_LSB]     = vpos;
    s[dsl_regs_pkg::S_QMLW_LSB]     = qmlw;
    s[dsl_regs_pkg::S_PRST_LSB]     = prst;
    s[dsl_regs_pkg::S_MIN_LSB]      = message_events_i.min;
    s[dsl_regs_pkg::S_FRES_LSB]     = message_events_i.safe_fres;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {h_q, l_q, s_q}                <= '0;
      {mask_h_q, mask_l_q, mask_s_q} <= '0;
      mask_sum_q                     <= '0;
      {main_q, safe_q}               <= '0;
    end else begin
      h_q <= (h_q & (byte_i | {8{!stores_i.event_h}})) | h;
      l_q <= (l_q & (byte_i | {8{!stores_i.event_l}})) | l;
      s_q <= (s_q & (byte_i | {8{!stores_i.event_s}})) | s;
      if (orders_i.starts_long) l_q[dsl_regs_pkg::FREL_LSB]   <= 1'b0;
      if (orders_i.starts_main) l_q[dsl_regs_pkg::FRES_LSB]   <= 1'b0;
      if (orders_i.starts_safe) s_q[dsl_regs_pkg::S_FRES_LSB] <= 1'b0;
      if (stores_i.mask_h)   mask_h_q   <= byte_i;
      if (stores_i.mask_l)   mask_l_q   <= byte_i;
      if (stores_i.mask_s)   mask_s_q   <= byte_i;
      if (stores_i.mask_sum) mask_sum_q <= byte_i;
      main_q <= main;
      safe_q <= safe;
    end
  end

  assign main = ((h_q & mask_h_q) | (l_q & mask_l_q)) != 8'd0;
  assign safe = (s_q & mask_s_q) != 8'd0;

  // ---- What they come from ----------------------------------------------------------------------

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      gap_q      <= 1'b0;
      lost_q     <= 1'b1;
      linked_q   <= 1'b0;
      frame_q    <= 1'b0;
      vertical_q <= 1'b0;
      summary_q  <= 1'b0;
      any_q      <= 1'b0;
      sum2_q     <= 1'b0;
      record_q   <= '0;
      {is_summary_q, is_status2_q} <= '0;
      postx_q    <= '0;
    end else begin
      gap_q    <= state_i == dsl_pkg::GAP_STATE;
      lost_q   <= lost_i;
      linked_q <= linked;
      if (answer_i.ends && answer_i.running) begin
        frame_q    <= 1'b1;
        vertical_q <= answer_i.place == dsl_pkg::LAST_PLACE;
      end else if (tell_i) begin
        frame_q <= 1'b0;
      end
      record_q     <= record_byte_i;
      is_summary_q <= record_write_i && record_address_i == SUMMARY_PLACE;
      is_status2_q <= record_write_i && record_address_i == STATUS2_PLACE;
      if (is_summary_q) begin
        summary_q <= (record_q & mask_sum_q) != 8'd0;
        any_q     <= record_q != 8'd0;
      end
      if (is_status2_q) sum2_q <= record_q[6:5] != 2'd0;
      if (ready)       postx_q <= {1'b1, sdk_map_i && whole && told_i.safe1_valid};
      else if (edge_i) postx_q <= 2'd0;
      if (whole && !sdk_map_i && (told_i.safe1_valid || told_i.safe2_valid)) begin
        postx_q <= {told_i.safe2_valid, 1'b1};
      end
    end
  end

  // ---- As it is now -----------------------------------------------------------------------------

  always_comb begin
    online_d_h = '0;
    online_d_h[dsl_regs_pkg::NOW_INT_LSB]   = main;
    online_d_h[dsl_regs_pkg::NOW_SUM_LSB]   = summary_q && linked;
    online_d_h[dsl_regs_pkg::NOW_SCE_LSB]   = sce && linked;
    online_d_h[dsl_regs_pkg::NOW_ONE_LSB]   = 1'b1;
    online_d_h[dsl_regs_pkg::NOW_POS_LSB]   = lost_i;
    online_d_h[dsl_regs_pkg::NOW_VPOS_LSB]  = told_i.checks.marked1 && linked;
    online_d_h[dsl_regs_pkg::NOW_PRST_LSB]  = !linked;
    online_d_l = '0;
    online_d_l[dsl_regs_pkg::NOW_MIN_LSB]   = messages_i.renewed;
    online_d_l[dsl_regs_pkg::NOW_ANS_LSB]   = messages_i.failed;
    online_d_l[dsl_regs_pkg::NOW_QMLW_LSB]  = low;
    online_d_l[dsl_regs_pkg::NOW_FREL_LSB]  = answer_i.running && !messages_i.long_runs;
    online_d_l[dsl_regs_pkg::NOW_FRES_LSB]  = answer_i.running && !messages_i.main_runs;
    online_1_h = '0;
    online_1_h[dsl_regs_pkg::NOW_SINT_LSB]  = safe;
    online_1_h[dsl_regs_pkg::NOW_SSUM_LSB]  = any_q && linked;
    online_1_h[dsl_regs_pkg::NOW1_SCE_LSB]  = told_i.safe1_error && linked;
    online_1_h[dsl_regs_pkg::NOW1_ONE_LSB]  = 1'b1;
    online_1_h[dsl_regs_pkg::NOW1_VPOS_LSB] = told_i.checks.marked1 && linked;
    online_1_h[dsl_regs_pkg::NOW1_PRST_LSB] = !linked;
    online_1_l = '0;
    online_1_l[dsl_regs_pkg::NOW1_MIN_LSB]  = messages_i.renewed;
    online_1_l[dsl_regs_pkg::NOW1_QMLW_LSB] = low;
    online_1_l[dsl_regs_pkg::NOW1_FRES_LSB] = answer_i.running && !messages_i.safe_runs;
    online_2_h = '0;
    online_2_h[dsl_regs_pkg::NOW2_SUM2_LSB]  = sum2_q && linked;
    online_2_h[dsl_regs_pkg::NOW2_SCE2_LSB]  = told_i.safe2_error && linked;
    online_2_h[dsl_regs_pkg::NOW2_ONE_LSB]   = 1'b1;
    online_2_h[dsl_regs_pkg::NOW2_VPOS2_LSB] = told_i.checks.marked2 && linked;
    online_2_h[dsl_regs_pkg::NOW2_PRST_LSB]  = !linked;
  end

  assign bytes_o.event_h    = {main, h_q[6:0]};
  assign bytes_o.event_l    = l_q;
  assign bytes_o.event_s    = {safe, s_q[6:0]};
  assign bytes_o.online_d_h = online_d_h;
  assign bytes_o.online_d_l = online_d_l;
  assign bytes_o.online_1_h = online_1_h;
  assign bytes_o.online_1_l = online_1_l;
  assign bytes_o.online_2_h = online_2_h;
  assign bytes_o.low        = low;
  assign bytes_o.postx      = postx_q;
  assign bytes_o.irq_status = status_q;
  assign bytes_o.irq_enable = enable_q;

  // ---- Interrupts -------------------------------------------------------------------------------

  assign causes_o.main_event = main && !main_q;
  assign causes_o.safe1      = whole && told_i.safe1_valid;
  assign causes_o.safe2      = whole && told_i.safe2_valid;
  assign causes_o.frame      = ready;
  assign causes_o.safe_event = safe && !safe_q;
  // A frame that ends while its bit is still set sets FRAME_LOST.
  always_comb begin
    causes = '0;
    causes[dsl_page_regs_pkg::SAFE2_READY_LSB] = causes_o.safe2;
    causes[dsl_page_regs_pkg::SAFE1_READY_LSB] = causes_o.safe1;
    causes[dsl_page_regs_pkg::FRAME_LOST_LSB]  = ready
                                               && status_q[dsl_page_regs_pkg::FRAME_ENDED_LSB];
    causes[dsl_page_regs_pkg::SAFE_EVENT_LSB]  = causes_o.safe_event;
    causes[dsl_page_regs_pkg::EVENT_LSB]       = causes_o.main_event;
    causes[dsl_page_regs_pkg::LINK_LOST_LSB]   = falls;
    causes[dsl_page_regs_pkg::FRAME_ENDED_LSB] = ready;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      status_q <= '0;
      enable_q <= '0;
    end else begin
      status_q <= (status_q & ~(byte_i[6:0] & {7{stores_i.irq_status}})) | causes;
      if (stores_i.irq_enable) enable_q <= byte_i[6:0];
    end
  end

  assign irq_o  = (status_q & enable_q) != 7'd0;
  assign unused = ^{answer_i.begins, answer_i.valid, answer_i.number, answer_i.word, h_q[7], s_q[7],
                    told_i.acceleration_good, told_i.acceleration_marked, told_i.missing,
                    told_i.checks, messages_i.resets, orders_i.resets};

endmodule
