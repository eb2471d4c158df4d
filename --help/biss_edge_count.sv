




















`include "enc_check.svh"

module biss_edge_count #(
  parameter int Slaves   = 8,    
  parameter int DataBits = 64,   
  parameter bit          Mo       = 1'b1  
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       biss_c_i,
  input  logic       ssi_i,
  input  logic       bus_i,
  input  logic [7:0] mo_busy_i,
  input  logic       begin_i,
  input  logic       run_i,        
  input  logic       len_valid_i,
  input  logic [6:0] len_i,
  input  logic       wait_i,
  input  logic       rise_i,
  output logic       two_o,        
  output logic       two_next_o,   
  output logic       none_left_o,
  output logic       one_left_o    
);

  
  localparam int MOST = 5 + (Mo ? 255 : 0) + Slaves * (DataBits + 17);
  localparam int W    = $clog2((MOST > 127 ? MOST : 127) + 1) + 1;  

  logic [1:0]          rises_d;
  logic [1:0]          rises_q;
  logic signed [W-1:0] more;       
  logic signed [W-1:0] need_d;
  logic signed [W-1:0] need_q;     
  logic               len_valid_q;
  logic [6:0]         len_q;
  logic               bus;
  logic [2:0]         base;        
  logic               take;
  logic               none_d;
  logic               none_q;
  logic               one_d;
  logic               one_q;

  assign more = need_q + (len_valid_q ? $signed(W'(len_q)) : $signed(W'(0)))
                       + (wait_i ? $signed(W'(1)) : $signed(W'(0)));
  assign take = rise_i && !need_q[W-1];

  assign bus  = Mo && bus_i;
  assign base = biss_c_i ? 3'd5 : ssi_i ? 3'd1 : 3'd4;

  
  logic signed [W-1:0] need_d_shadow; logic none_d_shadow; logic one_d_shadow; logic [1:0] rises_d_shadow; always begin begin
    rises_d_shadow = rises_q;
    need_d_shadow  = need_q;
    none_d_shadow  = none_q;
    one_d_shadow   = one_q;
    if (begin_i) begin
      rises_d_shadow = 2'd0;
      need_d_shadow  = $signed(W'(base)) + (bus ? $signed(W'(mo_busy_i)) : $signed(W'(0)));
      none_d_shadow  = 1'b0;
      one_d_shadow   = ssi_i && !biss_c_i && !(bus && mo_busy_i != 8'd0);
    end else if (run_i) begin
      if (rise_i && rises_q != 2'd2) rises_d_shadow = rises_q + 2'd1;
      need_d_shadow = more - (take ? $signed(W'(1)) : $signed(W'(0)));
      none_d_shadow = more[W-1] || more[W-2:1] == '0 && (take || !more[0]);
      one_d_shadow  = more[W-1] || more[W-2:1] == '0 || (take && more[W-2:0] == (W-1)'(2));
    end
  end need_d = need_d_shadow; none_d = none_d_shadow; one_d = one_d_shadow; rises_d = rises_d_shadow; @(base or begin_i or biss_c_i or bus or mo_busy_i or more or need_q or none_q or one_q or rise_i or rises_q or run_i or ssi_i or take); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rises_q <= '0;
      need_q  <= '0;
      none_q  <= 1'b1;
      one_q   <= 1'b1;
      len_valid_q <= 1'b0;
      len_q       <= '0;
    end else begin
      rises_q <= rises_d;
      need_q  <= need_d;
      none_q  <= none_d;
      one_q   <= one_d;
      len_valid_q <= len_valid_i && !begin_i;   
      len_q       <= len_i;
    end
  end

  assign two_o       = rises_q == 2'd2;
  assign two_next_o  = rises_d == 2'd2;
  assign none_left_o = none_q && !len_valid_q;
  assign one_left_o  = one_q && !len_valid_q;

  `ENC_ASSERT(NeedInRange_A, clk_i, rst_ni,
              32'(need_q) >= -1 && 32'(need_q) <= $signed(MOST))
  `ENC_ASSERT(NoneLeft_A, clk_i, rst_ni, none_q == (32'(need_q) <= 0))
  `ENC_ASSERT(OneLeft_A, clk_i, rst_ni, one_q == (32'(need_q) <= 1))

endmodule
