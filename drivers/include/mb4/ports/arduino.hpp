// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: byte interfaces as Arduino's SPI library has them. Knows no Arduino header: the types are
// template parameters.

#ifndef MB4_PORTS_ARDUINO_HPP_
#define MB4_PORTS_ARDUINO_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstddef>
#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/result.hpp"

namespace mb4::ports {

// `Spi` has beginTransaction(settings), endTransaction() and `uint8_t transfer(uint8_t)`; `Select`
// is called with true to pull NCS low and with false to release it:
//
//   mb4::ports::ByteBus bus(SPI, SPISettings(5'000'000, MSBFIRST, SPI_MODE0),
//                           [](bool active) { digitalWrite(10, active ? LOW : HIGH); });
//
// Above 5 MHz opcode 0x03 needs settings of its own (I204):
//
//   mb4::ports::ByteBus bus(SPI, SPISettings(10'000'000, MSBFIRST, SPI_MODE0),
//                           SPISettings(mb4::kReadSclkHz, MSBFIRST, SPI_MODE0), select);
//
// There may be any pause between the bytes of one frame. Before the first transfer the pin must be
// an output at HIGH, and SPI.begin() must have been called. transfer() never fails.
template <typename Spi, typename Settings, typename Select>
class ByteBus {
 public:
  constexpr ByteBus(Spi& spi, Settings settings, Select select)
      : ByteBus(spi, settings, settings, select) {}
  // `read_settings` are those of opcode 0x03.
  constexpr ByteBus(Spi& spi, Settings settings, Settings read_settings, Select select)
      : spi_(spi), settings_(settings), read_settings_(read_settings), select_(select) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    spi_.beginTransaction(needs_read_sclk(tx) ? read_settings_ : settings_);
    select_(true);
    for (std::size_t i = 0; i < tx.size(); ++i) {
      const std::uint8_t received = spi_.transfer(tx[i]);
      if (!rx.empty()) {
        rx[i] = received;
      }
    }
    select_(false);
    spi_.endTransaction();
    return true;
  }

 private:
  Spi& spi_;
  Settings settings_;
  Settings read_settings_;
  Select select_;
};

// A clock made from a function such as micros().
template <typename Micros>
class MicrosClock {
 public:
  explicit constexpr MicrosClock(Micros micros) : micros_(micros) {}

  std::uint32_t now_us() { return static_cast<std::uint32_t>(micros_()); }

 private:
  Micros micros_;
};

}  // namespace mb4::ports

#endif  // C++17

#endif  // MB4_PORTS_ARDUINO_HPP_
