/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The read path in C99: one BiSS encoder of up to 32 bits with a CRC, bit by bit or, with
 * -DPARTS=MB4_WITH_TABLE, by table. Word, watch, table and the memory of the read are the
 * application's.
 */
#include <stddef.h>

#include "mb4_cyclic.h"

#ifndef PARTS
#define PARTS 0
#endif

bool board_transfer(const uint8_t *tx, uint8_t *rx, size_t size);
uint32_t board_now_us(void);

uint8_t firmware(mb4_cyclic *read, mb4_plan *plan, uint64_t *position);

uint8_t firmware(mb4_cyclic *read, mb4_plan *plan, uint64_t *position) {
  uint8_t code;
  mb4_cyclic_plan(read, plan, PARTS);
  do {
    bool done = true;
    uint8_t i;
    for (i = 0; i < plan->frames && done; ++i) {
      done = board_transfer(mb4_plan_tx(plan, i), mb4_plan_rx(plan, i), plan->size[i]);
    }
    code = mb4_cyclic_finish(read, plan, done, board_now_us(), PARTS);
  } while (code == MB4_MORE);
  if (code == MB4_OK) {
    mb4_reading reading;
    mb4_slot_reading(read->words, read->slots, &reading, PARTS);
    *position = reading.position;
  }
  return code;
}
