// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The results of frames: the bytes that a frame leaves in the memory, and what stands beside them.
//
// Clock domain: core. update_i is high for one clock: memory_o changes with its end, all at once;
// what belongs to the control frame comes from there with the same edge. In the clock behind it
// ended_o is high, and error_o if one of PROC_TIME_ERR, POS_CRC_ERR, CMD_CRC_ERR, NO_SLAVE_FLAG has
// risen.
//
// - A frame without MA leaves line delay, processing time, CRC and position; RAW_DATA is 0.
// - One without acknowledge leaves CRC and position; RAW_DATA is 0xFF.
// - One with too much processing time leaves CRC and position.
// - One with a wrong CRC leaves position, nE and nW, and is counted.
//
// Misuse: none; clear_i only clears the counter of wrong CRCs.
// Source: TIDEP0022, Table 1; docs/pru.md.

module pru_memory (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,       // RUN rises
  input  logic        update_i,
  input  logic        absent_i,      // no MA
  input  logic        averages_i,    // the average is on
  input  pru_pkg::found_t found_i,
  input  logic        more_line_i,   // two periods more in LINE_DELAY
  input  logic        ctrl_bad_i,    // CMD_CRC_ERR
  output pru_pkg::memory_t memory_o,
  output logic        ended_o,
  output logic        error_o
);

  pru_pkg::memory_t memory_q;
  logic        whole;       // the frame has a word
  logic        good;
  logic        acked;
  logic        update_q;
  logic [3:0]  errors;
  logic [3:0]  errors_q;    // as of the update before

  assign acked = !absent_i && found_i.acked;
  assign whole = acked && !found_i.late;
  assign good  = whole && !found_i.crc_bad;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      memory_q       <= '0;
      memory_q.nerr  <= 1'b1;
      memory_q.nwarn <= 1'b1;
    end else begin
      if (clear_i) memory_q.crc_errors <= '0;
      if (update_i) begin
        memory_q.frames      <= memory_q.frames + 16'd1;
        memory_q.no_slave    <= !acked;
        memory_q.pos_crc_bad <= whole && found_i.crc_bad;
        memory_q.late        <= acked && found_i.late;
        memory_q.averaged    <= averages_i;
        memory_q.raw         <= (found_i.raw | {8{!acked}}) & {8{!absent_i}};
        if (whole && found_i.crc_bad) memory_q.crc_errors <= memory_q.crc_errors + 16'd1;
        if (!absent_i) begin
          memory_q.line       <= found_i.line + {5'd0, more_line_i, 1'b0};
          memory_q.processing <= found_i.processing;
        end
        if (acked) begin
          memory_q.after    <= found_i.point[3];
          memory_q.used     <= ~found_i.point[2:0];
          memory_q.measured <= ~found_i.place[2:0];
        end
        if (whole) memory_q.crc <= found_i.crc;
        if (good) begin
          memory_q.position <= found_i.position;
          memory_q.nerr     <= found_i.nerr;
          memory_q.nwarn    <= found_i.nwarn;
        end
      end
    end
  end

  assign memory_o = memory_q;

  // ---- Errors that rise ---------------------------------------------------------------------

  assign errors = {memory_q.no_slave, ctrl_bad_i, memory_q.pos_crc_bad, memory_q.late};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      update_q <= 1'b0;
      errors_q <= '0;
    end else begin
      update_q <= update_i;
      errors_q <= errors;
    end
  end

  assign ended_o = update_q;
  assign error_o = update_q && (errors & ~errors_q) != 4'd0;

endmodule
