// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The word of a byte in M_PAR: 8b/10b as the published master sends it. 28 goes out as K28, x.3
// has one form, and x.7 has no second one.
//
// Clock domain: core. word_o and uneven_o are those of the data_i of the clock before, and of
// disparity_i now. Synthesis makes a read-only memory of the table of the block of six.
//
// disparity_i is the counter of the equaliser. uneven_o: the block of six bits moves it by two, up
// if it is negative, else down. The block of four follows what the counter is then, and does not
// move it.
// Misuse: none, each byte has a word.
// Source: docs/dsl.md, "The protocol".

module dsl_code_tx (
  input  logic       clk_i,
  input  logic [7:0] data_i,
  input  logic [7:0] disparity_i,    // signed
  output logic       uneven_o,
  output logic [9:0] word_o       // the first bit on the line is bit 9
);

  logic [7:0] data_q;
  logic [6:0] row;               // uneven, block of six
  logic [5:0] six;
  logic [3:0] four;
  logic       uneven4;
  logic       negative, negative4;   // the counter is, in front of each block

  // The forms with fewer ones.
  always_comb begin
    (* rom_block *)
    case (data_q[4:0])
      5'd0:    row = 7'b1_011000;
      5'd1:    row = 7'b1_100010;
      5'd2:    row = 7'b1_010010;
      5'd3:    row = 7'b0_110001;
      5'd4:    row = 7'b1_001010;
      5'd5:    row = 7'b0_101001;
      5'd6:    row = 7'b0_011001;
      5'd7:    row = 7'b0_000111;
      5'd8:    row = 7'b1_000110;
      5'd9:    row = 7'b0_100101;
      5'd10:   row = 7'b0_010101;
      5'd11:   row = 7'b0_110100;
      5'd12:   row = 7'b0_001101;
      5'd13:   row = 7'b0_101100;
      5'd14:   row = 7'b0_011100;
      5'd15:   row = 7'b1_101000;
      5'd16:   row = 7'b1_100100;
      5'd17:   row = 7'b0_100011;
      5'd18:   row = 7'b0_010011;
      5'd19:   row = 7'b0_110010;
      5'd20:   row = 7'b0_001011;
      5'd21:   row = 7'b0_101010;
      5'd22:   row = 7'b0_011010;
      5'd23:   row = 7'b1_000101;
      5'd24:   row = 7'b1_001100;
      5'd25:   row = 7'b0_100110;
      5'd26:   row = 7'b0_010110;
      5'd27:   row = 7'b1_001001;
      5'd28:   row = 7'b1_110000;
      5'd29:   row = 7'b1_010001;
      5'd30:   row = 7'b1_100001;
      default: row = 7'b1_010100;
    endcase
  end
  assign {uneven_o, six} = row;

  always_comb begin
    uneven4 = 1'b0;
    unique case (data_q[7:5])
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

  always_ff @(posedge clk_i) begin
    data_q <= data_i;
  end

  assign negative  = disparity_i[7];
  assign negative4 = !uneven_o ? negative
                   : negative  ? signed'(disparity_i) < -8'sd2
                               : signed'(disparity_i) < 8'sd2;
  assign word_o    = {six ^ {6{uneven_o && negative}}, four ^ {4{uneven4 && negative4}}};

endmodule
