// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Receiver of events from another clock domain. The sender counts the events in Gray code; each
// step of count_i gives one pulse_o in clk_i.
//
// Clock domain: clk_i; count_i comes from another domain.
// Latency: pulse_o comes 1..2 clocks after the step, but at least three clocks after the previous
// pulse. Data that the sender holds from the step on may be captured with pulse_o. ack_o is the
// count of the steps taken. It follows two clocks after the capture, when the receiver has acted.
//
// Misuse: count_i must be at most two steps ahead of ack_o, as the sender sees it; steps beyond
// that are lost. While two steps are on their way, the sender may change its data without a third
// step: only the second pulse has to see them.
// Constraint: data held by the sender need a maximum delay of one clk_i period; false path to the
// first flops.

module enc_count_rx (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [1:0] count_i,
  output logic       pulse_o,
  output logic [1:0] ack_o
);

  logic [1:0] sync;
  logic [1:0] taken_q;
  logic [1:0] late_q;
  logic [1:0] ack_q;

  for (genvar i = 0; i < 2; i++) begin : gen_bit
    enc_sync_bit u_sync (
      .clk_i,
      .rst_ni,
      .data_i (count_i[i]),
      .data_o (sync[i])
    );
  end

  assign pulse_o = sync != taken_q && ack_q == taken_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      taken_q <= '0;
      late_q  <= '0;
      ack_q   <= '0;
    end else begin
      if (pulse_o) taken_q <= {taken_q[0], !taken_q[1]};
      late_q <= taken_q;
      ack_q  <= late_q;
    end
  end

  assign ack_o = ack_q;

endmodule
