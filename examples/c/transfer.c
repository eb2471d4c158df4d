/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The simulated chip behind a function of the usual form; prints its revision.
 *
 *   cc transfer.c $(pkg-config --cflags --libs mb4sim) && ./a.out
 */
#include <mb4sim.h>
#include <stdio.h>

static mb4sim *chip;

static int transfer(const uint8_t *tx, uint8_t *rx, size_t n) {
  return mb4sim_spi_transfer(chip, tx, rx, n);
}

int main(void) {
  const uint8_t tx[] = {0x03, 0xEA, 0, 0}; /* read REVISION and VERSION */
  uint8_t rx[4];
  chip = mb4sim_open("[chip]\n", NULL, 0);
  if (chip == NULL || transfer(tx, rx, sizeof tx) != 0) return 1;
  printf("revision 0x%02X, version 0x%02X\n", rx[2], rx[3]);
  mb4sim_close(chip);
  return 0;
}
