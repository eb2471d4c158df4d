// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: RP2040 and RP2350 with the C SDK of the Raspberry Pi Pico. Libraries: hardware_spi,
// hardware_gpio, hardware_timer.

#ifndef MB4_PORTS_PICO_HPP_
#define MB4_PORTS_PICO_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <hardware/gpio.h>
#include <hardware/spi.h>
#include <hardware/timer.h>

#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/result.hpp"

namespace mb4::ports {

// One chip at an SPI, blocking. Before the first transfer spi_init() has been called, SCK, MOSI and
// MISO have the function GPIO_FUNC_SPI, and NCS is an output at 1. SPI mode 0 with 8 bits is what
// spi_init() sets.
class PicoBus {
 public:
  // `sclk_hz` may be more than 5 MHz: opcode 0x03 alone then runs at 5 MHz (I204).
  PicoBus(spi_inst_t* spi, unsigned select, std::uint32_t sclk_hz = kReadSclkHz)
      : spi_(spi), select_(select), sclk_hz_(sclk_hz) {}

  // Never fails: the SDK has no error for it.
  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    run_at(needs_read_sclk(tx) && sclk_hz_ > kReadSclkHz ? kReadSclkHz : sclk_hz_);
    gpio_put(select_, false);
    if (rx.empty()) {
      spi_write_blocking(spi_, tx.data(), tx.size());
    } else {
      spi_write_read_blocking(spi_, tx.data(), rx.data(), tx.size());
    }
    while (spi_is_busy(spi_)) {
    }
    gpio_put(select_, true);
    return true;
  }

 private:
  // The SDK rounds the rate down.
  void run_at(std::uint32_t hz) {
    if (hz != now_hz_) {
      spi_set_baudrate(spi_, hz);
      now_hz_ = hz;
    }
  }

  spi_inst_t* spi_;
  unsigned select_;
  std::uint32_t sclk_hz_;
  std::uint32_t now_hz_ = 0;
};

// The timer of the chip. It has no state of its own, so devices and interrupts may share it.
struct PicoClock {
  static constexpr std::uint32_t kStepUs = 1;
  std::uint32_t now_us() { return time_us_32(); }
};

}  // namespace mb4::ports

#endif  // C++17

#endif  // MB4_PORTS_PICO_HPP_
