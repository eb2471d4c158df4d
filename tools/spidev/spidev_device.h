/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Does in the simulator the work of the kernel for an open /dev/spidevX.Y
 * (Documentation/spi/spidev.rst; drivers/spi/spidev.c for the errors).
 */
#ifndef MB4_TOOLS_SPIDEV_SPIDEV_DEVICE_H_
#define MB4_TOOLS_SPIDEV_SPIDEV_DEVICE_H_

#include <stddef.h>
#include <sys/types.h>

/* As the calls of the same name; -1 and errno on error. */
ssize_t spidev_read(void *buffer, size_t size);
ssize_t spidev_write(const void *buffer, size_t size);
int spidev_ioctl(unsigned long request, void *argument);

#endif /* MB4_TOOLS_SPIDEV_SPIDEV_DEVICE_H_ */
