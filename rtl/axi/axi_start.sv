// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What starts a read on all channels: the internal sample clock, the external one, or a
// single-point request; and what a frame then is.
//
// Clock domain: core; ext_sample_clk_i and sample_en_i are asynchronous. An external edge starts a
// read three to four clocks later. start_o is high for one clock; frame_o belongs to it and stays
// until the next start.
//
// The internal sample clock always runs: its half period is cfg_i.sample_divider clocks, 0 acts as
// 1. A smaller value counts at once. sample_clk_o shows the selected clock. sample_en_i = 0 holds
// its edges back, not those of requests.
// done_o is high for one clock when the last enabled channel has ended its frame.
// An edge while busy_i or a read is running is skipped: skip_o is high for one clock. An edge
// without an enabled channel or in soft reset does nothing.
//
// Misuse: a sample clock faster than half of clk_i loses edges.
// Source: hello-fpga BiSS-C master manual 2.3.4 and 2.4; docs/axi.md.

module axi_start #(
  parameter bit Wide = 1'b0      // up to 64 bits of position
) (
  input  logic            clk_i,
  input  logic            rst_ni,
  input  axi_pkg::cfg_t   cfg_i,
  input  logic            check_i,      // a wrong CRC makes a word bad
  input  logic [4:0]      crc_bits_i,   // of the CRC
  input  logic            any_i,        // a channel is enabled
  input  logic            busy_i,       // an enabled channel is in a frame or its timeout, or the
                                        // words of the last read are still needed
  input  logic            in_frame_i,   // an enabled channel is in a frame
  output logic            take_o,       // the clock before start_o: what the registers say counts
  output logic            start_o,
  output logic            done_o,
  output logic            skip_o,
  output logic            sense_o,      // the external sample clock has risen
  output axi_pkg::frame_t frame_o,
  // pins
  input  logic            ext_sample_clk_i,
  input  logic            sample_en_i,
  output logic            sample_clk_o
);

  // A word has 2 flags, and 4 edges of MA in a frame belong to no bit of the word.
  localparam logic [6:0] FLAGS      = 7'd2;
  localparam logic [6:0] MORE_EDGES = 7'd6;
  localparam logic [7:0] MOST_BITS  = Wide ? 8'd64 : 8'd32;

  logic        ext_clk;
  logic        sample_en;
  logic [27:0] left_q;      // clocks of a half period so far, inverted
  logic        more;        // the half period is longer
  logic [27:0] unused_sum;
  logic        internal_q;
  logic        sample_clk;
  logic        sample_clk_q;
  logic        request_q;
  logic        edge_q;      // a read is asked for
  logic        edge_single_q;
  logic        free;
  logic        start_q;
  logic        run_q;       // a read runs
  logic        skip_q;
  logic        take;
  logic [6:0]  bits;
  axi_pkg::frame_t frame_q;

  enc_sync_bit u_ext_clk (
    .clk_i,
    .rst_ni,
    .data_i (ext_sample_clk_i),
    .data_o (ext_clk)
  );

  enc_sync_bit u_sample_en (
    .clk_i,
    .rst_ni,
    .data_i (sample_en_i),
    .data_o (sample_en)
  );

  // The carry of this sum compares: sample_divider > clocks so far.
  assign {more, unused_sum} = {1'b0, cfg_i.sample_divider} + {1'b0, left_q};

  assign sample_clk = cfg_i.external_clock ? ext_clk : internal_q;
  assign free       = !busy_i && !run_q;

  assign take       = edge_q && free;

  // 0 acts as 32. A value above MOST_BITS acts as MOST_BITS.
  assign bits = cfg_i.position_bits == 8'd0      ? 7'd32 :
                cfg_i.position_bits > MOST_BITS  ? MOST_BITS[6:0] : cfg_i.position_bits[6:0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q        <= 28'hFFF_FFFE;
      internal_q    <= 1'b0;
      sample_clk_q  <= 1'b0;
      request_q     <= 1'b0;
      edge_q        <= 1'b0;
      edge_single_q <= 1'b0;
      start_q       <= 1'b0;
      run_q         <= 1'b0;
      skip_q        <= 1'b0;
      frame_q       <= '0;
    end else begin
      // The count begins with 1.
      left_q        <= more ? left_q - 28'd1 : 28'hFFF_FFFE;
      internal_q    <= internal_q ^ !more;
      sample_clk_q  <= sample_clk;
      request_q     <= cfg_i.request;
      edge_single_q <= cfg_i.single_point;
      edge_q        <= any_i && !cfg_i.soft_reset &&
                       (cfg_i.single_point ? cfg_i.request && !request_q
                                           : sample_clk && !sample_clk_q && sample_en);
      start_q       <= take;
      skip_q        <= edge_q && !free;
      run_q         <= take || (run_q && !done_o);
      if (take) begin
        frame_q.half_last <= {cfg_i.ma_divider[7:1],
                              cfg_i.ma_divider[0] || cfg_i.ma_divider == 8'd0} - 8'd1;
        frame_q.data_last <= bits + FLAGS - 7'd1;
        frame_q.edges     <= bits + MORE_EDGES + 7'(crc_bits_i);
        frame_q.check     <= check_i;
        frame_q.single    <= edge_single_q;
      end
    end
  end

  assign take_o       = take;
  assign start_o      = start_q;
  assign sense_o      = cfg_i.external_clock && sample_clk && !sample_clk_q;
  assign done_o       = run_q && !start_q && !in_frame_i;
  assign skip_o       = skip_q;
  assign frame_o      = frame_q;
  assign sample_clk_o = sample_clk_q;

endmodule
