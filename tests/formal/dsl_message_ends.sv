// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How messages end (dsl_message), with any bytes in its memory, any S_PAR at any time, any frames and any
// accesses of the host. The host starts no message while one of its kind runs, nor while MRST waits. A frame has one
// S_PAR, and the work on it ends before the next frame, or the next link, begins.
//
// claim: no message ends without its event: a long one with FREL, and with ANS if its NAK, the link or a broken answer ends
//   it, a short one with FRES of its host; one that runs goes on up to then; the end of the link and MRST leave no long
//   message that has begun, the acknowledge of MRST none at all; MRST waits for its acknowledge with INIT in each frame; a
//   short message that is whole counts each frame up to 64, and is due then until it is sent again or ends
// clocks: one
// depth: 20
// cover: 60
// unbounded: induction 2
// keep: common/enc_ram.sv | rd_data_q <= mem[rd_addr_i]; | rd_data_q <= $anyseq;
// look: main = u_dut.main_q
// look: safe = u_dut.safe_q
// look: long = u_dut.long_q
// look: resets = u_dut.resets_q
// look: short = u_dut.short_q
// look: of_safe = u_dut.host_q
// look: open = u_dut.open_q
// look: done = u_dut.done_q
// look: nak = u_dut.nak_q
// look: due = u_dut.due
// look: select = u_dut.select_q
// look: send = u_dut.send_q
// look: send_long = u_dut.send_long
// look: long_open = u_dut.long_open_q
// look: frames = u_dut.wait_q
// look: ran = u_dut.ran_q
// look: pending = u_dut.parameter_q
// look: state = u_dut.state
// look: comes = u_dut.comes
// look: differs = u_dut.u_answer.short_differs_q
// look: copy_long = u_dut.copy_long
// look: whole = u_dut.whole
// mutation: dsl/dsl_message.sv | assign events_o.frel      = fails || ends_long | assign events_o.frel      = ends_long
// mutation: dsl/dsl_message.sv | (ends_short && host_q) || renews | (ends_short && host_q)
// mutation: dsl/dsl_message.sv | if (long_begun) {long_q, long_open_q} <= '0; | if (long_begun) long_open_q <= '0;
// mutation: dsl/dsl_message.sv | assign fails      = breaks || (over && long_begun); | assign fails      = breaks;
// mutation: dsl/dsl_message.sv | if (running && resets_q)             symbol_q
//   | if (running && resets_q && !send_q)  symbol_q
// mutation: dsl/dsl_message.sv | copied && copy_long && long_open_q; | copied && copy_long;
// mutation: dsl/dsl_message.sv | wait_q[6] || wait_q == WAIT_LAST; | wait_q == WAIT_LAST;
// mutation: dsl/dsl_message.sv | && !wait_q[6])      wait_q <= wait_q + 7'd1; | && !wait_q[5])      wait_q <= wait_q + 7'd1;

