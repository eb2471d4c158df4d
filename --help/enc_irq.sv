


















module enc_irq (
  
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [4:0] event_i,       
  
  input  logic       bus_clk_i,
  input  logic       bus_rst_ni,
  input  logic       status_we_i,   
  input  logic       enable_we_i,
  input  logic [4:0] data_i,
  output logic [4:0] status_o,
  output logic [4:0] enable_o,
  output logic       irq_o
);

  
  logic [4:0] wait_q;     
  logic [4:0] held_q;     
  logic       req_q;
  logic       ack;
  logic       send;
  logic [4:0] left;       
  
  logic [4:0] status_q;
  logic [4:0] enable_q;
  logic       ack_q;
  logic       req;
  logic [4:0] kept;
  logic [4:0] set;

  enc_sync_bit u_ack (
    .clk_i,
    .rst_ni,
    .data_i (ack_q),
    .data_o (ack)
  );

  assign send = req_q == ack && wait_q != 5'd0;
  assign left = wait_q & {5{!send}};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wait_q <= '0;
      held_q <= '0;
      req_q  <= 1'b0;
    end else begin
      wait_q <= left | event_i | {left[0] && event_i[0], 4'd0};
      if (send) held_q <= wait_q;
      req_q  <= req_q ^ send;
    end
  end

  enc_sync_bit u_req (
    .clk_i  (bus_clk_i),
    .rst_ni (bus_rst_ni),
    .data_i (req_q),
    .data_o (req)
  );

  assign set  = held_q & {5{req != ack_q}};
  assign kept = status_q & ~(data_i & {5{status_we_i}});

  always_ff @(posedge bus_clk_i or negedge bus_rst_ni) begin
    if (!bus_rst_ni) begin
      status_q <= '0;
      enable_q <= '0;
      ack_q    <= 1'b0;
    end else begin
      status_q <= kept | set | {kept[0] && set[0], 4'd0};
      if (enable_we_i) enable_q <= data_i;
      ack_q    <= req;
    end
  end

  assign status_o = status_q;
  assign enable_o = enable_q;
  assign irq_o    = (status_q & enable_q) != 5'd0;

endmodule
