/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of the GPIO driver as the port and the example use;
 * names and signatures as in the "ESP-IDF Programming Guide", release 5.
 */
#ifndef TESTS_DRIVER_PORTS_ESP_IDF_GPIO_H_
#define TESTS_DRIVER_PORTS_ESP_IDF_GPIO_H_

#include <stdint.h>

#include "esp_err.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { GPIO_NUM_NC = -1, GPIO_NUM_10 = 10 } gpio_num_t;

esp_err_t gpio_set_level(gpio_num_t gpio_num, uint32_t level);

#ifdef __cplusplus
}
#endif

#endif
