// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Status flags with their set and clear conditions; EOT and the NER output.
//
// Clock domain: core.
// Latency: EOT falls one clock after frame_i.busy rises. It rises three clocks after that falls,
// when the other flags, SVALID and the banks have settled. So a host that reads EOT = 1 also reads
// their new values. If a set and a clear come in one clock, the set wins.
// Datasheet: pages 33..35, Tables 54..60, 62, 63; decisions 1, 8, 9, 15, 24, 26.

module mb4_status_flags (
  input  logic clk_i,
  input  logic rst_ni,
  input  mb4_pkg::frame_flags_t  frame_i,
  input  mb4_pkg::bank_event_t   bank_i,
  input  mb4_pkg::access_event_t access_i,
  input  mb4_pkg::access_state_t access_state_i,
  output mb4_pkg::flags_t flags_o,
  output logic ner_low_o       // pull NER low
);

  logic [1:0] quiet_q;
  logic       eot_q;
  logic       n_scderr_d;
  logic       n_scderr_q;
  logic       n_agserr_d;
  logic       n_agserr_q;
  logic       n_regerr_d;
  logic       n_regerr_q;
  logic       n_delayerr_d;
  logic       n_delayerr_q;
  logic       regend_d;
  logic       regend_q;
  logic       fail_d;
  logic       fail_q;
  logic       ner_low_q;
  // NER is pulled low whatever frame_i.scd_bad is. Kept: synthesis does not know that this comes
  // late.
  (* keep *) logic ner_low;

  always_comb begin
    n_scderr_d   = n_scderr_q;
    n_agserr_d   = n_agserr_q;
    fail_d       = fail_q && !bank_i.swapped;
    n_regerr_d   = n_regerr_q;
    n_delayerr_d = n_delayerr_q;
    regend_d     = regend_q;
    if (frame_i.clear) begin
      n_scderr_d = 1'b1;
      n_agserr_d = 1'b1;
    end
    if (frame_i.clear || access_i.begins) begin
      n_regerr_d   = 1'b1;
      n_delayerr_d = 1'b1;
      regend_d     = 1'b0;
    end else if (access_i.ends) begin
      n_regerr_d   = !access_i.reg_error;
      n_delayerr_d = !access_i.delay_error;
      regend_d     = 1'b1;
    end
    if (frame_i.scd_en)    n_scderr_d = !frame_i.scd_bad;
    if (frame_i.ags_error) n_agserr_d = 1'b0;
    if (frame_i.bank_fail || bank_i.lost) fail_d = 1'b1;
  end

  // frame_i.scd_bad comes late.
  assign ner_low = !((frame_i.scd_en || n_scderr_q || frame_i.clear) && n_agserr_d && n_regerr_d &&
                     n_delayerr_d);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      quiet_q      <= 2'b11;
      eot_q        <= 1'b1;
      n_scderr_q   <= 1'b1;
      n_agserr_q   <= 1'b1;
      n_regerr_q   <= 1'b1;
      n_delayerr_q <= 1'b1;
      regend_q     <= 1'b0;
      fail_q       <= 1'b0;
      ner_low_q    <= 1'b0;
    end else begin
      quiet_q      <= {quiet_q[0], !frame_i.busy};
      eot_q        <= (quiet_q == 2'b11) && !frame_i.busy;
      n_scderr_q   <= n_scderr_d;
      n_agserr_q   <= n_agserr_d;
      n_regerr_q   <= n_regerr_d;
      n_delayerr_q <= n_delayerr_d;
      regend_q     <= regend_d;
      fail_q       <= fail_d;
      ner_low_q    <= ner_low || (frame_i.scd_en && frame_i.scd_bad);
    end
  end

  // REGBYTES tells the number of good bytes only after an error (Table 63).
  assign flags_o.n_agserr    = n_agserr_q;
  assign flags_o.n_delayerr  = n_delayerr_q;
  assign flags_o.n_scderr    = n_scderr_q;
  assign flags_o.n_regerr    = n_regerr_q;
  assign flags_o.regend      = regend_q;
  assign flags_o.eot         = eot_q;
  assign flags_o.swbank_fail = fail_q;
  assign flags_o.cdm_timeout = access_state_i.cdm_timeout;
  assign flags_o.regbytes    = (n_regerr_q && n_delayerr_q) ? 6'd0 : access_state_i.good_bytes;
  assign ner_low_o = ner_low_q;

endmodule
