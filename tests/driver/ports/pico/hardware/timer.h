/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of hardware_timer as the port uses; as in the manual "Raspberry Pi Pico-series C/C++ SDK".
 */
#ifndef TESTS_DRIVER_PORTS_PICO_TIMER_H_
#define TESTS_DRIVER_PORTS_PICO_TIMER_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

uint32_t time_us_32(void);

#ifdef __cplusplus
}
#endif

#endif
