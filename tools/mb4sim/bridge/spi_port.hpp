// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The simulated chip as a device on the SPI controller of an operating system: the settings stay,
// and a message has several transfers. Values have the meaning of Linux's spidev
// (Documentation/spi/spidev.rst, include/uapi/linux/spi/spi.h).
#ifndef MB4SIM_TOOL_SPI_PORT_HPP_
#define MB4SIM_TOOL_SPI_PORT_HPP_

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "mb4sim/simulator.hpp"

namespace mb4::tool {

// The controller or the simulation does not accept a value; nothing has changed. what() is one
// line.
class RefusedValue : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct SpiSettings {
  // Bits as in linux/spi/spi.h; the controller has those below.
  static constexpr std::uint32_t kCpha = 0x01;
  static constexpr std::uint32_t kCpol = 0x02;
  static constexpr std::uint32_t kLsbFirst = 0x08;
  static constexpr std::uint32_t kNoCs = 0x40;
  static constexpr std::uint32_t kModes = kCpha | kCpol | kLsbFirst | kNoCs;
  static constexpr std::uint32_t kMaxSpeedHz = 50'000'000;  // of the controller; faster is clamped
  static constexpr unsigned kMaxBits = 32;

  std::uint32_t mode = 0;
  std::uint8_t bits_per_word = 8;  // 1 to kMaxBits
  std::uint32_t speed_hz = 0;
};

struct SpiTransfer {
  std::size_t length = 0;            // bytes; a word takes 1, 2 or 4 of them, little-endian
  std::span<const std::uint8_t> tx;  // length bytes, or empty: zeros are sent
  std::uint32_t speed_hz = 0;        // 0: as the settings say
  std::uint16_t delay_us = 0;        // after the transfer, before NCS may change
  std::uint8_t word_delay_us = 0;    // after every word
  std::uint8_t bits_per_word = 0;    // 0: as the settings say
  bool cs_change = false;            // NCS high after it; after the last one: NCS stays low
};

class SpiPort {
 public:
  // Needs a scenario with SPI; the speed is at first the scenario's sclk_hz.
  explicit SpiPort(sim::Simulator& simulator);

  const SpiSettings& settings() const { return settings_; }
  // Each throws RefusedValue. A new mode ends a frame that is still open.
  void set_mode(std::uint32_t mode);
  void set_bits_per_word(std::uint32_t bits);
  void set_speed(std::uint32_t hz);

  // One message. Appends `length` bytes of each transfer to `rx`. Throws RefusedValue before the
  // first edge.
  void message(std::span<const SpiTransfer> transfers, std::vector<std::uint8_t>& rx);
  // Ends a frame that cs_change has left open.
  void release();

 private:
  unsigned bits_of(const SpiTransfer& transfer) const;  // in a word
  void check(const SpiTransfer& transfer) const;
  void run(const SpiTransfer& transfer, std::vector<std::uint8_t>& rx);
  void select(bool active);

  sim::Simulator& simulator_;
  SpiSettings settings_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SPI_PORT_HPP_
