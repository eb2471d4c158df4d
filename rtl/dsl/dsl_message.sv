// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages on the parameter channel, a nibble a frame: short ones of two hosts and long ones. It
// keeps the bytes of requests and answers, and other bytes of the host, in one memory.
//
// Clock domain: core. symbol_o is that of the frame from the clock behind begin_i on. An S_PAR is
// worked on within 40 clocks, an answer within 120; clocks with an access of the host do not count.
// What events_o says is complete then, with all bytes of the answer in the memory.
//
// Host: a byte a clock. host_data_o is that of host_address_i one clock behind host_read_i.
// busy_o: bytes that belong together are being changed, accesses to the memory wait. clears_o: it
// gets its first values behind a reset.
// orders_i: a start while the same kind of message runs is ignored.
//
// A request is taken with the begin of a frame that is IDLE and follows with the next one. A short
// one that is not answered within 64 frames, or gets its NAK, is sent again, without end; a long
// one ends with an answer, its NAK or the link. MRST sends INIT up to its acknowledge, and ends
// all. The first vertical frame of a link has no messages.
// An answer is one of an open request, with its address, direction and length, and a right CRC.
// check_i = 0: each answer with a right CRC is one of the open request of its kind.
// Misuse: an S_PAR within 200 clocks of the one before spoils a message.
// Source: docs/dsl.md, "Messages".

