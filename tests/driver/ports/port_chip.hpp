// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The Verilated chip behind what the ports call, and the reads that each of them makes.

#ifndef TESTS_DRIVER_PORTS_PORT_CHIP_HPP_
#define TESTS_DRIVER_PORTS_PORT_CHIP_HPP_

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/driver/rtl/rtl_calls.hpp"
#include "tests/support/chip_fixture.hpp"
#include "tests/support/wave.hpp"

namespace mb4test {

inline mb4::sim::Simulator* chip = nullptr;  // what the functions of the system talk to
inline bool fails = false;
inline std::uint32_t read_hz = 0;   // fastest SCLK of opcode 0x03
inline std::uint32_t other_hz = 0;  // slowest SCLK of any other opcode

inline void forget_rates() {
  read_hz = 0;
  other_hz = ~std::uint32_t{0};
}

inline void note_rate(std::uint8_t opcode, std::uint32_t hz) {
  if (opcode == mb4::regs::kSpiOpcodeReadRegisters) {
    read_hz = std::max(read_hz, hz);
  } else {
    other_hz = std::min(other_hz, hz);
  }
}

inline std::vector<std::uint8_t> exchange(const std::uint8_t* tx, std::size_t size) {
  std::vector<std::uint8_t> rx(size);
  chip->spi().transfer(std::span(tx, size), rx);
  return rx;
}

// The encoder sends the position 0x2ABCDEF.
class PortChip : public testing::Test {
 protected:
  PortChip() : simulator(mb4::sim::parse_scenario(kEncoder, "test.toml"), mb4test::with_wave()) {
    chip = &simulator;
    fails = false;
    forget_rates();
  }
  ~PortChip() override { chip = nullptr; }

  template <typename Bus, typename Clock>
  void read_positions(Bus& bus, Clock& clock) {
    mb4::Device<Bus, Clock> device(bus, clock);
    ASSERT_TRUE(device.probe().ok());
    ASSERT_TRUE(device.configure(encoder(false)).ok());
    for (int i = 0; i < 3; ++i) {
      const mb4::Result<mb4::Reading> reading = device.read_frame();
      ASSERT_TRUE(reading.ok());
      EXPECT_EQ(reading->position, 0x2ABCDEFU);
    }
    std::array<std::uint8_t, 4> serial{};
    ASSERT_TRUE(device.control().read_registers({1, 0}, 0x44, serial).ok());
    EXPECT_EQ(serial[1], 0xD9);
  }

  mb4::sim::Simulator simulator;
};

}  // namespace mb4test

#endif  // TESTS_DRIVER_PORTS_PORT_CHIP_HPP_
