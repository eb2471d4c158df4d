// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The word of a byte in M_PAR: 8b/10b as the published master sends it. 28 goes out as K28, x.3
// has one form, and x.7 has no second one.
//
// Clock domain: none, combinational.
//
// disparity_i is the counter of the equaliser. uneven_o: the block of six bits moves it by two, up
// if it is negative, else down. The block of four follows what the counter is then, and does not
// move it.
// Misuse: none, each byte has a word.
// Source: docs/dsl.md, "The protocol".

module dsl_code_tx (
  input  logic [7:0] data_i,
  input  logic [7:0] disparity_i,    // signed
  output logic       uneven_o,
  output logic [9:0] word_o       // the first bit on the line is bit 9
);

  logic [5:0] six;
  logic [3:0] four;
  logic       uneven4;
  logic       negative, negative4;   // the counter is, in front of each block

  // The forms with fewer ones.
  always_comb begin
    uneven_o = 1'b0;
    unique case (data_i[4:0])
      5'd0:    {uneven_o, six} = 7'b1_011000;
      5'd1:    {uneven_o, six} = 7'b1_100010;
      5'd2:    {uneven_o, six} = 7'b1_010010;
      5'd3:    six = 6'b110001;
      5'd4:    {uneven_o, six} = 7'b1_001010;
      5'd5:    six = 6'b101001;
      5'd6:    six = 6'b011001;
      5'd7:    six = 6'b000111;
      5'd8:    {uneven_o, six} = 7'b1_000110;
      5'd9:    six = 6'b100101;
      5'd10:   six = 6'b010101;
      5'd11:   six = 6'b110100;
      5'd12:   six = 6'b001101;
      5'd13:   six = 6'b101100;
      5'd14:   six = 6'b011100;
      5'd15:   {uneven_o, six} = 7'b1_101000;
      5'd16:   {uneven_o, six} = 7'b1_100100;
      5'd17:   six = 6'b100011;
      5'd18:   six = 6'b010011;
      5'd19:   six = 6'b110010;
      5'd20:   six = 6'b001011;
      5'd21:   six = 6'b101010;
      5'd22:   six = 6'b011010;
      5'd23:   {uneven_o, six} = 7'b1_000101;
      5'd24:   {uneven_o, six} = 7'b1_001100;
      5'd25:   six = 6'b100110;
      5'd26:   six = 6'b010110;
      5'd27:   {uneven_o, six} = 7'b1_001001;
      5'd28:   {uneven_o, six} = 7'b1_110000;
      5'd29:   {uneven_o, six} = 7'b1_010001;
      5'd30:   {uneven_o, six} = 7'b1_100001;
      default: {uneven_o, six} = 7'b1_010100;
    endcase

    uneven4 = 1'b0;
    unique case (data_i[7:5])
      3'd0:    {uneven4, four} = 5'b1_0100;
      3'd1:    four = 4'b1001;
      3'd2:    four = 4'b0101;
      3'd3:    four = 4'b0011;
      3'd4:    {uneven4, four} = 5'b1_0010;
      3'd5:    four = 4'b1010;
      3'd6:    four = 4'b0110;
      default: {uneven4, four} = 5'b1_0001;
    endcase
  end

  assign negative  = disparity_i[7];
  assign negative4 = !uneven_o ? negative
                   : negative  ? signed'(disparity_i) < -8'sd2
                               : signed'(disparity_i) < 8'sd2;
  assign word_o    = {six ^ {6{uneven_o && negative}}, four ^ {4{uneven4 && negative4}}};

endmodule
