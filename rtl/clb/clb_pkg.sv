// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Types of the BiSS C master with the registers of TIDM-1010 (biss_clb).

package clb_pkg;

  // Tables 2-5 and 2-6: s1, s0.
  typedef enum logic [1:0] {
    IDLE     = 2'b00,
    TRANSMIT = 2'b01,   // MA runs, SL is watched
    BOTH     = 2'b10,   // MA runs, SL is received
    RECEIVE  = 2'b11    // MA has ended, the rest of SL is received
  } state_e;

  // Numbers of one counter of the clock tile.
  typedef struct packed {
    logic [11:0] match1;
    logic [11:0] match2;
  } period_t;

  // What the host configures. All registers.
  typedef struct packed {
    period_t     ma;
    period_t     receive;
    logic        clock_run;      // START_OPERATION of the clock tile
    logic        clock_enable;   // GLOBAL_EN of the clock tile
    logic        end_level;      // GPREG bit 7
    logic        fsm_enable;     // GLOBAL_EN of the FSM tile
    logic [7:0]  spi_match;
    logic [7:0]  r0;
    logic [3:0]  char_last;      // bits of a word minus 1
    logic        spi_enable;     // SPISWRESET
    logic        fifo_enable;    // RXFIFORESET
    logic        fifo_irq;       // RXFFIENA
    logic [4:0]  fifo_level;     // RXFFIL
  } cfg_t;

  // Accesses that do something at once, each high for one clock. The data are those of the bus.
  typedef struct packed {
    logic        ma_load;
    logic        receive_load;
    logic        start;          // rising edge of START_OPERATION of the FSM tile
    logic        count_load;
    logic        count_match;
    logic        spi_load;
    logic        char_write;
    logic        fifo_write;     // bits 7..0 of SPIFFRX
    logic        overflow_clear;
    logic        fifo_read;
  } act_t;

  // What the frame shows. All registers.
  typedef struct packed {
    logic        watchdog;       // has ended the frame
    logic [7:0]  spi_count;
    logic [15:0] ma_count;
    logic [15:0] count_match;
    logic        sl;             // behind the synchroniser
    logic [1:0]  state;          // state_e
  } frame_t;

  // What the FIFO shows. All registers but word.
  typedef struct packed {
    logic        overflow;
    logic        raised;
    logic [4:0]  level;
    logic [15:0] word;
  } fifo_t;

  // An access of the host. Requests are high for one clock.
  typedef struct packed {
    logic        rd;
    logic        wr;
    logic [3:0]  be;
    logic [11:0] addr;           // of a word
    logic [31:0] data;
  } bus_t;

endpackage
