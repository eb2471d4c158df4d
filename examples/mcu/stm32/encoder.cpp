// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// STM32: prints the position of a BiSS C encoder of 26 bits. Call encoder() at the end of CubeMX's
// main(). SPI1 and TIM2 as docs/boards.md says; NCS has the user label MB4_NCS.

#include <cinttypes>
#include <cstdio>

#include "main.h"
#include "mb4/mb4.hpp"
#include "mb4/ports/stm32_hal.hpp"

extern "C" SPI_HandleTypeDef hspi1;
extern "C" TIM_HandleTypeDef htim2;  // counts microseconds, 32 bits

extern "C" void encoder() {
  mb4::ports::HalSpiBus bus(hspi1, MB4_NCS_GPIO_Port, MB4_NCS_Pin);
  mb4::ports::TimerClock clock(htim2);
  if (!clock.fits()) {
    std::printf("TIM2 does not wrap at 2^32\n");
    return;
  }
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
    HAL_Delay(100);
  }
}
