// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// RP2040, RP2350: prints the position of a BiSS C encoder of 26 bits. Pins: docs/boards.md.

#include <pico/stdlib.h>

#include <cinttypes>
#include <cstdio>

#include "mb4/mb4.hpp"
#include "mb4/ports/pico.hpp"

int main() {
  stdio_init_all();
  spi_init(spi0, mb4::kReadSclkHz);
  for (const unsigned pin : {16U, 18U, 19U}) {  // MISO, SCLK, MOSI
    gpio_set_function(pin, GPIO_FUNC_SPI);
  }
  gpio_init(17);
  gpio_put(17, true);
  gpio_set_dir(17, GPIO_OUT);
  mb4::ports::PicoBus bus(spi0, 17, 10'000'000);
  mb4::ports::PicoClock clock;
  mb4::Device device(bus, clock);

  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;  // 26 position, nE, nW
  config.slaves[0].crc_polynomial = 0x43;
  if (const mb4::Result<void> done = device.configure(config); !done) {
    std::printf("%s\n", mb4::to_string(done.error()));
    return 1;
  }
  for (;;) {
    if (const mb4::Result<mb4::Reading> reading = device.read_frame(); reading) {
      std::printf("%" PRIu32 "\n", static_cast<std::uint32_t>(reading->position));
    } else {
      std::printf("%s\n", mb4::to_string(reading.error()));
    }
    sleep_ms(100);
  }
}
