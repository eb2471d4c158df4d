/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of Zephyr's kernel.h as the port and the sensor use; names and types as in Zephyr. */
#ifndef ZEPHYR_KERNEL_H_
#define ZEPHYR_KERNEL_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int64_t ticks;
} k_timeout_t;
#ifdef __cplusplus
#define K_FOREVER (k_timeout_t{-1})
#else
#define K_FOREVER ((k_timeout_t){-1})
#endif

struct k_mutex {
  int count;
};
int k_mutex_init(struct k_mutex* mutex);
int k_mutex_lock(struct k_mutex* mutex, k_timeout_t timeout);
int k_mutex_unlock(struct k_mutex* mutex);
int32_t k_msleep(int32_t ms);

uint32_t k_cycle_get_32(void);
uint32_t sys_clock_hw_cycles_per_sec(void);

#ifdef __cplusplus
}
#endif

#endif
