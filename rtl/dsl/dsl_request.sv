// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The nibbles of a request, one after another, with its CRC: a byte of the memory is asked for, and
// its half goes through the division; the CRC follows.
//
// Clock domain: core. take_i begins a request, long_i says of which kind it is. byte_o is the byte
// that is wanted; data_i has it with load_i, and nibble_o is the nibble four clocks of shift_i
// later. sends_i goes on to the next one: last_o tells that there is none. With crc_o the nibble is
// one of the CRC, and needs no load_i.
// Its flops have no reset: take_i comes before all of the others, and clear_i before take_i.
// Misuse: sends_i before the four clocks of shift_i spoils the CRC.
// Source: docs/dsl.md, "Messages".

module dsl_request (
  input  logic       clk_i,
  input  logic       clear_i,
  input  logic       take_i,
  input  logic       long_i,
  input  logic       sends_i,
  input  logic       load_i,
  input  logic       shift_i,
  input  logic [7:0] data_i,
  output logic       long_o,
  output logic [3:0] byte_o,
  output logic       crc_o,
  output logic       last_o,
  output logic [3:0] nibble_o
);

  logic       long_q;
  logic [3:0] byte_q;
  logic       half_q;         // the lower one
  logic       crc_q;
  logic [3:0] nibble_q;
  logic       write_q;        // data follow
  logic       offset_q;
  logic [1:0] length_q;       // 0, 2, 4, 8 bytes
  logic       top;
  logic [3:0] data_last;      // byte of a long request with data
  assign data_last = {length_q == 2'd3, length_q != 2'd3, length_q != 2'd1, 1'b1};

  logic       to_crc;         // behind this byte
  logic [3:0] byte_d;
  always_comb begin
    to_crc = 1'b0;
    byte_d = byte_q + 4'd1;
    if (!crc_q) begin
      if (!long_q) to_crc = byte_q[0] || !write_q;
      else begin
        case (byte_q)
          4'd0, 4'd2: ;
          4'd1: if (!offset_q) begin
            to_crc = !write_q;
            byte_d = 4'd4;
          end
          4'd3:    to_crc = !write_q;
          default: to_crc = byte_q == data_last;
        endcase
      end
      if (to_crc) byte_d = 4'd0;
    end
  end

  always_ff @(posedge clk_i) begin
    if (take_i) begin
      long_q     <= long_i;
      byte_q          <= 4'd0;
      {half_q, crc_q} <= '0;
    end else if (sends_i) begin
      half_q <= !half_q;
      if (half_q) begin
        byte_q <= byte_d;
        if (to_crc) crc_q <= 1'b1;
      end
    end
    if (load_i) begin
      nibble_q <= half_q                   ? data_i[3:0]
                : long_q || byte_q[0] ? data_i[7:4]
                                           : {1'b0, data_i[7], data_i[5:4]};
      if (byte_q == 4'd0 && !half_q) begin
        write_q  <= long_q ? !data_i[6] && data_i[3:2] != 2'd0 : !data_i[7];
        offset_q <= data_i[5];
        length_q <= data_i[3:2];
      end
    end else if (shift_i) begin
      nibble_q <= {nibble_q[2:0], crc_q ? top ^ byte_q[0] : nibble_q[3]};
    end
  end

  dsl_crc16 u_crc (
    .clk_i,
    .load_i  (clear_i),
    .shift_i (shift_i),
    .feed_i  (!crc_q),
    .bit_i   (nibble_q[3]),
    .top_o   (top)
  );

  assign long_o   = long_q;
  assign byte_o   = byte_q;
  assign crc_o    = crc_q;
  assign last_o   = crc_q && byte_q[0] && half_q;
  assign nibble_o = nibble_q;

endmodule
