// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register access of one channel at a time, by one CDM and one CDS bit in each of its frames, while
// all channels go on with their positions. biss_control_frame makes the control frame; this module
// has the registers of the host, chooses the channel and counts what limits an access.
//
// Clock domain: core. An access of one register needs about 50 frames, and up to 14 more before it
// if the encoder has not seen as many frames without CDM. end_o is high for one clock at its end.
//
// - Writing ACCESS with START = 1 begins an access; while one runs the write is ignored. START = 0
//   ends one that runs, as ERROR.
// - A frame that fails ends it as ERROR. An encoder that does not answer within WaitFrames frames
//   ends it as NO_ANSWER. A start with SLO = 0 is no frame, and the access goes on later.
//
// Misuse: a channel that does not exist ends the access at once as ERROR. Without frames of its
// channel an access does not end by itself.
// Source: regmap/axi.rdl; BiSS C, control frame: see biss_control_frame.

module axi_access #(
  parameter int unsigned Channels   = 1,
  parameter int unsigned WaitFrames = 1024   // a power of 2
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,    // soft reset
  input  axi_pkg::bus_t bus_i,
  output logic [31:0] data_o,
  input  logic [Channels*axi_pkg::EVENT_W-1:0] events_i,
  output logic [Channels*2-1:0] cdm_o,    // for each channel: CDM if CDS of the frame is 1, 0
  output logic        end_o
);

  localparam int unsigned WAIT_W = $clog2(WaitFrames);

  logic [6:0] address_q;
  logic [2:0] slave_q;
  logic [3:0] channel_q;
  logic       write_q;
  logic [7:0] byte_q;      // to write, or as read
  logic       begin_q;
  logic       busy_q;
  logic       error_q;
  logic       silent_q;
  logic       end_q;
  logic [WAIT_W-1:0] wait_q;   // frames without an answer

  logic       command, start, stop, present;
  logic [axi_pkg::EVENT_W-1:0] happens;   // in the channel
  logic       ended, abort;
  logic       running, waits, in_body, moved, timeout;
  logic [1:0] cdm0, cdm1;
  biss_pkg::access_t      access;
  biss_pkg::access_byte_t data;
  biss_pkg::access_end_t  finish;
  logic       unused_active, unused_start, unused_begin, unused;

  assign command = bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_ACCESS;
  assign start   = command && bus_i.data[31] && !busy_q;
  assign stop    = command && !bus_i.data[31] && busy_q;
  assign present = {1'b0, channel_q} < 5'(Channels);

  always_comb begin
    happens = '0;
    for (int unsigned i = 0; i < Channels; i++)
      if (channel_q == 4'(i)) happens = events_i[i*axi_pkg::EVENT_W +: axi_pkg::EVENT_W];
  end

  assign ended = happens[axi_pkg::EVENT_ENDED];
  assign abort = clear_i || stop || (begin_q && !present) ||
                 (busy_q && happens[axi_pkg::EVENT_FAILED]);

  assign access.cts       = 1'b1;
  assign access.write     = write_q;
  assign access.addr      = address_q;
  assign access.byte_last = 6'd0;
  assign access.id        = slave_q;

  biss_control_frame u_frame (
    .clk_i,
    .rst_ni,
    .access_i      (access),
    .ida_invert_i  (1'b0),
    .select_i      (2'b01),
    .blind_i       (1'b0),
    .byte_o        (data),
    .rdata_i       (byte_q),
    .post_busy_i   (1'b0),
    .begin_i       (begin_q && present),
    .abort_i       (abort),
    .start_i       (happens[axi_pkg::EVENT_BEGUN]),
    .frame_done_i  (ended),
    .cds_i         ({1'b0, happens[axi_pkg::EVENT_CDS]}),
    .cdm_timeout_i (timeout),
    .expired_i     (wait_q == WAIT_W'(WaitFrames - 1)),
    .stalled_i     (1'b0),
    .stalled_start_i (1'b0),
    .active_o      (unused_active),
    .active_start_o (unused_start),
    .running_o     (running),
    .in_body_o     (in_body),
    .wait_o        (waits),
    .moved_o       (moved),
    .cdm0_o        (cdm0),
    .cdm1_o        (cdm1),
    .begin_o       (unused_begin),
    .end_o         (finish)
  );

  biss_cdm_timeout u_timeout (
    .clk_i,
    .rst_ni,
    .frame_done_i (ended),
    .cdm_i        (happens[axi_pkg::EVENT_CDM] || in_body),
    .clear_i      (abort || (start && bus_i.data[15:12] != channel_q)),
    .timeout_o    (timeout)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      address_q <= '0;
      slave_q   <= '0;
      channel_q <= '0;
      write_q   <= 1'b0;
      byte_q    <= '0;
      begin_q   <= 1'b0;
      busy_q    <= 1'b0;
      error_q   <= 1'b0;
      silent_q  <= 1'b0;
      end_q     <= 1'b0;
      wait_q    <= '0;
    end else begin
      if (start) begin
        address_q <= bus_i.data[6:0];
        slave_q   <= bus_i.data[10:8];
        channel_q <= bus_i.data[15:12];
        write_q   <= bus_i.data[16];
      end
      if (bus_i.wr && bus_i.addr == axi_regs_pkg::ADDR_ACCESS_DATA && !busy_q)
        byte_q <= bus_i.data[7:0];
      else if (data.wr_en)
        byte_q <= data.wr_data;
      begin_q <= start && !clear_i;
      busy_q  <= !abort && (start || (busy_q && !finish.ends));
      if (start || clear_i)                error_q <= 1'b0;
      else if (abort && busy_q)            error_q <= 1'b1;
      else if (finish.ends && busy_q)      error_q <= finish.reg_error;
      if (start || clear_i)                silent_q <= 1'b0;
      else if (finish.ends && busy_q)      silent_q <= finish.delay_error;
      end_q   <= busy_q && (abort || finish.ends);
      if (!waits || moved) wait_q <= '0;
      else if (ended)      wait_q <= wait_q + WAIT_W'(1);
    end
  end

  for (genvar i = 0; i < Channels; i++) begin : gen_channel
    assign cdm_o[2*i +: 2] = {cdm1[0], cdm0[0]} & {2{running && channel_q == 4'(i)}};
  end

  always_comb begin
    data_o = '0;
    unique case (bus_i.addr)
      axi_regs_pkg::ADDR_ACCESS:
        data_o = {busy_q, 14'd0, write_q, channel_q, 1'b0, slave_q, 1'b0, address_q};
      axi_regs_pkg::ADDR_ACCESS_DATA:   data_o[7:0] = byte_q;
      axi_regs_pkg::ADDR_ACCESS_STATUS: data_o[2:0] = {silent_q, error_q, busy_q};
      default:                          data_o      = '0;
    endcase
  end

  assign end_o  = end_q;
  assign unused = (^events_i) ^ (^happens) ^ (^bus_i) ^ (^cdm0) ^ (^cdm1) ^ (^data) ^ (^finish);

endmodule
