



















module biss_mo_tx #(
  parameter int DataBits = 64,   
  parameter bit          FreeCrc  = 1'b1  
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  
  input  biss_pkg_line_cmd_t cmd_i,
  input  biss_pkg_line_go_t  go_i,
  input  logic       begin_i,       
  input  logic       biss_c_i,
  input  logic       rise_i,        
  input  logic       final_i,       
  input  logic       clocks_i,      
  input  logic       line_idle_i,
  
  input  biss_pkg_offer_t offer_i,
  output logic       next_o,
  output biss_pkg_mo_read_t read_o,
  input  logic [7:0] data_i,
  output logic       mo_o
);

  typedef logic [2:0] state_e; localparam logic [2:0] IDLE = 0, REQUEST = 1, WAIT = 2, CDS = 3, DATA = 4, STOP = 5;

  biss_pkg_word_t word;
  state_e     state_d;
  state_e     state_q;
  logic       mo_d;
  logic       mo_q;
  logic       second_d;
  logic       second_q;   
  logic [7:0] busy_d;
  logic [7:0] busy_q;     
  logic       load_d;
  logic       load_q;     
  logic       stop_d;
  logic       stop_q;     
  logic       in_crc_d;
  logic       in_crc_q;
  logic [5:0] left_d;
  logic [5:0] left_q;     
  logic [2:0] byte_now;   
  logic       data_bit;
  logic       crc_top;
  logic       shift;
  logic       none;       
  logic       ends;       

  
  localparam logic [5:0] LEFT = 6'((32'd1 << (DataBits > 16 ? $clog2(DataBits) : 4)) - 32'd1);

  assign word     = offer_i.word;
  assign ends     = line_idle_i || go_i.mo_return || go_i.stop;
  assign none     = !offer_i.any || go_i.reduced;
  assign byte_now = load_q ? word.data_last[5:3] : left_q[5:3];
  assign data_bit = data_i[left_q[2:0]] && word.actuator;
  assign shift    = rise_i && state_q == DATA && !stop_q;

  enc_crc #(.Free(FreeCrc)) u_crc (
    .clk_i,
    .rst_ni,
    .crc16_i (word.crc_last[3]),
    .poly_i  (word.crc_poly),
    .top_i   (word.crc_top),
    .start_i (word.crc_start),
    .load_i  (load_q),
    .shift_i (shift),
    .feed_i  (!in_crc_q),
    .bit_i   (data_bit),
    .top_o   (crc_top)
  );

  logic [7:0] busy_d_shadow; logic in_crc_d_shadow; logic [5:0] left_d_shadow; logic load_d_shadow; logic mo_d_shadow; logic next_o_shadow; logic second_d_shadow; state_e state_d_shadow; logic stop_d_shadow; always begin begin
    state_d_shadow  = state_q;
    mo_d_shadow     = mo_q;
    second_d_shadow = second_q;
    busy_d_shadow   = busy_q;
    load_d_shadow   = 1'b0;
    stop_d_shadow   = stop_q;
    in_crc_d_shadow = in_crc_q;
    left_d_shadow   = left_q;
    next_o_shadow   = 1'b0;

    if (load_q) begin
      stop_d_shadow   = word.stop;
      in_crc_d_shadow = 1'b0;
      left_d_shadow   = word.data_last & LEFT;
    end

    case (state_q)
      IDLE: begin
        
        mo_d_shadow     = 1'b1;
        second_d_shadow = 1'b0;
        if (begin_i && cmd_i.mo_en) state_d_shadow = REQUEST;
      end
      REQUEST: begin
        
        busy_d_shadow = cmd_i.mo_busy;
        if (rise_i) begin
          second_d_shadow = 1'b1;
          if (second_q) begin
            mo_d_shadow    = 1'b0;
            state_d_shadow = WAIT;
          end
        end
      end
      WAIT: begin
        
        if (rise_i) begin
          busy_d_shadow = busy_q - 8'd1;
          mo_d_shadow   = busy_q == 8'd0;
          if (mo_d_shadow) begin
            load_d_shadow  = !biss_c_i && !none;
            state_d_shadow = biss_c_i ? CDS : none ? STOP : DATA;
          end
        end
      end
      CDS: begin
        
        if (rise_i) begin
          mo_d_shadow    = 1'b0;
          load_d_shadow  = !none;
          state_d_shadow = none ? STOP : DATA;
        end
      end
      DATA: begin
        
        if (rise_i) begin
          stop_d_shadow = 1'b0;
          mo_d_shadow   = !stop_q && word.actuator && (in_crc_q ? !crc_top : data_bit);
          if (!stop_q) begin
            left_d_shadow = (left_q - 6'd1) & LEFT;
            if (left_q == 6'd0) begin
              in_crc_d_shadow = 1'b1;
              left_d_shadow   = (6'd0 | word.crc_last);
              if (in_crc_q || !word.crc_on) begin
                next_o_shadow = 1'b1;
                load_d_shadow = !offer_i.last;
                if (offer_i.last) state_d_shadow = STOP;
              end
            end
          end
        end
      end
      STOP: begin
        
        
        if (rise_i) mo_d_shadow = 1'b0;
        if (final_i || !clocks_i) state_d_shadow = IDLE;
      end
      default: state_d_shadow = IDLE;
    endcase

    if (state_q != IDLE && ends) state_d_shadow = IDLE;
    if (state_d_shadow == IDLE) mo_d_shadow = cmd_i.mo_en && !cmd_i.mo_low;
  end busy_d = busy_d_shadow; in_crc_d = in_crc_d_shadow; left_d = left_d_shadow; load_d = load_d_shadow; mo_d = mo_d_shadow; next_o = next_o_shadow; second_d = second_d_shadow; state_d = state_d_shadow; stop_d = stop_d_shadow; @(begin_i or biss_c_i or busy_q or clocks_i or cmd_i or crc_top or data_bit or ends or final_i or in_crc_q or left_q or load_q or mo_q or none or offer_i or rise_i or second_q or state_q or stop_q or word); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= IDLE;
      mo_q     <= 1'b0;
      second_q <= 1'b0;
      busy_q   <= '0;
      load_q   <= 1'b0;
      stop_q   <= 1'b0;
      in_crc_q <= 1'b0;
      left_q   <= '0;
    end else begin
      state_q  <= state_d;
      mo_q     <= mo_d;
      second_q <= second_d;
      busy_q   <= busy_d;
      load_q   <= load_d;
      stop_q   <= stop_d;
      in_crc_q <= in_crc_d;
      left_q   <= left_d;
    end
  end

  assign read_o = {state_q != IDLE, offer_i.slave, byte_now};
  assign mo_o   = mo_q;

endmodule
