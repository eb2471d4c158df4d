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
uint32_t sys_clock_hw_cycles_per_sec(void);

#ifdef __cplusplus
}
#endif

#endif
