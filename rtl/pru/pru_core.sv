// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C master with the memory of TIDEP0022 on AXI4-Lite. Its quirks are a port, so that a
// simulator can set them; biss_pru ties them to parameters.
//
// Clock domain: clk_i, 200 or 80 MHz. sl_i and trigger_i are asynchronous. ma_o is a flop.
//
// Reset: rst_ni may fall and rise at any time; it is released here with clk_i. It cuts a low pulse
// of MA short. The master then rests until RUN is 1.
//
// Misuse: an address without a register reads 0 and ignores writes. quirks_i must not change while
// RUN is 1. Others: pru_pace, pru_frame, pru_control.
// Source: TIDEP0022; docs/pru.md.

module pru_core #(
  parameter int unsigned ClockHz = 200_000_000   // or 80_000_000
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  pru_pkg::quirks_t quirks_i,
  // AXI4-Lite
  input  logic        s_axi_awvalid,
  output logic        s_axi_awready,
  input  logic [11:0] s_axi_awaddr,
  input  logic        s_axi_wvalid,
  output logic        s_axi_wready,
  input  logic [31:0] s_axi_wdata,
  input  logic [3:0]  s_axi_wstrb,
  output logic        s_axi_bvalid,
  input  logic        s_axi_bready,
  output logic [1:0]  s_axi_bresp,
  input  logic        s_axi_arvalid,
  output logic        s_axi_arready,
  input  logic [11:0] s_axi_araddr,
  output logic        s_axi_rvalid,
  input  logic        s_axi_rready,
  output logic [31:0] s_axi_rdata,
  output logic [1:0]  s_axi_rresp,
  output logic        irq_o,
  // frames
  input  logic        trigger_i,
  // BiSS C
  output logic        ma_o,
  input  logic        sl_i
);

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (ClockHz != 200_000_000 && ClockHz != 80_000_000) begin : gen_clock
    $error("ClockHz is 200000000 or 80000000");
  end
