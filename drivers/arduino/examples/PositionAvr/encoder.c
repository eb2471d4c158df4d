/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "encoder.h"

#include <mb4_cyclic.h>
#include <mb4_regs.h>

static encoder_transfer frame;
static mb4_word word;
static mb4_watch watch;
static mb4_cyclic cyclic;
static mb4_slot slot;
static mb4_plan plan;
static uint32_t tx[MB4_PLAN_WORDS(1)], rx[MB4_PLAN_WORDS(1)];

static void write_register(uint8_t address, uint8_t value) {
  const uint8_t bytes[3] = {MB4_SPI_OPCODE_WRITE_REGISTERS, address, value};
  frame(bytes, 0, sizeof bytes);
}

void encoder_begin(encoder_transfer transfer, uint32_t now_us) {
  const mb4_slave_config slave = {true, 28, MB4_FLAGS_ERROR_WARNING, 0, 0x43, false, false, false};
  const uint8_t stop[3] = {MB4_SPI_OPCODE_WRITE_INSTRUCTION, MB4_BREAK_MASK, MB4_CLKENI_MASK};
  const uint8_t run[2] = {MB4_SPI_OPCODE_WRITE_INSTRUCTION, MB4_AGS_MASK};
  frame = transfer;
  frame(stop, 0, sizeof stop); /* internal oscillator, 20 MHz */
  write_register(MB4_SCDLEN_ADDR(1), MB4_ENSCD_MASK(1) | (28 - 1));
  write_register(MB4_SCRCLEN_ADDR(1), 6);
  /* BiSS C (table 26), and CTS = 1: the request at rest is a read, no command. */
  write_register(MB4_REGVERS_ADDR, MB4_REGVERS_MASK | MB4_CTS_MASK);
  write_register(MB4_FREQS_ADDR, 3);          /* MA: 20 MHz / 2 / (3 + 1) = 2.5 MHz (table 35) */
  write_register(MB4_FREQAGS_ADDR, 127 + 32); /* 20 MHz / 625 / 32 = 1 kHz (table 37) */
  write_register(MB4_CFGCH_ADDR(1), 0x0D);    /* line 1 BiSS C, line 2 unused (table 8) */
  mb4_word_set(&word, 1, &slave, MB4_SPI_CHECK_CRC);
  watch.news_us = now_us;
  watch.omitted_us = 3000;
  watch.silent_us = 16000;
  watch.lines = 1;
  watch.held = true; /* the first read drops words from before */
  cyclic.words = &word;
  cyclic.slots = &slot;
  cyclic.count = 1;
  mb4_plan_memory(&plan, tx, rx);
  cyclic.watch = &watch;
  cyclic.spi_check = MB4_SPI_CHECK_CRC;
  cyclic.chain = true;
  /* All for the parts that encoder_read() has: MB4_OK, or each read is an error. */
  (void)mb4_cyclic_check(&cyclic, &plan, MB4_PLAN_WORDS(1), 0);
  frame(run, 0, sizeof run);
}

uint8_t encoder_read(uint32_t now_us, uint32_t *position) {
  uint8_t code;
  mb4_cyclic_plan(&cyclic, &plan, 0);
  do {
    uint8_t i;
    for (i = 0; i < plan.frames; ++i) {
      frame(mb4_plan_tx(&plan, i), mb4_plan_rx(&plan, i), plan.size[i]);
    }
    /* One slave of 28 bits, HOLDBANK at each read: the parts for other cases are left out. */
    code = mb4_cyclic_finish(&cyclic, &plan, true, now_us, 0);
  } while (code == MB4_MORE);
  if (code == MB4_OK) {
    mb4_reading reading;
    mb4_slot_reading(&word, &slot, &reading, 0);
    *position = (uint32_t)reading.position;
    return ENCODER_GOOD;
  }
  if (code == MB4_SLAVE_ERROR) {
    return ENCODER_SLAVE_ERROR;
  }
  return code == MB4_NO_DATA ? ENCODER_NOTHING_NEW : ENCODER_ERROR;
}
