








module mb4_freqs_dec (
  input  logic [4:0] freqs_i,
  output logic [7:0] half_len_o
);

  logic [4:0] steps;

  assign steps      = 5'(freqs_i[3:0]) + 5'd1;
  assign half_len_o = freqs_i[4] ? {steps, 3'b000} + {2'b00, steps, 1'b0} : {3'b000, steps};

endmodule
