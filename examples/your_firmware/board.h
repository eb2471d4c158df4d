/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What firmware.c needs of a board. Each board_*.c is one: docs/firmware.md.
 */
#ifndef YOUR_FIRMWARE_BOARD_H_
#define YOUR_FIRMWARE_BOARD_H_

#include <stddef.h>
#include <stdint.h>

/* One SPI frame: NCS low, `size` bytes (1 to 64) out of `tx` and into `rx`, NCS high. A board that
 * has lost its chip ends the program with a message. */
void board_transfer(const uint8_t *tx, uint8_t *rx, size_t size);

/* Waits at least `us` microseconds. */
void board_wait_us(unsigned us);

#endif /* YOUR_FIRMWARE_BOARD_H_ */
