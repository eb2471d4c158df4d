/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A Linux board with the chip at /dev/spidev0.0. Nothing in it knows a simulator.
 */
#define _DEFAULT_SOURCE /* usleep() */
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "board.h"

void board_transfer(const uint8_t *tx, uint8_t *rx, size_t size) {
  static int device = -1;
  const struct spi_ioc_transfer transfer = {
      .tx_buf = (unsigned long)tx,
      .rx_buf = (unsigned long)rx,
      .len = (unsigned)size,
      .speed_hz = 5000000};
  if (device < 0) device = open("/dev/spidev0.0", O_RDWR);
  if (device < 0 || ioctl(device, SPI_IOC_MESSAGE(1), &transfer) < 0) {
    perror("/dev/spidev0.0");
    exit(1);
  }
}

void board_wait_us(unsigned us) { usleep(us); }
