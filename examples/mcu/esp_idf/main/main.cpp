// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// ESP32 family: prints the position of a BiSS C encoder of 26 bits. Pins: docs/boards.md.

#include <freertos/FreeRTOS.h>
#include <freertos/task.h>

#include <cinttypes>
#include <cstdio>

#include "mb4/mb4.hpp"
#include "mb4/ports/esp_idf.hpp"

extern "C" void app_main() {
  spi_bus_config_t pins{};
  pins.mosi_io_num = 7, pins.miso_io_num = 2, pins.sclk_io_num = 6;
  pins.quadwp_io_num = pins.quadhd_io_num = -1;
  ESP_ERROR_CHECK(spi_bus_initialize(SPI2_HOST, &pins, SPI_DMA_CH_AUTO));
  spi_device_interface_config_t chip{};
  chip.clock_speed_hz = mb4::kReadSclkHz, chip.spics_io_num = 10, chip.queue_size = 1;
  spi_device_handle_t handle = nullptr;
  ESP_ERROR_CHECK(spi_bus_add_device(SPI2_HOST, &chip, &handle));
  mb4::ports::EspIdfBus bus(handle);
  mb4::ports::EspTimerClock clock;
  mb4::Device device(bus, clock);

  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;  // 26 position, nE, nW
  config.slaves[0].crc_polynomial = 0x43;
  if (const mb4::Result<void> done = device.configure(config); !done) {
    std::printf("%s\n", mb4::to_string(done.error()));
    return;
  }
  for (;;) {
    if (const mb4::Result<mb4::Reading> reading = device.read_frame(); reading) {
      std::printf("%" PRIu32 "\n", static_cast<std::uint32_t>(reading->position));
    } else {
      std::printf("%s\n", mb4::to_string(reading.error()));
    }
    vTaskDelay(pdMS_TO_TICKS(100));
  }
}
