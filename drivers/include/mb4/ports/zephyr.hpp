// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: Zephyr's SPI and kernel clock.

#ifndef MB4_PORTS_ZEPHYR_HPP_
#define MB4_PORTS_ZEPHYR_HPP_

#include <zephyr/drivers/spi.h>
#include <zephyr/kernel.h>

#include <cstdint>

#include "mb4/span.hpp"

namespace mb4::ports {

// One chip select out of the device tree:
//
//   const spi_dt_spec spec = SPI_DT_SPEC_GET(DT_NODELABEL(mb4), SPI_WORD_SET(8) | SPI_TRANSFER_MSB,
//   0); mb4::ports::ZephyrBus bus(spec);
//
// spi-max-frequency is at most 5 MHz (I204). `spec` must outlive the bus. A transfer sleeps if the
// SPI driver sleeps: calls from an interrupt need an SPI driver that does not.
class ZephyrBus {
 public:
  explicit ZephyrBus(const spi_dt_spec& spec) : spec_(spec) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    // Zephyr's buffers are not const, but those it sends are only read.
    const spi_buf out{const_cast<std::uint8_t*>(tx.data()), tx.size()};
    const spi_buf in{rx.data(), rx.size()};
    const spi_buf_set sent{&out, 1};
    const spi_buf_set received{&in, 1};
    return spi_transceive_dt(&spec_, &sent, rx.empty() ? nullptr : &received) == 0;
  }

 private:
  const spi_dt_spec& spec_;
};

// The cycle counter of the kernel. Its 32 bits must not wrap within one call of the driver.
class ZephyrClock {
 public:
  std::uint32_t now_us() {
    const std::uint32_t cycles = k_cycle_get_32();
    // Differences of a wrapping counter, so that the microseconds wrap at 2^32.
    time_us_ += k_cyc_to_us_floor32(cycles - last_cycles_);
    last_cycles_ += k_us_to_cyc_floor32(k_cyc_to_us_floor32(cycles - last_cycles_));
    return time_us_;
  }

 private:
  std::uint32_t last_cycles_ = 0;
  std::uint32_t time_us_ = 0;
};

}  // namespace mb4::ports

#endif  // MB4_PORTS_ZEPHYR_HPP_
