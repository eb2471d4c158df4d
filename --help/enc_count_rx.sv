
















module enc_count_rx (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [1:0] count_i,
  output logic       pulse_o,
  output logic [1:0] ack_o
);

  logic [1:0] sync;
  logic [1:0] taken_q;
  logic [1:0] late_q;
  logic [1:0] ack_q;

  for (genvar i = 0; i < 2; i++) begin : gen_bit
    enc_sync_bit u_sync (
      .clk_i,
      .rst_ni,
      .data_i (count_i[i]),
      .data_o (sync[i])
    );
  end

  assign pulse_o = sync != taken_q && ack_q == taken_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      taken_q <= '0;
      late_q  <= '0;
      ack_q   <= '0;
    end else begin
      if (pulse_o) taken_q <= {taken_q[0], !taken_q[1]};
      late_q <= taken_q;
      ack_q  <= late_q;
    end
  end

  assign ack_o = ack_q;

endmodule
