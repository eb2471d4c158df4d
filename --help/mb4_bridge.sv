



























`include "enc_check.svh"

module mb4_bridge #(
  parameter int WaitLimit = 1024
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  
  input  logic        word_req_i,
  input  logic        word_write_i,
  input  logic [11:2] word_addr_i,
  input  logic [31:0] word_data_i,
  input  logic [3:0]  word_be_i,
  output logic        word_ready_o,
  output logic [31:0] word_data_o,
  output logic        word_error_o,
  
  output mb4_pkg_host_t host_o,
  input  logic [7:0]  rd_data_i,    
  input  logic        empty_i,      
  
  output mb4_pkg_page_req_t page_o,
  input  logic        ack_i,        
  input  logic        beat_i,
  output logic        shadow_en_o,
  output logic [5:0]  shadow_addr_o,
  input  logic [31:0] shadow_data_i,
  
  output logic        status_we_o,
  output logic        enable_we_o,
  output logic [4:0]  irq_data_o,
  input  logic [4:0]  status_i,
  input  logic [4:0]  enable_i,
  
  input  logic [31:0] features_i
);

  
  localparam logic [7:0]  ROOM    = 8'd124;
  localparam int LIMIT_W = $clog2(WaitLimit + 1);

  typedef logic [2:0] state_e; localparam logic [2:0] IDLE = 0, QUEUE = 1, BYTES = 2, ASK = 3, ANSWER = 4, SHADOW = 5, FETCH = 6, READY = 7;

  state_e      state_d;
  state_e      state_q;
  
  logic        map, page, instr, posts, memory, time_low, time_high, word_low, channel_word;
  logic [2:0]  channel;
  logic [2:0]  row;
  logic [5:0]  index;        
  logic [31:0] page_data;
  
  logic [2:0]  count_d, count_q;
  logic [1:0]  place;        
  logic        wr_en;
  logic [7:0]  posted_q;     
  logic [1:0]  fresh_q;      
  logic        post;
  logic        empty;
  logic        blocked;      
  
  logic        ack, beat, beat_q;
  logic        free;         
  logic        ask;
  logic [3:0]  shadow;            
  logic [8:0]  shown_d, shown_q;  
  mb4_pkg_page_req_t page_q;
  logic [LIMIT_W-1:0] limit_q;
  logic        waits, expired;
  
  logic [31:0] data_d, data_q;
  logic        error_d, error_q;

  enc_sync_bit u_empty (
    .clk_i,
    .rst_ni,
    .data_i (empty_i),
    .data_o (empty)
  );

  enc_sync_bit u_ack (
    .clk_i,
    .rst_ni,
    .data_i (ack_i),
    .data_o (ack)
  );

  enc_sync_bit u_beat (
    .clk_i,
    .rst_ni,
    .data_i (beat_i),
    .data_o (beat)
  );

  

  assign map       = word_addr_i[11:8] == 4'd0;
  assign page      = word_addr_i[11:8] == mb4_page_regs_pkg_ADDR_ID[11:8];
  assign index     = word_addr_i[7:2];
  assign instr     = map && {index, 2'b00} == mb4_regs_pkg_ADDR_INSTR;
  assign memory    = map && !word_addr_i[6];               
  assign posts     = memory || (map && {index, 2'b00} == mb4_regs_pkg_ADDR_STATUS0);
  assign time_low  = page && index == mb4_page_regs_pkg_ADDR_TIME_LOW[7:2];
  assign time_high = page && index == mb4_page_regs_pkg_ADDR_TIME_HIGH[7:2];

  logic [2:0] channel_shadow; logic channel_word_shadow; logic [2:0] row_shadow; always begin begin
    channel_shadow      = 3'd0;
    row_shadow          = 3'd0;
    channel_word_shadow = 1'b0;
    for (int i = 0; i < 8; i++) begin
      if (page && index >= 6'(8 + 6 * i) && index < 6'(14 + 6 * i)) begin
        channel_shadow      = 3'(i);
        row_shadow          = 3'(index - 6'(8 + 6 * i));
        channel_word_shadow = 1'b1;
      end
    end
    if (time_low || time_high) row_shadow = {2'b11, time_high};
  end channel = channel_shadow; channel_word = channel_word_shadow; row = row_shadow; @(index or page or time_high or time_low); end

  assign shadow   = (time_low || time_high) ? 4'd8 : {1'b0, channel};
  assign word_low = channel_word && row == 3'd0;

  logic [31:0] page_data_shadow; always begin begin
    page_data_shadow = 32'd0;
    if (page) begin
      case ({index, 2'b00})
        mb4_page_regs_pkg_ADDR_ID[7:0]:         page_data_shadow = mb4_page_regs_pkg_RESET_ID;
        mb4_page_regs_pkg_ADDR_VERSION[7:0]:    page_data_shadow = mb4_page_regs_pkg_RESET_VERSION;
        mb4_page_regs_pkg_ADDR_FEATURES[7:0]:   page_data_shadow = features_i;
        mb4_page_regs_pkg_ADDR_IRQ_STATUS[7:0]: page_data_shadow = {27'd0, status_i};
        mb4_page_regs_pkg_ADDR_IRQ_ENABLE[7:0]: page_data_shadow = {27'd0, enable_i};
        default:                                 page_data_shadow = 32'd0;
      endcase
    end
  end page_data = page_data_shadow; @(enable_i or features_i or index or page or status_i); end

  

  
  assign place  = count_q[1:0] + {1'b0, instr && word_write_i};
  assign wr_en  = state_q == BYTES && word_req_i && word_write_i && word_be_i[place];
  assign host_o = {wr_en, index, place, word_data_i[{place, 3'b000} +: 8],
                   state_q == BYTES && !word_write_i && !count_q[2], index, place};
  assign post   = wr_en && (memory || (posts && (place == 2'd1 || place == 2'd2)));

  assign blocked = word_write_i ? posts && posted_q > ROOM
                                : (memory || word_low) && posted_q != 8'd0;

  

  assign free    = ack == page_q.req;
  assign waits   = (state_q == QUEUE && blocked) || (state_q == ASK && !free) ||
                   (state_q == ANSWER && !free);
  assign expired = limit_q == LIMIT_W'(WaitLimit);

  logic ask_shadow; logic [2:0] count_d_shadow; logic [31:0] data_d_shadow; logic error_d_shadow; logic [8:0] shown_d_shadow; state_e state_d_shadow; always begin begin
    state_d_shadow = state_q;
    count_d_shadow = 3'd0;
    ask_shadow     = 1'b0;
    shown_d_shadow = shown_q;
    data_d_shadow  = data_q;
    error_d_shadow = error_q;

    case (state_q)
      IDLE: begin
        
        error_d_shadow = 1'b0;
        data_d_shadow  = page_data;
        if (word_req_i) begin
          state_d_shadow = READY;
          if (map || (!word_write_i && (time_low || word_low))) state_d_shadow = QUEUE;
          if (!word_write_i && (time_high || (channel_word && !word_low))) state_d_shadow = SHADOW;
        end
      end
      QUEUE: begin
        
        if (!blocked) state_d_shadow = map ? BYTES : ASK;
      end
      BYTES: begin
        
        count_d_shadow = count_q + 3'd1;
        if (count_q == (word_write_i ? 3'd3 : 3'd4)) state_d_shadow = READY;
        data_d_shadow  = {rd_data_i, data_q[31:8]};
      end
      ASK: begin
        
        if (free) begin
          state_d_shadow = ANSWER;
          ask_shadow     = 1'b1;
          shown_d_shadow[shadow] = 1'b0;
        end
      end
      ANSWER: begin
        
        if (free) begin
          state_d_shadow = SHADOW;
          shown_d_shadow[shadow] = 1'b1;
        end
      end
      SHADOW: begin
        
        state_d_shadow = FETCH;
      end
      FETCH: begin
        
        state_d_shadow = READY;
        data_d_shadow  = shadow_data_i & {32{shown_q[shadow]}};
      end
      READY: begin
        
        state_d_shadow = IDLE;
      end
      default: state_d_shadow = IDLE;
    endcase

    if (waits && expired) begin
      state_d_shadow = READY;
      error_d_shadow = 1'b1;
      data_d_shadow  = 32'd0;
    end
    if (!word_req_i) state_d_shadow = IDLE;
  end ask = ask_shadow; count_d = count_d_shadow; data_d = data_d_shadow; error_d = error_d_shadow; shown_d = shown_d_shadow; state_d = state_d_shadow; @(blocked or channel_word or count_q or data_q or error_q or expired or free or map or page_data or rd_data_i or shadow or shadow_data_i or shown_q or state_q or time_high or time_low or waits or word_low or word_req_i or word_write_i); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= IDLE;
      count_q  <= '0;
      posted_q <= '0;
      fresh_q  <= '0;
      beat_q   <= 1'b0;
      shown_q  <= '0;
      page_q   <= '0;
      limit_q  <= '0;
      data_q   <= '0;
      error_q  <= 1'b0;
    end else begin
      state_q  <= state_d;
      count_q  <= count_d;
      posted_q <= (empty && fresh_q == 2'd0 && !post) ? 8'd0 : posted_q + 8'(post);
      fresh_q  <= post ? 2'd3 : fresh_q - {1'b0, fresh_q != 2'd0};
      beat_q   <= beat;
      shown_q  <= shown_d;
      if (ask) page_q <= {!page_q.req, time_low, channel};
      limit_q  <= (!waits || beat != beat_q) ? '0 : limit_q + LIMIT_W'(!expired);
      data_q   <= data_d;
      error_q  <= error_d;
    end
  end

  assign page_o        = page_q;
  assign shadow_en_o   = state_q == SHADOW;
  assign shadow_addr_o = {channel, row};

  assign word_ready_o = state_q == READY;
  assign word_data_o  = data_q;
  assign word_error_o = error_q;

  assign status_we_o = word_ready_o && word_req_i && word_write_i && word_be_i[0] && page &&
                       {index, 2'b00} == mb4_page_regs_pkg_ADDR_IRQ_STATUS[7:0];
  assign enable_we_o = word_ready_o && word_req_i && word_write_i && word_be_i[0] && page &&
                       {index, 2'b00} == mb4_page_regs_pkg_ADDR_IRQ_ENABLE[7:0];
  assign irq_data_o  = word_data_i[4:0];

  `ENC_ASSERT(QueueNeverOverflows_A, clk_i, rst_ni, posted_q <= 8'd128)

endmodule