module dsl_message (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  logic               sdk_map_i,
  input  logic               check_i,
  // line
  input  logic               begin_i,        // a frame does
  input  dsl_pkg::answer_t   answer_i,
  input  dsl_pkg::counts_t   counts_i,
  output logic [4:0]         symbol_o,       // of M_PAR in a running frame
  // host
  input  logic               host_read_i,
  input  logic               host_write_i,
  input  logic [5:0]         host_address_i,
  input  logic [7:0]         host_byte_i,
  output logic [7:0]         host_data_o,
  output logic               busy_o,
  output logic               clears_o,
  input  dsl_pkg::orders_t   orders_i,
  output dsl_pkg::messages_t messages_o,
  output dsl_pkg::message_events_t events_o
);

  localparam logic [2:0] PARAMETER  = 3'd1;
  localparam logic [6:0] WAIT_LAST  = 7'd63;    // frames
  localparam logic [6:0] PAUSE_LAST = 7'd62;    // ... behind the end of a short message

  logic [3:0] state;          // dsl_message_pkg::work_e
  logic [1:0] bits;           // of a nibble
  logic [5:0] index;          // byte that is cleared, of an answer that is copied, of a counter
  logic       stall;          // the host has the memory
  logic       parameter_q;    // an S_PAR is there
  logic       job_q;          // a nibble has to be prepared
  logic       takes;          // the S_PAR is worked on

  // Hosts.
  logic       main_q, safe_q, long_q;     // messages that run
  logic       resets_q;                   // MRST
  logic       failed_q, renewed_q;
  // The short message that is sent or waits.
  logic       short_q;        // there is one
  logic       host_q;         // it is that of the safe host
  logic       begun_q;        // its first nibble has been sent
  logic       open_q;         // all of it has
  logic       again_q;        // ... twice or more, because no answer came
  logic       nak_q;          // it is to be sent again
  logic       done_q;         // it is answered
  logic       long_open_q;    // all of a long one has been sent
  logic [6:0] wait_q;         // frames since the last nibble
  logic       ready_q;        // the first vertical frame is over
  logic       ran_q;
  // The line.
  logic       takes_one;      // a request is taken
  logic       select_q;       // ... follows
  logic       send_q;         // ... is being sent
  logic       send_long;
  logic [3:0] send_byte;
  logic       crc;            // a nibble of its CRC comes next
  logic [3:0] send_nibble;
  logic [7:0] data;           // of the memory
  logic [4:0] symbol_q;
  // Answers.
  logic [1:0] comes;          // dsl_message_pkg::comes_e
  logic       is_long;
  logic [4:0] count;          // nibbles that have come
  logic       whole;          // an answer is
  logic       bad;            // its CRC is wrong
  logic       mine;           // it is the one that was asked for
  logic       short_read;
  logic       error;          // LOFF
  logic [1:0] answer_length;
  logic       copy_long;      // the answer that is copied is long
  logic [3:0] high_q;
  logic [3:0] answer;         // a nibble of one

  // ---- Frames -----------------------------------------------------------------------------------

  logic       running;
  logic       runs;           // a frame that may have messages follows
  logic       rises, over;    // the link
  logic       shorts;
  logic       due;
  logic       free;
  logic       take_short, take_again, take_long;
  logic       sends;          // a nibble goes out with the frame that begins
  logic       last;           // ... the last one of a request
  logic       long_begun;
  assign running    = answer_i.running && answer_i.linked;
  assign rises      = running && !ran_q;
  assign over       = !running && ran_q;
  assign runs       = running && (ready_q || answer_i.place == dsl_pkg::LAST_PLACE);
  assign shorts     = main_q || safe_q;
  assign due        = nak_q || wait_q[6] || wait_q == WAIT_LAST;
  assign free       = begin_i && runs && !send_q && !select_q && !resets_q;
  assign take_again = free && short_q && due && !done_q
                   && !(comes == dsl_message_pkg::SHORT && open_q);
  assign take_short = free && !short_q && shorts;
  assign take_long  = free && !short_q && !shorts && long_q && !long_open_q;
  assign sends      = begin_i && (send_q || select_q);
  assign long_begun = long_open_q || (send_q && send_long);

  // ---- S_PAR ------------------------------------------------------------------------------------

  logic [4:0] symbol;
  logic       wrong;
  logic       nibble;
  logic       idle;
  logic       paused;
  logic       waits;          // a short one for its answer
  logic       goes_long;      // a first nibble is one of a long message
  logic       fresh;
  logic       stops;          // an answer comes while its request is sent again
  logic       stays;          // a paused message does
  logic       late;           // ... for too long
  logic       breaks_now;     // a long one
  logic       inits;          // the frame carries INIT, and its S_PAR no message
  logic       renews;
  assign symbol     = answer_i.word.data[4:0];
  assign wrong      = answer_i.word.error || answer_i.word.special;
  assign nibble     = !wrong && !symbol[4];
  assign idle       = !wrong && symbol == dsl_message_pkg::IDLE;
  assign takes      = state == dsl_message_pkg::READY && parameter_q;
  assign waits      = short_q && open_q && !done_q;
  assign goes_long  = paused ? !waits || symbol[3] : symbol[3];
  assign inits      = symbol_q == dsl_pkg::INIT;
  assign fresh      = takes && nibble && comes == dsl_message_pkg::NONE && !inits;
  assign stops      = fresh && !goes_long && waits;
  assign stays      = paused && !shorts && !is_long && !(fresh && goes_long) && !inits;
  assign late       = stays && wait_q == PAUSE_LAST;
  assign breaks_now = takes && !inits
                   && ((comes == dsl_message_pkg::LONG && !nibble && !(idle && shorts)) || late
                       || (!wrong && symbol == dsl_message_pkg::LONG_NAK && long_open_q));
  assign renews     = takes && inits && !wrong && symbol == dsl_message_pkg::INIT;

  // ---- The ends of messages ---------------------------------------------------------------------

  logic       copies;         // bytes of it
  logic       copied;         // the last one
  logic       breaks;         // a long message
  logic       answers;        // a short one
  logic       ends_short, ends_long;
  logic       fails;          // a long one, with ANS
  assign copies     = whole && !bad && mine && (is_long || short_read);
  assign breaks     = long_open_q && (breaks_now || (whole && is_long && bad));
  assign answers    = (whole && !bad && mine && !is_long && !short_read)
                   || (copied && !copy_long);
  assign ends_short = (answers && !(again_q && !wait_q[6]))
                   || (done_q && (over || (takes && wait_q[6])));
  assign ends_long  = copied && copy_long && long_open_q;
  assign fails      = breaks || (over && long_begun);

  assign messages_o.long_runs = long_q;
  assign messages_o.main_runs = main_q;
  assign messages_o.safe_runs = safe_q;
  assign messages_o.resets    = resets_q;
  assign messages_o.failed    = failed_q;
  assign messages_o.renewed   = renewed_q;
  assign events_o.min       = renews;
  assign events_o.ans       = fails;
  assign events_o.frel      = fails || ends_long || renews || (rises && !long_q);
  assign events_o.fres      = (ends_short && !host_q) || renews || (rises && !main_q);
  assign events_o.safe_fres = (ends_short && host_q) || renews || (rises && !safe_q);

  // ---- Work -------------------------------------------------------------------------------------

  dsl_work u_work (
    .clk_i, .rst_ni,
    .stall_i     (stall),
    .parameter_i (parameter_q),
    .stores_i    (nibble && comes != dsl_message_pkg::REST && !inits),
    .job_i       (job_q),
    .crc_i       (crc),
    .copies_i    (copies),
    .is_long_i   (is_long),
    .length_i    (answer_length),
    .data_i      (data),
    .foreign_i   (whole && !bad && !mine),
    .retry_i     (sends && select_q && !send_long && begun_q),
    .counts_i,
    .state_o     (state),
    .clears_o, .busy_o,
    .bit_o       (bits),
    .index_o     (index),
    .copied_o    (copied),
    .copy_long_o (copy_long)
  );

  // ---- Requests ---------------------------------------------------------------------------------

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {select_q, send_q, job_q} <= '0;
      symbol_q <= dsl_pkg::IDLE;
    end else begin
      if (state == dsl_message_pkg::READY && !parameter_q) job_q <= 1'b0;
      if (begin_i) begin
        symbol_q <= dsl_pkg::IDLE;
        if (running && (send_q || select_q)) symbol_q <= {1'b0, send_nibble};
        if (running && resets_q)             symbol_q <= dsl_pkg::INIT;
      end
      if (sends) begin
        select_q <= 1'b0;
        send_q   <= !last;
        job_q    <= !last;
      end
      if (takes_one) {select_q, job_q} <= '1;
      if (resets_q || !running || (stops && !send_long)) {select_q, send_q} <= '0;
    end
  end

  dsl_request u_request (
    .clk_i,
    .clear_i  (begin_i && !send_q && !select_q),
    .take_i   (takes_one),
    .long_i   (take_long),
    .sends_i  (sends),
    .load_i   (state == dsl_message_pkg::LOAD),
    .shift_i  (state == dsl_message_pkg::SHIFT),
    .data_i   (data),
    .long_o   (send_long),
    .byte_o   (send_byte),
    .crc_o    (crc),
    .last_o   (last),
    .nibble_o (send_nibble)
  );

  // ---- What runs --------------------------------------------------------------------------------

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {main_q, safe_q, long_q, resets_q, failed_q, renewed_q} <= '0;
      {short_q, host_q, begun_q, open_q, again_q, nak_q, done_q, long_open_q} <= '0;
      wait_q      <= '0;
      {ready_q, ran_q, parameter_q} <= '0;
    end else begin
      ran_q       <= running;
      ready_q     <= running && (ready_q || (begin_i && answer_i.place == dsl_pkg::LAST_PLACE));
      parameter_q <= (parameter_q && !takes)
                  || (answer_i.valid && answer_i.number == PARAMETER && running);
      // Requests.
      if (take_short) begin
        short_q <= 1'b1;
        host_q  <= !main_q;
        {begun_q, open_q, again_q, nak_q, done_q} <= '0;
      end
      if (begin_i && short_q && open_q && !done_q && wait_q == WAIT_LAST && !nak_q) again_q <= 1'b1;
      if (sends && !send_long) begun_q <= 1'b1;
      if (sends && last) begin
        if (send_long) begin
          long_open_q <= 1'b1;
        end else begin
          open_q <= 1'b1;
          nak_q  <= 1'b0;
        end
      end
      if (takes && !inits && !wrong && symbol == dsl_message_pkg::SHORT_NAK && waits) nak_q <= 1'b1;
      // Time.
      if (ends_short || (sends && last && !send_long))        wait_q <= '0;
      else if (begin_i && short_q && open_q && !wait_q[6])      wait_q <= wait_q + 7'd1;
      else if (takes && stays)                                  wait_q <= wait_q + 7'd1;
      // Ends.
      if (answers) done_q <= 1'b1;
      if (over) begin
        {open_q, again_q} <= '0;
        nak_q             <= 1'b1;
        if (long_begun) {long_q, long_open_q} <= '0;
      end
      if (ends_short) begin
        {short_q, done_q} <= '0;
        if (host_q) safe_q <= 1'b0;
        else        main_q <= 1'b0;
      end
      if (ends_long || breaks) {long_q, long_open_q} <= '0;
      if (fails) failed_q <= 1'b1;
      // Hosts.
      if (orders_i.resets) resets_q <= 1'b1;
      if (orders_i.starts_long) {long_q, failed_q} <= 2'b10;
      if (orders_i.starts_main) main_q <= 1'b1;
      if (orders_i.starts_safe) safe_q <= 1'b1;
      if (orders_i.starts_long || orders_i.starts_main || orders_i.starts_safe) renewed_q <= 1'b0;
      if (renews) begin
        {main_q, safe_q, long_q, resets_q, short_q, done_q, long_open_q} <= '0;
        renewed_q <= 1'b1;
      end
    end
  end

  // ---- Answers and memory -----------------------------------------------------------------------

  dsl_answer u_answer (
    .clk_i, .rst_ni,
    .check_i,
    .clear_i     (!running || renews),
    .takes_i     (takes),
    .symbol_i    (symbol),
    .nibble_i    (nibble),
    .fresh_i     (fresh),
    .goes_i      (goes_long),
    .breaks_i    (breaks_now),
    .waits_i     (waits),
    .long_open_i (long_open_q),
    .compare_i   (state == dsl_message_pkg::COMPARE),
    .divide_i    (state == dsl_message_pkg::DIVIDE),
    .bit_i       (bits),
    .data_i      (data),
    .comes_o     (comes),
    .paused_o    (paused),
    .count_o     (count),
    .whole_o     (whole),
    .bad_o       (bad),
    .mine_o      (mine),
    .read_o      (short_read),
    .error_o     (error),
    .length_o    (answer_length)
  );

  dsl_stored u_stored (
    .clk_i, .sdk_map_i,
    .host_read_i, .host_write_i, .host_address_i, .host_byte_i,
    .state_i     (state),
    .index_i     (index),
    .safe_host_i (host_q),
    .send_long_i (send_long),
    .send_byte_i (send_byte),
    .is_long_i   (is_long),
    .count_i     (count),
    .nibble_i    (symbol[3:0]),
    .copy_long_i (copy_long),
    .error_i     (error),
    .high_i      (high_q),
    .data_o      (data),
    .answer_o    (answer)
  );

  // Written before they are read.
  always_ff @(posedge clk_i) begin
    if (state == dsl_message_pkg::LOW)    high_q      <= answer;
  end

  assign stall       = host_read_i || host_write_i;
  assign takes_one   = take_short || take_again || take_long;
  assign is_long     = comes == dsl_message_pkg::LONG;
  assign host_data_o = data;
  assign symbol_o    = symbol_q;

endmodule
