// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What dsl_message does clock by clock: an S_PAR is worked on before a nibble is prepared, and that
// before something is counted. Four counters of two bytes stand in the memory.
//
// Clock domain: core. state_o is dsl_message_pkg::work_e; clears_o is 1 from the reset until the
// memory has its first values. bit_o counts the bits of a nibble. index_o is the byte that is
// cleared, copied or counted; copied_o tells the last one of an answer.
// stall_i: the host has the memory; a state that needs it waits, and a counter is read anew.
// parameter_i, job_i: an S_PAR is there, a nibble has to be prepared. stores_i: the S_PAR brings a
// nibble of a message. copies_i, in JUDGE: bytes of the answer are copied.
// Misuse: more than three illegal words within the work on an S_PAR are not all counted.
// Source: docs/dsl.md, "Messages".

module dsl_work (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             stall_i,
  input  logic             parameter_i,
  input  logic             stores_i,
  input  logic             job_i,
  input  logic             crc_i,          // the nibble is one of a CRC
  input  logic             copies_i,
  input  logic             is_long_i,      // the answer is
  input  logic [1:0]       length_i,       // ... with so much data
  input  logic [7:0]       data_i,         // of the memory
  // to be counted
  input  logic             foreign_i,
  input  logic             retry_i,
  input  dsl_pkg::counts_t counts_i,
  output logic [3:0]       state_o,
  output logic             clears_o,
  output logic             busy_o,         // bytes that belong together are being changed
  output logic [1:0]       bit_o,
  output logic [5:0]       index_o,
  output logic             copied_o,
  output logic             copy_long_o     // what is copied is a long answer
);

  // The states by their short names.
  localparam logic [3:0] CLEAR     = dsl_message_pkg::CLEAR;
  localparam logic [3:0] READY     = dsl_message_pkg::READY;
  localparam logic [3:0] FETCH     = dsl_message_pkg::FETCH;
  localparam logic [3:0] LOAD      = dsl_message_pkg::LOAD;
  localparam logic [3:0] SHIFT     = dsl_message_pkg::SHIFT;
  localparam logic [3:0] STORE     = dsl_message_pkg::STORE;
  localparam logic [3:0] COMPARE   = dsl_message_pkg::COMPARE;
  localparam logic [3:0] DIVIDE    = dsl_message_pkg::DIVIDE;
  localparam logic [3:0] HIGH      = dsl_message_pkg::HIGH;
  localparam logic [3:0] LOW       = dsl_message_pkg::LOW;
  localparam logic [3:0] PUT       = dsl_message_pkg::PUT;
  localparam logic [3:0] COUNT     = dsl_message_pkg::COUNT;
  localparam logic [3:0] ADD       = dsl_message_pkg::ADD;
  localparam logic [3:0] JUDGE     = dsl_message_pkg::JUDGE;

  logic [3:0] state_d, state_q;
  logic       clears_q;
  logic [1:0] bit_q;
  logic [5:0] index_q;
  logic       copy_long_q;
  logic [3:0] last;           // byte of a long answer
  logic       copied;
  logic       foreign_q, retry_q, restart_q;
  logic [1:0] illegal_q;      // they may come faster than one after another
  logic [5:0] first;          // what is counted first
  logic       begins;         // a count

  assign last   = {length_i == 2'd3, length_i == 2'd2, length_i == 2'd1, 1'b1};
  assign copied = state_q == PUT && !stall_i && (!copy_long_q || index_q[3:0] == last);

  always_comb begin
    state_d = READY;
    case (state_q)
      CLEAR:     state_d = index_q == dsl_message_pkg::LAST ? READY : CLEAR;
      READY: begin
        if (parameter_i)  state_d = stores_i ? STORE : READY;
        else if (job_i)   state_d = crc_i ? SHIFT : FETCH;
        else if (foreign_q || retry_q || restart_q || illegal_q != 2'd0) state_d = COUNT;
      end
      FETCH:     state_d = LOAD;
      LOAD:      state_d = SHIFT;
      SHIFT:     state_d = bit_q == 2'd3 ? READY : SHIFT;
      STORE:     state_d = COMPARE;
      COMPARE:   state_d = DIVIDE;
      DIVIDE:    state_d = bit_q == 2'd3 ? JUDGE : DIVIDE;
      JUDGE:     state_d = copies_i ? HIGH : READY;
      HIGH:      state_d = LOW;
      LOW:       state_d = PUT;
      PUT:       state_d = copied ? READY : HIGH;
      COUNT:     state_d = ADD;
      ADD:       state_d = data_i == 8'hFF && !index_q[0] ? COUNT : READY;
      default: ;
    endcase
    if (stall_i) begin
      case (state_q)
        CLEAR, FETCH, STORE, PUT, COUNT: state_d = state_q;
        ADD:     state_d = COUNT;
        default: ;
      endcase
    end
  end

  assign begins = state_q == READY && state_d == COUNT;
  always_comb begin
    first = dsl_message_pkg::FOREIGN;
    if (retry_q)           first = dsl_message_pkg::RETRIES;
    if (restart_q)         first = dsl_message_pkg::RESTARTS;
    if (illegal_q != 2'd0) first = dsl_message_pkg::ILLEGAL;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q   <= CLEAR;
      clears_q  <= 1'b1;
      bit_q     <= '0;
      index_q   <= '0;
      {foreign_q, retry_q, restart_q} <= '0;
      illegal_q <= '0;
    end else begin
      state_q  <= state_d;
      clears_q <= clears_q && state_q != READY;
      bit_q    <= state_q == SHIFT || state_q == DIVIDE ? bit_q + 2'd1 : 2'd0;
      case (state_q)
        CLEAR, PUT, ADD: if (!stall_i) index_q <= index_q + 6'd1;
        READY:           index_q <= first;
        DIVIDE:          index_q <= is_long_i ? 6'd0 : 6'd1;
        default: ;
      endcase
      foreign_q <= (foreign_q && !(begins && first == dsl_message_pkg::FOREIGN)) || foreign_i;
      retry_q   <= (retry_q && !(begins && first == dsl_message_pkg::RETRIES)) || retry_i;
      restart_q <= (restart_q && !(begins && first == dsl_message_pkg::RESTARTS))
                || counts_i.restart;
      illegal_q <= illegal_q + {1'b0, counts_i.illegal} - {1'b0, begins && illegal_q != 2'd0};
    end
  end

  // Written before it is read.
  always_ff @(posedge clk_i) begin
    if (state_q == DIVIDE) copy_long_q <= is_long_i;
  end

  assign state_o     = state_q;
  assign clears_o    = clears_q;
  assign busy_o      = (copy_long_q && (state_q == HIGH || state_q == LOW || state_q == PUT))
                    || state_q == COUNT || state_q == ADD;
  assign bit_o       = bit_q;
  assign index_o     = index_q;
  assign copied_o    = copied;
  assign copy_long_o = copy_long_q;

endmodule
