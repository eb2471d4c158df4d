












module mb4_ma_force (
  input  logic       clk_i,
  input  logic       rst_ni,
  
  input  logic       mafs_i,     
  input  logic       mavs_i,     
  input  logic       mafo_i,     
  input  logic       mavo_i,
  input  logic [1:0] chsel_i,
  output logic [1:0] force_o,
  output logic [1:0] level_o,
  output logic       change_o,
  output logic       any_o       
);

  logic [5:0] meta_q;
  logic [5:0] sync_q;
  logic [5:0] last_q;
  logic [5:0] held_q;
  logic [1:0] selected;
  logic       change_q, any_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      meta_q   <= '0;
      sync_q   <= '0;
      last_q   <= '0;
      held_q   <= '0;
      change_q <= 1'b0;
      any_q    <= 1'b0;
    end else begin
      meta_q   <= {mafs_i, mavs_i, mafo_i, mavo_i, chsel_i};
      sync_q   <= meta_q;
      last_q   <= sync_q;
      if (sync_q == last_q) held_q <= sync_q;
      change_q <= sync_q == last_q && held_q != sync_q;
      any_q    <= force_o != 2'b00;
    end
  end

  assign selected = held_q[1:0] == 2'b00 ? 2'b01 : held_q[1:0];
  assign force_o  = ({2{held_q[5]}} & selected) | ({2{held_q[3]}} & ~selected);
  assign level_o  = ({2{held_q[4]}} & selected) | ({2{held_q[2]}} & ~selected);
  assign change_o = change_q;
  assign any_o    = any_q;

endmodule
