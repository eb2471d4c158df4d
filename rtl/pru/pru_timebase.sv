// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time base of biss_pru: eight samples and two half periods of MA in each period.
//
// Clock domain: core. restart_i begins a period, with MA at 1, in the next clock. Sample j of a
// period, 1 to 8, lies floor(j x ratio) clocks behind the edge that begins it; the ratio is 25,
// 12.5, 5, 2.5 clocks at 200 MHz and 10, 5, 2, 1 at 80 MHz. sample_o is high in the clock that ends
// with the edge of the sample; with last_o it is the eighth. tick_o is high with samples four and
// eight: MA changes with them. half_next_o is the level of MA behind the tick.
//
// Misuse: mhz_i must not change while run_i is 1. With run_i = 0 everything stands.
// Source: TIDEP0022, Table 4; docs/pru.md.

module pru_timebase #(
  parameter int unsigned ClockHz = 200_000_000
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [1:0] mhz_i,        // pru_pkg::mhz_e
  input  logic       run_i,
  input  logic       restart_i,
  output logic       sample_o,
  output logic       last_o,
  output logic       tick_o,
  output logic       half_next_o
);

  localparam bit FAST = ClockHz == 200_000_000;

  logic [4:0] gap_last;   // clocks between two samples minus 1
  logic       odd_gap;    // every second gap is a clock longer
  logic [4:0] left_q;     // clocks before the next sample
  logic [2:0] number_q;   // the next sample, from 0
  logic       sample;

  if (FAST) begin : gen_200
    always_comb begin
      unique case (mhz_i)
        pru_pkg::MHZ_1:  gap_last = 5'd24;
        pru_pkg::MHZ_2:  gap_last = 5'd11;
        pru_pkg::MHZ_5:  gap_last = 5'd4;
        default:         gap_last = 5'd1;
      endcase
    end
    assign odd_gap = mhz_i == pru_pkg::MHZ_2 || mhz_i == pru_pkg::MHZ_10;
  end else begin : gen_80
    always_comb begin
      unique case (mhz_i)
        pru_pkg::MHZ_1:  gap_last = 5'd9;
        pru_pkg::MHZ_2:  gap_last = 5'd4;
        pru_pkg::MHZ_5:  gap_last = 5'd1;
        default:         gap_last = 5'd0;
      endcase
    end
    assign odd_gap = 1'b0;
  end

  assign sample = run_i && left_q == 5'd0;

  // The first gap of a pair is the short one.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q   <= '0;
      number_q <= '0;
    end else if (restart_i) begin
      left_q   <= gap_last;
      number_q <= '0;
    end else if (sample) begin
      left_q   <= gap_last + 5'(odd_gap && !number_q[0]);
      number_q <= number_q + 3'd1;
    end else if (run_i) begin
      left_q   <= left_q - 5'd1;
    end
  end

  assign sample_o    = sample;
  assign last_o      = number_q == 3'd7;
  assign tick_o      = sample && number_q[1:0] == 2'd3;
  assign half_next_o = number_q[2];

endmodule
