






















module enc_wb #(
  parameter int AddrW = 12,
  parameter bit Pipelined = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  
  input  logic             wb_cyc_i,
  input  logic             wb_stb_i,
  input  logic             wb_we_i,
  input  logic [AddrW-1:2] wb_adr_i,
  input  logic [31:0]      wb_dat_i,
  input  logic [3:0]       wb_sel_i,
  output logic [31:0]      wb_dat_o,
  output logic             wb_ack_o,
  output logic             wb_err_o,
  output logic             wb_stall_o,   
  
  output logic             word_req_o,
  output logic             word_write_o,
  output logic [AddrW-1:2] word_addr_o,
  output logic [31:0]      word_data_o,
  output logic [3:0]       word_be_o,
  input  logic             word_ready_i,
  input  logic [31:0]      word_data_i,
  input  logic             word_error_i
);

  logic        busy_q;      
  logic        accept_q;    
  logic        ack_q;
  logic        err_q;
  logic        error_q;
  logic [31:0] data_q;
  logic        strobe;
  logic        done;

  assign strobe = wb_cyc_i && wb_stb_i;

  assign word_req_o   = busy_q && strobe;
  assign word_write_o = wb_we_i;
  assign word_addr_o  = wb_adr_i;
  assign word_data_o  = wb_dat_i;
  assign word_be_o    = wb_sel_i | {4{!wb_we_i}};
  assign done         = word_req_o && word_ready_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q   <= 1'b0;
      accept_q <= 1'b0;
      ack_q    <= 1'b0;
      err_q    <= 1'b0;
      error_q  <= 1'b0;
      data_q   <= '0;
    end else begin
      busy_q   <= strobe && !done;
      accept_q <= done;
      ack_q    <= Pipelined ? accept_q && strobe && !error_q : done && !word_error_i;
      err_q    <= Pipelined ? accept_q && strobe && error_q : done && word_error_i;
      if (done) begin
        error_q <= word_error_i;
        data_q  <= word_data_i;
      end
    end
  end

  assign wb_dat_o   = data_q;
  assign wb_ack_o   = ack_q && wb_cyc_i && (Pipelined || wb_stb_i);
  assign wb_err_o   = err_q && wb_cyc_i && (Pipelined || wb_stb_i);
  assign wb_stall_o = !accept_q;

endmodule
