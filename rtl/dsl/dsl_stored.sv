// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes of messages that the host shares, and what the host alone writes and reads: a memory
// with one port for reading and one for writing, which the host's accesses have first. Nibbles of
// answers are kept in a memory of their own.
//
// Clock domain: core. state_i is what dsl_message works on: it asks for a byte in FETCH, STORE and
// COUNT, which data_o is one clock later, and writes one in the states that do; in a clock with an
// access of the host it has to wait. answer_o is the nibble that HIGH or LOW has asked for.
// Bit 7 of ADD_H and OFF_H is always 1.
// Misuse: a byte is undefined before it is written.
// Source: docs/dsl.md, "Messages".

module dsl_stored (
  input  logic       clk_i,
  input  logic       sdk_map_i,
  // host
  input  logic       host_read_i,
  input  logic       host_write_i,
  input  logic [5:0] host_address_i,
  input  logic [7:0] host_byte_i,
  // dsl_message
  input  logic [3:0] state_i,        // dsl_message_pkg::work_e
  input  logic [5:0] index_i,
  input  logic       safe_host_i,
  input  logic       send_long_i,    // a request
  input  logic [3:0] send_byte_i,
  input  logic       is_long_i,      // an answer
  input  logic [4:0] count_i,
  input  logic [3:0] nibble_i,
  input  logic       copy_long_i,    // ... that is copied
  input  logic       error_i,
  input  logic [3:0] high_i,
  output logic [7:0] data_o,
  output logic [3:0] answer_o
);

  localparam logic [5:0] HEADER = 6'd2;     // bytes of one

  logic       wr_en;
  logic [4:0] short_host;        // CTRL and DATA of the host
  assign short_host = {4'b0100, safe_host_i};
  logic [5:0] wr_address, rd_address;
  logic [7:0] wr_data;
  logic [5:0] put_to;

  always_comb begin
    case (state_i)
      dsl_message_pkg::FETCH:   rd_address = send_long_i ? {2'd0, send_byte_i}
                                                         : {short_host, send_byte_i[0]};
      dsl_message_pkg::STORE:   rd_address = is_long_i ? {5'd0, count_i[1]} : {short_host, 1'b0};
      default: rd_address = index_i;
    endcase
    if (host_read_i) rd_address = host_address_i;
  end

  // The two bytes of an error stand in the other order in the SDK.
  always_comb begin
    put_to = {short_host, 1'b1};
    if (copy_long_i) begin
      put_to = index_i;
      if (index_i >= HEADER) put_to = index_i + HEADER;
      if (index_i[5:1] == 5'd1 && error_i && sdk_map_i) put_to[0] = !index_i[0];
    end
  end

  always_comb begin
    case (state_i)
      dsl_message_pkg::PUT:       wr_address = put_to;
      default:   wr_address = index_i;
    endcase
    if (host_write_i) wr_address = host_address_i;
  end
  always_comb begin
    wr_data = {high_i, answer_o};
    case (state_i)
      dsl_message_pkg::ADD:   wr_data = data_o + 8'd1;
      dsl_message_pkg::CLEAR: begin
        wr_data = 8'h00;
        if (index_i == dsl_message_pkg::SYNC_CTRL) wr_data = dsl_regs_pkg::RESET_SYNC_CTRL;
      end
      default: ;
    endcase
    if (host_write_i) wr_data = host_byte_i;
    // The marks of a long message in ADD_H and OFF_H.
    if (wr_address[5:2] == 4'd0 && !wr_address[0]) wr_data[7] = 1'b1;
  end

  always_comb begin
    case (state_i)
      dsl_message_pkg::CLEAR, dsl_message_pkg::PUT, dsl_message_pkg::ADD: wr_en = 1'b1;
      default:         wr_en = 1'b0;
    endcase
  end

  enc_ram #(.Width(8), .AddrW(6)) u_memory (
    .wr_clk_i  (clk_i),
    .wr_en_i   (host_write_i || (wr_en && !host_read_i)),
    .wr_addr_i (wr_address),
    .wr_data_i (wr_data),
    .rd_clk_i  (clk_i),
    .rd_en_i   (1'b1),
    .rd_addr_i (rd_address),
    .rd_data_o (data_o)
  );

  // Answers: a long one in the upper half.
  enc_ram #(.Width(4), .AddrW(6)) u_answers (
    .wr_clk_i  (clk_i),
    .wr_en_i   (state_i == dsl_message_pkg::STORE),
    .wr_addr_i ({is_long_i, count_i}),
    .wr_data_i (nibble_i),
    .rd_clk_i  (clk_i),
    .rd_en_i   (state_i == dsl_message_pkg::HIGH || state_i == dsl_message_pkg::LOW),
    .rd_addr_i ({copy_long_i, index_i[3:0], state_i == dsl_message_pkg::LOW}),
    .rd_data_o (answer_o)
  );

endmodule
