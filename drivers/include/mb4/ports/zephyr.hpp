// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: Zephyr's SPI and kernel clock.

#ifndef MB4_PORTS_ZEPHYR_HPP_
#define MB4_PORTS_ZEPHYR_HPP_

#include <zephyr/drivers/spi.h>
#include <zephyr/kernel.h>

#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/span.hpp"

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
// the driver. What a reading rounds off counts in the next one, so the time is exact at any rate.
class ZephyrClock {
 public:
  std::uint32_t now_us() {
    const std::uint32_t cycles = k_cycle_get_32();
    const std::uint64_t hz = sys_clock_hw_cycles_per_sec();
    const std::uint64_t parts = rest_ + std::uint64_t{cycles - last_cycles_} * 1'000'000U;
    last_cycles_ = cycles;
    time_us_ += static_cast<std::uint32_t>(parts / hz);
    rest_ = parts % hz;
    return time_us_;
  }

 private:
  std::uint64_t rest_ = 0;  // of a microsecond, times the counter's rate
  std::uint32_t last_cycles_ = 0;
  std::uint32_t time_us_ = 0;
};

}  // namespace mb4::ports

#endif  // MB4_PORTS_ZEPHYR_HPP_
