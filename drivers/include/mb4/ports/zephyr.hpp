// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: Zephyr's SPI and kernel clock.

#ifndef MB4_PORTS_ZEPHYR_HPP_
#define MB4_PORTS_ZEPHYR_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <zephyr/drivers/spi.h>
#include <zephyr/kernel.h>

#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/ports/counter_us.hpp"
#include "mb4/result.hpp"

namespace mb4::ports {

// One chip select out of the device tree:
//
//   mb4::ports::ZephyrBus bus(
//       SPI_DT_SPEC_GET(DT_NODELABEL(mb4), SPI_WORD_SET(8) | SPI_TRANSFER_MSB, 0));
//
// The bus keeps a copy of `spec`. spi-max-frequency may be more than 5 MHz: opcode 0x03 alone then
// runs at 5 MHz (I204). A transfer sleeps if the SPI driver sleeps: calls from an interrupt need an
// SPI driver that does not.
class ZephyrBus {
 public:
  explicit ZephyrBus(const spi_dt_spec& spec) : spec_(spec), read_spec_(spec) {
    if (read_spec_.config.frequency > kReadSclkHz) {
      read_spec_.config.frequency = kReadSclkHz;
    }
  }

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    // Zephyr's buffers are not const, but those it sends are only read.
    const spi_buf out{const_cast<std::uint8_t*>(tx.data()), tx.size()};
    const spi_buf in{rx.data(), rx.size()};
    const spi_buf_set sent{&out, 1};
    const spi_buf_set received{&in, 1};
    return spi_transceive_dt(needs_read_sclk(tx) ? &read_spec_ : &spec_, &sent,
                             rx.empty() ? nullptr : &received) == 0;
  }

 private:
  // Two objects that stay where they are: SPI drivers of Zephyr set up their hardware again when
  // the address of the configuration changes.
  spi_dt_spec spec_;
  spi_dt_spec read_spec_;
};

// The cycle counter of the kernel, 32 kHz or faster. Its 32 bits must not wrap within one call of
// the driver.
class ZephyrClock {
 public:
  std::uint32_t now_us() { return time_.at(k_cycle_get_32(), sys_clock_hw_cycles_per_sec()); }

 private:
  CounterUs<std::uint32_t> time_;
};

}  // namespace mb4::ports

#endif  // C++17

#endif  // MB4_PORTS_ZEPHYR_HPP_
