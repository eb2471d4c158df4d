// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The port of a Device or a Page on biss_spi: words as frames of SPI. Mode 0 or 3, SCLK at most an
// eighth of the master's clock. Freestanding C++17.

#ifndef BISS_AXI_SPI_PORT_HPP_
#define BISS_AXI_SPI_PORT_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstdint>

#include "enc/bus.hpp"
#include "enc/span.hpp"

namespace biss_axi {

// Bus: see enc/bus.hpp. It lives as long as the port.
template <typename Bus>
class SpiPort {
  static_assert(enc::kIsBus<Bus>, "Bus needs bool transfer(Span<const uint8_t>, Span<uint8_t>)");

 public:
  explicit SpiPort(Bus& bus) : bus_(bus) {}

  // False if the bus failed, or if the master has not understood the frame.
  bool write(std::uint32_t offset, std::uint32_t value) {
    return exchange(kWrite, offset, value, nullptr);
  }
  bool read(std::uint32_t offset, std::uint32_t& value) {
    return exchange(kRead, offset, 0, &value);
  }
  // A frame was void since the last clear(), or there was a reset: write the configuration anew.
  bool was_void() const { return (answer_ & kVoid) != 0; }
  // An access was too late for its frame since the last clear().
  bool was_late() const { return (answer_ & kLate) != 0; }
  bool clear() { return exchange(kClear, 0, 0, nullptr); }

 private:
  static constexpr std::uint8_t kWrite = 0x02, kRead = 0x03, kClear = 0x04;
  static constexpr std::uint8_t kLate = 0x08, kVoid = 0x04;
  static constexpr std::uint8_t kUnderstood = 0x51;
  static constexpr unsigned kFrameBytes = 7, kAnswerByte = 2;

  bool exchange(std::uint8_t opcode, std::uint32_t offset, std::uint32_t out,
                std::uint32_t* value) {
    std::uint8_t tx[kFrameBytes] = {opcode, static_cast<std::uint8_t>(offset)};
    std::uint8_t rx[kFrameBytes] = {};
    for (unsigned i = kFrameBytes - 1; i > kAnswerByte; --i) {
      tx[i] = static_cast<std::uint8_t>(out & 0xFFU);
      out >>= 8U;
    }
    if (value != nullptr) *value = 0;
    if (!bus_.transfer(enc::Span<const std::uint8_t>(tx, kFrameBytes),
                       enc::Span<std::uint8_t>(rx, kFrameBytes))) {
      return false;
    }
    answer_ = rx[kAnswerByte];
    if ((answer_ & ~(kLate | kVoid) & 0xFFU) != kUnderstood) return false;
    if (value != nullptr) {
      for (unsigned i = kAnswerByte + 1; i < kFrameBytes; ++i) *value = *value << 8U | rx[i];
    }
    return true;
  }

  Bus& bus_;
  std::uint8_t answer_ = 0;
};

}  // namespace biss_axi

#endif  // C++17

#endif  // BISS_AXI_SPI_PORT_HPP_
