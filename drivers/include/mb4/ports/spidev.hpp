// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: Linux, /dev/spidevB.C. Needs the kernel's user headers; not freestanding.

#ifndef MB4_PORTS_SPIDEV_HPP_
#define MB4_PORTS_SPIDEV_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/result.hpp"

namespace mb4::ports {

// Owns the file. SPI mode 0, eight bits. One object for one chip select; not copied.
class SpidevBus {
 public:
  // `path` is the device file. `sclk_hz` may be more than 5 MHz: opcode 0x03 alone then runs at
  // 5 MHz, the fastest SCLK at which it is safe without a stretched clock (I204).
  explicit SpidevBus(const char* path, std::uint32_t sclk_hz = 5'000'000)
      : sclk_hz_(sclk_hz), file_(::open(path, O_RDWR | O_CLOEXEC)) {
    std::uint8_t mode = SPI_MODE_0;
    ready_ = file_ >= 0 && ::ioctl(file_, SPI_IOC_WR_MODE, &mode) == 0;
  }
  SpidevBus(const SpidevBus&) = delete;
  SpidevBus& operator=(const SpidevBus&) = delete;
  ~SpidevBus() {
    if (file_ >= 0) {
      ::close(file_);
    }
  }

  // True when the file was opened and SPI mode 0 was set. If false, errno tells the reason directly
  // after the constructor, and every transfer fails.
  [[nodiscard]] bool ready() const { return ready_; }

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    spi_ioc_transfer message{};
    message.tx_buf = reinterpret_cast<std::uintptr_t>(tx.data());
    message.rx_buf = reinterpret_cast<std::uintptr_t>(rx.data());
    message.len = static_cast<std::uint32_t>(tx.size());
    message.speed_hz = needs_read_sclk(tx) && sclk_hz_ > kReadSclkHz ? kReadSclkHz : sclk_hz_;
    message.bits_per_word = 8;
    return ready_ && ::ioctl(file_, SPI_IOC_MESSAGE(1), &message) == static_cast<int>(tx.size());
  }

 private:
  std::uint32_t sclk_hz_;
  int file_;
  bool ready_ = false;
};

// CLOCK_MONOTONIC.
struct MonotonicClock {
  std::uint32_t now_us() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<std::uint32_t>(now.tv_sec * 1'000'000LL + now.tv_nsec / 1000);
  }
};

}  // namespace mb4::ports

#endif  // C++17

#endif  // MB4_PORTS_SPIDEV_HPP_
