/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of hardware_spi as the port and the example use; as in the manual "Raspberry Pi Pico-series C/C++ SDK".
 */
#ifndef TESTS_DRIVER_PORTS_PICO_SPI_H_
#define TESTS_DRIVER_PORTS_PICO_SPI_H_

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef unsigned int uint;
typedef struct spi_inst spi_inst_t;
extern spi_inst_t* const stub_spi0;
#define spi0 stub_spi0

uint spi_init(spi_inst_t* spi, uint baudrate);
uint spi_set_baudrate(spi_inst_t* spi, uint baudrate);
int spi_write_read_blocking(spi_inst_t* spi, const uint8_t* src, uint8_t* dst, size_t len);
int spi_write_blocking(spi_inst_t* spi, const uint8_t* src, size_t len);
bool spi_is_busy(const spi_inst_t* spi);

#ifdef __cplusplus
}
#endif

#endif
