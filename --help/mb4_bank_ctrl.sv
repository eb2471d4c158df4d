






















module mb4_bank_ctrl (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic singlebank_i,
  input  logic holdbank_i,
  input  logic kept_i,          
  input  mb4_pkg_bank_cmd_t bank_i,
  output logic pending_o,
  output mb4_pkg_bank_event_t event_o,
  output logic base_o,          
  output logic newest_o,        
  output mb4_pkg_banks_t banks_o
);

  logic host_q;
  logic base_q;
  logic base_d;
  logic newest_q;
  logic pending_q;
  logic pending_d;
  logic hold_q;
  logic end_q;
  logic kept;
  logic want;
  logic swap;
  logic follow;
  logic made_q;       

  enc_sync_bit u_kept (
    .clk_i,
    .rst_ni,
    .data_i (kept_i),
    .data_o (kept)
  );

  assign want   = ((pending_q && !bank_i.run) || end_q) && !singlebank_i;
  assign swap   = want && !holdbank_i;
  assign follow = (holdbank_i || hold_q) && base_q != kept;
  assign base_d = base_q ^ (swap || follow);
  assign pending_d = follow ? !hold_q : want && holdbank_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      host_q    <= 1'b0;
      base_q    <= 1'b0;
      newest_q  <= 1'b0;
      pending_q <= 1'b0;
      hold_q    <= 1'b0;
      end_q     <= 1'b0;
      made_q    <= 1'b0;
    end else begin
      host_q    <= host_q ^ (swap || follow) ^ bank_i.swap;
      base_q    <= base_d;
      newest_q  <= base_d ^ pending_d;
      pending_q <= pending_d;
      hold_q    <= holdbank_i;
      end_q     <= bank_i.data_end;
      made_q    <= follow && hold_q;
    end
  end

  assign pending_o   = pending_q;
  assign event_o     = {swap || made_q, pending_q && bank_i.run};
  assign base_o      = base_q;
  assign newest_o    = newest_q;
  assign banks_o     = {host_q, host_q ^ !singlebank_i};

endmodule
