// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers of the DSL master on a bus of words. An access takes its four bytes one after another:
// dsl_map says what stands there, so a byte costs no decoder, and records and what the host alone
// writes stay in their memories.
//
// Clock domain: core. word_req_i and what comes with it stay up to the clock with word_ready_o,
// which is the eighth one of an access: word_data_o is right in it. If a number of more than one
// byte changes meanwhile, a read begins anew; one of TIME_LOW waits 9 to 17 clocks for the time.
// stored_busy_i keeps an access of the memory of dsl_message waiting, stored_clears_i each one.
// word_data_o of a write is undefined; it stays up to the second clock of the next access, also
// through a reset.
// record_data_i and stored_data_i are the byte that was asked for, one clock later. Its group and
// record_hold_o come a clock before record_read_o. hold_o is 1
// while PRST is, in the personality of the SDK for one clock. orders_o: starts of messages; a byte
// that is locked while its message runs is not written, and starts nothing.
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
  output logic [7:0]            safe2_bits_o,
  output logic [7:0]            tolerance_o,
  output dsl_pkg::orders_t      orders_o,
  // line and position
  input  dsl_pkg::answer_t      answer_i,
  input  dsl_pkg::line_status_t status_i,
  input  logic                  ended_i,
  input  dsl_pkg::told_t        told_i,
  input  logic                  lost_i,
  input  logic                  tell_i,
  input  logic                  stale_i,
  input  logic                  mismatch_i,
  // events
  output dsl_pkg::event_stores_t stores_o,
  output logic [7:0]            byte_o,        // what is written
  input  dsl_pkg::event_bytes_t events_i,
  // messages
  input  dsl_pkg::messages_t    messages_i,
  input  logic                  stored_busy_i,
  input  logic                  stored_clears_i,
  output logic                  stored_read_o,
  output logic                  stored_write_o,
  output logic [5:0]            stored_address_o,
  input  logic [7:0]            stored_data_i,
  // records
  output logic                  record_read_o,
  output logic                  record_hold_o,
  output logic [2:0]            record_group_o,
  output logic [5:0]            record_address_o,
  input  logic [7:0]            record_data_i,
  // time
  output logic                  time_copy_o,
  input  logic                  time_copied_i,
  output logic [2:0]            time_address_o,
  input  logic [7:0]            time_data_i
);

  localparam logic [2:0] FIRST_STEP    = 3'd2;    // with a row
  localparam logic [2:0] LAST_STEP     = 3'd7;
  localparam logic [2:0] PIPELINE      = 3'd2;
  localparam logic [2:0] AGES          = 3'd6;    // in the record: places 48 to 55
  localparam logic [7:0] SDK_VERSION   = 8'h10;

  // An access.
  logic [2:0]         step_d, step_q;    // byte of dsl_map, its row, register or record, word
  logic               maps;              // dsl_map shows a row: step 1 to 4
  logic               works;             // ... which row_q is, a clock later
  logic               changes;           // a number of more than one byte has
  dsl_map_pkg::row_t  row, row_q;
  logic               here, here_q;      // the row is one of this personality and of a channel
  logic               stored_q;          // ... and a byte of the memory of dsl_message
  logic               register_q;        // ... and a register
  logic               stored_waits;      // for bytes that belong together
  // Behind it.
  logic               shown_q;           // the byte is one of a memory
  logic               kept_q;            // ... of that of dsl_message
  logic [2:0]         kind_q;
  logic [7:0]         register;
  logic [7:0]         byte_q;
  logic [7:0]         shaped;            // of the record
  logic [31:0]        word_q;
  logic               copy_q, copied_q;  // the time is being copied, has been
  // Writes.
  logic               writes;            // a byte
  logic               store;             // ... a register
  logic               store_ctrl;        // ... SYS_CTRL or SAFE_CTRL
  logic [7:0]         lane, lane_q;
  logic               enable_q;          // of the byte
  logic               locked;
  logic               runs;              // the short message of this byte's host
  logic               ctrl;              // the byte starts one
  logic               safe_host;         // a stored byte is one of the safe host
  logic               starts;            // a short message
  // Registers.
  logic               prst_q, oen_q;
  logic [4:0]         limit_q;
  logic [7:0]         bits_q, tolerance_q;
  // Of the last answer: status_i.place moves while a frame ends, status_i.rssi with its edges.
  logic [11:0]        place_q;
  logic [3:0]         rssi_q;
  logic [7:0]         pipe_q;
  logic [2:0]         pipe_state_q;      // of PIPE_S
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
  assign maps    = step_q >= 3'd1 && step_q <= 3'd4;
  assign works   = step_q >= FIRST_STEP && step_q <= 3'd5;
  assign here    = word_addr_i[11:9] == 3'd0 && (!row.sdk || quirks_i.sdk_map != row.hold);

  always_comb begin
    step_d = step_q + 3'd1;
    if (works && !word_write_i && changes)     step_d = 3'd0;
    if (stored_waits)                          step_d = 3'd0;
    if (time_copy_o || !word_req_i)            step_d = 3'd0;
    if (stored_clears_i)                       step_d = 3'd0;
  end

  always_comb begin
    shaped = record_data_i;
    case (kind_q)
      dsl_map_pkg::STATUS:      shaped[7:6] = 2'b00;
      dsl_map_pkg::SAFE1_STATE: shaped = {record_data_i[3], record_data_i[6], 6'd0};
      dsl_map_pkg::SAFE2_STATE: shaped = {record_data_i[4], record_data_i[7], 6'd0};
      dsl_map_pkg::TOGGLES:     shaped[4:0] = 5'd0;
      default: ;
    endcase
    if (kept_q) shaped = stored_data_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      step_q     <= '0;
      row_q      <= '0;
      here_q     <= 1'b0;
      stored_q   <= 1'b0;
      register_q <= 1'b0;
      shown_q    <= 1'b0;
      kept_q     <= 1'b0;
      kind_q     <= dsl_map_pkg::CONSTANT;
      byte_q     <= '0;
      copy_q     <= 1'b0;
      copied_q   <= 1'b0;
    end else begin
      step_q     <= step_d;
      row_q      <= row;
      here_q     <= here;
      stored_q   <= here && row.kind == dsl_map_pkg::STORED;
      register_q <= here && row.kind == dsl_map_pkg::REGISTER;
      shown_q    <= (stored_q && (!ctrl || runs))
                 || (here_q && told_q && row_q.kind >= dsl_map_pkg::RECORD
                     && row_q.kind != dsl_map_pkg::STORED);
      kept_q     <= stored_q;
      kind_q     <= row_q.kind;
      byte_q     <= register;
      copy_q     <= time_copy_o && !time_copied_i;
      copied_q   <= word_req_i && step_q != LAST_STEP && (copied_q || (copy_q && time_copied_i));
    end
  end

  // No reset: an answer on its way to the bus outlives the core's.
  always_ff @(posedge clk_i) begin
    if (step_q > FIRST_STEP && step_q != LAST_STEP) begin
      word_q <= {byte_q | (shaped & {8{shown_q}}), word_q[31:8]};
    end
  end

  assign word_ready_o     = step_q == LAST_STEP;
  assign word_data_o      = word_q;
  assign record_hold_o    = maps && !word_write_i && here && row.hold && !row.kind[0];
  assign record_group_o   = row.group;
  assign record_read_o    = works && !word_write_i;
  assign record_address_o = row_q.value[5:0];
  assign stored_waits     = step_q == FIRST_STEP && stored_q && stored_busy_i;
  assign stored_read_o    = works && !word_write_i && stored_q;
  assign stored_address_o = {row_q.value[5:2], row_q.value[1] || safe_host, row_q.value[0]};
  assign time_copy_o      = copy_q || (step_q == FIRST_STEP && !word_write_i && !copied_q
                         && register_q && row_q.hold && !row_q.sdk);
  assign time_address_o   = {word_addr_i[3], step_q[1:0] - 2'd1};

  always_comb begin
    register = 8'd0;
    if (row_q.kind == dsl_map_pkg::CONSTANT) begin
      register = row_q.value;
    end else if (row_q.kind == dsl_map_pkg::REGISTER) begin
      case (row_q.value[5:0])
        dsl_map_pkg::SYS_CTRL:     register = {prst_q, messages_i.resets, 5'd0, oen_q};
        dsl_map_pkg::SAFE_CTRL:    register = {1'b0, messages_i.resets, 6'd0};
        dsl_map_pkg::MASTER_QM:    register = {answer_i.linked, 3'd0, status_i.quality};
        dsl_map_pkg::EVENT_H:      register = events_i.event_h;
        dsl_map_pkg::EVENT_L:      register = events_i.event_l;
        dsl_map_pkg::EVENT_S:      register = events_i.event_s;
        dsl_map_pkg::POSTX:        register = {6'd0, events_i.postx};
        dsl_map_pkg::ONLINE_D_H:   register = events_i.online_d_h;
        dsl_map_pkg::ONLINE_D_L:   register = events_i.online_d_l;
        dsl_map_pkg::ONLINE_1_H:   register = events_i.online_1_h;
        dsl_map_pkg::ONLINE_1_L:   register = events_i.online_1_l;
        dsl_map_pkg::ONLINE_2_H:   register = events_i.online_2_h;
        dsl_map_pkg::PIPE_S:       register = {5'd0, pipe_state_q};
        dsl_map_pkg::PIPE_D:       register = pipe_q;
        dsl_map_pkg::CHECKS_L:     register = {told_i.checks.crc1, told_i.checks.marked2,
                                               told_i.checks.marked1, told_i.checks.fix2,
                                               told_i.checks.err2, told_i.checks.test2,
                                               told_i.checks.tog2, mismatch_i};
        dsl_map_pkg::CHECKS_H:     register = {1'b0, told_i.checks.vsync_late, stale_i,
                                               told_i.checks.vsync_missing,
                                               told_i.checks.vsync_early, told_i.checks.code2,
                                               told_i.checks.code1, told_i.checks.crc2};
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
        dsl_map_pkg::PLACE_L:      register = place_q[7:0];
        dsl_map_pkg::PLACE_H:      register = {4'd0, place_q[11:8]};
        dsl_map_pkg::FEATURES:     register = {2'd0, quirks_i.sample, quirks_i.sdk_map,
                                               quirks_i.strict_code, quirks_i.recover, 1'b1};
        dsl_map_pkg::IRQ_STATUS:   register = {1'b0, events_i.irq_status};
        dsl_map_pkg::IRQ_ENABLE:   register = {1'b0, events_i.irq_enable};
        dsl_map_pkg::TIME:         register = time_data_i;
        default:                   register = 8'd0;
      endcase
    end
    // Before the first link: the position is not certain, and no safe one has come.
    if (!told_q && row_q.kind == dsl_map_pkg::STATUS) register = 8'd1;
    if (!told_q && row_q.kind == dsl_map_pkg::RECORD && row_q.value[5:3] == AGES) register = '1;
    if (row_q.kind == dsl_map_pkg::TOGGLES) register[dsl_regs_pkg::NOW2_QMLW_LSB] = events_i.low;
    if (ctrl && !runs) register = dsl_message_pkg::NOTHING;
    if (!here_q) register = 8'd0;
  end

  // ---- Writes -----------------------------------------------------------------------------------

  always_comb begin
    case (step_q[1:0])
      2'd1:    lane = word_data_i[7:0];
      2'd2:    lane = word_data_i[15:8];
      2'd3:    lane = word_data_i[23:16];
      default: lane = word_data_i[31:24];
    endcase
  end

  // Masks keep the bits that they have.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      lane_q   <= '0;
      enable_q <= 1'b0;
    end else begin
      lane_q   <= lane;
      enable_q <= word_be_i[step_q[1:0] - 2'd1];
      if (row.kind == dsl_map_pkg::STORED) begin
        case (row.group)
          dsl_map_pkg::STORE_H: lane_q <= lane & dsl_regs_pkg::WMASK_MASK_H;
          dsl_map_pkg::STORE_L: lane_q <= lane & dsl_regs_pkg::WMASK_MASK_L;
          dsl_map_pkg::STORE_S: lane_q <= lane & dsl_regs_pkg::WMASK_MASK_S;
          default: ;
        endcase
      end
    end
  end

  assign writes    = word_req_i && word_write_i && works && enable_q && !stored_waits;
  assign store     = writes && register_q;
  assign safe_host = quirks_i.sdk_map && row_q.group == dsl_map_pkg::STORE_ALIAS;

  always_comb begin
    case (row_q.value[7:6])
      dsl_map_pkg::ALWAYS:   locked = 1'b0;
      dsl_map_pkg::NO_LONG:  locked = messages_i.long_runs;
      dsl_map_pkg::NO_SHORT: locked = runs || (messages_i.resets && !row_q.value[0]);
      default:               locked = 1'b1;
    endcase
  end

  assign runs           = stored_address_o[1] ? messages_i.safe_runs : messages_i.main_runs;
  assign ctrl           = row_q.kind == dsl_map_pkg::STORED && !row_q.value[0]
                       && row_q.value[7:6] == dsl_map_pkg::NO_SHORT;
  assign stored_write_o = writes && stored_q && !locked;
  assign starts         = stored_write_o && ctrl && lane_q != dsl_message_pkg::NOTHING;

  assign store_ctrl           = store && row_q.group == dsl_map_pkg::STORE_CTRL;
  assign orders_o.resets      = store_ctrl && lane_q[dsl_regs_pkg::MRST_LSB];
  assign orders_o.starts_long = store && row_q.group == dsl_map_pkg::STORE_START
                             && lane_q[dsl_regs_pkg::LSTA_LSB] && !messages_i.long_runs
                             && !messages_i.resets;
  assign orders_o.starts_main = starts && !stored_address_o[1];
  assign orders_o.starts_safe = starts && stored_address_o[1];

  assign stores_o.event_h    = store && row_q.group == dsl_map_pkg::STORE_H;
  assign stores_o.event_l    = store && row_q.group == dsl_map_pkg::STORE_L;
  assign stores_o.event_s    = store && row_q.group == dsl_map_pkg::STORE_S;
  assign stores_o.mask_h     = stored_write_o && row_q.group == dsl_map_pkg::STORE_H;
  assign stores_o.mask_l     = stored_write_o && row_q.group == dsl_map_pkg::STORE_L;
  assign stores_o.mask_s     = stored_write_o && row_q.group == dsl_map_pkg::STORE_S;
  assign stores_o.mask_sum   = stored_write_o && row_q.group == dsl_map_pkg::STORE_SUM;
  assign stores_o.irq_status = store && row_q.group == dsl_map_pkg::STORE_IRQ && !row_q.value[0];
  assign stores_o.irq_enable = store && row_q.group == dsl_map_pkg::STORE_IRQ && row_q.value[0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      prst_q       <= 1'b0;
      oen_q        <= 1'b0;
      limit_q      <= dsl_regs_pkg::THRESH_RESET;
      bits_q       <= '0;
      tolerance_q  <= '0;
      place_q      <= '0;
      rssi_q       <= '0;
      pipe_q       <= '0;
      pipe_state_q <= dsl_regs_pkg::RESET_PIPE_S[2:0];
      told_q       <= 1'b0;
    end else begin
      if (store_ctrl) begin
        prst_q <= lane_q[dsl_regs_pkg::PRST_LSB];
      end else if (quirks_i.sdk_map) begin
        prst_q <= 1'b0;
      end
      if (store_ctrl && !row_q.sdk) oen_q <= lane_q[dsl_regs_pkg::OEN_LSB];
      // ACC_ERR_CNT can be written in ours alone, the threshold exists in the SDK alone.
      if (store && row_q.group == dsl_map_pkg::STORE_LIMIT && row_q.sdk == quirks_i.sdk_map) begin
        limit_q <= lane_q[4:0];
      end
      if (stored_write_o && row_q.group == dsl_map_pkg::STORE_BITS)      bits_q      <= lane_q;
      if (stored_write_o && row_q.group == dsl_map_pkg::STORE_TOLERANCE) tolerance_q <= lane_q;
      if (ended_i) begin
        place_q <= status_i.place;
        rssi_q  <= status_i.rssi;
      end
      if (!answer_i.running) begin
        pipe_state_q <= dsl_regs_pkg::RESET_PIPE_S[2:0];
      end else if (answer_i.valid && answer_i.number == PIPELINE) begin
        if (!answer_i.word.error) pipe_q <= answer_i.word.data;
        pipe_state_q <= {1'b0, answer_i.word.error, answer_i.word.special};
      end
      told_q <= told_q || (tell_i && answer_i.linked);
    end
  end

  assign byte_o       = lane_q;
  assign hold_o       = prst_q;
  assign driver_off_o = oen_q;
  assign limit_o      = limit_q;
  assign safe2_bits_o = bits_q;
  assign tolerance_o  = tolerance_q;
  assign unused       = ^{answer_i.begins, answer_i.place, answer_i.ends, answer_i.word.only_strict,
                          told_i.acceleration_good, told_i.acceleration_marked, status_i.width,
                          status_i.low, messages_i};

endmodule
