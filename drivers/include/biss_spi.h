/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* Positions of BiSS C encoders through biss_spi, in C99 without a library. One call is some frames of
 * 7 bytes on SPI, mode 0 or 3, SCLK at most an eighth of the master's clock. No call waits.
 *
 *   biss_spi master = {transfer, context, 0};
 *   biss_spi_configure(&master, 0x3, 6, 26);     two channels, MA = clock / 12, 26 bits
 *   biss_spi_request(&master);                   the encoders latch now
 *   ... the time of a frame ...
 *   biss_spi_position(&master, 0, &reading);
 *
 * For a master with the parameters of biss_spi as they are by default. With EXTRAS the positions are
 * the same. A master must not be used from two contexts at the same time. */

#ifndef BISS_SPI_H_
#define BISS_SPI_H_

#include <stdbool.h>
#include <stdint.h>

#include "axi_regs.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  BISS_SPI_OK = 0,
  BISS_SPI_ARGUMENT = 1,    /* nothing was sent */
  BISS_SPI_BUS = 2,         /* the transfer failed, or the master has not understood its frame */
  BISS_SPI_NO_DATA = 3,     /* the last request has brought no good word of this channel, or not yet */
  BISS_SPI_SLAVE_ERROR = 4, /* nE = 0: the position has come and is not to be trusted */
  BISS_SPI_CRC = 5          /* the word and its CRC register are not of one frame */
};

/* Exchanges `size` bytes with NCS low; 0 for success. */
typedef int (*biss_spi_transfer)(void *context, const uint8_t *tx, uint8_t *rx, uint8_t size);

typedef struct {
  biss_spi_transfer transfer;
  void *context;
  uint8_t answer; /* third byte of the last frame */
} biss_spi;

typedef struct {
  uint32_t position;
  bool slave_error;   /* nE = 0 */
  bool slave_warning; /* nW = 0 */
} biss_spi_reading;

/* Bits of `answer` that stay until biss_spi_clear(). */
#define BISS_SPI_LATE 0x08U /* an access was too late for its frame */
#define BISS_SPI_VOID 0x04U /* a frame was void, or there was a reset: configure anew */

static inline int biss_spi_exchange(biss_spi *master, uint8_t opcode, uint32_t address,
                                    uint32_t value, uint32_t *read) {
  uint8_t tx[7];
  uint8_t rx[7] = {0};
  uint8_t i;
  tx[0] = opcode;
  tx[1] = (uint8_t)(address & 0xFFU);
  tx[2] = 0;
  for (i = 6; i > 2; --i) {
    tx[i] = (uint8_t)(value & 0xFFU);
    value >>= 8;
  }
  if (master->transfer(master->context, tx, rx, (uint8_t)sizeof tx) != 0) {
    return BISS_SPI_BUS;
  }
  master->answer = rx[2];
  if ((rx[2] & 0xF3U) != 0x51U) {
    return BISS_SPI_BUS;
  }
  if (read != 0) {
    *read = (uint32_t)rx[3] << 24 | (uint32_t)rx[4] << 16 | (uint32_t)rx[5] << 8 | rx[6];
  }
  return BISS_SPI_OK;
}

/* A word of the register map (axi_regs.h). */
static inline int biss_spi_write(biss_spi *master, uint32_t address, uint32_t value) {
  return biss_spi_exchange(master, 0x02, address, value, 0);
}
static inline int biss_spi_read(biss_spi *master, uint32_t address, uint32_t *value) {
  return biss_spi_exchange(master, 0x03, address, 0, value);
}
static inline int biss_spi_clear(biss_spi *master) {
  return biss_spi_exchange(master, 0x04, 0, 0, 0);
}

/* Single-point mode with CRC check. Bit c of `channels`: channel c. MA is the master's clock divided
 * by twice `ma_divider`, 1 to 255. */
