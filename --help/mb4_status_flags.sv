










module mb4_status_flags (
  input  logic clk_i,
  input  logic rst_ni,
  input  mb4_pkg_frame_flags_t  frame_i,
  input  mb4_pkg_bank_event_t   bank_i,
  input  mb4_pkg_access_event_t access_i,
  input  mb4_pkg_access_state_t access_state_i,
  output mb4_pkg_flags_t flags_o,
  output logic ner_low_o       
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

  logic fail_d_shadow; logic n_agserr_d_shadow; logic n_delayerr_d_shadow; logic n_regerr_d_shadow; logic n_scderr_d_shadow; logic regend_d_shadow; always begin begin
    n_scderr_d_shadow   = n_scderr_q;
    n_agserr_d_shadow   = n_agserr_q;
    fail_d_shadow       = fail_q && !bank_i.swapped;
    n_regerr_d_shadow   = n_regerr_q;
    n_delayerr_d_shadow = n_delayerr_q;
    regend_d_shadow     = regend_q;
    if (frame_i.clear) begin
      n_scderr_d_shadow = 1'b1;
      n_agserr_d_shadow = 1'b1;
    end
    if (frame_i.clear || access_i.begins) begin
      n_regerr_d_shadow   = 1'b1;
      n_delayerr_d_shadow = 1'b1;
      regend_d_shadow     = 1'b0;
    end else if (access_i.ends) begin
      n_regerr_d_shadow   = !access_i.reg_error;
      n_delayerr_d_shadow = !access_i.delay_error;
      regend_d_shadow     = 1'b1;
    end
    if (frame_i.scd_en)    n_scderr_d_shadow = !frame_i.scd_bad;
    if (frame_i.ags_error) n_agserr_d_shadow = 1'b0;
    if (frame_i.bank_fail || bank_i.lost) fail_d_shadow = 1'b1;
  end fail_d = fail_d_shadow; n_agserr_d = n_agserr_d_shadow; n_delayerr_d = n_delayerr_d_shadow; n_regerr_d = n_regerr_d_shadow; n_scderr_d = n_scderr_d_shadow; regend_d = regend_d_shadow; @(access_i or bank_i or fail_q or frame_i or n_agserr_q or n_delayerr_q or n_regerr_q or n_scderr_q or regend_q); end

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
      ner_low_q    <= !(n_scderr_d && n_agserr_d && n_regerr_d && n_delayerr_d);
    end
  end

  
  assign flags_o = {n_agserr_q, n_delayerr_q, n_scderr_q, n_regerr_q, regend_q, eot_q, fail_q,
                    access_state_i.cdm_timeout,
                    (n_regerr_q && n_delayerr_q) ? 6'd0 : access_state_i.good_bytes};
  assign ner_low_o = ner_low_q;

endmodule
