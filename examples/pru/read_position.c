/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* Positions of an encoder with 12 bits at 5 MHz, one in 100 us, and two of its registers meanwhile.
 *
 *   read_position SCENARIO             with port_simulator.c
 *   read_position /dev/uio0            with linux.c
 *   read_position 0x43C00000           with linux.c: the physical address */

#include <inttypes.h>
#include <stdio.h>

#include "port.h"

static biss_pru_master pru;

/* Waits for the next frame and prints what is wrong with it. False: it is no use to go on. */
static bool frame(biss_pru_reading *reading) {
  biss_pru_result result = BISS_PRU_NO_NEW_FRAME;
  while (result == BISS_PRU_NO_NEW_FRAME) {
    board_sleep_us(1000);
    result = biss_pru_position(&pru, reading);
  }
  if (result != BISS_PRU_OK) printf("frame %u: %s\n", (unsigned)reading->frame, biss_pru_text(result));
  return result != BISS_PRU_NOT_RUNNING && result != BISS_PRU_NO_FRAMES;
}

/* A register of the encoder. The loop goes on with positions; it counts them. */
static bool read_register(uint8_t address, uint8_t *value, unsigned *frames) {
  biss_pru_reading reading = {0};
  biss_pru_result result = biss_pru_begin_read(&pru, 0, address);
  if (result == BISS_PRU_OK) result = BISS_PRU_PENDING;
  while (result == BISS_PRU_PENDING && frame(&reading)) {
    ++*frames;
    result = biss_pru_poll(&pru, value);
  }
  if (result != BISS_PRU_OK) printf("register 0x%02X: %s\n", (unsigned)address, biss_pru_text(result));
  return result == BISS_PRU_OK;
}

static bool work(void) {
  biss_pru_reading reading = {0};
  unsigned frames = 0;
  uint8_t maker[2] = {0, 0};
  for (int i = 0; i < 4; ++i) {
    if (!frame(&reading)) return false;
    printf("position %" PRIu64 "%s, line delay %u, processing %u\n", reading.position,
           reading.warning ? " (encoder warns)" : "", (unsigned)reading.line_delay, (unsigned)reading.proc_time);
  }
  if (!read_register(0x7E, &maker[0], &frames) || !read_register(0x7F, &maker[1], &frames)) return false;
  printf("manufacturer %02X %02X, %u frames meanwhile\n", (unsigned)maker[0], (unsigned)maker[1], frames);
  return true;
}

static bool run(const biss_pru_port *port) {
  biss_pru_config config = {0};
  biss_pru_result result = BISS_PRU_OK;
  bool good = false;
  config.position_bits = 12;
  config.crc_err_war = 8; /* nE, nW, 6 bits of CRC */
  config.mhz = 5;
  config.period_us = 100;
  config.interrupt = true;
  result = biss_pru_start(&pru, port, &config);
  if (result != BISS_PRU_OK) {
    printf("start: %s\n", biss_pru_text(result));
    return false;
  }
  good = work();
  biss_pru_stop(&pru);
  return good;
}

int main(int argc, char **argv) {
  biss_pru_port port;
  int status = 2;
  if (argc == 2 && board_open(argv[1], &port)) {
    status = run(&port) ? 0 : 1;
    board_close();
  }
  return status;
}
