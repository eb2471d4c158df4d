// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A received word: its byte, and whether it may be there.
//
// Clock domain: core. word_o is that of the line_i of the clock before; strict_i, raw_i and
// second_i are of now. Synthesis makes a read-only memory of the table of the block of six.
//
// strict_i: the 464 words of the standard are right: 440 of data, K28.0 to K28.7, K23.7, K27.7,
// K29.7, K30.7, each as it follows a right start. Else as published: four or five equal bits in two
// places are an error, and a word that no table has reads as FFh.
// K28.1, K28.2, K28.5 and K28.6 that begin with 110000 read with their upper three bits inverted in
// the tables of data. The strict check mends this but for raw_i, the published one in the second
// safe channel alone; with second_i both do.
// Misuse: none, each word has an answer.
// Source: docs/dsl.md, "The protocol"; Widmer and Franaszek for the code.

module dsl_code_rx (
  input  logic           clk_i,
  input  logic [9:0]     line_i,          // the first bit is bit 9
  input  logic           strict_i,
  input  logic           raw_i,           // K28 as the tables of data have it
  input  logic           second_i,        // the word is one of the second safe channel
  output dsl_pkg::word_t word_o
);

  logic [9:0] line_q;
  logic [5:0] six;
  logic [9:0] row;
  logic [3:0] four;
  logic [4:0] x;
  logic [2:0] y;
  logic       none6;          // in no table
  logic       none4;
  logic       k28;
  logic       more, less;     // the block of six has four ones, or two
  logic       wants_more;     // the block of four follows a positive disparity
  logic       wants_less;
  logic       seven;          // x.7, first form
  logic       seven2;         // ... second form
  logic       ends_equal;     // five equal bits would stand in the first form
  logic       can_special;    // 23, 27, 29, 30, each with both of its forms
  logic       special, data;
  logic       looks_special;
  logic       many_equal;
  logic       mend;

  always_ff @(posedge clk_i) begin
    line_q <= line_i;
  end
  assign {six, four} = line_q;

  // Of a block of six: in no table, K28, four ones, two ones, special with both of its forms; x.
  always_comb begin
    (* rom_block *)
    case (six)
      6'b011000: row = {5'b00010, 5'd0};
      6'b100111: row = {5'b00100, 5'd0};
      6'b100010: row = {5'b00010, 5'd1};
      6'b011101: row = {5'b00100, 5'd1};
      6'b010010: row = {5'b00010, 5'd2};
      6'b101101: row = {5'b00100, 5'd2};
      6'b110001: row = {5'b00000, 5'd3};
      6'b001010: row = {5'b00010, 5'd4};
      6'b110101: row = {5'b00100, 5'd4};
      6'b101001: row = {5'b00000, 5'd5};
      6'b011001: row = {5'b00000, 5'd6};
      6'b000111: row = {5'b00100, 5'd7};    // balanced: the disparity stays positive
      6'b111000: row = {5'b00010, 5'd7};    // ... negative
      6'b000110: row = {5'b00010, 5'd8};
      6'b111001: row = {5'b00100, 5'd8};
      6'b100101: row = {5'b00000, 5'd9};
      6'b010101: row = {5'b00000, 5'd10};
      6'b110100: row = {5'b00000, 5'd11};
      6'b001101: row = {5'b00000, 5'd12};
      6'b101100: row = {5'b00000, 5'd13};
      6'b011100: row = {5'b00000, 5'd14};
      6'b101000: row = {5'b00010, 5'd15};
      6'b010111: row = {5'b00100, 5'd15};
      6'b100100: row = {5'b00010, 5'd16};
      6'b011011: row = {5'b00100, 5'd16};
      6'b100011: row = {5'b00000, 5'd17};
      6'b010011: row = {5'b00000, 5'd18};
      6'b110010: row = {5'b00000, 5'd19};
      6'b001011: row = {5'b00000, 5'd20};
      6'b101010: row = {5'b00000, 5'd21};
      6'b011010: row = {5'b00000, 5'd22};
      6'b000101: row = {5'b00011, 5'd23};
      6'b111010: row = {5'b00101, 5'd23};
      6'b001100: row = {5'b00010, 5'd24};
      6'b110011: row = {5'b00100, 5'd24};
      6'b100110: row = {5'b00000, 5'd25};
      6'b010110: row = {5'b00000, 5'd26};
      6'b001001: row = {5'b00011, 5'd27};
      6'b110110: row = {5'b00101, 5'd27};
      6'b001110: row = {5'b00000, 5'd28};
      6'b110000: row = {5'b01010, 5'd28};
      6'b001111: row = {5'b01100, 5'd28};
      6'b010001: row = {5'b00011, 5'd29};
      6'b101110: row = {5'b00101, 5'd29};
      6'b100001: row = {5'b00011, 5'd30};
      6'b011110: row = {5'b00101, 5'd30};
      6'b010100: row = {5'b00010, 5'd31};
      6'b101011: row = {5'b00100, 5'd31};
      default:   row = {5'b10000, 5'd31};
    endcase
  end
  assign {none6, k28, more, less, can_special, x} = row;

  always_comb begin
    {none4, wants_more, wants_less, seven, seven2} = 5'b00000;
    y = 3'd7;
    case (four)
      4'b0100: begin y = 3'd0; wants_more = 1'b1; end
      4'b1011: begin y = 3'd0; wants_less = 1'b1; end
      4'b1001: y = 3'd1;
      4'b0101: y = 3'd2;
      4'b0011: begin y = 3'd3; wants_more = 1'b1; end
      4'b1100: begin y = 3'd3; wants_less = 1'b1; end
      4'b0010: begin y = 3'd4; wants_more = 1'b1; end
      4'b1101: begin y = 3'd4; wants_less = 1'b1; end
      4'b1010: y = 3'd5;
      4'b0110: y = 3'd6;
      4'b0001: begin wants_more = 1'b1; seven  = 1'b1; end
      4'b1110: begin wants_less = 1'b1; seven  = 1'b1; end
      4'b1000: begin wants_more = 1'b1; seven2 = 1'b1; end
      4'b0111: begin wants_less = 1'b1; seven2 = 1'b1; end
      default: none4 = 1'b1;
    endcase
  end

  // A block of four fits to the disparity that the block of six leaves.
  logic fits;
  assign fits       = !none6 && !none4 && !(wants_more && less) && !(wants_less && more);
  assign ends_equal = six[1:0] == {2{wants_less}};
  assign special    = fits && (k28 ? !seven : seven2 && can_special);
  assign data       = fits && !k28 && !(seven && ends_equal) && !(seven2 && !ends_equal);

  // As published. c = d = e = i, or e and i differ and i = g = h = j.
  assign looks_special = line_q[7:4] == 4'b0000 || line_q[7:4] == 4'b1111
                      || {line_q[5:4], line_q[2:0]} == 5'b01_111
                      || {line_q[5:4], line_q[2:0]} == 5'b10_000;
  // a = b = c = d, or e = i = f = g = h.
  assign many_equal    = line_q[9:6] == 4'b0000 || line_q[9:6] == 4'b1111
                      || line_q[5:1] == 5'b00000 || line_q[5:1] == 5'b11111;

  // y = 1, 2, 5, 6 has no disparity.
  assign mend = (second_i || (strict_i && !raw_i)) && k28 && less
             && !wants_more && !wants_less;

  assign word_o.data        = none6 || none4 ? 8'hFF : {y ^ {3{mend}}, x};
  assign word_o.error       = strict_i ? !special && !data : many_equal;
  assign word_o.special     = strict_i ? special : looks_special && (!second_i || special);
  assign word_o.only_strict = strict_i && !special && !data && !many_equal;

endmodule
