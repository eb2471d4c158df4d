























`include "enc_check.svh"

module biss_b_access (
  input  logic       clk_i,
  input  logic       rst_ni,
  
  input  logic [2:0] freqr_i,
  input  biss_pkg_access_t access_i,
  input  logic       mo_i,           
  
  input  logic       start_i,
  input  logic [1:0] use_i,          
  input  logic       init_i,         
  input  logic       abort_i,
  input  logic       tick_i,
  input  logic       expired_i,      
  output logic       wait_o,
  output logic       active_o,
  
  input  logic [1:0] sl_i,           
  output biss_pkg_register_ma_t ma_o,
  output logic [1:0] mo_low_o,
  
  output biss_pkg_access_byte_t byte_o,
  input  logic [7:0] rdata_i,
  
  output logic       ags_error_o,    
  output biss_pkg_access_end_t end_o
);

  typedef logic [2:0] state_e; localparam logic [2:0] IDLE = 0, REQUEST = 1, HAND_OVER = 2, ADDRESS = 3, WRITE = 4, READ = 5, SETTLE = 6;

  
  localparam logic [4:0] ADDRESS_CRC  = 5'd12;
  localparam logic [4:0] ADDRESS_STOP = 5'd16;
  localparam logic [4:0] BYTE_CRC     = 5'd9;
  localparam logic [4:0] BYTE_LAST    = 5'd12;   
  localparam logic [4:0] BYTE_STOP    = 5'd13;

  state_e      state_d;
  state_e      state_q;
  logic        init_q;
  logic [1:0]  use_q;
  logic        mo_q;
  logic        sl;          
  logic [6:0]  pre_q;       
  logic [1:0]  phase_q;     
  logic [1:0]  phase_next;  
  logic [4:0]  cell_d;
  logic [4:0]  cell_q;      
  logic [10:0] bits_d;
  logic [10:0] bits_q;      
  logic [3:0]  crc_d;
  logic [3:0]  crc_q;
  logic [5:0]  index_d;
  logic [5:0]  index_q;     
  logic        fail_d;
  logic        fail_q;      
  logic [1:0]  sent_q;      
  logic [1:0]  check_q;     
  logic [1:0]  sample_q;    
  logic        fresh_q;     
  logic        ma;
  logic        ends;
  logic        wr_en;
  logic        reg_error, delay_error;
  logic        quarter;
  logic        boundary;    
  logic        in_fields;
  logic        in_crc;
  logic        out;         
  logic        sample;
  logic        feed;
  logic        divide;
  logic        last;        

  assign sl         = use_q[0] ? sl_i[0] : sl_i[1];
  assign quarter    = tick_i && pre_q == 7'd0;
  assign phase_next = phase_q + {1'b0, quarter};
  assign boundary   = quarter && phase_q == 2'd3;
  assign in_fields  = cell_q != 5'd0 &&
                      cell_q < (state_q == ADDRESS ? ADDRESS_CRC : BYTE_CRC);
  assign in_crc     = !in_fields && cell_q != 5'd0 &&
                      cell_q != (state_q == ADDRESS ? ADDRESS_STOP : BYTE_STOP);
  assign out        = cell_q == 5'd0 || (in_fields && bits_q[10]) || (in_crc && !crc_q[3]);
  assign sample     = sample_q[1];
  assign last       = index_q == access_i.regnum;

  
  assign feed   = in_fields && (state_q == READ ? sample : boundary);
  assign divide = feed && (crc_q[3] ^ (state_q == READ ? sl : bits_q[10]));

  logic [3:0] crc_d_shadow; always begin begin
    crc_d_shadow = crc_q;
    if (cell_q == 5'd0)                                        crc_d_shadow = 4'h0;
    else if (feed || (in_crc && (state_q == READ ? sample : boundary)))
      crc_d_shadow = {crc_q[2:0], 1'b0} ^ (divide ? biss_pkg_CONTROL_CRC_POLY : 4'h0);
  end crc_d = crc_d_shadow; @(boundary or cell_q or crc_q or divide or feed or in_crc or sample or state_q); end

  logic ags_error_o_shadow; logic [10:0] bits_d_shadow; logic [4:0] cell_d_shadow; logic delay_error_shadow; logic ends_shadow; logic fail_d_shadow; logic [5:0] index_d_shadow; logic reg_error_shadow; state_e state_d_shadow; logic wr_en_shadow; always begin begin
    state_d_shadow         = state_q;
    cell_d_shadow          = cell_q;
    bits_d_shadow          = bits_q;
    index_d_shadow         = index_q;
    fail_d_shadow          = fail_q;
    ends_shadow           = 1'b0;
    ags_error_o_shadow     = 1'b0;
    reg_error_shadow     = 1'b0;
    delay_error_shadow   = 1'b0;
    wr_en_shadow   = 1'b0;

    case (state_q)
      IDLE: begin
        
        cell_d_shadow  = 5'd0;
        fail_d_shadow  = 1'b0;
        if (start_i) begin
          state_d_shadow = REQUEST;
          index_d_shadow = 6'd0;
        end
      end
      REQUEST: begin
        
        bits_d_shadow = {access_i.slaveid, access_i.regadr, access_i.wnr};
        if (tick_i) state_d_shadow = HAND_OVER;
      end
      HAND_OVER: begin
        
        if (quarter) begin
          if (mo_q && !init_q) begin
            if (phase_q == 2'd1) state_d_shadow = ADDRESS;
          end else if ((use_q & sl_i) == 2'b00) begin
            state_d_shadow = init_q ? IDLE : ADDRESS;
          end else if (expired_i) begin
            state_d_shadow     = IDLE;
            ags_error_o_shadow = 1'b1;
          end
        end
      end
      ADDRESS: begin
        
        if (boundary) begin
          cell_d_shadow = cell_q + 5'd1;
          if (in_fields) bits_d_shadow = {bits_q[9:0], 1'b0};
          if (cell_q == ADDRESS_STOP) begin
            cell_d_shadow  = 5'd0;
            state_d_shadow = access_i.wnr ? WRITE : READ;
          end
        end
      end
      WRITE: begin
        
        if (boundary) begin
          cell_d_shadow = cell_q == BYTE_STOP ? 5'd0 : fail_q ? BYTE_STOP : cell_q + 5'd1;
          bits_d_shadow = cell_q == 5'd0 ? {rdata_i, 3'b000} : {bits_q[9:0], 1'b0};
        end
        if (sample) begin
          fail_d_shadow = fail_q || (check_q[1] && sl != sent_q[1]);
          
          if (cell_q == 5'd0 && (check_q[1] || fail_q)) begin
            if (fail_d_shadow || last) state_d_shadow = SETTLE;
            if (!fail_d_shadow) index_d_shadow = index_q + 6'd1;
          end
        end
      end
      READ: begin
        
        if (sample && !fresh_q) begin
          if (cell_q != 5'd0 || sl) cell_d_shadow = cell_q + 5'd1;
          if (in_fields) bits_d_shadow = {bits_q[9:0], sl};
          if (in_crc && sl == crc_q[3]) fail_d_shadow = 1'b1;
          if (cell_q == BYTE_LAST) begin
            wr_en_shadow = !fail_d_shadow;
            if (!fail_d_shadow) index_d_shadow = index_q + 6'd1;
            if (fail_d_shadow || last) state_d_shadow = SETTLE;
          end
          if (cell_q == BYTE_STOP || state_d_shadow == SETTLE) cell_d_shadow = 5'd0;
        end
        if (boundary && cell_q == 5'd0 && expired_i) begin
          state_d_shadow       = IDLE;
          delay_error_shadow = 1'b1;
        end
      end
      SETTLE: begin
        
        if (sample) cell_d_shadow = 5'd1;
        if (sample && cell_q != 5'd0) begin
          state_d_shadow     = IDLE;
          reg_error_shadow = fail_q;
        end
      end
      default: state_d_shadow = IDLE;
    endcase

    ends_shadow = state_q != IDLE && state_d_shadow == IDLE;
    if (abort_i) begin
      state_d_shadow = IDLE;
      ends_shadow   = 1'b0;
    end
  end ags_error_o = ags_error_o_shadow; bits_d = bits_d_shadow; cell_d = cell_d_shadow; delay_error = delay_error_shadow; ends = ends_shadow; fail_d = fail_d_shadow; index_d = index_d_shadow; reg_error = reg_error_shadow; state_d = state_d_shadow; wr_en = wr_en_shadow; @(abort_i or access_i or bits_q or boundary or cell_q or check_q or crc_q or expired_i or fail_q or fresh_q or in_crc or in_fields or index_q or init_q or last or mo_q or phase_q or quarter or rdata_i or sample or sent_q or sl or sl_i or start_i or state_q or tick_i or use_q); end

  
  logic ma_shadow; always begin begin
    ma_shadow = 1'b1;
    if (state_d == HAND_OVER) begin
      ma_shadow = 1'b0;
    end else if (state_q != HAND_OVER && state_d != SETTLE && state_d != IDLE) begin
      if (phase_next == 2'd1) ma_shadow = out || state_q == READ;
      if (phase_next == 2'd2) ma_shadow = out && state_q != READ;
      if (phase_next == 2'd3) ma_shadow = 1'b0;
    end
  end ma = ma_shadow; @(out or phase_next or state_d or state_q); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= IDLE;
      init_q   <= 1'b0;
      use_q    <= '0;
      mo_q     <= 1'b0;
      pre_q    <= '0;
      phase_q  <= '0;
      cell_q   <= '0;
      bits_q   <= '0;
      crc_q    <= '0;
      index_q  <= '0;
      fail_q   <= 1'b0;
      sent_q   <= '0;
      check_q  <= '0;
      sample_q <= '0;
      fresh_q  <= 1'b0;
    end else begin
      state_q  <= state_d;
      cell_q   <= cell_d;
      bits_q   <= bits_d;
      crc_q    <= crc_d;
      index_q  <= index_d;
      fail_q   <= fail_d;
      sample_q <= {sample_q[0], boundary};
      if (start_i && state_q == IDLE) {use_q, init_q, mo_q} <= {use_i, init_i, mo_i};
      if (state_q == IDLE || state_q == REQUEST || quarter) pre_q <= (7'd1 << freqr_i) - 7'd1;
      else if (tick_i)                                      pre_q <= pre_q - 7'd1;
      if (state_q == IDLE || state_q == REQUEST || (state_q == HAND_OVER && state_d == ADDRESS))
        phase_q <= 2'd0;
      else
        phase_q <= phase_next;
      if (boundary) begin
        sent_q  <= {sent_q[0], out};
        check_q <= {check_q[0], state_q == WRITE && cell_q != BYTE_STOP};
        fresh_q <= state_q == ADDRESS;
      end
    end
  end

  assign ma_o     = {ma, ends};
  assign end_o    = {ends && !init_q, reg_error, delay_error, index_q};
  assign byte_o   = {wr_en, index_q, bits_q[7:0]};
  assign mo_low_o = use_q & {2{init_q ? state_q == HAND_OVER : state_q != IDLE}};
  assign active_o = state_q != IDLE;
  assign wait_o   = (state_q == HAND_OVER && (init_q || !mo_q)) ||
                           (state_q == READ && cell_q == 5'd0);

  `ENC_ASSERT(StateInRange_A, clk_i, rst_ni, state_q <= SETTLE)
  `ENC_ASSERT(CellInRange_A, clk_i, rst_ni, cell_q <= ADDRESS_STOP)

endmodule
