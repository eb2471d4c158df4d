/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A small program for the chip, written byte by byte as in docs/programmers_guide.md: it reads five
 * positions of one BiSS C encoder (26 bits, nE, nW, CRC of 6 bits) on channel 1 at 10 MHz. It knows
 * its board only by board.h, so the same file runs on a board and on the simulator.
 * docs/firmware.md shows three boards; with the simulator in the same process:
 *
 *   cc firmware.c board_simulator.c $(pkg-config --cflags --libs mb4sim) && CHIP=ramp.toml ./a.out
 */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "board.h"

static void write_bytes(uint8_t address, const uint8_t *data, size_t size) {
  uint8_t tx[9] = {0x02, address}; /* opcode "write registers" */
  uint8_t rx[9];
  memcpy(tx + 2, data, size);
  board_transfer(tx, rx, size + 2);
}

static void instruction(uint8_t value) {
  const uint8_t tx[2] = {0x07, value}; /* opcode "write instruction" */
  uint8_t rx[2];
  board_transfer(tx, rx, sizeof tx);
}

/* Bytes 0xF0 and 0xF1: EOT is bit 0 of the first, SVALID1 bit 1 of the second. */
static bool frame_is_good(void) {
  for (int tries = 0; tries < 100; ++tries) {
    const uint8_t tx[3] = {0x05};
    uint8_t rx[3];
    board_transfer(tx, rx, sizeof tx);
    if ((rx[1] & 0x01) != 0) return (rx[2] & 0x02) != 0;
    board_wait_us(10);
  }
  instruction(0x80); /* BREAK: the encoder does not answer */
  return false;
}

int main(void) {
  static const uint8_t encoder[] = {0x5B, 0x06, 0x00, 0x00}; /* 28 bits, CRC 6 */
  /* From 0xE2 on. First the request at rest, a read of register 0: one disturbed bit of 0xF4 can
   * start what stands there, and four times 0 is the command "data off". */
  static const uint8_t master[] = {0x00, 0x00, 0x00, 0xC0, /* BiSS C */
                                   0xA0, 0x00, 0x7C};      /* 10 MHz, AGSMIN */
  static const uint8_t channels[] = {0x01, 0x0D};          /* channel 1 BiSS C, 2 not used */
  static const uint8_t clear_svalid1[] = {0xFD};
  int good = 0;

  instruction(0x80); /* BREAK: known state */
  write_bytes(0xC0, encoder, sizeof encoder);
  write_bytes(0xE2, master, sizeof master);
  write_bytes(0xEC, channels, sizeof channels);
  for (int i = 0; i < 5; ++i) {
    const uint8_t tx[5] = {0x09};
    uint8_t rx[5];
    write_bytes(0xF1, clear_svalid1, sizeof clear_svalid1);
    instruction(0x04); /* one frame */
    if (!frame_is_good()) {
      puts("no position");
      continue;
    }
    board_transfer(tx, rx, sizeof tx);
    /* nW and nE are bits 0 and 1; both are 1 if the encoder has no warning and no error. With nE =
     * 0 the encoder does not trust its position, so nobody else may. */
    const uint32_t word =
        rx[1] | (uint32_t)rx[2] << 8 | (uint32_t)rx[3] << 16 | (uint32_t)rx[4] << 24;
    if ((word & 2) != 0) {
      printf("position %lu%s\n", (unsigned long)(word >> 2), (word & 1) != 0 ? "" : ", warning");
      good += 1;
    } else {
      puts("the encoder reports an error");
    }
    board_wait_us(100);
  }
  return good == 5 ? 0 : 1;
}
