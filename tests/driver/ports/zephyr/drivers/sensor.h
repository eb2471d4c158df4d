/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of Zephyr's drivers/sensor.h as the sensor uses; names and types as in Zephyr. */
#ifndef ZEPHYR_DRIVERS_SENSOR_H_
#define ZEPHYR_DRIVERS_SENSOR_H_

#include <stdint.h>
#include <zephyr/device.h>

#define CONFIG_SENSOR_INIT_PRIORITY 90

#ifdef __cplusplus
extern "C" {
#endif

struct sensor_value {
  int32_t val1;
  int32_t val2;
};
enum sensor_channel {
  SENSOR_CHAN_ROTATION = 35,
  SENSOR_CHAN_ALL = 61,
  SENSOR_CHAN_COMMON_COUNT,
  SENSOR_CHAN_PRIV_START = SENSOR_CHAN_COMMON_COUNT,
  SENSOR_CHAN_MAX = INT16_MAX,
};

typedef int (*sensor_sample_fetch_t)(const struct device* dev, enum sensor_channel chan);
typedef int (*sensor_channel_get_t)(const struct device* dev, enum sensor_channel chan,
                                    struct sensor_value* val);
typedef int (*sensor_attr_set_t)(const struct device* dev, enum sensor_channel chan, int attr,
                                 const struct sensor_value* val);
struct sensor_driver_api {
  sensor_attr_set_t attr_set;
  sensor_attr_set_t attr_get;
  sensor_attr_set_t trigger_set;
  sensor_sample_fetch_t sample_fetch;
  sensor_channel_get_t channel_get;
};

static inline int sensor_sample_fetch(const struct device* dev) {
  return ((const struct sensor_driver_api*)dev->api)->sample_fetch(dev, SENSOR_CHAN_ALL);
}
static inline int sensor_channel_get(const struct device* dev, enum sensor_channel chan,
                                     struct sensor_value* val) {
  return ((const struct sensor_driver_api*)dev->api)->channel_get(dev, chan, val);
}

#define SENSOR_DEVICE_DT_INST_DEFINE(inst, init, pm, data, config, level, priority, api) \
  extern const struct device zephyr_device_##inst = {config, api, data, init}

#ifdef __cplusplus
}
#endif

#endif
