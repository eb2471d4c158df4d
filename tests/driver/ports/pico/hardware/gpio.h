/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of hardware_gpio as the port and the example use; as in the manual "Raspberry Pi Pico-series C/C++ SDK".
 */
#ifndef TESTS_DRIVER_PORTS_PICO_GPIO_H_
#define TESTS_DRIVER_PORTS_PICO_GPIO_H_

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef unsigned int uint;
enum gpio_function { GPIO_FUNC_SPI = 1 };
#define GPIO_OUT true

void gpio_init(uint gpio);
void gpio_set_function(uint gpio, enum gpio_function fn);
void gpio_set_dir(uint gpio, bool out);
void gpio_put(uint gpio, bool value);

#ifdef __cplusplus
}
#endif

#endif
