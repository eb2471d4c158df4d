














module mb4_word_list #(
  parameter bit Sum = 1'b1
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  
  input  logic [7:0] enscd_i,    
  input  logic [7:0] actnsens_i,
  input  logic       ssi_i,
  input  logic       nocrc_i,
  
  input  logic       start_i,
  input  logic       next_i,      
  output logic       cfg_en_o,
  output logic [2:0] cfg_slave_o, 
  input  mb4_pkg_slave_cfg_t cfg_i,  
  output logic       actuator_o,  
  
  output logic       len_valid_o,
  output logic [6:0] len_o,
  output biss_pkg_offer_t offer_o  
);

  logic [7:0]  todo_d;
  logic [7:0]  todo_q;
  logic [7:0]  rest;       
  logic        begins;     
  logic        summing_d;
  logic        summing_q;  
  logic [2:0]  first_new;
  logic [2:0]  first_rest;
  logic [2:0]  slave_d;
  logic [2:0]  slave_q;
  logic        crc_on;
  logic [3:0]  crc_last;
  logic [7:0]  crc_poly;
  logic [7:0]  crc_top;
  logic        actuator;
  logic        stop;
  logic        crc_room;
  logic        last;
  logic        unused;

  assign rest    = todo_q & (todo_q - 8'd1);
  
  assign unused  = cfg_i.enscd;

  mb4_crc_decode u_decode (
    .poly_i     (cfg_i.crc_poly),
    .crc_on_o   (crc_on),
    .crc_last_o (crc_last),
    .crc_poly_o (crc_poly),
    .crc_top_o  (crc_top)
  );

  assign begins = start_i || (summing_q && last);

  
  
  logic [2:0] first_new_shadow; logic [2:0] first_rest_shadow; always begin begin
    first_new_shadow  = 3'd0;
    first_rest_shadow = 3'd0;
    for (int i = 7; i >= 0; i--) begin
      if (enscd_i[i]) first_new_shadow  = 3'(i);
      if (rest[i])    first_rest_shadow = 3'(i);
    end
  end first_new = first_new_shadow; first_rest = first_rest_shadow; @(enscd_i or rest); end

  logic [2:0] slave_d_shadow; logic summing_d_shadow; logic [7:0] todo_d_shadow; always begin begin
    todo_d_shadow    = begins ? enscd_i : rest;
    slave_d_shadow   = begins ? first_new : first_rest;
    summing_d_shadow = Sum && (start_i ? enscd_i != 8'h00 : summing_q && !last);
  end slave_d = slave_d_shadow; summing_d = summing_d_shadow; todo_d = todo_d_shadow; @(begins or enscd_i or first_new or first_rest or last or rest or start_i or summing_q); end

  assign cfg_en_o    = start_i || next_i || summing_q;
  assign cfg_slave_o = slave_d;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      todo_q    <= 8'h00;
      summing_q <= 1'b0;
      slave_q   <= 3'd0;
    end else if (cfg_en_o) begin
      todo_q    <= todo_d;
      summing_q <= summing_d;
      slave_q   <= slave_d;
    end
  end

  assign actuator_o = (enscd_i & actnsens_i) != 8'h00 && !ssi_i;

  assign actuator = actnsens_i[slave_q] && !ssi_i;
  assign stop     = actuator && cfg_i.gray_lstop;

  assign len_valid_o = summing_q;
  assign len_o       = (7'd0 | cfg_i.scdlen) + 7'd1 + 7'(crc_last) + 7'(crc_on) + 7'(stop);

  assign last = rest == 8'h00;

  
  assign crc_room = !(cfg_i.scdlen[5:4] == 2'b11 && (cfg_i.scdlen[3] || crc_last[3]));

  assign offer_o = {todo_q != 8'h00, last, slave_q,
                    cfg_i.scdlen, crc_on, crc_last, crc_poly, crc_top, cfg_i.crc_start,
                    crc_room && !nocrc_i && crc_on, ssi_i && cfg_i.gray_lstop, actuator, stop};

endmodule