static inline int biss_spi_configure(biss_spi *master, uint32_t channels, uint32_t ma_divider,
                                     uint32_t position_bits) {
  const uint32_t words[8][2] = {{AXI_ADDR_SOFT_RESET, 1},
                                {AXI_ADDR_MODE, 1},
                                {AXI_ADDR_REQUEST, 0},
                                {AXI_ADDR_MA_DIVIDER, ma_divider},
                                {AXI_ADDR_POSITION_BITS, position_bits},
                                {AXI_ADDR_CRC_CHECK, 1},
                                {AXI_ADDR_CHANNEL_ENABLE, channels},
                                {AXI_ADDR_SOFT_RESET, 0}};
  uint8_t i;
  int code = BISS_SPI_OK;
  if (channels == 0 || channels > 0xFU || ma_divider == 0 || ma_divider > 255U ||
      position_bits == 0 || position_bits > 32U) {
    return BISS_SPI_ARGUMENT;
  }
  for (i = 0; i < 8 && code == BISS_SPI_OK; ++i) {
    code = biss_spi_write(master, words[i][0], words[i][1]);
  }
  return code == BISS_SPI_OK ? biss_spi_clear(master) : code;
}

/* Clears all words and starts a frame on each enabled channel. In the timeout of an encoder, up to 40
 * us after its frame, nothing starts, and the words stay BISS_SPI_NO_DATA: ask again. */
static inline int biss_spi_request(biss_spi *master) {
  int code = biss_spi_write(master, AXI_ADDR_REQUEST, 0);
  if (code == BISS_SPI_OK) {
    code = biss_spi_write(master, AXI_ADDR_SOFT_RESET, 1);
  }
  if (code == BISS_SPI_OK) {
    code = biss_spi_write(master, AXI_ADDR_SOFT_RESET, 0);
  }
  return code == BISS_SPI_OK ? biss_spi_write(master, AXI_ADDR_REQUEST, 1) : code;
}

/* The next state of CRC 0x43. */
static inline uint8_t biss_spi_crc(uint8_t crc, uint32_t bit) {
  const uint32_t top = (uint32_t)crc >> 5 & 1U;
  return (uint8_t)(((uint32_t)crc << 1 & 0x3FU) ^ (top != bit ? 0x03U : 0U));
}

/* The channel's word of the last request. nE and nW are not in the map: CALCULATED_CRC fits the
 * position with one of their four pairs. */
static inline int biss_spi_position(biss_spi *master, uint32_t channel, biss_spi_reading *reading) {
  uint32_t valid = 0;
  uint32_t word = 0;
  uint32_t bits = 0;
  uint32_t calculated = 0;
  uint8_t of_position = 0;
  uint8_t pair;
  reading->position = 0;
  reading->slave_error = true;
  reading->slave_warning = true;
  if (channel > 3U) {
    return BISS_SPI_ARGUMENT;
  }
  if (biss_spi_write(master, AXI_ADDR_CHANNEL_INDEX, channel) != BISS_SPI_OK ||
      biss_spi_read(master, AXI_ADDR_SINGLE_POINT_VALID, &valid) != BISS_SPI_OK) {
    return BISS_SPI_BUS;
  }
  if ((valid >> channel & 1U) == 0) {
    return BISS_SPI_NO_DATA;
  }
  if (biss_spi_read(master, AXI_ADDR_SINGLE_POINT_DATA, &word) != BISS_SPI_OK ||
      biss_spi_read(master, AXI_ADDR_POSITION_BITS, &bits) != BISS_SPI_OK ||
      biss_spi_read(master, AXI_ADDR_CALCULATED_CRC, &calculated) != BISS_SPI_OK) {
    return BISS_SPI_BUS;
  }
  for (; bits > 0; --bits) {
    of_position = biss_spi_crc(of_position, word >> (bits - 1U) & 1U);
  }
  for (pair = 0; pair < 4; ++pair) {
    const uint8_t crc = biss_spi_crc(biss_spi_crc(of_position, pair >> 1 & 1U), pair & 1U);
    if (((uint32_t)~crc & 0x3FU) == (calculated & 0x3FU)) {
      reading->position = word;
      reading->slave_error = (pair & 2U) == 0;
      reading->slave_warning = (pair & 1U) == 0;
      return reading->slave_error ? BISS_SPI_SLAVE_ERROR : BISS_SPI_OK;
    }
  }
  return BISS_SPI_CRC;
}

#ifdef __cplusplus
}
#endif

#endif /* BISS_SPI_H_ */
