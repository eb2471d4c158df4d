/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of the SPI master driver as the port and the example use;
 * names and signatures as in the "ESP-IDF Programming Guide", release 5.
 */
#ifndef TESTS_DRIVER_PORTS_ESP_IDF_SPI_MASTER_H_
#define TESTS_DRIVER_PORTS_ESP_IDF_SPI_MASTER_H_

#include <stddef.h>
#include <stdint.h>

#include "driver/gpio.h"
#include "freertos/FreeRTOS.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { SPI1_HOST = 0, SPI2_HOST = 1 } spi_host_device_t;
typedef enum { SPI_DMA_DISABLED = 0, SPI_DMA_CH_AUTO = 3 } spi_dma_chan_t;
typedef struct {
  int mosi_io_num;
  int miso_io_num;
  int sclk_io_num;
  int quadwp_io_num;
  int quadhd_io_num;
} spi_bus_config_t;
typedef struct {
  uint8_t mode;
  int clock_speed_hz;
  int spics_io_num;
  int queue_size;
} spi_device_interface_config_t;
typedef struct {
  uint32_t flags;
  uint16_t cmd;
  uint64_t addr;
  size_t length; /* bits */
  size_t rxlength;
  void* user;
  union {
    const void* tx_buffer;
    uint8_t tx_data[4];
  };
  union {
    void* rx_buffer;
    uint8_t rx_data[4];
  };
} spi_transaction_t;
typedef struct spi_device_t* spi_device_handle_t;

esp_err_t spi_bus_initialize(spi_host_device_t host_id, const spi_bus_config_t* bus_config,
                             spi_dma_chan_t dma_chan);
esp_err_t spi_bus_add_device(spi_host_device_t host_id,
                             const spi_device_interface_config_t* dev_config,
                             spi_device_handle_t* handle);
esp_err_t spi_device_polling_transmit(spi_device_handle_t handle, spi_transaction_t* trans_desc);
esp_err_t spi_device_acquire_bus(spi_device_handle_t device, TickType_t wait);
void spi_device_release_bus(spi_device_handle_t dev);

#ifdef __cplusplus
}
#endif

#endif