module proof (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             sdk_map_i,
  input logic             check_i,
  input logic             begin_i,
  input dsl_pkg::answer_t answer_i,
  input dsl_pkg::counts_t counts_i,
  input logic             host_read_i, host_write_i,
  input logic [5:0]       host_address_i,
  input logic [7:0]       host_byte_i,
  input dsl_pkg::orders_t orders_i
);

  logic [4:0]               symbol;
  dsl_pkg::messages_t       messages;
  dsl_pkg::message_events_t events;
  dsl_message u_dut (
    .clk_i, .rst_ni, .sdk_map_i, .check_i, .begin_i, .answer_i, .counts_i,
    .symbol_o    (symbol),
    .host_read_i, .host_write_i, .host_address_i, .host_byte_i,
    .host_data_o (),
    .busy_o      (),
    .clears_o    (),
    .orders_i,
    .messages_o  (messages),
    .events_o    (events)
  );

  wire       main, safe, long, resets, short, of_safe, open, done, nak, due, select, send, send_long, long_open, ran, pending;
  wire [6:0] frames;
  wire [3:0] state;
  wire [1:0] comes;
  wire       differs, copy_long, whole;

  logic copies, works;            // an answer is copied; a nibble is worked on
  assign copies = state == dsl_message_pkg::HIGH || state == dsl_message_pkg::LOW || state == dsl_message_pkg::PUT;
  assign works  = copies || state == dsl_message_pkg::STORE || state == dsl_message_pkg::COMPARE
               || state == dsl_message_pkg::DIVIDE || state == dsl_message_pkg::JUDGE;
  logic goes;                     // a short request
  assign goes   = (select || send) && !send_long;

  logic running;
  assign running = answer_i.running && answer_i.linked;

  logic s_par, came_q;            // S_PAR of a frame
  assign s_par = answer_i.valid && answer_i.number == 3'd1;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) came_q <= 1'b0;
    else         came_q <= !begin_i && (came_q || s_par);
  end

  logic started = 1'b0;
  always @(posedge clk_i) started <= 1'b1;

  always @* begin
    assume (rst_ni == started);
    assume (!(orders_i.starts_main && (main || resets)));
    assume (!(orders_i.starts_safe && (safe || resets)));
    assume (!(orders_i.starts_long && (long || resets)));
    assume (!(orders_i.resets && resets));
    // A link that falls is down for longer than a nibble needs.
    if (works || pending) assume (!running || running_q);
    assume (!(came_q && s_par) && !(begin_i && (pending || s_par || works)));
  end

  // What was a clock before.
  logic             seen_q;
  logic             main_q, safe_q, long_q, resets_q, open_q, due_q, begin_q, running_q, ran_q, begun_q;
  logic [6:0]       frames_q;
  dsl_pkg::message_events_t events_q;
  always @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {seen_q, main_q, safe_q, long_q, resets_q, open_q, due_q, begin_q, running_q, ran_q, begun_q, goes_q} <= '0;
      {frames_q, events_q} <= '0;
    end else begin
      {seen_q, main_q, safe_q, long_q, resets_q} <= {1'b1, main, safe, long, resets};
      open_q    <= short && open && !done;
      due_q     <= due;
      begin_q   <= begin_i;
      running_q <= running;
      ran_q     <= ran;
      begun_q   <= long_open || (send && send_long);
      goes_q    <= goes;
      frames_q  <= frames;
      events_q  <= events;
    end
  end

  logic waits;                    // a whole short message does for its answer
  assign waits = short && open && !done;

  always @* if (started && seen_q) begin
    if (long_q && !long)     Long_A:  assert (events_q.frel);
    if (main_q && !main)     Main_A:  assert (events_q.fres);
    if (safe_q && !safe)     Safe_A:  assert (events_q.safe_fres);
    if (resets_q && !resets) Reset_A: assert (events_q.min);
    if (events_q.ans)        Ans_A:   assert (events_q.frel);
    // The end of the link, and the acknowledge.
    if (ran_q && !running_q && begun_q) Over_A: assert (events_q.ans && (!long || !long_q));
    if (events_q.min) Renewed_A: assert (!main && !safe && !long && !short && !long_open && !resets);
    if (begin_q && running_q && resets_q) Init_A: assert (symbol == 5'h1E);
    // A short message that waits.
    if (waits && open_q && !goes && !goes_q && running_q && ran_q) begin
      Frames_A: assert (frames == (begin_q && !frames_q[6] ? frames_q + 7'd1 : frames_q));
      if (due_q) Due_A: assert (due);
    end
    if (waits && frames >= 7'd63) Late_A: assert (due);
  end

  // What a message is that is sent or waits.
  always @* if (started) begin
    if (short) Short_A: assert (of_safe ? safe : main);
    if (long_open || ((select || send) && send_long)) Open_A: assert (long);
    if (long_open) One_A: assert (!((select || send) && send_long));
    if (pending) Pending_A: assert (came_q);
    if (symbol == 5'h1E && !resets) Once_A: assert (came_q && !pending);
    if (goes) Sent_A: assert (short && !done);
    if (goes && waits && comes == dsl_message_pkg::SHORT) Foreign_A: assert (differs);
    if (whole) Whole_A: assert (state == dsl_message_pkg::JUDGE && copy_long == (comes == dsl_message_pkg::LONG)
                                && (comes == dsl_message_pkg::LONG || comes == dsl_message_pkg::SHORT));
    if (works && !copies && state != dsl_message_pkg::JUDGE) Comes_A: assert (comes != dsl_message_pkg::REST);
    if (works && !copies && comes == dsl_message_pkg::NONE && seen_q) None_A: assert (!running_q);
    if (goes) Copied_A: assert (!copies || copy_long);
  end

  always @(posedge clk_i) if (rst_ni) begin
    Taken_C: cover (short && select);
    Min_C:   cover (events.min);
  end

endmodule
