// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sampler of eight samples a period (biss_os_sampler) in the frame behind a reset: any line, a sample each
// clock or each second one, any point that the user makes of the place. The search begins at any time. The bench
// has its own samples.
//
// claim: the first byte with a low sample is kept; the place is four behind its number of ones, with
//   FIRST_LOW four behind its first low sample; from then on each eighth sample from the point on, and no
//   other, is a bit
// clocks: one
// depth: 40
// cover: 40
// unbounded: reachability
// mutation: biss/biss_os_sampler.sv | {1'b0, ones} + 4'd4 | {1'b0, ones} + 4'd5
// mutation: biss/biss_os_sampler.sv | sl && !(first_low_i && low_q && !begins_q) | sl && !(first_low_i && low_q)
// mutation: biss/biss_os_sampler.sv | (begins_q ? 3'd0 : ones_q) | ones_q
// mutation: biss/biss_os_sampler.sv | strobe2_q.search && !found_q | strobe2_q.search
// mutation: biss/biss_os_sampler.sv | if (loads_q)   wait_q <= point_i; | if (loads_q) wait_q <= point_i + 4'd1;
// mutation: biss/biss_os_sampler.sv | if (take) wait_q <= 4'd7; | if (take) wait_q <= 4'd8;

module proof (
  input logic       clk_i,
  input logic       rst_ni,
  input logic       sl_i,
  input logic       search_i,
  input logic       first_low_i,
  input logic [3:0] point_i,
  input logic       each_i      // a sample each clock
);

  // Samples are numbered; the eighth ends a byte.
  logic [2:0] number_q;
  logic       started = 1'b0;
  logic       sample_q, first_low_q, search_q, each_q;
  logic [3:0] point_q;

  logic       found, byte_done, bit_valid, sl_bit, level;
  logic [7:0] raw;
  logic [3:0] place;

  biss_os_sampler u_dut (
    .clk_i, .rst_ni, .sl_i, .sample_i (sample_q), .last_i (number_q == 3'd7), .clear_i (1'b0), .search_i,
    .first_low_i, .point_i, .sl_o (level), .byte_o (byte_done), .found_o (found), .raw_o (raw),
    .place_o (place), .bit_valid_o (bit_valid), .bit_o (sl_bit)
  );

  always @(posedge clk_i) begin
    started     <= 1'b1;
    first_low_q <= first_low_i;
    search_q    <= search_i && rst_ni;
    point_q     <= point_i;
    sample_q    <= (each_i || !sample_q) && rst_ni;
    each_q      <= each_i;
    if (!rst_ni)       number_q <= '0;
    else if (sample_q) number_q <= number_q + 3'd1;
  end
  always @* begin
    if (!started) assume (!rst_ni);
    else begin
      assume (rst_ni);
      assume (first_low_i == first_low_q && point_i == point_q && each_i == each_q);
      if (each_i) assume (point_i >= 4'd4);  // as each place is
      if (search_q) assume (search_i);
    end
  end

  // What the pin had at each sample, as the sampler sees it two clocks later.
  logic [1:0] when_q, what_q, last_q;
  always @(posedge clk_i) begin
    if (!rst_ni) begin
      when_q <= '0;
      last_q <= '0;
    end else begin
      when_q <= {when_q[0], sample_q};
      last_q <= {last_q[0], sample_q && number_q == 3'd7 && search_i};
    end
    what_q <= {what_q[0], sl_i};
  end

  logic [7:0] byte_q;       // of the bench
  logic       found_q;
  logic [4:0] since_q;      // samples behind the byte that was found, 31 and more together
  logic       due_q, bit_q;
  always @(posedge clk_i) begin
    due_q <= 1'b0;
    if (!rst_ni) begin
      byte_q  <= 8'hFF;
      found_q <= 1'b0;
      since_q <= '0;
    end else if (when_q[1]) begin
      if (!found_q) byte_q <= {byte_q[6:0], what_q[1]};
      if (!found_q && last_q[1] && {byte_q[6:0], what_q[1]} != 8'hFF) found_q <= 1'b1;
      if (found_q && since_q != 5'd31) since_q <= since_q + 5'd1;
      due_q <= found_q && since_q >= {1'b0, point_i} && since_q[2:0] == point_i[2:0] && since_q != 5'd31;
      bit_q <= what_q[1];
    end
  end

  wire [3:0] ones = 4'(raw[0]) + 4'(raw[1]) + 4'(raw[2]) + 4'(raw[3]) + 4'(raw[4]) + 4'(raw[5]) + 4'(raw[6]) + 4'(raw[7]);
  logic [3:0] leading;
  always @* begin
    casez (raw)
      8'b0???????: leading = 4'd0;
      8'b10??????: leading = 4'd1;
      8'b110?????: leading = 4'd2;
      8'b1110????: leading = 4'd3;
      8'b11110???: leading = 4'd4;
      8'b111110??: leading = 4'd5;
      8'b1111110?: leading = 4'd6;
      default:     leading = 4'd7;
    endcase
  end

  always @* if (rst_ni && started) begin
    Found_A: assert (found == found_q);
    if (found) begin
      Raw_A:   assert (raw == byte_q && raw != 8'hFF);
      Place_A: assert (place == (first_low_i ? leading : ones) + 4'd4);
    end
    if (since_q != 5'd31) begin
      Valid_A: assert (bit_valid == due_q);
      if (bit_valid) Bit_A: assert (sl_bit == bit_q);
    end
  end

  always @(posedge clk_i) if (rst_ni) begin
    Early_C: cover (bit_valid && point_i == 4'd1);
    Late_C:  cover (found && place == 4'd11 && !first_low_i);
    Each_C:  cover (bit_valid && each_i);
    Low_C:   cover (found && first_low_i && place == 4'd6 && raw[0]);
  end

endmodule