`endif

  localparam logic [6:0] LONGEST = 7'd63;   // bits of position, nE, nW, CRC

  logic        rst_n;
  logic        word_req, word_write;
  logic [11:2] word_addr;
  logic [31:0] word_wdata;
  logic [3:0]  word_be;
  pru_pkg::bus_t     bus;
  pru_pkg::cfg_t     cfg;
  pru_pkg::plan_t    plan;
  pru_pkg::found_t   found;
  pru_pkg::control_t control;
  pru_pkg::memory_t  memory;
  logic [31:0] data;
  logic        settle, first, start, absent, update, stop, triggered, lost;
  logic        over, rests, latch, sl, averages;
  logic        cdm, ctrl_end;
  logic [3:0]  ctrl_write;
  logic [31:0] ctrl_word;
  logic        ended, error;
  logic [5:0]  data_bits_q, tail_bits_q;
  logic [5:0]  tail_bits;
  logic [6:0]  most;            // bits of position beside tail_bits
  logic        fits;
  logic [1:0]  mhz_d;
  logic [1:0]  mhz_q;           // last legal value of FREQUENCY
  logic [1:0]  mhz_next;
  logic        known;           // FREQUENCY has a legal value
  logic [1:0]  mhz;             // of the next frame
  logic [1:0]  plan_mhz_q;
  logic        plan_cdm_q;
  logic        calm_q;          // MA rests, and the plan is that of the next frame
  logic [9:0]  proc_max;        // of the next frame
  logic [9:0]  proc_max_q;
  logic        unused;

  enc_reset_sync u_rst (
    .clk_i,
    .rst_ni,
    .rst_sync_no (rst_n)
  );

  enc_axil #(.AddrW(12)) u_axil (
    .clk_i,
    .rst_ni        (rst_n),
    .s_axi_awvalid,
    .s_axi_awready,
    .s_axi_awaddr  (s_axi_awaddr[11:2]),
    .s_axi_wvalid,
    .s_axi_wready,
    .s_axi_wdata,
    .s_axi_wstrb,
    .s_axi_bvalid,
    .s_axi_bready,
    .s_axi_bresp,
    .s_axi_arvalid,
    .s_axi_arready,
    .s_axi_araddr  (s_axi_araddr[11:2]),
    .s_axi_rvalid,
    .s_axi_rready,
    .s_axi_rdata,
    .s_axi_rresp,
    .word_req_o    (word_req),
    .word_write_o  (word_write),
    .word_addr_o   (word_addr),
    .word_data_o   (word_wdata),
    .word_be_o     (word_be),
    .word_ready_i  (1'b1),
    .word_data_i   (data),
    .word_error_i  (1'b0)
  );

  always_comb begin
    bus.rd   = word_req && !word_write;
    bus.wr   = word_req && word_write;
    bus.be   = word_be;
    bus.addr = {word_addr, 2'b00};
    bus.data = word_wdata;
  end

  pru_regs #(.ClockHz(ClockHz)) u_regs (
    .clk_i,
    .rst_ni       (rst_n),
    .quirks_i,
    .bus_i        (bus),
    .data_o       (data),
    .cfg_o        (cfg),
    .ctrl_write_o (ctrl_write),
    .ctrl_word_i  (ctrl_word),
    .control_i    (control),
    .memory_i     (memory),
    .latch_i      (latch),
    .update_i     (ended),
    .error_i      (error),
    .ctrl_end_i   (ctrl_end),
    .triggered_i  (triggered),
    .lost_i       (lost),
    .irq_o
  );

  pru_pace #(.ClockHz(ClockHz)) u_pace (
    .clk_i,
    .rst_ni      (rst_n),
    .run_i       (cfg.run),
    .period_i    (cfg.period),
    .overhead_i  (cfg.overhead),
    .trigger_i,
    .sl_i        (sl),
    .rests_i     (calm_q),
    .over_i      (over),
    .settle_o    (settle),
    .first_o     (first),
    .start_o     (start),
    .absent_o    (absent),
    .update_o    (update),
    .stop_o      (stop),
    .triggered_o (triggered),
    .lost_o      (lost)
  );

  // ---- What a frame is ----------------------------------------------------------------------

  assign tail_bits = cfg.crc_err_war > 8'd32 ? 6'd32 : cfg.crc_err_war[5:0];
  assign most      = LONGEST - {1'b0, tail_bits};
  assign fits      = cfg.data_length <= {1'b0, most};

  always_comb begin
    known = 1'b1;
    mhz_d = pru_pkg::MHZ_1;
    unique case (cfg.frequency)
      8'd1:    mhz_d = pru_pkg::MHZ_1;
      8'd2:    mhz_d = pru_pkg::MHZ_2;
      8'd5:    mhz_d = pru_pkg::MHZ_5;
      8'd10:   mhz_d = pru_pkg::MHZ_10;
      default: known = 1'b0;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_n) begin
    if (!rst_n) begin
      data_bits_q <= 6'd1;
      tail_bits_q <= '0;
      mhz_q       <= pru_pkg::MHZ_1;
    end else begin
      if (settle) begin
        data_bits_q <= cfg.data_length == 8'd0 ? 6'd1 : fits ? cfg.data_length[5:0] : most[5:0];
        tail_bits_q <= tail_bits;
      end
      if (update) mhz_q <= mhz_next;
    end
  end

  assign mhz_next = known ? mhz_d : mhz_q;
  assign mhz      = first ? pru_pkg::MHZ_1 : mhz_q;

  always_comb begin
    proc_max = cfg.proc_max;
    if (cfg.proc_max == 10'd0) begin
      unique case (mhz)
        pru_pkg::MHZ_1: proc_max = 10'd40;
        pru_pkg::MHZ_2: proc_max = 10'd80;
        pru_pkg::MHZ_5: proc_max = 10'd200;
        default:        proc_max = 10'd400;
      endcase
    end
  end

  // What changes with the memory may do so while MA makes its last edge: a frame keeps its own.
  always_ff @(posedge clk_i or negedge rst_n) begin
    if (!rst_n) begin
      plan_mhz_q <= pru_pkg::MHZ_1;
      plan_cdm_q <= 1'b0;
      proc_max_q <= '0;
      calm_q     <= 1'b0;
    end else begin
      if (rests) begin
        plan_mhz_q <= mhz;
        plan_cdm_q <= cdm;
        proc_max_q <= proc_max;
      end
      calm_q <= rests && !update;
    end
  end

  always_comb begin
    plan.mhz       = plan_mhz_q;
    plan.data_bits = data_bits_q;
    plan.tail_bits = tail_bits_q;
    plan.cdm       = plan_cdm_q;
  end

  pru_frame #(.ClockHz(ClockHz)) u_frame (
    .clk_i,
    .rst_ni     (rst_n),
    .quirks_i,
    .plan_i     (plan),
    .proc_max_i (proc_max_q),
    .start_i    (start),
    .stop_i     (stop),
    .forget_i   (settle || (update && mhz_next != mhz)),
    .update_i   (update && !absent),
    .over_o     (over),
    .rests_o    (rests),
    .latch_o    (latch),
    .sl_o       (sl),
    .averages_o (averages),
    .found_o    (found),
    .ma_o,
    .sl_i
  );

  pru_control u_control (
    .clk_i,
    .rst_ni    (rst_n),
    .write_i   (ctrl_write),
    .data_i    (bus.data),
    .word_o    (ctrl_word),
    .clear_i   (stop),
    .step_i    (update),
    .clocked_i (!absent),
    .cds_i     (found.cds),
    .cdm_o     (cdm),
    .end_o     (ctrl_end),
    .control_o (control)
  );

  pru_memory u_memory (
    .clk_i,
    .rst_ni      (rst_n),
    .clear_i     (settle),
    .update_i    (update),
    .absent_i    (absent),
    .averages_i  (averages),
    .found_i     (found),
    .more_line_i (quirks_i.extra_10 && plan.mhz == pru_pkg::MHZ_10),
    .ctrl_bad_i  (control.crc_bad),
    .memory_o    (memory),
    .ended_o     (ended),
    .error_o     (error)
  );

  assign unused = (^s_axi_awaddr[1:0]) ^ (^s_axi_araddr[1:0]);

endmodule
