// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers of the DSL master on a bus of words. An access takes its four bytes one after another:
// dsl_map says what stands there, so a byte costs no decoder, and the records stay in their memory.
//
// Clock domain: core. word_req_i and what comes with it stay up to the clock with word_ready_o,
// which is the seventh one of an access: word_data_o is right in it. If a number of more than one
// byte changes meanwhile, a read begins anew; one of TIME_LOW waits 9 to 17 clocks for the time.
// word_data_o of a write is undefined; it stays up to the second clock of the next access, also
// through a reset.
// record_data_i is the byte that record_*_o has asked for, one clock later. hold_o is 1 while PRST
// is, in the personality of the SDK for one clock.
//
// irq_o is 1 while an interrupt is set and enabled. Events set their bits with the record of their
// frame (tell_i), POS and EVENT_PRST at once; a set in the clock of a write wins.
// Misuse: addresses without a register read 0 and ignore writes. A request that falls before
// word_ready_o is forgotten; a write may then have been done or not.
// Source: regmap/dsl.rdl, regmap/dsl_page.rdl; docs/dsl.md.

module dsl_regs (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  input  dsl_pkg::quirks_t      quirks_i,
  // word bus
  input  logic                  word_req_i,
  input  logic                  word_write_i,
  input  logic [11:2]           word_addr_i,
  input  logic [31:0]           word_data_i,
  input  logic [3:0]            word_be_i,
  output logic                  word_ready_o,
  output logic [31:0]           word_data_o,
  // what the host sets
  output logic                  hold_o,
  output logic                  driver_off_o,
  output logic [4:0]            limit_o,       // of missing accelerations
  // line and position
  input  dsl_pkg::answer_t      answer_i,
  input  dsl_pkg::line_status_t status_i,
  input  logic                  ended_i,
  input  dsl_pkg::told_t        told_i,
  input  logic                  lost_i,
  input  logic                  tell_i,
  output logic                  ready_o,       // the record of a running frame is complete
  // records
  input  logic                  record_write_i,
  input  logic [5:0]            record_address_i,
  input  logic [7:0]            record_byte_i,
  output logic                  record_read_o,
  output logic                  record_hold_o,
  output logic [2:0]            record_group_o,
  output logic [5:0]            record_address_o,
  input  logic [7:0]            record_data_i,
  // time
  output logic                  time_copy_o,
  input  logic                  time_copied_i,
  output logic [2:0]            time_address_o,
  input  logic [7:0]            time_data_i,
  output logic                  irq_o
);

  localparam logic [2:0] LAST_STEP     = 3'd6;
  localparam logic [2:0] LAST_PLACE    = 3'd7;
  localparam logic [5:0] SUMMARY_PLACE = 6'd37;   // in the record
  localparam logic [2:0] AGES          = 3'd6;    // in the record: places 48 to 55
  localparam logic [7:0] SDK_VERSION   = 8'h10;

  // An access.
  logic [2:0]         step_d, step_q;    // byte of dsl_map, behind it register or record, word
  logic               reads;             // a row is there: step 1 to 4
  logic               changes;           // a number of more than one byte has
  dsl_map_pkg::row_t  row;
  logic               here;              // the row is one of this personality and of a channel
  logic               record_q;          // the byte is one of a record
  logic [2:0]         kind_q;
  logic [7:0]         register;
  logic [7:0]         byte_q;
  logic [7:0]         shaped;            // of the record
  logic [31:0]        word_q;
  logic               copy_q, copied_q;  // the time is being copied, has been
  // Writes.
  logic               store;
  logic [7:0]         low_lane, high_lane;
  logic               store_sys, store_sync, store_h, store_l, store_safe, store_limit;
  logic               store_status, store_enable;
  // Registers.
  logic               prst_q, oen_q;
  logic [7:0]         es_q;
  logic [4:0]         limit_q;
  // Of the last answer: status_i.place moves while a frame ends, status_i.rssi with its edges.
  logic [11:0]        place_q;
  logic [3:0]         rssi_q;
  dsl_pkg::events_t   set, kept, events_q;
  logic [4:0]         irq_status, irq_enable;
  // Events.
  logic               gap_q;             // the last state was the gap
  logic               lost_q, linked_q;
  logic               frame_q;           // the record is one of a running frame
  logic               vertical_q;        // ... of the last one in a vertical frame
  logic               summary_q;         // a bit of the record's summary is 1
  logic               told_q;            // a link has made a record
  logic               unused;

  // ---- An access --------------------------------------------------------------------------------

  dsl_map u_map (
    .clk_i,
    .address_i ({word_addr_i[8:2], step_q[1:0]}),
    .row_o     (row)
  );

  // They change behind a word of an answer, and with ended_i.
  assign changes = answer_i.valid || ended_i;
  assign reads   = step_q != 3'd0 && step_q <= 3'd4;
  assign here    = word_addr_i[11:9] == 3'd0 && (!row.sdk || quirks_i.sdk_map);

  always_comb begin
    step_d = step_q + 3'd1;
    if (reads && !word_write_i && changes) step_d = 3'd0;
    if (time_copy_o || step_q == LAST_STEP || !word_req_i) step_d = 3'd0;
  end

  always_comb begin
    shaped = record_data_i;
    case (kind_q)
      dsl_map_pkg::STATUS:      shaped[7:6] = 2'b00;
      dsl_map_pkg::SAFE1_STATE: shaped = {record_data_i[3], record_data_i[6], 6'd0};
      dsl_map_pkg::SAFE2_STATE: shaped = {record_data_i[4], record_data_i[7], 6'd0};
      default: ;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      step_q   <= '0;
      record_q <= 1'b0;
      kind_q   <= dsl_map_pkg::CONSTANT;
      byte_q   <= '0;
      copy_q   <= 1'b0;
      copied_q <= 1'b0;
    end else begin
      step_q   <= step_d;
      record_q <= here && told_q && row.kind >= dsl_map_pkg::RECORD;
      kind_q   <= row.kind;
      byte_q   <= register;
      copy_q   <= time_copy_o && !time_copied_i;
      copied_q <= word_req_i && step_q != LAST_STEP && (copied_q || (copy_q && time_copied_i));
    end
  end

  // No reset: an answer on its way to the bus outlives the core's.
  always_ff @(posedge clk_i) begin
    if (step_q[2:1] != 2'd0 && step_q != LAST_STEP) begin
      word_q <= {byte_q | (shaped & {8{record_q}}), word_q[31:8]};
    end
  end

  assign word_ready_o     = step_q == LAST_STEP;
  assign word_data_o      = word_q;
  assign record_read_o    = reads && !word_write_i;
  assign record_hold_o    = row.hold && here;
  assign record_group_o   = row.group;
  assign record_address_o = row.value[5:0];
  assign time_copy_o      = copy_q || (step_q == 3'd1 && !word_write_i && here && !copied_q
                         && row.kind == dsl_map_pkg::REGISTER && row.hold);
  assign time_address_o   = {word_addr_i[3], step_q[1:0]};

  always_comb begin
    register = 8'd0;
    if (row.kind == dsl_map_pkg::CONSTANT) begin
      register = row.value;
    end else if (row.kind == dsl_map_pkg::REGISTER) begin
      case (row.value)
        dsl_map_pkg::SYS_CTRL:     register = {prst_q, 6'd0, oen_q};
        dsl_map_pkg::SYNC_CTRL:    register = es_q;
        dsl_map_pkg::MASTER_QM:    register = {answer_i.linked, 3'd0, status_i.quality};
        dsl_map_pkg::EVENT_H:      register = {1'b0, events_q.sum, events_q.sce, 1'b0,
                                               events_q.pos, events_q.vpos, 1'b0, events_q.prst};
        dsl_map_pkg::EVENT_L:      register = {5'd0, events_q.qmlw, 2'd0};
        dsl_map_pkg::EDGES:        register = status_i.edges;
        dsl_map_pkg::DELAY:        register = {rssi_q, place_q[11:8]};
        dsl_map_pkg::CODE_VERSION:
          register = quirks_i.sdk_map ? SDK_VERSION : dsl_regs_pkg::RESET_CODE_VERSION;
        dsl_map_pkg::ENC_ID2:      register = {4'd0, status_i.identity[19:16]};
        dsl_map_pkg::ENC_ID1:      register = status_i.identity[15:8];
        dsl_map_pkg::ENC_ID0:      register = status_i.identity[7:0];
        dsl_map_pkg::ACC_ERR_CNT:  register = {3'd0, told_i.missing};
        dsl_map_pkg::THRESH:       register = {3'd0, limit_q};
        dsl_map_pkg::STATUS0:      register = {2'd0, told_i.safe1_error || told_i.safe2_error,
                                               told_i.safe2_valid && answer_i.linked,
                                               told_i.safe1_valid && answer_i.linked,
                                               answer_i.running, answer_i.linked, lost_i};
        dsl_map_pkg::STATUS1:      register = {place_q[11:8], status_i.quality};
        dsl_map_pkg::STATUS2:      register = {4'd0, status_i.state};
        dsl_map_pkg::STATUS3:      register = {5'd0, status_i.reason};
        dsl_map_pkg::RESETS_L:     register = status_i.resets[7:0];
        dsl_map_pkg::RESETS_H:     register = status_i.resets[15:8];
        dsl_map_pkg::ILLEGAL_L:    register = status_i.illegal[7:0];
        dsl_map_pkg::ILLEGAL_H:    register = status_i.illegal[15:8];
        dsl_map_pkg::PLACE_L:      register = place_q[7:0];
        dsl_map_pkg::PLACE_H:      register = {4'd0, place_q[11:8]};
        dsl_map_pkg::FEATURES:     register = {2'd0, quirks_i.sample, quirks_i.sdk_map,
                                               quirks_i.strict_code, quirks_i.recover, 1'b0};
        dsl_map_pkg::IRQ_STATUS:   register = {3'd0, irq_status};
        dsl_map_pkg::IRQ_ENABLE:   register = {3'd0, irq_enable};
        dsl_map_pkg::TIME:         register = time_data_i;
        default:                   register = 8'd0;
      endcase
    end
    // Before the first link: the position is not certain, and no safe one has come.
    if (!told_q && row.kind == dsl_map_pkg::STATUS) register = 8'd1;
    if (!told_q && row.kind == dsl_map_pkg::RECORD && row.value[5:3] == AGES) register = '1;
    if (!here) register = 8'd0;
  end

  // ---- Writes -----------------------------------------------------------------------------------

  // All registers that can be written are in the two lower lanes.
  assign low_lane     = word_data_i[7:0];
  assign high_lane    = word_data_i[15:8];
  assign store        = word_req_i && word_write_i && here && row.kind == dsl_map_pkg::REGISTER
                     && ((step_q == 3'd1 && word_be_i[0]) || (step_q == 3'd2 && word_be_i[1]));
  assign store_sys    = store && row.value == dsl_map_pkg::SYS_CTRL;
  assign store_sync   = store && row.value == dsl_map_pkg::SYNC_CTRL;
  assign store_h      = store && row.value == dsl_map_pkg::EVENT_H;
  assign store_l      = store && row.value == dsl_map_pkg::EVENT_L;
  assign store_safe   = store && row.value == dsl_map_pkg::SAFE_CTRL;
  assign store_limit  = store && row.value == (quirks_i.sdk_map ? dsl_map_pkg::THRESH
                                                                : dsl_map_pkg::ACC_ERR_CNT);
  assign store_status = store && row.value == dsl_map_pkg::IRQ_STATUS;
  assign store_enable = store && row.value == dsl_map_pkg::IRQ_ENABLE;

  always_comb begin
    kept = events_q;
    if (store_h) begin
      kept.sum  = events_q.sum  && low_lane[dsl_regs_pkg::SUM_LSB];
      kept.sce  = events_q.sce  && low_lane[dsl_regs_pkg::SCE_LSB];
      kept.pos  = events_q.pos  && low_lane[dsl_regs_pkg::POS_LSB];
      kept.vpos = events_q.vpos && low_lane[dsl_regs_pkg::VPOS_LSB];
      kept.prst = events_q.prst && low_lane[dsl_regs_pkg::EVENT_PRST_LSB];
    end
    if (store_l) kept.qmlw = events_q.qmlw && high_lane[dsl_regs_pkg::QMLW_LSB];
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      prst_q   <= 1'b0;
      oen_q    <= 1'b0;
      es_q     <= dsl_regs_pkg::RESET_SYNC_CTRL;
      limit_q  <= dsl_regs_pkg::THRESH_RESET;
      place_q  <= '0;
      rssi_q   <= '0;
      events_q <= '0;
    end else begin
      if (store_sys)             prst_q <= low_lane[dsl_regs_pkg::PRST_LSB];
      else if (store_safe)       prst_q <= high_lane[dsl_regs_pkg::SAFE_PRST_LSB];
      else if (quirks_i.sdk_map) prst_q <= 1'b0;
      if (store_sys)   oen_q   <= low_lane[dsl_regs_pkg::OEN_LSB];
      if (store_sync)  es_q    <= high_lane;
      if (store_limit) limit_q <= quirks_i.sdk_map ? high_lane[4:0] : low_lane[4:0];
      if (ended_i) begin
        place_q <= status_i.place;
        rssi_q  <= status_i.rssi;
      end
      events_q <= kept | set;
    end
  end

  assign hold_o       = prst_q;
  assign driver_off_o = oen_q;
  assign limit_o      = limit_q;

  // ---- Events -----------------------------------------------------------------------------------

  always_comb begin
    set      = '0;
    set.sum  = ready_o && vertical_q && told_i.safe1_valid && summary_q;
    set.sce  = ready_o && vertical_q && (told_i.safe1_error || told_i.safe2_error);
    set.vpos = ready_o && vertical_q && !told_i.safe1_valid && !told_i.safe1_error;
    set.pos  = (lost_i && !lost_q) || (tell_i && lost_i && answer_i.linked);
    set.prst = gap_q && status_i.state != dsl_pkg::GAP_STATE;
    set.qmlw = ended_i && status_i.low && (answer_i.linked || answer_i.running);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      gap_q      <= 1'b0;
      lost_q     <= 1'b1;
      linked_q   <= 1'b0;
      frame_q    <= 1'b0;
      vertical_q <= 1'b0;
      summary_q  <= 1'b0;
      told_q     <= 1'b0;
    end else begin
      gap_q    <= status_i.state == dsl_pkg::GAP_STATE;
      lost_q   <= lost_i;
      linked_q <= answer_i.linked;
      if (answer_i.ends && answer_i.running) begin
        frame_q    <= 1'b1;
        vertical_q <= answer_i.place == LAST_PLACE;
      end else if (tell_i) begin
        frame_q <= 1'b0;
      end
      told_q <= told_q || (tell_i && answer_i.linked);
      if (record_write_i && record_address_i == SUMMARY_PLACE) summary_q <= record_byte_i != 8'd0;
    end
  end

  assign ready_o = tell_i && frame_q;

  enc_irq u_irq (
    .clk_i,
    .rst_ni,
    .event_i     ({3'b000, (lost_i && !lost_q) || (linked_q && !answer_i.linked), ready_o}),
    .bus_clk_i   (clk_i),
    .bus_rst_ni  (rst_ni),
    .status_we_i (store_status),
    .enable_we_i (store_enable),
    .data_i      (low_lane[4:0] & dsl_page_regs_pkg::WMASK_IRQ_STATUS[4:0]),
    .status_o    (irq_status),
    .enable_o    (irq_enable),
    .irq_o
  );

  assign unused = ^{answer_i.begins, answer_i.number, answer_i.word, told_i.acceleration_good,
                    told_i.acceleration_marked, status_i.width,
                    word_data_i[31:16], word_be_i[3:2]};

endmodule
