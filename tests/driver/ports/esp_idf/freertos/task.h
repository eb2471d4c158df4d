/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of FreeRTOS as the example uses; names and signatures as in the "ESP-IDF Programming Guide", release 5.
 */
#ifndef TESTS_DRIVER_PORTS_ESP_IDF_TASK_H_
#define TESTS_DRIVER_PORTS_ESP_IDF_TASK_H_

#include "freertos/FreeRTOS.h"

#ifdef __cplusplus
extern "C" {
#endif

void vTaskDelay(const TickType_t xTicksToDelay);

#ifdef __cplusplus
}
#endif

#endif
