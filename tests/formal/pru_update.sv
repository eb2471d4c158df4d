// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The results of biss_pru (pru_memory, pru_control): whatever the frame, the control frame and the host do.
//
// claim: results change in the clock of an update only, all at once, the counter of wrong CRCs also when RUN
//   rises, CMD_START_FLAG when it falls; a frame that is not good leaves position, nE and nW
// clocks: one
// depth: 8
// cover: 8
// unbounded: reachability
// mutation: pru/pru_memory.sv | if (update_i) begin | if (update_i != absent_i) begin
// mutation: pru/pru_memory.sv | whole && !found_i.crc_bad | whole
// mutation: pru/pru_memory.sv | if (clear_i) memory_q.crc_errors <= '0;
//   | if (clear_i) {memory_q.crc_errors, memory_q.line} <= '0;
// mutation: pru/pru_memory.sv | memory_q.crc_errors <= '0; | {memory_q.crc_errors, memory_q.crc} <= '0;
// mutation: pru/pru_memory.sv | acked && !found_i.late | acked
// mutation: pru/pru_control.sv | if (ends) begin | if (count_q == LAST) begin

module proof (
  input logic        clk_i,
  input logic        rst_ni,
  input logic        clear_i,
  input logic        update_i,
  input logic        absent_i,
  input logic        averages_i,
  input logic        acked_i,
  input logic        late_i,
  input logic        crc_bad_i,
  input logic        cds_i,
  input logic [62:0] position_i,
  input logic        more_line_i,
  input logic [3:0]  place_i,
  input logic [3:0]  point_i,
  input logic [7:0]  raw_i,
  input logic [6:0]  line_i,
  input logic [10:0] processing_i,
  input logic [5:0]  crc_i,
  input logic [1:0]  flags_i,
  input logic [3:0]  write_i,
  input logic [31:0] data_i
);

  pru_pkg::found_t   found;
  pru_pkg::memory_t  memory;
  pru_pkg::control_t control;
  always @* begin
    found          = '0;
    found.acked    = acked_i;
    found.late     = late_i;
    found.crc_bad  = crc_bad_i;
    found.place    = place_i;
    found.point    = point_i;
    found.raw      = raw_i;
    found.line     = line_i;
    found.processing = processing_i;
    found.crc      = crc_i;
    found.cds      = cds_i;
    found.position = position_i;
    found.nerr     = flags_i[0];
    found.nwarn    = flags_i[1];
  end

  pru_memory u_memory (
    .clk_i, .rst_ni, .clear_i, .update_i, .absent_i, .averages_i, .found_i (found), .more_line_i,
    .ctrl_bad_i (control.crc_bad), .memory_o (memory), .ended_o (), .error_o ()
  );
  pru_control u_control (
    .clk_i, .rst_ni, .write_i, .data_i, .word_o (), .clear_i, .step_i (update_i), .clocked_i (!absent_i),
    .cds_i, .cdm_o (), .end_o (), .control_o (control)
  );

  logic              started = 1'b0;
  logic              update_q, clear_q, good_q;
  pru_pkg::memory_t  memory_q;
  pru_pkg::control_t control_q;
  pru_pkg::memory_t  kept;
  always @(posedge clk_i) begin
    started   <= 1'b1;
    update_q  <= update_i;
    clear_q   <= clear_i;
    good_q    <= !absent_i && acked_i && !late_i && !crc_bad_i;
    memory_q  <= memory;
    control_q <= control;
  end
  always @* begin
    if (!started) assume (!rst_ni);
    else assume (rst_ni);
    // Without an update only the counter may change, and only to 0.
    kept = memory;
    kept.crc_errors = memory_q.crc_errors;
  end

  logic second = 1'b0;
  always @(posedge clk_i) second <= started;
  always @* if (second) begin
    if (!update_q) begin
      Memory_A:  assert (kept == memory_q);
      Counter_A: assert (memory.crc_errors == memory_q.crc_errors || (clear_q && memory.crc_errors == 16'd0));
      Control_A: assert (control.result == control_q.result && control.crc == control_q.crc &&
                         control.crc_bad == control_q.crc_bad && (control.sending == control_q.sending || clear_q));
    end
    if (!good_q) Position_A: assert (memory.position == memory_q.position && memory.nerr == memory_q.nerr &&
                                     memory.nwarn == memory_q.nwarn);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Good_C:  cover (second && memory.position == 63'd5 && memory.frames == 16'd2);
    Error_C: cover (second && memory.crc_errors == 16'd1);
  end

endmodule
