// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C control frame, master side: register read, register write, commands. Each frame carries
// one CDM bit and one CDS bit. The slot is the number of frames since the start bit S (slot
// numbers: biss_pkg).
//
// Clock domain: core. begin_i starts a control communication; it is ignored while active_o is high.
// Each frame that starts from then on carries one bit:
//
// - cdm0_o and cdm1_o are the CDM to send if CDS of the same frame is 0 or 1, one bit for each
//   line.
// - frame_done_i takes CDS. CDS of a slot answers CDM of the slot before. With abort_i it has no
//   result.
// - Slot 0 lasts until 14 zeros have been sent (cdm_timeout_i). Slot 19 lasts until the start bit
//   of the slave.
// - IDS is the first byte of the data. It is taken when the bytes have arrived that the host wrote
//   before begin_i.
//
// Latency: end_o comes one clock after the step that finished or failed.
// Misuse: a register access needs exactly one line in select_i. The configuration must be stable
// while active_o is high.
// Silent slave: without echo of R and W reg_error. Without start bit delay_error with the first
// frame that ends with expired_i. Frames that do not end (stalled_i) also end the control frame.
// Datasheet: pages 27..29, 34, 35, Figures 20..22; decisions 5, 12, 20, 22..24, 31.

`include "enc_check.svh"

module biss_control_frame (
  input  logic       clk_i,
  input  logic       rst_ni,
  // configuration
  input  biss_pkg::access_t access_i,
  input  logic       ida_invert_i,   // quirk: IDA_TEST has the opposite polarity
  input  logic [1:0] select_i,       // lines {2, 1} that carry the control frame
  input  logic       blind_i,        // SSI: no CDS, every answer to a write counts as right
  // data of the access: the byte is valid one clock after its address
  output biss_pkg::access_byte_t byte_o,
  input  logic [7:0] rdata_i,
  input  logic       post_busy_i,    // bytes of the host are on their way to the data
  // frames
  input  logic       begin_i,
  input  logic       abort_i,        // stopped, or the access cannot run any more
  input  logic       start_i,        // a frame starts
  input  logic       frame_done_i,   // the frame has ended
  input  logic [1:0] cds_i,          // CDS of the frame, lines {2, 1}
  input  logic       cdm_timeout_i,  // at least 14 frames with CDM = 0 before this one
  input  logic       expired_i,      // no start bit for too long
  input  logic       stalled_i,      // no frame has ended for too long
  input  logic       stalled_start_i, // ... if a frame starts in this clock
  output logic       active_o,
  output logic       active_start_o, // active_o, if a frame starts in this clock; it comes earlier
  output logic       running_o,      // as active_o, but rises one clock later
  output logic       in_body_o,      // the slot is between S and the stop bit
  output logic       wait_o,         // waiting for the slave's start bit
  output logic       moved_o,        // a frame ends, but not while S is awaited
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o,
  // result
  output logic       begin_o,
  output biss_pkg::access_end_t end_o
);

  logic       active_q;
  logic       active_d;
  logic [1:0] fresh_q;      // the fields have not been taken yet
  logic       broadcast_q;
  logic       carries_q;    // the running frame carries a bit of the control frame
  logic       carries_d;
  logic [5:0] slot_q;
  logic [5:0] slot_d;
  logic [9:0] bits_q;       // header fields, IDS and CMD, or data byte; next bit on top
  logic [9:0] bits_d;
  logic       bits_header, bits_byte, bits_shift;  // what bits_q takes
  logic [3:0] crc_q;
  logic [3:0] crc_d;
  logic [5:0] index_q;      // bytes done
  logic [5:0] index_d;
  logic       last_q;       // the last byte is done
  logic       last_d;
  logic       sent_q;       // CDM of the slot before
  logic       sent_d;
  logic [1:0] ida_bad_q;    // lines whose IDA differs from IDS
  logic [1:0] ida_bad_d;
  logic       end_q, reg_error_q, delay_error_q;
  logic       end_d, reg_error_d, delay_error_d;

  logic       cts;          // a register access, no command
  logic       write;
  logic       step;
  logic       take;
  logic       tested;
  logic       cds;          // of the selected line
  logic       cdm0, cdm1, sent;
  logic       top, crc_feed, crc_shift, crc_bit;
  logic       by_ida;       // CDM depends on the IDA of the line
  logic       stay, fail, late, finish;
  logic       header, echo, ida;
  logic       data;         // slot of a data bit, on CDM (write) or CDS (read)
  logic       data_crc;

  // Slots from `first` to the one before `behind`.
  function automatic logic [63:0] slots(input logic [5:0] first, input logic [5:0] behind);
    slots = (64'd1 << behind) - (64'd1 << first);
  endfunction

  assign cts       = access_i.cts;
  assign write     = access_i.write;
  assign step      = carries_q && frame_done_i;
  assign take      = fresh_q[1] && !post_busy_i;
  assign tested    = (access_i.id[0] ^ ida_invert_i) && !broadcast_q;
  assign cds       = (blind_i && cts) ? sent_q : (cds_i & select_i) != 2'b00;
  assign top       = bits_q[9];

  // ---- slots --------------------------------------------------------------------------------
  // Sets of slots, one bit for each. A set costs less than two comparisons.
  localparam logic [63:0] HEADER  = slots(biss_pkg::SLOT_HEADER, biss_pkg::SLOT_CRC);
  localparam logic [63:0] CRC     = slots(biss_pkg::SLOT_CRC, biss_pkg::SLOT_READ);
  localparam logic [63:0] ACK     = slots(biss_pkg::SLOT_IDA, biss_pkg::SLOT_STOP_TESTED);
  localparam logic [63:0] DATA    = slots(biss_pkg::SLOT_WAIT + 6'd1, biss_pkg::SLOT_DATA_CRC);
  localparam logic [63:0] ANSWER  = slots(biss_pkg::SLOT_WAIT + 6'd1, biss_pkg::SLOT_NEXT);
  localparam logic [63:0] BODY    = slots(biss_pkg::SLOT_CTS, biss_pkg::SLOT_STOP);
  localparam logic [63:0] TESTED  = slots(biss_pkg::SLOT_CTS, biss_pkg::SLOT_STOP_TESTED);
  localparam logic [63:0] COMMAND = slots(biss_pkg::SLOT_CTS, biss_pkg::SLOT_STOP_COMMAND);

  assign header   = HEADER[slot_q];
  assign echo     = cts && ANSWER[slot_q];
  assign ida      = !cts && !broadcast_q && ACK[slot_q];
  // CDS of a read comes one slot after CDM of a write.
  assign data     = cts && (DATA[slot_q] ||
                    (slot_q == (write ? biss_pkg::SLOT_WAIT : biss_pkg::SLOT_DATA_CRC) &&
                     (cds || !write)));
  assign data_crc = echo && !data;

  // ---- CDM ----------------------------------------------------------------------------------

  always_comb begin
    cdm0   = 1'b0;
    by_ida = 1'b0;
    unique case (slot_q)
      biss_pkg::SLOT_START: cdm0 = cdm_timeout_i;
      biss_pkg::SLOT_CTS:   cdm0 = cts;
      6'd2, 6'd3, 6'd4, 6'd5, 6'd6, 6'd7, 6'd8, 6'd9, 6'd10, 6'd11:
        cdm0 = top;
      6'd12, 6'd13, 6'd14, 6'd15:
        cdm0 = !crc_q[3];
      biss_pkg::SLOT_READ:  cdm0 = cts ? !write : !tested;   // EX at once
      biss_pkg::SLOT_WRITE: cdm0 = cts && write;
      biss_pkg::SLOT_BYTE:  cdm0 = cts;
      biss_pkg::SLOT_WAIT, 6'd20, 6'd21, 6'd22, 6'd23, 6'd25, 6'd26:
        cdm0 = cts && write && top;
      biss_pkg::SLOT_EX_TESTED: begin
        cdm0   = cts && write && top;
        by_ida = !cts && tested;
      end
      6'd27, 6'd28, 6'd29, 6'd30:
        cdm0 = write && !crc_q[3];
      biss_pkg::SLOT_NEXT:  cdm0 = !last_q;
      default: cdm0 = 1'b0;
    endcase
    cdm1 = cdm0;
    // S is repeated until the slave answers it.
    if (cts && !blind_i && slot_q == biss_pkg::SLOT_WAIT) cdm0 = 1'b1;
  end

  assign sent = cds ? cdm1 : cdm0;

  for (genvar i = 0; i < 2; i++) begin : gen_line
    assign cdm0_o[i] = select_i[i] && (by_ida ? !ida_bad_q[i] && !top : cdm0);
    assign cdm1_o[i] = select_i[i] && (by_ida ? !ida_bad_q[i] && top : cdm1);
  end

  // ---- what a frame's end does ----------------------------------------------------------------

  always_comb begin
    stay      = 1'b0;
    fail      = 1'b0;
    finish    = 1'b0;
    ida_bad_d = ida_bad_q;
    unique case (slot_q)
      biss_pkg::SLOT_START: stay = !sent;
      biss_pkg::SLOT_WRITE: begin
        fail   = cts && (cds == write || (blind_i && !write));
        finish = !cts && broadcast_q;
      end
      biss_pkg::SLOT_BYTE:  fail   = cts && cds != write;
      biss_pkg::SLOT_WAIT:  stay   = cts && !cds;
      biss_pkg::SLOT_STOP_TESTED: finish = !cts;
      biss_pkg::SLOT_NEXT:  finish = last_q;
      default: ;
    endcase
    if (echo && write && cds != sent_q)        fail = 1'b1;
    if (data_crc && !write && cds == crc_q[3]) fail = 1'b1;
    if (ida) begin
      ida_bad_d = ida_bad_q | (select_i & (cds_i ^ {2{top}}));
      if (slot_q == biss_pkg::SLOT_EX_TESTED && !tested) finish = 1'b1;
    end
  end

  always_comb begin
    crc_feed  = header || data;
    crc_shift = CRC[slot_q] || data_crc;
    crc_bit   = crc_q[3] ^ ((header || write) ? sent : cds);
    crc_d     = crc_q;
    if (crc_feed)       crc_d = {crc_q[2:0], 1'b0} ^ (crc_bit ? biss_pkg::CONTROL_CRC_POLY : 4'h0);
    else if (crc_shift) crc_d = {crc_q[2:0], 1'b0};
    // The CRC of the header does not cover S. After a CRC has been sent, crc_q is 0 again.
    if (slot_q == biss_pkg::SLOT_START) crc_d = 4'h0;
  end

  // The header of a register access, a byte (with the end of the slave address of a command), or
  // the next bit. At most one of the three is chosen.
  assign bits_header = take && cts;
  assign bits_byte   = take ? !cts : step && cts && (slot_q == biss_pkg::SLOT_BYTE ||
                                                     slot_q == biss_pkg::SLOT_NEXT);
  assign bits_shift  = !take && step &&
                       ((header && slot_q != biss_pkg::SLOT_CTS) || data || ida);
  assign bits_d = ({access_i.id, access_i.addr} & {10{bits_header}}) |
                  ({rdata_i, access_i.id[2:1] & {2{!cts}}} & {10{bits_byte}}) |
                  ({bits_q[8:0], (data && !write) ? cds : top} & {10{bits_shift}});

  assign byte_o.wr_en   = step && cts && !write && !fail && slot_q == biss_pkg::SLOT_STOP &&
                          !abort_i;
  assign byte_o.addr    = index_q;
  assign byte_o.wr_data = bits_q[7:0];

  always_comb begin
    active_d      = active_q;
    carries_d     = start_i ? active_start_o : carries_q && !frame_done_i;
    slot_d        = slot_q;
    index_d       = index_q;
    last_d        = last_q;
    sent_d        = sent_q;
    end_d         = 1'b0;
    reg_error_d   = 1'b0;
    delay_error_d = 1'b0;

    if (step) begin
      sent_d = sent;
      if (!stay) slot_d = (slot_q == biss_pkg::SLOT_NEXT) ? biss_pkg::SLOT_WAIT
                                                             : slot_q + 6'd1;
      if (slot_q == biss_pkg::SLOT_STOP && !fail) begin
        index_d = index_q + 6'd1;
        last_d  = index_q == access_i.byte_last;
      end
      end_d         = fail || finish || late;
      reg_error_d   = fail || ida_bad_d != 2'b00;
      delay_error_d = late;
    end else if (active_q && stalled_i) begin
      end_d         = 1'b1;
      reg_error_d   = !(cts && slot_q == biss_pkg::SLOT_WAIT);
      delay_error_d = cts && slot_q == biss_pkg::SLOT_WAIT;
    end

    // A frame may start in the clock of begin_i, so slot_q is 0 whenever no control frame runs.
    if (end_d) begin
      active_d  = 1'b0;
      carries_d = 1'b0;
      slot_d    = biss_pkg::SLOT_START;
    end
    if (begin_o) begin
      active_d = 1'b1;
      index_d  = 6'd0;
      last_d   = 1'b0;
    end
    if (abort_i) begin
      active_d  = 1'b0;
      carries_d = 1'b0;
      slot_d    = biss_pkg::SLOT_START;
      index_d   = 6'd0;
      end_d     = 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      active_q      <= 1'b0;
      carries_q     <= 1'b0;
      fresh_q       <= '0;
      broadcast_q   <= 1'b0;
      slot_q        <= '0;
      bits_q        <= '0;
      crc_q         <= '0;
      index_q       <= '0;
      last_q        <= 1'b0;
      sent_q        <= 1'b0;
      ida_bad_q     <= '0;
      end_q         <= 1'b0;
      reg_error_q   <= 1'b0;
      delay_error_q <= 1'b0;
    end else begin
      active_q      <= active_d;
      carries_q     <= carries_d;
      fresh_q       <= begin_o ? 2'b01 : take ? 2'b00 : {fresh_q[0], fresh_q[0]};
      slot_q        <= slot_d;
      index_q       <= index_d;
      last_q        <= last_d;
      sent_q        <= sent_d;
      end_q         <= end_d;
      reg_error_q   <= reg_error_d;
      delay_error_q <= delay_error_d;
      if (take) broadcast_q <= rdata_i == 8'h00;
      if (bits_header || bits_byte || bits_shift) bits_q <= bits_d;
      if (step) crc_q <= crc_d;
      if (begin_o)   ida_bad_q <= '0;
      else if (step) ida_bad_q <= ida_bad_d;
    end
  end

  // begin_i stays high until a frame takes the instruction. After a stall it is still the old
  // instruction, so it does not begin a control frame.
  assign begin_o       = begin_i && !active_q && !stalled_i;
  assign active_o      = active_q || begin_o;
  assign active_start_o = active_q || (begin_i && !stalled_start_i);
  assign running_o     = active_q;
  assign wait_o        = active_q && cts && slot_q == biss_pkg::SLOT_WAIT;
  assign late          = wait_o && stay && expired_i;
  assign moved_o       = step && !(wait_o && stay);
  assign in_body_o     = carries_q &&
                         (cts ? BODY[slot_q] : tested ? TESTED[slot_q] : COMMAND[slot_q]);
  assign end_o.ends        = end_q;
  assign end_o.reg_error   = reg_error_q;
  assign end_o.delay_error = delay_error_q;
  assign end_o.good_bytes  = index_q;

  `ENC_ASSERT(SlotInRange_A, clk_i, rst_ni, slot_q <= biss_pkg::SLOT_NEXT)
  `ENC_ASSERT_IF(IdleIsSlot0_A, clk_i, rst_ni, !active_q, slot_q == biss_pkg::SLOT_START)
  `ENC_ASSERT_IF(DataCrcStartsAtZero_A, clk_i, rst_ni,
                 slot_q == biss_pkg::SLOT_BYTE || slot_q == biss_pkg::SLOT_NEXT, crc_q == 4'h0)
  `ENC_ASSERT_IF(NextIsForRegisters_A, clk_i, rst_ni, active_q && !cts,
                 slot_q <= biss_pkg::SLOT_STOP_TESTED)

endmodule
