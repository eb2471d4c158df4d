/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of Zephyr's kernel.h as the port uses; names and types as in Zephyr. */
#ifndef ZEPHYR_KERNEL_H_
#define ZEPHYR_KERNEL_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

uint32_t k_cycle_get_32(void);
/* A kernel clock of 16 MHz. */
inline uint32_t k_cyc_to_us_floor32(uint32_t cycles) { return cycles / 16; }
inline uint32_t k_us_to_cyc_floor32(uint32_t us) { return us * 16; }

#ifdef __cplusplus
}
#endif

#endif
