




















module biss_ma_drive (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic por_ni,         
  input  logic tick_i,
  input  logic half_next_i,
  input  logic start_i,        
  
  input  logic begin_i,
  input  logic clocked_i,      
  input  logic stop_i,         
  input  logic enough_i,       
  input  logic cdm_i,
  input  logic high_i,         
  input  logic register_i,     
  input  logic register_ma_i,
  
  input  logic force_i,
  input  logic force_level_i,
  output logic released_o,
  output logic rise_o,
  output logic clocking_o,
  output logic ma_o
);

  logic ma_d;
  logic ma_q;
  logic clocking_d;
  logic clocking_q;
  logic force_q;
  logic level_q;
  logic released_q;

  logic clocking_d_shadow; logic ma_d_shadow; always begin begin
    ma_d_shadow       = ma_q;
    clocking_d_shadow = clocking_q;
    if (begin_i) begin
      ma_d_shadow       = 1'b1;
      clocking_d_shadow = clocked_i;
    end else if (stop_i) begin
      clocking_d_shadow = 1'b0;
    end else if (tick_i && register_i) begin
      ma_d_shadow = register_ma_i;
    end else if (tick_i && clocking_q) begin
      if (!half_next_i) begin
        ma_d_shadow       = enough_i ? !cdm_i : 1'b0;
        clocking_d_shadow = !enough_i;
      end else if (enough_i && cdm_i) begin
        clocking_d_shadow = 1'b0;
      end else begin
        ma_d_shadow = 1'b1;
      end
    end else if (tick_i && high_i) begin
      ma_d_shadow = 1'b1;
    end
    if (force_q) ma_d_shadow = (tick_i && !start_i) ? level_q : ma_q;
  end clocking_d = clocking_d_shadow; ma_d = ma_d_shadow; @(begin_i or cdm_i or clocked_i or clocking_q or enough_i or force_q or half_next_i or high_i or level_q or ma_q or register_i or register_ma_i or start_i or stop_i or tick_i); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clocking_q <= 1'b0;
      force_q    <= 1'b0;
      level_q    <= 1'b0;
      released_q <= 1'b0;
    end else begin
      clocking_q <= clocking_d;
      force_q    <= force_i;
      level_q    <= force_level_i;
      released_q <= force_q && (!force_i || (tick_i && ma_q && !level_q));
    end
  end

  always_ff @(posedge clk_i or negedge por_ni) begin
    if (!por_ni) ma_q <= 1'b1;
    else         ma_q <= ma_d;
  end

  
  
  assign rise_o = tick_i && clocking_q && half_next_i && !register_i && !stop_i &&
                  !(enough_i && cdm_i);

  assign released_o = released_q;
  assign clocking_o = clocking_q;
  assign ma_o       = ma_q;

endmodule
