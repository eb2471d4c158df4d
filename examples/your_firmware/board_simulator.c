/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The board is the simulator in the same process. The environment variable CHIP names the
 * scenario file with the encoder. Simulated time passes only in board_transfer() and
 * board_wait_us(), so each run gives the same.
 */
#include <mb4sim.h>
#include <stdio.h>
#include <stdlib.h>

#include "board.h"

static mb4sim *chip(void) {
  static mb4sim *opened;
  const char *path = getenv("CHIP");
  char error[256] = "CHIP is not set";
  if (opened == NULL && path != NULL) opened = mb4sim_open_file(path, error, sizeof error);
  if (opened == NULL) {
    fprintf(stderr, "%s\n", error);
    exit(1);
  }
  return opened;
}

/* Ends the program if a call has failed. */
static void check(int result) {
  char text[256] = "";
  if (result == 0) return;
  mb4sim_last_error(chip(), text, sizeof text);
  fprintf(stderr, "simulator: error %d %s\n", result, text);
  exit(1);
}

void board_transfer(const uint8_t *tx, uint8_t *rx, size_t size) {
  check(mb4sim_spi_transfer(chip(), tx, rx, size));
}

void board_wait_us(unsigned us) {
  mb4sim_advance_ns(chip(), us * 1000ULL);
  check(mb4sim_last_error(chip(), NULL, 0));
}
