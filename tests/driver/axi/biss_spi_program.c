/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* A program that uses every call of biss_spi.h. It is C99 and C++, and is compiled only. */

#include "biss_spi.h"

int program(biss_spi *master, biss_spi_reading *reading);

int program(biss_spi *master, biss_spi_reading *reading) {
  uint32_t delay = 0;
  int code = biss_spi_configure(master, 0x3, 6, 26);
  if (code == BISS_SPI_OK) {
    code = biss_spi_request(master);
  }
  if (code == BISS_SPI_OK) {
    code = biss_spi_position(master, 1, reading);
  }
  if (code == BISS_SPI_OK) {
    code = biss_spi_read(master, AXI_ADDR_LINE_DELAY, &delay);
  }
  return (master->answer & BISS_SPI_VOID) != 0 ? biss_spi_clear(master) : code;
}
