// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Second host read port: chooses the byte of the host's bank, as mb4_host_read does.
//
// Clock domain: its own rd_clk_i. bank_i and ram_ready_i are asynchronous here; one flop each
// samples them at the edge that reads the memory.
// Until the memories are cleared the port reads 0.
// Datasheet: page 19.

module mb4_read_port2 (
  input  logic        rd_clk_i,
  input  logic        rst_ni,
  input  logic        rd_en_i,
  output logic [7:0]  rd_data_o,
  input  logic        ram_ready_i,
  input  logic        bank_i,
  input  logic [15:0] data_i       // read register of the memory, bank 1 in the upper byte
);

  logic bank_q;
  logic ready_q;

  always_ff @(posedge rd_clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank_q  <= 1'b0;
      ready_q <= 1'b0;
    end else if (rd_en_i) begin
      bank_q  <= bank_i;
      ready_q <= ram_ready_i;
    end
  end

  assign rd_data_o = !ready_q ? 8'h00 : bank_q ? data_i[15:8] : data_i[7:0];

endmodule
