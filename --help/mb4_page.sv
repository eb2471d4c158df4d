





















module mb4_page (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  mb4_pkg_tap_t tap_i,
  
  input  logic        getsens_i,
  input  logic        ner_i,
  
  output logic        rd_en_o,
  output logic [4:0]  rd_addr_o,
  
  input  mb4_pkg_page_req_t page_i,
  output logic        ack_o,
  output logic        beat_o,      
  output logic [4:0]  event_o,     
  input  logic        shadow_clk_i,
  input  logic        shadow_en_i,
  input  logic [5:0]  shadow_addr_i,  
  output logic [31:0] shadow_data_o
);

  localparam int TAG_W = 96;

  typedef logic [1:0] state_e; localparam logic [1:0] REST = 0, SETTLE = 1, COPY = 2, STAMP = 3;

  state_e      state_q;
  logic [3:0]  step_q;
  logic        req, ack_q;
  logic [63:0] now;
  
  logic [1:0]  latch;
  logic [1:0]  ma_q, fall_q, rise_q;   
  logic [TAG_W-1:0] tag1_q, tag2_q;    
  
  logic        late_q;                 
  logic [3:0]  late_addr_q;
  logic        tag_wr;
  logic [3:0]  tag_addr;               
  logic [TAG_W-1:0] tag;
  logic [15:0] tagged_q;               
  logic        has_tag_q;
  
  logic        host_q;
  logic        disturbed;
  logic [1:0]  hit;
  logic [15:0] pair;
  logic [7:0]  data;
  logic [31:0] word_q;
  logic        line2;
  logic [31:0] row_data;
  logic        row_wr;
  logic [2:0]  row;
  
  logic        getsens, getsens_q, ner;
  logic [4:0]  good, good_q;
  logic        regend_q;
  logic        unused;

  enc_time u_time (
    .clk_i,
    .rst_ni,
    .time_o (now)
  );

  enc_sync_bit u_req (
    .clk_i,
    .rst_ni,
    .data_i (page_i.req),
    .data_o (req)
  );

  enc_sync_bit u_getsens (
    .clk_i,
    .rst_ni,
    .data_i (getsens_i),
    .data_o (getsens)
  );

  enc_sync_bit #(.ResetValue(1'b1)) u_ner (
    .clk_i,
    .rst_ni,
    .data_i (ner_i),
    .data_o (ner)
  );

  

  for (genvar i = 0; i < 2; i++) begin : gen_line
    assign latch[i] = tap_i.ssi[i] ? fall_q[i] && ma_q[i] && !tap_i.ma[i]
                                   : rise_q[i] && !ma_q[i] && tap_i.ma[i];
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        ma_q[i]   <= 1'b1;
        fall_q[i] <= 1'b0;
        rise_q[i] <= 1'b0;
      end else begin
        ma_q[i]   <= tap_i.ma[i];
        fall_q[i] <= tap_i.start[i] ||
                     (fall_q[i] && !tap_i.stop && !(ma_q[i] && !tap_i.ma[i]));
        rise_q[i] <= !tap_i.start[i] && !tap_i.stop &&
                     (rise_q[i] ? !tap_i.ma[i] : fall_q[i] && ma_q[i] && !tap_i.ma[i]);
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tag1_q <= '0;
      tag2_q <= '0;
    end else begin
      if (latch[0]) tag1_q <= {tag1_q[TAG_W-1:64] + 32'd1, now};
      if (latch[1]) tag2_q <= {tag2_q[TAG_W-1:64] + 32'd1, now};
    end
  end

  

  
  assign tag_wr   = tap_i.done != 2'b00 || late_q;
  assign tag_addr = tap_i.done[0] ? {tap_i.banks.eng, tap_i.slave[2:0]}
                                  : late_q ? late_addr_q : {tap_i.banks.eng, tap_i.slave[5:3]};

  enc_ram #(.Width(TAG_W), .AddrW(4)) u_tags (
    .wclk_i    (clk_i),
    .wr_en_i   (tag_wr),
    .wr_addr_i (tag_addr),
    .wr_data_i (tap_i.done[0] ? tag1_q : tag2_q),
    .rclk_i    (clk_i),
    .rd_en_i   (rd_en_o),
    .rd_addr_i ({tap_i.banks.host, page_i.channel}),
    .rd_data_o (tag)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      late_q      <= 1'b0;
      late_addr_q <= '0;
      tagged_q    <= '0;
      has_tag_q   <= 1'b0;
    end else begin
      late_q <= tap_i.done == 2'b11;
      late_addr_q <= {tap_i.banks.eng, tap_i.slave[5:3]};
      if (tag_wr) tagged_q[tag_addr] <= 1'b1;
      has_tag_q <= tagged_q[{tap_i.banks.host, page_i.channel}];
    end
  end

  

  assign hit[0] = (tap_i.wr[0] || tap_i.done[0]) && tap_i.slave[2:0] == page_i.channel;
  assign hit[1] = (tap_i.wr[1] || tap_i.done[1]) && tap_i.slave[5:3] == page_i.channel;
  assign disturbed = tap_i.banks.host != host_q || !tap_i.ready || late_q ||
                     (tap_i.banks.host == tap_i.banks.eng && hit != 2'b00);

  assign rd_en_o   = state_q == COPY && !step_q[3];
  assign rd_addr_o = {page_i.channel[1:0], step_q[2:0]};
  assign pair      = page_i.channel[2] ? tap_i.hi : tap_i.lo;
  assign data      = tap_i.banks.host ? pair[15:8] : pair[7:0];
  assign line2     = page_i.channel[2] && tap_i.slaveloc5;

  logic [2:0] row_shadow; logic [31:0] row_data_shadow; logic row_wr_shadow; always begin begin
    row_wr_shadow   = 1'b0;
    row_shadow      = 3'd0;
    row_data_shadow = word_q;
    if (state_q == STAMP) begin
      row_wr_shadow   = 1'b1;
      row_shadow      = {2'b11, step_q[0]};
      row_data_shadow = step_q[0] ? word_q : now[31:0];
    end else if (state_q == COPY) begin
      case (step_q)
        4'd5: row_wr_shadow = 1'b1;
        4'd9: begin
          row_wr_shadow = 1'b1;
          row_shadow    = 3'd1;
        end
        4'd10: begin
          row_wr_shadow   = 1'b1;
          row_shadow      = 3'd2;
          row_data_shadow = {29'd0, tap_i.swbank_fail, tap_i.cds[{tap_i.banks.host, line2}],
                      tap_i.svalid[{tap_i.banks.host, page_i.channel}]};
        end
        4'd11: begin
          row_wr_shadow   = 1'b1;
          row_shadow      = 3'd3;
          row_data_shadow = tag[TAG_W-1:64] & {32{has_tag_q}};
        end
        4'd12: begin
          row_wr_shadow   = 1'b1;
          row_shadow      = 3'd4;
          row_data_shadow = tag[31:0] & {32{has_tag_q}};
        end
        4'd13: begin
          row_wr_shadow   = 1'b1;
          row_shadow      = 3'd5;
          row_data_shadow = tag[63:32] & {32{has_tag_q}};
        end
        default: row_wr_shadow = 1'b0;
      endcase
    end
  end row = row_shadow; row_data = row_data_shadow; row_wr = row_wr_shadow; @(has_tag_q or line2 or now or page_i or state_q or step_q or tag or tap_i or word_q); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= REST;
      step_q  <= '0;
      ack_q   <= 1'b0;
      host_q  <= 1'b0;
      word_q  <= '0;
    end else begin
      host_q <= tap_i.banks.host;
      step_q <= step_q + 4'd1;
      word_q <= state_q == STAMP ? now[63:32] : {data, word_q[31:8]};
      case (state_q)
        REST: begin
          
          step_q <= 4'd0;
          if (req != ack_q) state_q <= SETTLE;
        end
        SETTLE: begin
          
          if (step_q == 4'd15) state_q <= page_i.stamp ? STAMP : COPY;
        end
        COPY: begin
          
          if (disturbed) begin
            step_q <= 4'd0;
          end else if (step_q == 4'd13) begin
            state_q <= REST;
            ack_q   <= req;
          end
        end
        STAMP: begin
          
          if (step_q[0]) begin
            state_q <= REST;
            ack_q   <= req;
          end
        end
        default: state_q <= REST;
      endcase
    end
  end

  enc_ram #(.Width(32), .AddrW(6)) u_shadow (
    .wclk_i    (clk_i),
    .wr_en_i   (row_wr),
    .wr_addr_i ({page_i.channel & {3{!page_i.stamp}}, row}),
    .wr_data_i (row_data),
    .rclk_i    (shadow_clk_i),
    .rd_en_i   (shadow_en_i),
    .rd_addr_i (shadow_addr_i),
    .rd_data_o (shadow_data_o)
  );

  

  assign good = {ner, tap_i.good};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      good_q    <= '1;
      regend_q  <= 1'b0;
      getsens_q <= 1'b0;
    end else begin
      good_q    <= good;
      regend_q  <= tap_i.regend;
      getsens_q <= getsens;
    end
  end

  assign event_o = {tap_i.lost, getsens && !getsens_q, tap_i.regend && !regend_q,
                    (good_q & ~good) != 5'd0, tap_i.frame_end};
  assign ack_o   = ack_q;
  assign beat_o  = now[3];

  assign unused = tap_i.empty;

endmodule
