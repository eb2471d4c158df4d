




























module enc_clk_mux #(
  parameter int TimeoutW = 10  
) (
  input  logic clk0_i,
  input  logic clk1_i,
  input  logic rst_ni,
  input  logic sel_i,
  output logic clk_o
);

  logic sel0_q;
  logic sel1_q;
  logic claim0_q;
  logic claim1_q;
  logic ready0_q;
  logic ready1_q;
  logic en0_q;
  logic en1_q;
  logic alive_n;
  logic dead_q;
  logic [1:0] claim0_sync_q;
  logic [TimeoutW-1:0] wait_q;

  assign alive_n = rst_ni && !dead_q;

  always_ff @(posedge clk0_i or negedge alive_n) begin
    if (!alive_n) begin
      sel0_q   <= 1'b0;
      claim0_q <= 1'b0;
      ready0_q <= 1'b0;
    end else begin
      sel0_q   <= !sel_i;
      claim0_q <= sel0_q || en0_q;
      ready0_q <= sel0_q && claim0_q && !claim1_q;
    end
  end

  always_ff @(negedge clk0_i or negedge alive_n) begin
    if (!alive_n) en0_q <= 1'b0;
    else          en0_q <= ready0_q;
  end

  always_ff @(posedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sel1_q   <= 1'b0;
      claim1_q <= 1'b0;
      ready1_q <= 1'b0;
    end else begin
      sel1_q   <= sel_i;
      claim1_q <= sel1_q || en1_q;
      ready1_q <= sel1_q && claim1_q && !claim0_q;
    end
  end

  always_ff @(negedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) en1_q <= 1'b0;
    else         en1_q <= ready1_q;
  end

  
  always_ff @(posedge clk1_i or negedge rst_ni) begin
    if (!rst_ni) begin
      claim0_sync_q <= 2'b00;
      wait_q        <= '0;
      dead_q        <= 1'b0;
    end else begin
      claim0_sync_q <= {claim0_sync_q[0], sel1_q && claim0_q};
      wait_q        <= claim0_sync_q[1] ? wait_q + TimeoutW'(1) : '0;
      dead_q        <= wait_q == '1;
    end
  end

  assign clk_o = (clk0_i & en0_q) | (clk1_i & en1_q);

endmodule
