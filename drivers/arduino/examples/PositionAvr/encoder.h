/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * One encoder on an iC-MB4, read through the C99 read path. This is C, because an AVR has no C++
 * standard library.
 */
#ifndef ENCODER_H_
#define ENCODER_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One SPI frame: NCS low, `size` bytes (2..40) out of `tx` and into `rx`, NCS high. `rx` may be null. */
typedef void (*encoder_transfer)(const uint8_t *tx, uint8_t *rx, uint8_t size);

/* Configures the chip and starts automatic frames, one each millisecond. Call it once, at least 1 ms
 * after the chip's reset. */
void encoder_begin(encoder_transfer transfer, uint32_t now_us);

enum { ENCODER_GOOD, ENCODER_NOTHING_NEW, ENCODER_ERROR, ENCODER_SLAVE_ERROR };

/* The newest position, 0..2^26 - 1. Returns ENCODER_...; `position` is written with ENCODER_GOOD only.
 * ENCODER_SLAVE_ERROR: a new word has come and its nE is 0, so the encoder does not trust it. */
uint8_t encoder_read(uint32_t now_us, uint32_t *position);

#ifdef __cplusplus
}
#endif

#endif
