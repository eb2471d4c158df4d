/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 */
#include "spidev_device.h"

#include <errno.h>
#include <limits.h>
#include <linux/spi/spi.h>
#include <linux/spi/spidev.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>

#include "bridge_client.h"

enum {
  BUFFER_SIZE = 4096, /* module parameter bufsiz of spidev */
  TRANSFER_HEAD = 11, /* request M: length, speed, delays, bits, flags */
  FLAG_CS_CHANGE = 1,
  FLAG_HAS_DATA = 2,
  SETTING_MODE = 0,
  SETTING_BITS = 1,
  SETTING_SPEED = 2
};

struct settings {
  uint32_t mode, bits, speed_hz;
};

static void put(uint8_t **to, uint32_t value, unsigned bytes) {
  for (; bytes > 0; --bytes, value >>= 8) *(*to)++ = (uint8_t)value;
}

static uint32_t take(const uint8_t *from) {
  return (uint32_t)from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 |
         (uint32_t)from[3] << 24;
}

static int get_settings(struct settings *settings) {
  uint8_t answer[12];
  if (bridge_request('G', NULL, 0, answer, sizeof answer) != sizeof answer) return -1;
  settings->mode = take(answer);
  settings->bits = take(answer + 4);
  settings->speed_hz = take(answer + 8);
  return 0;
}

static int set(uint8_t setting, uint32_t value) {
  uint8_t payload[5] = {setting};
  uint8_t *end = payload + 1;
  put(&end, value, 4);
  return bridge_request('C', payload, sizeof payload, NULL, 0) < 0 ? -1 : 0;
}

static uint8_t *put_transfer(uint8_t *to, const struct spi_ioc_transfer *transfer) {
  const void *data = (const void *)(uintptr_t)transfer->tx_buf;
  put(&to, transfer->len, 2);
  put(&to, transfer->speed_hz, 4);
  put(&to, transfer->delay_usecs, 2);
  *to++ = transfer->word_delay_usecs;
  *to++ = transfer->bits_per_word;
  *to++ = (uint8_t)((transfer->cs_change != 0 ? FLAG_CS_CHANGE : 0) |
                    (data != NULL ? FLAG_HAS_DATA : 0));
  if (data == NULL) return to;
  memcpy(to, data, transfer->len);
  return to + transfer->len;
}

/* The sum of all lengths, or -1 and errno. */
static long check(const struct spi_ioc_transfer *transfers, size_t count) {
  uint64_t total = 0, sent = 0, received = 0;
  for (size_t i = 0; i < count; ++i) {
    total += transfers[i].len;
    if (transfers[i].tx_buf != 0) sent += transfers[i].len;
    if (transfers[i].rx_buf != 0) received += transfers[i].len;
    /* More than one data line: the controller has no such mode. */
    if (transfers[i].tx_nbits > 1 || transfers[i].rx_nbits > 1) {
      errno = EINVAL;
      return -1;
    }
  }
  if (sent > BUFFER_SIZE || received > BUFFER_SIZE || total > BRIDGE_MAX_PAYLOAD) {
    errno = EMSGSIZE;
    return -1;
  }
  return (long)total;
}

static long message(const struct spi_ioc_transfer *transfers, size_t count) {
  const long total = check(transfers, count);
  if (total < 0) return -1;
  uint8_t *request = calloc(1, count * TRANSFER_HEAD + BUFFER_SIZE + (size_t)total);
  if (request == NULL) return -1;
  uint8_t *end = request;
  for (size_t i = 0; i < count; ++i) end = put_transfer(end, &transfers[i]);
  uint8_t *answer = end;
  const long got = bridge_request('M', request, (size_t)(end - request), answer, (size_t)total);
  if (got == total) {
    const uint8_t *from = answer;
    for (size_t i = 0; i < count; from += transfers[i++].len) {
      void *const to = (void *)(uintptr_t)transfers[i].rx_buf;
      if (to != NULL) memcpy(to, from, transfers[i].len);
    }
  } else if (got >= 0) {
    errno = EIO;
  }
  const int error = errno;
  free(request);
  errno = error;
  return got == total ? total : -1;
}

ssize_t spidev_read(void *buffer, size_t size) {
  if (size > BUFFER_SIZE) {
    errno = EMSGSIZE;
    return -1;
  }
  const struct spi_ioc_transfer transfer = {.rx_buf = (uintptr_t)buffer, .len = (uint32_t)size};
  return message(&transfer, 1);
}

ssize_t spidev_write(const void *buffer, size_t size) {
  if (size > BUFFER_SIZE) {
    errno = EMSGSIZE;
    return -1;
  }
  const struct spi_ioc_transfer transfer = {.tx_buf = (uintptr_t)buffer, .len = (uint32_t)size};
  return message(&transfer, 1);
}

static int write_mode(uint32_t mode) { return set(SETTING_MODE, mode); }

static int write_lsb_first(int lsb_first) {
  struct settings now;
  if (get_settings(&now) != 0) return -1;
  return write_mode(lsb_first ? now.mode | SPI_LSB_FIRST : now.mode & ~(uint32_t)SPI_LSB_FIRST);
}

static int read_setting(unsigned long request, void *argument) {
  struct settings now;
  if (get_settings(&now) != 0) return -1;
  switch (request) {
    case SPI_IOC_RD_MODE:
      *(uint8_t *)argument = (uint8_t)now.mode;
      return 0;
    case SPI_IOC_RD_MODE32:
      memcpy(argument, &now.mode, sizeof now.mode);
      return 0;
    case SPI_IOC_RD_LSB_FIRST:
      *(uint8_t *)argument = (now.mode & SPI_LSB_FIRST) != 0 ? 1 : 0;
      return 0;
    case SPI_IOC_RD_BITS_PER_WORD:
      *(uint8_t *)argument = (uint8_t)now.bits;
      return 0;
    default:
      memcpy(argument, &now.speed_hz, sizeof now.speed_hz);
      return 0;
  }
}

int spidev_ioctl(unsigned long request, void *argument) {
  request &= UINT_MAX; /* of an int some callers extend the sign */
  uint32_t word;
  switch (request) {
    case SPI_IOC_RD_MODE:
    case SPI_IOC_RD_MODE32:
    case SPI_IOC_RD_LSB_FIRST:
    case SPI_IOC_RD_BITS_PER_WORD:
    case SPI_IOC_RD_MAX_SPEED_HZ:
      return read_setting(request, argument);
    case SPI_IOC_WR_MODE:
      return write_mode(*(const uint8_t *)argument);
    case SPI_IOC_WR_MODE32:
      memcpy(&word, argument, sizeof word);
      return write_mode(word);
    case SPI_IOC_WR_LSB_FIRST:
      return write_lsb_first(*(const uint8_t *)argument != 0);
    case SPI_IOC_WR_BITS_PER_WORD:
      return set(SETTING_BITS, *(const uint8_t *)argument);
    case SPI_IOC_WR_MAX_SPEED_HZ:
      memcpy(&word, argument, sizeof word);
      return set(SETTING_SPEED, word);
    default:
      break;
  }
  if (_IOC_TYPE(request) != SPI_IOC_MAGIC || _IOC_NR(request) != 0 ||
      _IOC_DIR(request) != _IOC_WRITE) {
    errno = ENOTTY;
    return -1;
  }
  const size_t size = _IOC_SIZE(request);
  if (size % sizeof(struct spi_ioc_transfer) != 0) {
    errno = EINVAL;
    return -1;
  }
  return size == 0 ? 0 : (int)message(argument, size / sizeof(struct spi_ioc_transfer));
}
