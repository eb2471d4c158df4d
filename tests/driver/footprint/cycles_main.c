/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Runs firmware() of cyclic.c once in QEMU, with what a chip answers to a good frame: data
 * 0xAAF37BF of 28 bits with CRC 0x18 (CRC6 0x43), SVALID1 = 1, HOLDBANK and AGS. Ends through
 * semihosting: 0x18 with 0x20026 is success.
 */
#include <stddef.h>

#include "mb4_cyclic.h"

#ifndef PARTS
#define PARTS 0
#endif

extern uint32_t stack_top;

uint8_t firmware(mb4_cyclic *read, mb4_plan *plan, uint64_t *position);
bool board_transfer(const uint8_t *tx, uint8_t *rx, size_t size);
uint32_t board_now_us(void);
void reset(void);

bool board_transfer(const uint8_t *tx, uint8_t *rx, size_t size) {
  static const uint8_t data[9] = {0, 0xBF, 0x37, 0xAF, 0x0A, 0, 0, 0, 0x18};
  static const uint8_t status[6] = {0, 0xFA, 0x02, 0, 0, 0x41};
  const uint8_t *answer = tx[0] == 0x09 ? data : tx[0] == 0x05 ? status : NULL;
  for (size_t i = 0; answer != NULL && i < size; ++i) {
    rx[i] = answer[i];
  }
  return true;
}

uint32_t board_now_us(void) { return 100; }

void reset(void) {
  static mb4_word word;
  static mb4_watch watch;
  static mb4_cyclic read;
  static mb4_slot slot;
  static mb4_plan plan;
  static uint32_t tx[MB4_PLAN_WORDS(1)], rx[MB4_PLAN_WORDS(1)];
  static uint32_t table[16];
  static uint64_t position;
  const mb4_slave_config slave = {true, 28, MB4_FLAGS_ERROR_WARNING, 0, 0x43, false, false, false};
  mb4_word_set(&word, 1, &slave, MB4_SPI_CHECK_CRC);
  if ((PARTS & MB4_WITH_TABLE) != 0) {
    mb4_crc_table(&word, table);
  }
  read.words = &word;
  read.slots = &slot;
  read.count = 1;
  mb4_plan_memory(&plan, tx, rx);
  watch.omitted_us = 1000;
  watch.silent_us = 1000;
  watch.lines = 1;
  read.watch = &watch;
  read.spi_check = MB4_SPI_CHECK_CRC;
  read.chain = true;
  mb4_word_biss_c(&word, &slave, 1);
  if (mb4_cyclic_check(&read, &plan, MB4_PLAN_WORDS(1), PARTS) != MB4_OK) {
    position = 0;
  }
  (void)firmware(&read, &plan, &position); /* the first read of all also writes the frames */
  const uint8_t code = firmware(&read, &plan, &position);
  register uint32_t operation __asm__("r0") = 0x18;
  register uint32_t reason __asm__("r1") = code == MB4_OK && position == 0x2ABCDEF ? 0x20026 : 0x20023;
  __asm__ volatile("bkpt 0xAB" : : "r"(operation), "r"(reason));
  for (;;) {
  }
}

__attribute__((section(".vectors"), used)) static const void *const kVectors[2] = {&stack_top,
                                                                                  (void *)reset};
