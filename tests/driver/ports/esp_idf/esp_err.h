/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of esp_err.h as the port and the example use;
 * names and signatures as in the "ESP-IDF Programming Guide", release 5.
 */
#ifndef TESTS_DRIVER_PORTS_ESP_IDF_ESP_ERR_H_
#define TESTS_DRIVER_PORTS_ESP_IDF_ESP_ERR_H_

typedef int esp_err_t;
#define ESP_OK 0
#define ESP_FAIL (-1)
#define ESP_ERROR_CHECK(call) ((void)(call))

#endif
