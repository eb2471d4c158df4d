/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of FreeRTOS as the port and the example use;
 * names and signatures as in the "ESP-IDF Programming Guide", release 5.
 */
#ifndef TESTS_DRIVER_PORTS_ESP_IDF_FREERTOS_H_
#define TESTS_DRIVER_PORTS_ESP_IDF_FREERTOS_H_

#include <stdint.h>

typedef uint32_t TickType_t;
#define portMAX_DELAY 0xFFFFFFFFU
#define pdMS_TO_TICKS(ms) ((TickType_t)(ms) / 10)

#endif
