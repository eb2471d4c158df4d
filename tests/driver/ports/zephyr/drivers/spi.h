/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of Zephyr's drivers/spi.h as the port and the sensor use; names and types as in Zephyr.
 */
#ifndef ZEPHYR_DRIVERS_SPI_H_
#define ZEPHYR_DRIVERS_SPI_H_

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SPI_WORD_SET(bits) ((bits) << 5)
#define SPI_TRANSFER_MSB 0
/* Of the test: the specs of the nodes. */
#define SPI_DT_SPEC_INST_GET(inst, operation, delay)   \
  {                                                    \
    nullptr, { DT_INST_PROP(inst, spi_max_frequency) } \
  }

#ifdef __cplusplus
extern "C" {
#endif

struct spi_buf {
  void* buf;
  size_t len;
};
struct spi_buf_set {
  const struct spi_buf* buffers;
  size_t count;
};
struct spi_config {
  uint32_t frequency;
};
struct spi_dt_spec {
  const void* bus;
  struct spi_config config;
};

bool spi_is_ready_dt(const struct spi_dt_spec* spec);
int spi_transceive_dt(const struct spi_dt_spec* spec, const struct spi_buf_set* tx_bufs,
                      const struct spi_buf_set* rx_bufs);

#ifdef __cplusplus
}
#endif

#endif
