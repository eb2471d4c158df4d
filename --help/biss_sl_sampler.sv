




















`include "enc_check.svh"

module biss_sl_sampler #(
  parameter logic [1:0]  SlCells = biss_pkg_SL_FLOPS,
  parameter int DelayW  = 8    
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       sl_i,         
  
  input  biss_pkg_sample_t sample_i,
  input  logic       sample_half_i, 
  
  input  logic       clear_i,
  input  logic       ssi_i,
  input  logic       armed_a_i,
  input  logic       armed_b_i,
  
  output logic       sl_o,         
  output logic       ack_o,        
  output logic [7:0] quarters_o,
  output logic       late_o,       
  output logic       bit_valid_o,
  output logic       bit_o
);

  localparam logic [DelayW-1:0] LONGEST = {DelayW{1'b1}};

`ifndef __ICARUS__  
  if (DelayW < 1 || DelayW > 8) begin : gen_delay
    $error("DelayW is 1 to 8");
  end
`endif

  logic       pos;
  logic       neg;
  logic [1:0] armed_a_q;
  logic [1:0] armed_b_q;
  logic       value_b;
  logic       look_a;
  logic       look_b;
  logic       hit_a;
  logic       hit_b;
  logic       found_q;
  logic       found_d;
  logic [1:0] phase_q;   
  logic [1:0] phase_d;
  logic       skip_q;
  logic       skip_d;
  logic [DelayW-1:0] quarters_q;
  logic [DelayW-1:0] quarters_d;
  logic       phase_known;
  logic       at_phase;

  biss_sl_capture #(.SlCells(SlCells)) u_capture (
    .clk_i,
    .rst_ni,
    .sl_i,
    .pos_o (pos),
    .neg_o (neg)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_a_q <= '0;
      armed_b_q <= '0;
    end else begin
      armed_a_q <= clear_i ? 2'b00 : {armed_a_q[0], armed_a_i};
      armed_b_q <= clear_i ? 2'b00 : {armed_b_q[0], armed_b_i};
    end
  end

  assign value_b = sample_i.b_neg ? neg : pos;
  assign look_a  = sample_i.a && armed_a_q[1] && !found_q && !ssi_i;
  assign look_b  = sample_i.b && armed_b_q[1] && !found_q && !ssi_i;
  assign hit_a   = look_a && !pos;
  assign hit_b   = look_b && !value_b && !hit_a;

  assign phase_known = ssi_i ? armed_b_q[1] : found_q;

  logic at_phase_shadow; logic found_d_shadow; logic [1:0] phase_d_shadow; logic [DelayW-1:0] quarters_d_shadow; logic skip_d_shadow; always begin begin
    at_phase_shadow   = phase_known && sample_half_i != phase_q[1] &&
                 (phase_q[0] ? sample_i.b : sample_i.a);
    found_d_shadow    = found_q;
    phase_d_shadow    = phase_q;
    skip_d_shadow     = skip_q && !at_phase_shadow;
    quarters_d_shadow = quarters_q;
    if (clear_i) begin
      found_d_shadow    = 1'b0;
      phase_d_shadow    = 2'b00;
      skip_d_shadow     = 1'b0;
      quarters_d_shadow = '0;
    end else if (!found_q && !ssi_i) begin
      
      if (look_a && quarters_d_shadow != LONGEST)           quarters_d_shadow = quarters_d_shadow + DelayW'(1);
      if (look_b && !hit_a && quarters_d_shadow != LONGEST) quarters_d_shadow = quarters_d_shadow + DelayW'(1);
      found_d_shadow = hit_a || hit_b;
      
      
      if (hit_a) begin
        phase_d_shadow = {!sample_half_i, 1'b1};
        skip_d_shadow  = !sample_i.b;
      end else if (hit_b) begin
        phase_d_shadow = {sample_half_i, 1'b0};
        skip_d_shadow  = 1'b1;
      end
    end
  end at_phase = at_phase_shadow; found_d = found_d_shadow; phase_d = phase_d_shadow; quarters_d = quarters_d_shadow; skip_d = skip_d_shadow; @(clear_i or found_q or hit_a or hit_b or look_a or look_b or phase_known or phase_q or quarters_q or sample_half_i or sample_i or skip_q or ssi_i); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      found_q    <= 1'b0;
      phase_q    <= '0;
      skip_q     <= 1'b0;
      quarters_q <= '0;
    end else begin
      found_q    <= found_d;
      phase_q    <= phase_d;
      skip_q     <= skip_d;
      quarters_q <= quarters_d;
    end
  end

  assign sl_o        = pos;
  assign ack_o       = found_q;
  assign quarters_o  = 8'(quarters_q);
  assign late_o      = quarters_q == LONGEST;
  assign bit_valid_o = at_phase && !skip_q;
  assign bit_o       = phase_q[0] ? value_b : pos;

  `ENC_ASSERT_NEXT(AckIsKept_A, clk_i, rst_ni, found_q && !clear_i, found_q)

endmodule
