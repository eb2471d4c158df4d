// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Position and speed: it adds up the accelerations, guesses the missing ones, and finds the
// absolute position by safe position 1. The rows of dsl_program are run on an adder of eight bits
// and a memory of 256 bytes.
//
// Clock domain: core. Work on a running frame begins with the second word of its acceleration and
// waits for answer_i.ends. tell_o follows it by 40 to 700 clocks: the record of the frame is
// complete. lost_o falls with it and rises at once, so a position that is read behind lost_o = 0 is
// certain; it is 1 without a link. A new link (answer_i.begins) clears all but frames and time, in
// 1,050 clocks at most; so does the reset, with them.
//
// Record: a byte at a time, record_data_o goes to record_address_o with record_write_o. The lowest
// byte of a number comes first; dsl_program has its order, eight addresses a value. An age is all
// ones if none has come. Each tell_o has a whole record before it, so a reader needs banks that
// change with it (dsl_record): with record_busy_i nothing is written, and the work waits.
// Status: byte 0 as STATUS, with the errors of the two safe channels in bits 6 and 7; byte 1
// quality and delay; byte 2 the state of the link; byte 3 the reason. It is that of the frame's
// end. A link that is over makes a record more, without young safe positions.
//
// time_i: the byte of the frame's time; time_next_o asks for the next one, eight times a frame, the
// lowest one first. The first one is taken 5 clocks or more behind the second word.
// stale_o: with the last vertical frame safe position 1 and the fast one should have been the same,
// and were not. mismatch_o: it had two good safe positions, which differ by more than tolerance_i
// in the safe2_bits_i that the second one has (more than the position has are as many as it has);
// it is right from tell_o of the frame behind it on.
// Misuse: a frame that ends before tell_o of the frame before is left out. A width of more than 40
// bits is a position without bits.
// Source: docs/dsl.md, "Position".

