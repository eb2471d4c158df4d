












module mb4_reg_watchdog (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [2:0] freqr_i,
  input  logic       watch_i,
  input  logic       clear_i,
  input  logic       live_i,
  input  logic       tick_i,     
  output logic       expired_o,
  output logic       stalled_o
);

  localparam int BASE = 14;  

  logic [BASE+7:0] count_q;
  logic [7:0]      high;
  logic [7:0]      eighth;

  assign high      = count_q[BASE+7:BASE];
  assign eighth    = count_q[BASE+4:BASE-3];
  assign expired_o = high[freqr_i];
  assign stalled_o = expired_o && eighth[freqr_i];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                     count_q <= '0;
    else if (!watch_i || clear_i)    count_q <= '0;
    else if (tick_i && !stalled_o && (live_i || !expired_o)) count_q <= count_q + 22'd1;
  end

endmodule
