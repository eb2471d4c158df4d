
























`include "enc_check.svh"

module biss_control_frame (
  input  logic       clk_i,
  input  logic       rst_ni,
  
  input  biss_pkg_access_t access_i,
  input  logic       ida_invert_i,   
  input  logic [1:0] select_i,       
  input  logic       blind_i,        
  
  output biss_pkg_access_byte_t byte_o,
  input  logic [7:0] rdata_i,
  input  logic       post_busy_i,    
  
  input  logic       begin_i,
  input  logic       abort_i,        
  input  logic       start_i,        
  input  logic       frame_end_i,    
  input  logic [1:0] cds_i,          
  input  logic       cdm_timeout_i,  
  input  logic       expired_i,      
  input  logic       stalled_i,      
  output logic       active_o,
  output logic       running_o,      
  output logic       in_body_o,      
  output logic       wait_o,         
  output logic       moved_o,        
  output logic [1:0] cdm0_o,
  output logic [1:0] cdm1_o,
  
  output logic       begin_o,
  output biss_pkg_access_end_t end_o
);

  logic       active_q;
  logic       active_d;
  logic [1:0] fresh_q;      
  logic       broadcast_q;
  logic       carries_q;    
  logic       carries_d;
  logic [5:0] slot_q;
  logic [5:0] slot_d;
  logic [9:0] bits_q;       
  logic [9:0] bits_d;
  logic [3:0] crc_q;
  logic [3:0] crc_d;
  logic [5:0] index_q;      
  logic [5:0] index_d;
  logic       last_q;       
  logic       last_d;
  logic       sent_q;       
  logic       sent_d;
  logic [1:0] ida_bad_q;    
  logic [1:0] ida_bad_d;
  logic       end_q, reg_error_q, delay_error_q;
  logic       end_d, reg_error_d, delay_error_d;

  logic       cts;          
  logic       wnr;
  logic       step;
  logic       take;
  logic       tested;
  logic       cds;          
  logic       cdm0, cdm1, sent;
  logic       top, crc_feed, crc_shift, crc_bit;
  logic       by_ida;       
  logic       stay, fail, late, finish;
  logic       header, echo, ida;
  logic       data;         
  logic       data_crc;

  
  function automatic logic [63:0] slots(input logic [5:0] first, input logic [5:0] behind);
    slots = (64'd1 << behind) - (64'd1 << first);
  endfunction

  assign cts       = access_i.cts;
  assign wnr       = access_i.wnr;
  assign step      = carries_q && frame_end_i;
  assign take      = fresh_q[1] && !post_busy_i;
  assign tested    = (access_i.slaveid[0] ^ ida_invert_i) && !broadcast_q;
  assign cds       = (blind_i && cts) ? sent_q : (cds_i & select_i) != 2'b00;
  assign top       = bits_q[9];

  
  
  localparam logic [63:0] HEADER  = slots(biss_pkg_SLOT_HEADER, biss_pkg_SLOT_CRC);
  localparam logic [63:0] CRC     = slots(biss_pkg_SLOT_CRC, biss_pkg_SLOT_READ);
  localparam logic [63:0] ACK     = slots(biss_pkg_SLOT_IDA, biss_pkg_SLOT_STOP_TESTED);
  localparam logic [63:0] DATA    = slots(biss_pkg_SLOT_WAIT + 6'd1, biss_pkg_SLOT_DATA_CRC);
  localparam logic [63:0] ANSWER  = slots(biss_pkg_SLOT_WAIT + 6'd1, biss_pkg_SLOT_NEXT);
  localparam logic [63:0] BODY    = slots(biss_pkg_SLOT_CTS, biss_pkg_SLOT_STOP);
  localparam logic [63:0] TESTED  = slots(biss_pkg_SLOT_CTS, biss_pkg_SLOT_STOP_TESTED);
  localparam logic [63:0] COMMAND = slots(biss_pkg_SLOT_CTS, biss_pkg_SLOT_STOP_COMMAND);

  assign header   = HEADER[slot_q];
  assign echo     = cts && ANSWER[slot_q];
  assign ida      = !cts && !broadcast_q && ACK[slot_q];
  
  assign data     = cts && (DATA[slot_q] ||
                    (slot_q == (wnr ? biss_pkg_SLOT_WAIT : biss_pkg_SLOT_DATA_CRC) &&
                     (cds || !wnr)));
  assign data_crc = echo && !data;

  

  logic by_ida_shadow; logic cdm0_shadow; logic cdm1_shadow; always begin begin
    cdm0_shadow   = 1'b0;
    by_ida_shadow = 1'b0;
    case (slot_q)
      biss_pkg_SLOT_START: cdm0_shadow = cdm_timeout_i;
      biss_pkg_SLOT_CTS:   cdm0_shadow = cts;
      6'd2, 6'd3, 6'd4, 6'd5, 6'd6, 6'd7, 6'd8, 6'd9, 6'd10, 6'd11:
        cdm0_shadow = top;
      6'd12, 6'd13, 6'd14, 6'd15:
        cdm0_shadow = !crc_q[3];
      biss_pkg_SLOT_READ:  cdm0_shadow = cts ? !wnr : !tested;   
      biss_pkg_SLOT_WRITE: cdm0_shadow = cts && wnr;
      biss_pkg_SLOT_BYTE:  cdm0_shadow = cts;
      biss_pkg_SLOT_WAIT, 6'd20, 6'd21, 6'd22, 6'd23, 6'd25, 6'd26:
        cdm0_shadow = cts && wnr && top;
      biss_pkg_SLOT_EX_TESTED: begin
        cdm0_shadow   = cts && wnr && top;
        by_ida_shadow = !cts && tested;
      end
      6'd27, 6'd28, 6'd29, 6'd30:
        cdm0_shadow = wnr && !crc_q[3];
      biss_pkg_SLOT_NEXT:  cdm0_shadow = !last_q;
      default: cdm0_shadow = 1'b0;
    endcase
    cdm1_shadow = cdm0_shadow;
    
    if (cts && !blind_i && slot_q == biss_pkg_SLOT_WAIT) cdm0_shadow = 1'b1;
  end by_ida = by_ida_shadow; cdm0 = cdm0_shadow; cdm1 = cdm1_shadow; @(blind_i or cdm_timeout_i or crc_q or cts or last_q or slot_q or tested or top or wnr); end

  assign sent = cds ? cdm1 : cdm0;

  for (genvar i = 0; i < 2; i++) begin : gen_line
    assign cdm0_o[i] = select_i[i] && (by_ida ? !ida_bad_q[i] && !top : cdm0);
    assign cdm1_o[i] = select_i[i] && (by_ida ? !ida_bad_q[i] && top : cdm1);
  end

  

  logic fail_shadow; logic finish_shadow; logic [1:0] ida_bad_d_shadow; logic stay_shadow; always begin begin
    stay_shadow      = 1'b0;
    fail_shadow      = 1'b0;
    finish_shadow    = 1'b0;
    ida_bad_d_shadow = ida_bad_q;
    case (slot_q)
      biss_pkg_SLOT_START: stay_shadow = !sent;
      biss_pkg_SLOT_WRITE: begin
        fail_shadow   = cts && (cds == wnr || (blind_i && !wnr));
        finish_shadow = !cts && broadcast_q;
      end
      biss_pkg_SLOT_BYTE:  fail_shadow   = cts && cds != wnr;
      biss_pkg_SLOT_WAIT:  stay_shadow   = cts && !cds;
      biss_pkg_SLOT_STOP_TESTED: finish_shadow = !cts;
      biss_pkg_SLOT_NEXT:  finish_shadow = last_q;
      default: ;
    endcase
    if (echo && wnr && cds != sent_q)        fail_shadow = 1'b1;
    if (data_crc && !wnr && cds == crc_q[3]) fail_shadow = 1'b1;
    if (ida) begin
      ida_bad_d_shadow = ida_bad_q | (select_i & (cds_i ^ {2{top}}));
      if (slot_q == biss_pkg_SLOT_EX_TESTED && !tested) finish_shadow = 1'b1;
    end
  end fail = fail_shadow; finish = finish_shadow; ida_bad_d = ida_bad_d_shadow; stay = stay_shadow; @(blind_i or broadcast_q or cds or cds_i or crc_q or cts or data_crc or echo or ida or ida_bad_q or last_q or select_i or sent or sent_q or slot_q or tested or top or wnr); end

  logic crc_bit_shadow; logic [3:0] crc_d_shadow; logic crc_feed_shadow; logic crc_shift_shadow; always begin begin
    crc_feed_shadow  = header || data;
    crc_shift_shadow = CRC[slot_q] || data_crc;
    crc_bit_shadow   = crc_q[3] ^ ((header || wnr) ? sent : cds);
    crc_d_shadow     = crc_q;
    if (crc_feed_shadow)       crc_d_shadow = {crc_q[2:0], 1'b0} ^ (crc_bit_shadow ? biss_pkg_CONTROL_CRC_POLY : 4'h0);
    else if (crc_shift_shadow) crc_d_shadow = {crc_q[2:0], 1'b0};
    
    if (slot_q == biss_pkg_SLOT_START) crc_d_shadow = 4'h0;
  end crc_bit = crc_bit_shadow; crc_d = crc_d_shadow; crc_feed = crc_feed_shadow; crc_shift = crc_shift_shadow; @(cds or crc_q or data or data_crc or header or sent or slot_q or wnr); end

  logic [9:0] bits_d_shadow; always begin begin
    bits_d_shadow = bits_q;
    if (take)
      bits_d_shadow = cts ? {access_i.slaveid, access_i.regadr} : {rdata_i, access_i.slaveid[2:1]};
    else if (cts && (slot_q == biss_pkg_SLOT_BYTE || slot_q == biss_pkg_SLOT_NEXT))
      bits_d_shadow = {rdata_i, 2'b00};
    else if ((header && slot_q != biss_pkg_SLOT_CTS) || data || ida)
      bits_d_shadow = {bits_q[8:0], (data && !wnr) ? cds : top};
  end bits_d = bits_d_shadow; @(access_i or bits_q or cds or cts or data or header or ida or rdata_i or slot_q or take or top or wnr); end

  assign byte_o = {step && cts && !wnr && !fail && slot_q == biss_pkg_SLOT_STOP, index_q,
                   bits_q[7:0]};

  logic active_d_shadow; logic carries_d_shadow; logic delay_error_d_shadow; logic end_d_shadow; logic [5:0] index_d_shadow; logic last_d_shadow; logic reg_error_d_shadow; logic sent_d_shadow; logic [5:0] slot_d_shadow; always begin begin
    active_d_shadow      = active_q;
    carries_d_shadow     = start_i ? active_o : carries_q && !frame_end_i;
    slot_d_shadow        = slot_q;
    index_d_shadow       = index_q;
    last_d_shadow        = last_q;
    sent_d_shadow        = sent_q;
    end_d_shadow         = 1'b0;
    reg_error_d_shadow   = 1'b0;
    delay_error_d_shadow = 1'b0;

    if (step) begin
      sent_d_shadow = sent;
      if (!stay) slot_d_shadow = (slot_q == biss_pkg_SLOT_NEXT) ? biss_pkg_SLOT_WAIT
                                                             : slot_q + 6'd1;
      if (slot_q == biss_pkg_SLOT_STOP && !fail) begin
        index_d_shadow = index_q + 6'd1;
        last_d_shadow  = index_q == access_i.regnum;
      end
      end_d_shadow         = fail || finish || late;
      reg_error_d_shadow   = fail || (finish && ida_bad_d != 2'b00);
      delay_error_d_shadow = late;
    end else if (active_q && stalled_i) begin
      end_d_shadow         = 1'b1;
      reg_error_d_shadow   = !wait_o;
      delay_error_d_shadow = wait_o;
    end

    
    if (end_d_shadow) begin
      active_d_shadow  = 1'b0;
      carries_d_shadow = 1'b0;
      slot_d_shadow    = biss_pkg_SLOT_START;
    end
    if (begin_o) begin
      active_d_shadow = 1'b1;
      index_d_shadow  = 6'd0;
      last_d_shadow   = 1'b0;
    end
    if (abort_i) begin
      active_d_shadow  = 1'b0;
      carries_d_shadow = 1'b0;
      slot_d_shadow    = biss_pkg_SLOT_START;
      index_d_shadow   = 6'd0;
      end_d_shadow     = 1'b0;
    end
  end active_d = active_d_shadow; carries_d = carries_d_shadow; delay_error_d = delay_error_d_shadow; end_d = end_d_shadow; index_d = index_d_shadow; last_d = last_d_shadow; reg_error_d = reg_error_d_shadow; sent_d = sent_d_shadow; slot_d = slot_d_shadow; @(abort_i or access_i or active_o or active_q or begin_o or carries_q or fail or finish or frame_end_i or ida_bad_d or index_q or last_q or late or sent or sent_q or slot_q or stalled_i or start_i or stay or step or wait_o); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      active_q      <= 1'b0;
      carries_q     <= 1'b0;
      fresh_q       <= '0;
      broadcast_q   <= 1'b0;
      slot_q        <= '0;
      bits_q        <= '0;
      crc_q         <= '0;
      index_q       <= '0;
      last_q        <= 1'b0;
      sent_q        <= 1'b0;
      ida_bad_q     <= '0;
      end_q         <= 1'b0;
      reg_error_q   <= 1'b0;
      delay_error_q <= 1'b0;
    end else begin
      active_q      <= active_d;
      carries_q     <= carries_d;
      fresh_q       <= begin_o ? 2'b01 : take ? 2'b00 : {fresh_q[0], fresh_q[0]};
      slot_q        <= slot_d;
      index_q       <= index_d;
      last_q        <= last_d;
      sent_q        <= sent_d;
      end_q         <= end_d;
      reg_error_q   <= reg_error_d;
      delay_error_q <= delay_error_d;
      if (take) broadcast_q <= rdata_i == 8'h00;
      if (take || step) bits_q <= bits_d;
      if (step) crc_q <= crc_d;
      if (begin_o)   ida_bad_q <= '0;
      else if (step) ida_bad_q <= ida_bad_d;
    end
  end

  
  
  assign begin_o       = begin_i && !active_q && !stalled_i;
  assign active_o      = active_q || begin_o;
  assign running_o     = active_q;
  assign wait_o        = active_q && cts && slot_q == biss_pkg_SLOT_WAIT;
  assign late          = wait_o && stay && expired_i;
  assign moved_o       = step && !(wait_o && stay);
  assign in_body_o     = carries_q &&
                         (cts ? BODY[slot_q] : tested ? TESTED[slot_q] : COMMAND[slot_q]);
  assign end_o         = {end_q, reg_error_q, delay_error_q, index_q};

  `ENC_ASSERT(SlotInRange_A, clk_i, rst_ni, slot_q <= biss_pkg_SLOT_NEXT)
  `ENC_ASSERT_IF(IdleIsSlot0_A, clk_i, rst_ni, !active_q, slot_q == biss_pkg_SLOT_START)
  `ENC_ASSERT_IF(DataCrcStartsAtZero_A, clk_i, rst_ni,
                 slot_q == biss_pkg_SLOT_BYTE || slot_q == biss_pkg_SLOT_NEXT, crc_q == 4'h0)
  `ENC_ASSERT_IF(NextIsForRegisters_A, clk_i, rst_ni, active_q && !cts,
                 slot_q <= biss_pkg_SLOT_STOP_TESTED)

endmodule
