// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: ESP32 family with ESP-IDF 5. As a component: drivers/esp_idf/openmb4.

#ifndef MB4_PORTS_ESP_IDF_HPP_
#define MB4_PORTS_ESP_IDF_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <driver/gpio.h>
#include <driver/spi_master.h>
#include <esp_timer.h>
#include <freertos/FreeRTOS.h>

#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/result.hpp"

namespace mb4::ports {

// One chip, for tasks: ESP-IDF has no blocking transfer for interrupts. The bus is initialised with
// SPI_DMA_CH_AUTO, because a frame has up to 66 bytes and SPI without DMA ends at 64. The device
// has mode 0 and no command, address or dummy bits.
class EspIdfBus {
 public:
  // ESP-IDF drives NCS (spics_io_num). clock_speed_hz is at most 5 MHz (I204).
  explicit EspIdfBus(spi_device_handle_t device) : EspIdfBus(device, device, GPIO_NUM_NC) {}
  // The chip as two devices, both with spics_io_num = -1: `device` at any rate, `read_device` at
  // 5 MHz or less for opcode 0x03. This class drives NCS: `select` is an output at 1 before the
  // first transfer.
  EspIdfBus(spi_device_handle_t device, spi_device_handle_t read_device, gpio_num_t select)
      : device_(device), read_device_(read_device), select_(select) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    const spi_device_handle_t device = needs_read_sclk(tx) ? read_device_ : device_;
    spi_transaction_t frame{};
    frame.length = tx.size() * 8;
    frame.tx_buffer = tx.data();                         // NOLINT: a union of ESP-IDF
    frame.rx_buffer = rx.empty() ? nullptr : rx.data();  // NOLINT
    if (select_ == GPIO_NUM_NC) {
      return spi_device_polling_transmit(device, &frame) == ESP_OK;
    }
    // No other device of the bus may come between while NCS is low.
    if (spi_device_acquire_bus(device, portMAX_DELAY) != ESP_OK) {
      return false;
    }
    gpio_set_level(select_, 0);
    const esp_err_t done = spi_device_polling_transmit(device, &frame);
    gpio_set_level(select_, 1);
    spi_device_release_bus(device);
    return done == ESP_OK;
  }

 private:
  spi_device_handle_t device_;
  spi_device_handle_t read_device_;
  gpio_num_t select_;
};

// The microseconds of esp_timer. It has no state of its own, so devices may share it.
struct EspTimerClock {
  static constexpr std::uint32_t kStepUs = 1;
  std::uint32_t now_us() { return static_cast<std::uint32_t>(esp_timer_get_time()); }
};

}  // namespace mb4::ports

#endif  // C++17

#endif  // MB4_PORTS_ESP_IDF_HPP_
