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
#include <sys/ioctl.h>

#include "bridge_client.h"
#include "caller_memory.h"

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

/* Appends a transfer and its data; NULL and EFAULT if they cannot be read. */
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
  return get_from_caller(to, data, transfer->len) == 0 ? to + transfer->len : NULL;
}

/* Writes the request for a message and returns its end, or NULL and errno; `total` is the sum of
 * all lengths. The kernel looks at one transfer after the other, and then asks the controller. */
static uint8_t *put_message(uint8_t *end, const struct spi_ioc_transfer *transfers, size_t count,
                            size_t *total) {
  size_t sent = 0, received = 0;
  int wide = 0;
  *total = 0;
  for (size_t i = 0; i < count; ++i) {
    *total += transfers[i].len;
    if (transfers[i].tx_buf != 0) sent += transfers[i].len;
    if (transfers[i].rx_buf != 0) received += transfers[i].len;
    if (sent > BUFFER_SIZE || received > BUFFER_SIZE || *total > BRIDGE_MAX_PAYLOAD) {
      errno = EMSGSIZE;
      return NULL;
    }
    end = put_transfer(end, &transfers[i]);
    if (end == NULL) return NULL;
    if (transfers[i].tx_nbits > 1 || transfers[i].rx_nbits > 1) wide = 1;
  }
  if (wide) { /* more than one data line: the controller has no such mode */
    errno = EINVAL;
    return NULL;
  }
  return end;
}

/* Sends a message. What has come in all its transfers goes to `answer`, which has room for `size`
 * bytes. Returns the number of bytes, or -1 and errno. */
static long message(const struct spi_ioc_transfer *transfers, size_t count, uint8_t *answer,
                    size_t size) {
  uint8_t *const request = malloc(count * TRANSFER_HEAD + BUFFER_SIZE);
  if (request == NULL) return -1;
  size_t total;
  long got = -1;
  const uint8_t *const end = put_message(request, transfers, count, &total);
  if (end != NULL) {
    got = bridge_request('M', request, (size_t)(end - request), answer, size);
    if (got >= 0 && (size_t)got != total) {
      errno = EIO;
      got = -1;
    }
  }
  const int error = errno;
  free(request);
  errno = error;
  return got;
}

static int ioctl_message(const void *argument, size_t count) {
  const size_t size = count * sizeof(struct spi_ioc_transfer);
  struct spi_ioc_transfer *const transfers = malloc(size + BRIDGE_MAX_PAYLOAD);
  if (transfers == NULL) return -1;
  uint8_t *const answer = (uint8_t *)(transfers + count);
  long result = get_from_caller(transfers, argument, size);
  if (result == 0) result = message(transfers, count, answer, BRIDGE_MAX_PAYLOAD);
  const uint8_t *from = answer;
  for (size_t i = 0; result >= 0 && i < count; from += transfers[i++].len) {
    void *const to = (void *)(uintptr_t)transfers[i].rx_buf;
    if (to != NULL && give_to_caller(to, from, transfers[i].len) != 0) result = -1;
  }
  const int error = errno;
  free(transfers);
  errno = error;
  return (int)result;
}

ssize_t spidev_read(void *buffer, size_t size) {
  if (size > BUFFER_SIZE) {
    errno = EMSGSIZE;
    return -1;
  }
  uint8_t answer[BUFFER_SIZE];
  const struct spi_ioc_transfer transfer = {.len = (uint32_t)size};
  if (message(&transfer, 1, answer, sizeof answer) < 0) return -1;
  const size_t stored = write_caller(buffer, answer, size);
  if (stored > 0 || size == 0) return (ssize_t)stored;
  errno = EFAULT;
  return -1;
}

ssize_t spidev_write(const void *buffer, size_t size) {
  if (size > BUFFER_SIZE) {
    errno = EMSGSIZE;
    return -1;
  }
  uint8_t data[BUFFER_SIZE];
  if (get_from_caller(data, buffer, size) != 0) return -1;
  const struct spi_ioc_transfer transfer = {.tx_buf = (uintptr_t)data, .len = (uint32_t)size};
  return message(&transfer, 1, data, sizeof data);
}

static int write_lsb_first(int lsb_first) {
  struct settings now;
  if (get_settings(&now) != 0) return -1;
  return set(SETTING_MODE,
             lsb_first ? now.mode | SPI_LSB_FIRST : now.mode & ~(uint32_t)SPI_LSB_FIRST);
}

/* SPI_IOC_RD_...: one byte or four, as the request says. */
static int read_setting(unsigned long request, void *argument) {
  struct settings now;
  if (get_settings(&now) != 0) return -1;
  uint32_t word = now.speed_hz;
  if (request == SPI_IOC_RD_MODE || request == SPI_IOC_RD_MODE32) word = now.mode;
  if (request == SPI_IOC_RD_LSB_FIRST) word = (now.mode & SPI_LSB_FIRST) != 0 ? 1 : 0;
  if (request == SPI_IOC_RD_BITS_PER_WORD) word = now.bits;
  const uint8_t byte = (uint8_t)word;
  return _IOC_SIZE(request) == 1 ? give_to_caller(argument, &byte, 1)
                                 : give_to_caller(argument, &word, sizeof word);
}

static int write_setting(unsigned long request, const void *argument) {
  uint32_t word;
  uint8_t byte;
  if (_IOC_SIZE(request) == 1) {
    if (get_from_caller(&byte, argument, 1) != 0) return -1;
    word = byte;
  } else if (get_from_caller(&word, argument, sizeof word) != 0) {
    return -1;
  }
  if (request == SPI_IOC_WR_LSB_FIRST) return write_lsb_first(word != 0);
  if (request == SPI_IOC_WR_BITS_PER_WORD) return set(SETTING_BITS, word);
  return set(request == SPI_IOC_WR_MAX_SPEED_HZ ? SETTING_SPEED : SETTING_MODE, word);
}

int spidev_ioctl(unsigned long request, void *argument) {
  request &= UINT_MAX; /* of an int some callers extend the sign */
  switch (request) {
    case SPI_IOC_RD_MODE:
    case SPI_IOC_RD_MODE32:
    case SPI_IOC_RD_LSB_FIRST:
    case SPI_IOC_RD_BITS_PER_WORD:
    case SPI_IOC_RD_MAX_SPEED_HZ:
      return read_setting(request, argument);
    case SPI_IOC_WR_MODE:
    case SPI_IOC_WR_MODE32:
    case SPI_IOC_WR_LSB_FIRST:
    case SPI_IOC_WR_BITS_PER_WORD:
    case SPI_IOC_WR_MAX_SPEED_HZ:
      return write_setting(request, argument);
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
  return size == 0 ? 0 : ioctl_message(argument, size / sizeof(struct spi_ioc_transfer));
}
