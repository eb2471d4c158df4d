/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of Zephyr's device.h as the sensor uses. */
#ifndef ZEPHYR_DEVICE_H_
#define ZEPHYR_DEVICE_H_

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct device {
  const void* config;
  const void* api;
  void* data;
  int (*init)(const struct device* dev); /* of the test */
};
bool device_is_ready(const struct device* dev);

extern const struct device zephyr_device_0;
#define DEVICE_DT_GET(node) (&zephyr_device_0)

#ifdef __cplusplus
}
#endif

#endif
