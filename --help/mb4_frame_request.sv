


















module mb4_frame_request (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       ags_i,
  input  logic       restart_i,    
  input  logic [7:0] freqags_i,
  input  logic       hold_cdm_i,
  input  logic       getsens_i,    
  input  logic       busy_i,       
  input  logic       lines_idle_i,
  input  logic       taken_i,
  output mb4_pkg_request_t request_o,
  output logic       missed_o
);

  logic       agsmin;
  logic       infinite;
  logic       timed;
  logic       getsens;
  logic [9:0] pre_q;      
  logic [6:0] step_q;     
  logic       pre_end;
  logic       due;
  logic       pending_d;
  logic       pending_q;
  logic       armed_d;
  logic       armed_q;    

  enc_sync_bit u_getsens (
    .clk_i,
    .rst_ni,
    .data_i (getsens_i),
    .data_o (getsens)
  );

  assign agsmin   = freqags_i == mb4_regs_pkg_AGS_RATE_AGS_MIN;
  assign infinite = freqags_i[7:2] == 6'b011111 && !agsmin;
  assign timed      = ags_i && !agsmin && !infinite;

  assign pre_end = pre_q == (freqags_i[7] ? 10'd624 : 10'd19);
  assign due     = timed && !restart_i && pre_end && step_q == freqags_i[6:0];

  logic armed_d_shadow; logic pending_d_shadow; always begin begin
    armed_d_shadow   = (armed_q || !getsens) && !taken_i;
    pending_d_shadow = (pending_q && !taken_i) || (due && !busy_i);
    if (!timed || restart_i) pending_d_shadow = 1'b0;
  end armed_d = armed_d_shadow; pending_d = pending_d_shadow; @(armed_q or busy_i or due or getsens or pending_q or restart_i or taken_i or timed); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pre_q     <= '0;
      step_q    <= '0;
      pending_q <= 1'b0;
      armed_q   <= 1'b1;
    end else begin
      if (!timed || restart_i) begin
        pre_q  <= 10'd0;
        step_q <= 7'd0;
      end else begin
        pre_q <= pre_end ? 10'd0 : pre_q + 10'd1;
        if (pre_end) step_q <= due ? 7'd0 : step_q + 7'd1;
      end
      pending_q <= pending_d;
      armed_q   <= armed_d;
    end
  end

  assign request_o = {ags_i && (agsmin || pending_q ||
                                (infinite && getsens && lines_idle_i && (armed_q || !hold_cdm_i))),
                      agsmin, infinite};
  assign missed_o  = due && busy_i;

endmodule
