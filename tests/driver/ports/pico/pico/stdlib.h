/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of pico_stdlib as the example uses; as in the manual "Raspberry Pi Pico-series C/C++ SDK".
 */
#ifndef TESTS_DRIVER_PORTS_PICO_STDLIB_H_
#define TESTS_DRIVER_PORTS_PICO_STDLIB_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

bool stdio_init_all(void);
void sleep_ms(uint32_t ms);

#ifdef __cplusplus
}
#endif

#endif