module dsl_position (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  input  dsl_pkg::quirks_t      quirks_i,
  input  dsl_pkg::answer_t      answer_i,
  input  dsl_pkg::told_t        told_i,
  input  dsl_pkg::line_status_t status_i,
  input  logic [7:0]            safe2_bits_i,      // of safe position 2; 0: it is not compared
  input  logic [7:0]            tolerance_i,       // of the comparison, in its steps
  input  logic [7:0]            time_i,
  output logic                  time_next_o,
  output logic                  lost_o,            // POS
  output logic                  stale_o,           // safe and fast position did not agree
  output logic                  mismatch_o,        // the two safe positions do not agree
  // record
  output logic                  record_write_o,
  output logic [5:0]            record_address_o,
  output logic [7:0]            record_data_o,
  output logic                  tell_o,
  input  logic                  record_busy_i
);

  localparam logic [2:0] VERTICAL   = 3'd0;
  localparam logic [2:0] HIGH_WORD  = 3'd3;
  localparam logic [2:0] LOW_WORD   = 3'd4;
  localparam logic [2:0] SECONDARY  = 3'd5;
  localparam logic [2:0] FIRST_PLACE = 3'd0;
  localparam int unsigned SIGNED    = 10;    // bit of the identity

  // Rows.
  logic                         ready_q;     // the first row has been read
  logic                         run;         // the memory is free for it
  logic [7:0]                   step_d, step_q;
  logic [31:0]                  row;
  dsl_program_pkg::sum_t        sum;
  dsl_program_pkg::jump_t       jump;
  dsl_program_pkg::conditions_t conditions;
  logic [15:0]                  condition_bits;
  logic                         is_sum, set, tell;
  logic                         taken, next;

  // A sum: operand, operand, result. The first operand of a byte is read with the result of the one
  // before.
  logic       second_q;       // the second operand is read, the first one is there
  logic       result_q;       // there is a result
  logic [2:0] index_q;        // of the operands
  logic [2:0] to_d, to_q;     // of the result
  logic [7:0] result_to;
  logic       lowest_q;       // the result is the first one of the row
  logic       last_q;         // ... the last one
  logic       fill, fill_q;
  logic [1:0] source, change;  // as the row has them, or of a sign
  logic [7:0] memory;
  logic [7:0] in;
  logic [7:0] first_d, first_q;
  logic [7:0] second;
  logic       carry_in, carry;
  logic [7:0] total;
  logic       unused;
  logic       write;
  logic       zero_q, carry_q, negative_q;

  // Answers.
  logic       stores;         // a word goes into the memory
  logic [4:0] word_to;
  logic [2:0] word_index;
  logic       frame_q, begun_q, vertical_q, ended_q;
  logic       check_q;        // the frame is the one behind a vertical frame
  logic       mismatch_q;
  logic       unlike_q;
  logic       ran_q;          // the record is one of a running frame
  logic       shown_q;        // a record shows a link
  logic [2:0] align_q;        // dsl_program_pkg::align_e
  logic       certain_q;      // lost_o was 0
  logic [1:0] stale_d, stale_q; // vertical frames without a good safe position 1
  logic       stale;
  logic [7:0] status0;

  assign run = ready_q && !stores && !record_busy_i;

  // ---- Rows -------------------------------------------------------------------------------------

  dsl_program u_program (
    .clk_i,
    .enable_i (!stores),
    .step_i   (step_d),
    .row_o    (row)
  );

  assign sum    = row;
  assign jump   = row;
  assign is_sum = sum.kind == dsl_program_pkg::SUM;
  assign set    = sum.kind == dsl_program_pkg::SET;
  assign tell   = sum.kind == dsl_program_pkg::TELL;

  assign conditions.check     = check_q && told_i.safe1_valid && told_i.safe2_valid
                             && safe2_bits_i != 8'd0;
  assign conditions.over      = shown_q && !answer_i.linked;
  assign conditions.is_signed = status_i.identity[SIGNED];
  assign conditions.in_state  = align_q == jump.state;
  assign conditions.recover   = quirks_i.recover && !told_i.acceleration_marked;
  assign conditions.stale     = stale;
  assign conditions.new2      = told_i.safe2_valid;
  assign conditions.new1      = told_i.safe1_valid;
  assign conditions.vertical  = vertical_q;
  assign conditions.good      = told_i.acceleration_good;
  assign conditions.begun     = begun_q;
  assign conditions.frame     = frame_q;
  assign conditions.any       = 1'b1;
  assign conditions.negative  = negative_q;
  assign conditions.carry     = carry_q;
  assign conditions.zero      = zero_q;
  assign condition_bits       = conditions;

  assign taken = (jump.kind == dsl_program_pkg::JUMP || set)
              && (condition_bits[jump.condition] ^ jump.inverted);
  assign next  = !is_sum || (result_q && last_q);

  always_comb begin
    step_d = step_q;
    if (run && next) step_d = taken ? jump.target : step_q + 8'd1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ready_q <= 1'b0;
      step_q  <= '0;
    end else begin
      ready_q <= ready_q || !stores;
      step_q  <= step_d;
    end
  end

  // ---- Sums -------------------------------------------------------------------------------------

  enc_ram #(.Width(8), .AddrW(8)) u_memory (
    .wr_clk_i  (clk_i),
    .wr_en_i   (stores || write),
    .wr_addr_i (stores ? {word_to, word_index} : result_to),
    .wr_data_i (stores ? answer_i.word.data : total),
    .rd_clk_i  (clk_i),
    .rd_en_i   (!stores),
    .rd_addr_i ({second_q ? sum.second : sum.first, index_q[2] | sum.upper, index_q[1:0]}),
    .rd_data_o (memory)
  );

  assign status0 = {told_i.safe2_error, told_i.safe1_error,
                    told_i.safe2_error || told_i.safe1_error,
                    told_i.safe2_valid && answer_i.linked, told_i.safe1_valid && answer_i.linked,
                    answer_i.running || ran_q, answer_i.linked,
                    align_q != dsl_program_pkg::ALIGNED};

  always_comb begin
    in = time_i;
    if (sum.second[2:0] == dsl_program_pkg::IN_WIDTH) in = {1'b0, {1'b0, status_i.width} + 7'd8};
    if (sum.second[2:0] == dsl_program_pkg::IN_BITS) in = safe2_bits_i;
    if (sum.second[2:0] == dsl_program_pkg::IN_TOLERANCE) in = tolerance_i;
    if (sum.second[2:0] == dsl_program_pkg::IN_STATUS) begin
      case (index_q[1:0])
        2'd0:    in = status0;
        2'd1:    in = {status_i.place[11:8], status_i.quality};
        2'd2:    in = {4'd0, ran_q ? dsl_pkg::RUN_STATE : status_i.state};
        default: in = {5'd0, status_i.reason};
      endcase
    end
  end

  // Behind its highest byte a value has its sign.
  assign fill   = sum.widen[1] && index_q >= {1'b0, sum.widen};
  assign source = fill ? {1'b1, negative_q} : sum.source;    // ZEROS, ONES
  assign change = sum.change | {2{fill_q}};

  always_comb begin
    case (source)
      dsl_program_pkg::MEMORY: first_d = memory;
      dsl_program_pkg::INPUT:  first_d = in;
      dsl_program_pkg::ZEROS:  first_d = 8'h00;
      default:                 first_d = 8'hFF;
    endcase
  end

  always_comb begin
    case (change)
      dsl_program_pkg::PLAIN:    second = memory;
      dsl_program_pkg::INVERTED: second = ~memory;
      dsl_program_pkg::ANDED:    second = memory | ~first_q;
      default:                   second = 8'h00;
    endcase
  end

  always_comb begin
    carry_in = carry_q;
    if (lowest_q && sum.carry != dsl_program_pkg::CARRIED) carry_in = sum.carry[0];
    if (fill_q) carry_in = 1'b0;
  end

  // One chain: the carry enters by a bit below the lowest one.
  assign {carry, total, unused} = {1'b0, first_q, 1'b1} + {1'b0, second, carry_in};
  assign result_to      = {sum.to, to_q[2] | sum.upper, to_q[1:0]};
  assign write          = run && result_q && (carry || !sum.fits);
  assign to_d           = index_q - {2'd0, sum.down};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      second_q   <= 1'b0;
      result_q   <= 1'b0;
      index_q    <= '0;
      to_q       <= '0;
      lowest_q   <= 1'b1;
      last_q     <= 1'b0;
      fill_q     <= 1'b0;
      first_q    <= '0;
      zero_q     <= 1'b0;
      carry_q    <= 1'b0;
      negative_q <= 1'b0;
    end else if (run && is_sum) begin
      second_q <= !second_q && !(result_q && last_q);
      result_q <= second_q;
      if (second_q) begin
        first_q <= first_d;
        fill_q  <= fill;
        to_q    <= to_d;
        last_q  <= index_q == sum.last;
        index_q <= index_q == sum.last ? 3'd0 : index_q + 3'd1;
      end
      if (result_q) begin
        lowest_q   <= last_q;
        zero_q     <= total == 8'h00 && (lowest_q || zero_q);
        negative_q <= total[7];
        if (!sum.hold) carry_q <= carry;
      end
    end
  end

  // ---- Answers ----------------------------------------------------------------------------------

  // Byte RXi of a vertical frame becomes byte 5 - i, modulo 8: the position with its lowest byte
  // first, the summary, the CRC.
  always_comb begin
    stores     = answer_i.valid;
    word_index = {~(answer_i.place[2] ^ answer_i.place[1]), answer_i.place[1], ~answer_i.place[0]};
    case (answer_i.number)
      VERTICAL:  word_to = dsl_program_pkg::BYTES1;
      SECONDARY: word_to = dsl_program_pkg::BYTES2;
      HIGH_WORD, LOW_WORD: begin
        word_to    = dsl_program_pkg::WORD;
        word_index = {2'd0, answer_i.number[0]};
      end
      default: begin
        word_to = dsl_program_pkg::WORD;
        stores  = 1'b0;
      end
    endcase
  end

  assign stale_d = stale_q == 2'd3 ? 2'd3 : stale_q + 2'd1;
  assign stale   = quirks_i.stale_limit != 2'd0 && stale_q >= quirks_i.stale_limit;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      frame_q    <= 1'b0;
      begun_q    <= 1'b0;
      ran_q      <= 1'b0;
      shown_q    <= 1'b0;
      ended_q    <= 1'b0;
      vertical_q <= 1'b0;
      check_q    <= 1'b0;
      mismatch_q <= 1'b0;
      unlike_q   <= 1'b0;
      stale_q    <= '0;
      align_q    <= dsl_program_pkg::FIRST;
      certain_q  <= 1'b0;
    end else begin
      if (answer_i.ends) frame_q <= 1'b0;
      else if (answer_i.valid && answer_i.number == LOW_WORD) frame_q <= answer_i.running;
      if (answer_i.begins)     begun_q <= 1'b1;
      else if (answer_i.valid) begun_q <= 1'b0;
      ran_q   <= frame_q || (ran_q && !tell_o);
      shown_q <= answer_i.linked || frame_q || (shown_q && !(tell_o && jump.unused[0]));
      // told_i is right a clock later.
      ended_q <= answer_i.ends && answer_i.running && answer_i.place == dsl_pkg::LAST_PLACE;
      if (answer_i.ends) begin
        vertical_q <= answer_i.running && answer_i.place == dsl_pkg::LAST_PLACE;
        check_q    <= answer_i.running && answer_i.place == FIRST_PLACE;
      end
      if (ended_q || answer_i.begins)               unlike_q <= 1'b0;
      else if (run && set && jump.unused[0])        unlike_q <= 1'b1;
      if (answer_i.begins || (answer_i.ends && answer_i.place == FIRST_PLACE)) begin
        mismatch_q <= 1'b0;
      end else if (run && set && jump.state == dsl_program_pkg::MISMATCH) begin
        mismatch_q <= 1'b1;
      end
      if (answer_i.begins) stale_q <= '0;
      else if (ended_q)    stale_q <= told_i.safe1_valid ? 2'd0 : stale_d;
      certain_q <= !lost_o;
      if (!answer_i.linked) align_q <= dsl_program_pkg::FIRST;
      else if (run && set && jump.state != dsl_program_pkg::MISMATCH) align_q <= jump.state;
    end
  end

  assign time_next_o      = run && is_sum && second_q && sum.source == dsl_program_pkg::INPUT
                         && sum.second[2:0] == dsl_program_pkg::IN_TIME;
  assign lost_o           = align_q != dsl_program_pkg::ALIGNED || !(certain_q || tell_o);
  assign stale_o          = unlike_q;
  assign mismatch_o       = mismatch_q;
  assign record_write_o   = write && result_to[7:6] == 2'd0;
  assign record_address_o = result_to[5:0];
  assign record_data_o    = total;
  assign tell_o           = run && tell;

endmodule
