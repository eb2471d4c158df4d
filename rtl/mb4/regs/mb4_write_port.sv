// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The single write port of a data memory. Clearing after a reset goes first, then the engine, then
// the host.
//
// Clock domain: core; combinational. host_ready_o is high in the clock in which the posted byte of
// the host is taken. The engine writes at most every second clock, so the host waits at most one
// clock for it.

module mb4_write_port (
  input  logic       clear_i,
  input  logic [5:0] clear_addr_i,
  input  logic       eng_wr_en_i,
  input  logic [5:0] eng_wr_addr_i,
  input  logic [7:0] eng_wr_data_i,
  input  logic       host_wr_en_i,
  input  logic [5:0] host_wr_addr_i,
  input  logic [7:0] host_wr_data_i,
  output logic       host_ready_o,
  output logic       wr_en_o,
  output logic [5:0] wr_addr_o,
  output logic [7:0] wr_data_o
);

  always_comb begin
    wr_en_o      = host_wr_en_i;
    wr_addr_o    = host_wr_addr_i;
    wr_data_o    = host_wr_data_i;
    host_ready_o = 1'b1;
    if (clear_i) begin
      wr_en_o      = 1'b1;
      wr_addr_o    = clear_addr_i;
      wr_data_o    = 8'h00;
      host_ready_o = 1'b0;
    end else if (eng_wr_en_i) begin
      wr_en_o      = 1'b1;
      wr_addr_o    = eng_wr_addr_i;
      wr_data_o    = eng_wr_data_i;
      host_ready_o = 1'b0;
    end
  end

endmodule
