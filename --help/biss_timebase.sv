
















`include "enc_check.svh"

module biss_timebase (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [7:0] half_len_i,
  input  logic       run_i,
  input  logic       restart_i,
  output logic       tick_o,
  output logic       half_next_o,
  output biss_pkg_sample_t sample_o,
  output logic       sample_half_o  
);

  logic [7:0] len_q;
  logic [7:0] cnt_d;
  logic [7:0] cnt_q;
  logic       last_d;
  logic       last_q;      
  logic       half_d;
  logic       half_q;
  logic       tick;
  logic       middle;
  logic [1:0] a_q;
  logic [1:0] b_q;
  logic [1:0] h_q;

  
  assign tick   = run_i && last_q;
  assign middle = (len_q == 8'd1) ? tick : run_i && cnt_q == {1'b0, len_q[7:1]} - 8'd1;

  logic [7:0] cnt_d_shadow; logic half_d_shadow; logic last_d_shadow; always begin begin
    cnt_d_shadow  = cnt_q;
    last_d_shadow = last_q;
    half_d_shadow = half_q;
    if (restart_i) begin
      cnt_d_shadow  = 8'd0;
      last_d_shadow = half_len_i == 8'd1;
      half_d_shadow = 1'b1;
    end else if (tick) begin
      cnt_d_shadow  = 8'd0;
      last_d_shadow = len_q == 8'd1;
      half_d_shadow = !half_q;
    end else if (run_i) begin
      cnt_d_shadow  = cnt_q + 8'd1;
      last_d_shadow = cnt_q + 8'd2 == len_q;
    end
  end cnt_d = cnt_d_shadow; half_d = half_d_shadow; last_d = last_d_shadow; @(cnt_q or half_len_i or half_q or last_q or len_q or restart_i or run_i or tick); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      len_q  <= 8'd1;
      cnt_q  <= '0;
      last_q <= 1'b1;
      half_q <= 1'b1;
      a_q    <= '0;
      b_q    <= '0;
      h_q    <= '0;
    end else begin
      if (restart_i) len_q <= half_len_i;
      cnt_q  <= cnt_d;
      last_q <= last_d;
      half_q <= half_d;
      
      a_q    <= restart_i ? 2'b00 : {a_q[0], tick};
      b_q    <= restart_i ? 2'b00 : {b_q[0], middle};
      h_q    <= {h_q[0], half_d};
    end
  end

  assign tick_o        = tick;
  assign half_next_o   = !half_q;
  assign sample_o      = {a_q[1], b_q[1], len_q[0]};
  assign sample_half_o = h_q[1];

  `ENC_ASSERT(HalfLength_A, clk_i, rst_ni, len_q != 8'd0)
  `ENC_ASSERT_IF(CountInRange_A, clk_i, rst_ni, run_i, cnt_q < len_q)
  `ENC_ASSERT(LastOfHalf_A, clk_i, rst_ni, last_q == (cnt_q == len_q - 8'd1))

endmodule
