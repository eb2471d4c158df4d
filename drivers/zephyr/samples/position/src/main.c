/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Prints the angle of the encoder ten times a second, with Zephyr's sensor API. */
#include <errno.h>
#include <openmb4/sensor.h>
#include <zephyr/device.h>
#include <zephyr/devicetree.h>
#include <zephyr/drivers/sensor.h>
#include <zephyr/kernel.h>
#include <zephyr/sys/printk.h>

int main(void) {
  const struct device *const encoder = DEVICE_DT_GET(DT_NODELABEL(encoder));
  struct sensor_value angle;
  struct sensor_value flags;
  int error;

  if (!device_is_ready(encoder)) {
    printk("the SPI bus of the chip is not ready\n");
    return 0;
  }
  for (;;) {
    error = sensor_sample_fetch(encoder);
    if (error == 0) error = sensor_channel_get(encoder, SENSOR_CHAN_ROTATION, &angle);
    if (error == 0) {
      error = sensor_channel_get(encoder, (enum sensor_channel)SENSOR_CHAN_OPENMB4_FLAGS, &flags);
    }
    if (error == 0) {
      printk("%d.%06d degrees%s\n", (int)angle.val1, (int)angle.val2,
             (flags.val1 & 2) != 0 ? ", the encoder warns" : "");
    } else if (error == -EPROTO) { /* nE = 0: its position is not to be trusted */
      printk("the encoder reports an error\n");
    } else {
      printk("error %d\n", error);
    }
    k_msleep(100);
  }
}
