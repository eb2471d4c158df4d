




















module biss_rx_word #(
  parameter int DataBits = 64,   
  parameter bit          FreeCrc  = 1'b1  
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  biss_pkg_offer_t offer_i,
  input  logic       run_i,        
  input  logic       load_i,
  input  logic       bit_valid_i,
  input  logic       bit_i,
  output logic       next_o,
  output biss_pkg_rx_t rx_o
);

  biss_pkg_word_t word;
  logic       sensor;
  logic       wr_en;
  logic [2:0] wr_byte;
  logic       ok;
  logic       in_crc_d;
  logic       in_crc_q;
  logic [5:0] left_d;
  logic [5:0] left_q;    
  logic [6:0] part_d;
  logic [6:0] part_q;
  logic       skip_d;
  logic       skip_q;    
  logic       fresh_q;   
  logic       bin_q;     
  logic       good_d;
  logic       good_q;
  logic       crc_top;
  logic       value;
  logic       crc_fits;
  logic       known;     

  
  localparam logic [5:0] LEFT = 6'((32'd1 << (DataBits > 16 ? $clog2(DataBits) : 4)) - 32'd1);

`ifndef __ICARUS__  
  if (DataBits < 1 || DataBits > 64) begin : gen_data_bits
    $error("DataBits is 1 to 64");
  end
`endif

  enc_crc #(.Free(FreeCrc)) u_crc (
    .clk_i,
    .rst_ni,
    .crc16_i (word.crc_last[3]),
    .poly_i  (word.crc_poly),
    .top_i   (word.crc_top),
    .start_i (word.crc_start),
    .load_i,
    .shift_i (bit_valid_i && !skip_q),
    .feed_i  (!in_crc_q),
    .bit_i,
    .top_o   (crc_top)
  );

  assign word   = offer_i.word;
  assign sensor = !word.actuator;

  
  assign value    = bit_i ^ (in_crc_q || (word.gray && bin_q));
  assign crc_fits = good_q && value == crc_top && known;
  assign known    = FreeCrc || word.crc_last[3] ||
                    (word.crc_top == 8'h20 && word.crc_poly[5:0] == 6'h03);

  logic good_d_shadow; logic in_crc_d_shadow; logic [5:0] left_d_shadow; logic next_o_shadow; logic ok_shadow; logic [6:0] part_d_shadow; logic skip_d_shadow; logic [2:0] wr_byte_shadow; logic wr_en_shadow; always begin begin
    skip_d_shadow    = skip_q;
    in_crc_d_shadow  = in_crc_q;
    left_d_shadow    = left_q;
    part_d_shadow    = part_q;
    good_d_shadow    = good_q;
    wr_en_shadow   = 1'b0;
    wr_byte_shadow = left_q[5:3];
    next_o_shadow    = 1'b0;
    ok_shadow      = 1'b1;

    if (load_i) begin
      skip_d_shadow   = word.stop;
      in_crc_d_shadow = 1'b0;
      left_d_shadow   = word.data_last & LEFT;
      part_d_shadow   = '0;
      good_d_shadow   = 1'b1;
    end else if (bit_valid_i && skip_q) begin
      skip_d_shadow = 1'b0;
    end else if (bit_valid_i) begin
      left_d_shadow = (left_q - 6'd1) & LEFT;
      part_d_shadow = (left_q[2:0] == 3'd0) ? 7'h00 : {part_q[5:0], value};
      if (!in_crc_q) begin
        wr_en_shadow = left_q[2:0] == 3'd0;
        if (left_q == 6'd0) begin
          in_crc_d_shadow = 1'b1;
          left_d_shadow   = (6'd0 | word.crc_last);
          next_o_shadow   = !word.crc_on;
        end
      end else begin
        good_d_shadow    = crc_fits;
        ok_shadow      = crc_fits;
        next_o_shadow    = left_q == 6'd0;
        wr_en_shadow   = word.crc_store && left_q[2:0] == 3'd0;
        wr_byte_shadow = (word.crc_last[3] && left_q == 6'd0) ? 3'd6 : 3'd7;
      end
    end
  end good_d = good_d_shadow; in_crc_d = in_crc_d_shadow; left_d = left_d_shadow; next_o = next_o_shadow; ok = ok_shadow; part_d = part_d_shadow; skip_d = skip_d_shadow; wr_byte = wr_byte_shadow; wr_en = wr_en_shadow; @(bit_valid_i or crc_fits or good_q or in_crc_q or left_q or load_i or part_q or skip_q or value or word); end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      skip_q   <= 1'b0;
      fresh_q  <= 1'b0;
      bin_q    <= 1'b0;
      in_crc_q <= 1'b0;
      left_q   <= '0;
      part_q   <= '0;
      good_q   <= 1'b0;
    end else begin
      skip_q   <= skip_d;
      fresh_q  <= load_i || (fresh_q && !bit_valid_i);
      if (load_i)           bin_q <= 1'b0;
      else if (bit_valid_i) bin_q <= value;
      in_crc_q <= in_crc_d;
      left_q   <= left_d;
      part_q   <= part_d;
      good_q   <= good_d;
    end
  end

  assign rx_o = {offer_i.slave, wr_en && sensor, wr_byte, part_q, value,
                 bit_valid_i && fresh_q && sensor,
                 run_i && !load_i && (bit_valid_i || !fresh_q) && !next_o && sensor,
                 next_o && sensor, ok};

endmodule
