// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Stand-ins for a SPI data register and a timer, and the device that the interrupt uses. Compiled
// alone, so that its size can be taken off.

#include "board.hpp"

namespace {

volatile std::uint8_t spi_data;
volatile std::uint32_t timer_us;

}  // namespace

extern "C" bool board_transfer(const std::uint8_t* tx, std::uint8_t* rx, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    spi_data = tx[i];
    const std::uint8_t received = spi_data;
    if (rx != nullptr) {
      rx[i] = received;
    }
  }
  return true;
}

extern "C" std::uint32_t board_now_us() { return timer_us; }
