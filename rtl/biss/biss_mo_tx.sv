// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Drives MO of one line: the master acts as one more slave in front of the chain. It acknowledges
// with the slaves, sends the start bit after mo_busy more periods, and then a slot for each word:
// the word of an actuator (stop bit if configured, data, inverted CRC), or zeros for a sensor.
//
// Clock domain: core. In a frame MO changes with the rising MA edges, otherwise with cmd_i.mo_en.
// INIT is a frame that ends before the start bit (line_idle_i, go_i.mo_return; decision 39).
// begin_i starts a frame. From then on this module steps the word list: offer_i follows next_o by
// one clock. read_o is the byte that is needed next; its data follow one clock later.
//
// With FreeCrc = 0 a word with another CRC than 0x43 and 16 bits is sent with a wrong one.
//
// Misuse: a frame may end before the last slot (MO is not connected to the slaves, or mo_busy is
// larger than theirs). Then it ends here too, when MA stops: MO must not keep a line low that
// repeats it. BiSS B at f_CLK / 2 with mo_busy = 0 has time for six words: with seven or eight the
// first slot comes before the list is ready, and its contents are undefined.
// Datasheet: pages 15, 25, 31, Figure 12, Tables 17, 18, 39, 40; protocol of the chain.

module biss_mo_tx #(
  parameter int unsigned DataBits = 64,   // the longest word
  parameter bit          FreeCrc  = 1'b1  // any CRC; 0: only 0x43 and 16 bits
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  // control
  input  biss_pkg::line_cmd_t cmd_i,
  input  biss_pkg::line_go_t  go_i,
  input  logic       begin_i,       // a BiSS frame or INIT begins
  input  logic       biss_c_i,
  input  logic       rise_i,        // a rising MA edge of the frame
  input  logic       final_rise_i,  // ... the last one
  input  logic       ma_clocks_i,   // MA is clocking; 1 in INIT
  input  logic       line_idle_i,
  // words
  input  biss_pkg::offer_t offer_i,
  output logic       next_o,
  output biss_pkg::mo_read_t read_o,
  input  logic [7:0] data_i,
  output logic       mo_o
);

  typedef enum logic [2:0] {
    IDLE,
    REQUEST,       // up to the acknowledge
    WAIT,          // up to the start bit
    CDS,
    DATA,
    STOP
  } state_e;

  biss_pkg::word_t word;
  state_e     state_d;
  state_e     state_q;
  logic       mo_d;
  logic       mo_q;
  logic       second_d;
  logic       second_q;   // the first rising edge has come
  logic [7:0] busy_d;
  logic [7:0] busy_q;     // processing clocks left
  logic       load_d;
  logic       load_q;     // a new word: offer_i is valid
  logic       stop_d;
  logic       stop_q;     // the stop bit comes first
  logic       in_crc_d;
  logic       in_crc_q;
  logic [5:0] left_d;
  logic [5:0] left_q;     // bits of the current part that follow this one
  logic [2:0] byte_now;   // byte needed next
  logic       data_bit;
  logic       crc_top;
  logic       shift;
  logic       reduced_q;  // the frame ends after CDS
  logic       none;       // no words in this frame
  logic       answers;    // MO has sent the acknowledge: MA clocks up to the end of the frame
  logic       ends;       // the frame ends, even before its last slot

  // Bits of left_q that are in use: 16 CRC bits need four.
  localparam logic [5:0] LEFT = 6'((32'd1 << (DataBits > 16 ? $clog2(DataBits) : 4)) - 32'd1);

  assign word     = offer_i.word;
  assign answers  = state_q != IDLE && state_q != REQUEST;
  assign ends     = line_idle_i || go_i.mo_return || go_i.stop || (answers && !ma_clocks_i);
  // go_i.reduced comes late. It does not change between the start of a frame and its CDS.
  assign none     = !offer_i.any || reduced_q;
  assign byte_now = load_q ? word.data_last[5:3] : left_q[5:3];
  assign data_bit = data_i[left_q[2:0]] && word.actuator;
  assign shift    = rise_i && state_q == DATA && !stop_q;

  enc_crc #(.Free(FreeCrc)) u_crc (
    .clk_i,
    .rst_ni,
    .crc16_i (word.crc_last[3]),
    .poly_i  (word.crc_poly),
    .last_i  (word.crc_last[2:0]),
    .start_i (word.crc_start),
    .load_i  (load_q),
    .shift_i (shift),
    .feed_i  (!in_crc_q),
    .bit_i   (data_bit),
    .top_o   (crc_top)
  );

  always_comb begin
    state_d  = state_q;
    mo_d     = mo_q;
    second_d = second_q;
    busy_d   = busy_q;
    load_d   = 1'b0;
    stop_d   = stop_q;
    in_crc_d = in_crc_q;
    left_d   = left_q;
    next_o   = 1'b0;

    if (load_q) begin
      stop_d   = word.stop;
      in_crc_d = 1'b0;
      left_d   = word.data_last & LEFT;
    end

    unique case (state_q)
      IDLE: begin
        // No frame. MO is mo_en, but 0 in a BiSS B register access.
        mo_d     = 1'b1;
        second_d = 1'b0;
        if (begin_i && cmd_i.mo_en) state_d = REQUEST;
      end
      REQUEST: begin
        // MO is 1 up to the second rising edge; with it MO falls, as the acknowledge of the slaves.
        busy_d = cmd_i.mo_busy;
        if (rise_i) begin
          second_d = 1'b1;
          if (second_q) begin
            mo_d    = 1'b0;
            state_d = WAIT;
          end
        end
      end
      WAIT: begin
        // MO is 0 for mo_busy periods, then it sends the start bit.
        if (rise_i) begin
          busy_d = busy_q - 8'd1;
          mo_d   = busy_q == 8'd0;
          if (mo_d) begin
            load_d  = !biss_c_i && !none;
            state_d = biss_c_i ? CDS : none ? STOP : DATA;
          end
        end
      end
      CDS: begin
        // The start bit is on MO; the CDS slot, a 0, follows.
        if (rise_i) begin
          mo_d    = 1'b0;
          load_d  = !none;
          state_d = none ? STOP : DATA;
        end
      end
      DATA: begin
        // MO sends the slots of the words.
        if (rise_i) begin
          stop_d = 1'b0;
          mo_d   = !stop_q && word.actuator && (in_crc_q ? !crc_top : data_bit);
          if (!stop_q) begin
            left_d = (left_q - 6'd1) & LEFT;
            if (left_q == 6'd0) begin
              in_crc_d = 1'b1;
              left_d   = 6'(word.crc_last);
              if (in_crc_q || !word.crc_on) begin
                next_o = 1'b1;
                load_d = !offer_i.last;
                if (offer_i.last) state_d = STOP;
              end
            end
          end
        end
      end
      STOP: begin
        // The last bit is on MO. On a line that is longer than the frame MA goes on, and a 1 would
        // pass through the slaves: MO sends zeros.
        if (rise_i) mo_d = 1'b0;
        if (final_rise_i) state_d = IDLE;
      end
      default: state_d = IDLE;
    endcase

    if (state_q != IDLE && ends) state_d = IDLE;
    if (state_d == IDLE) mo_d = cmd_i.mo_en && !cmd_i.mo_low;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= IDLE;
      mo_q     <= 1'b0;
      second_q <= 1'b0;
      busy_q   <= '0;
      load_q   <= 1'b0;
      reduced_q <= 1'b0;
      stop_q   <= 1'b0;
      in_crc_q <= 1'b0;
      left_q   <= '0;
    end else begin
      state_q  <= state_d;
      mo_q     <= mo_d;
      second_q <= second_d;
      busy_q   <= busy_d;
      load_q   <= load_d;
      reduced_q <= go_i.reduced;
      stop_q   <= stop_d;
      in_crc_q <= in_crc_d;
      left_q   <= left_d;
    end
  end

  assign read_o.rd_en = state_q != IDLE;
  assign read_o.slave = offer_i.slave;
  assign read_o.place = byte_now;
  assign mo_o   = mo_q;

endmodule
