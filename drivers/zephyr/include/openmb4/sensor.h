/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Channels of the sensor "openmb4,ic-mb4" beside SENSOR_CHAN_ROTATION, which is the angle in one
 * turn in degrees, 0 <= angle < 360. */
#ifndef OPENMB4_SENSOR_H_
#define OPENMB4_SENSOR_H_

#include <zephyr/drivers/sensor.h>

enum openmb4_sensor_channel {
  /* All bits of the position: val1 has bits 31..0, val2 bits 63..32, both as bit patterns. */
  SENSOR_CHAN_OPENMB4_POSITION = SENSOR_CHAN_PRIV_START,
  /* The bits above single-turn-bits, as the encoder sends them: val1; val2 is 0. -ERANGE if they
   * do not fit 31 bits. */
  SENSOR_CHAN_OPENMB4_TURNS,
  /* val1: bit 0, the encoder reports an error (nE = 0), the position is not to be trusted; bit 1,
   * it reports a warning (nW = 0). val2 is 0. */
  SENSOR_CHAN_OPENMB4_FLAGS,
};

#endif /* OPENMB4_SENSOR_H_ */
