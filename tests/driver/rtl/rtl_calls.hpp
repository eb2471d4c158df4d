// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The chip in the states in which the tests make their calls.

#ifndef TESTS_DRIVER_RTL_RTL_CALLS_HPP_
#define TESTS_DRIVER_RTL_RTL_CALLS_HPP_

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/support/chip_fixture.hpp"

namespace mb4test {

using mb4::Config;
using mb4::Error;
using mb4::Frame;
namespace regs = mb4::regs;

inline const std::string kEncoder =
    "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n"
    "data = 0xAAF37BF\ncontrol = true\nregisters = { 0x44 = [0x00, 0xD9, 0x01, 0x32] }\n";

// What has happened before the call.
enum class State : std::uint8_t { kFresh, kConfigured, kAutomatic, kReadBegun, kReadEnded };

inline Config encoder(bool automatic) {
  Config config = mb4test::config26(5'000'000);
  if (automatic) {
    config.frame_start = mb4::FrameStart::kPeriodic;
    config.frame_period_clk = 2000;
  }
  return config;
}

inline void prepare(FaultyChip& chip, State state) {
  if (state == State::kFresh) return;
  ASSERT_TRUE(chip.device.configure(encoder(state == State::kAutomatic)).ok());
  if (state == State::kAutomatic) {
    ASSERT_TRUE(chip.device.automatic().start().ok());
    chip.simulator.advance(250 * mb4::sim::kPsPerUs);
  }
  if (state == State::kReadBegun || state == State::kReadEnded) {
    ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x44, 4).ok());
  }
  while (state == State::kReadEnded) {
    const mb4::Result<bool> ended = mb4_c::PolledAccess(chip.device).poll();
    ASSERT_TRUE(ended.ok());
    if (*ended) break;
  }
}

inline std::array<std::uint8_t, 4> buffer;
inline const std::array<std::uint8_t, 4> kBytes{1, 2, 3, 4};

inline mb4::Command activate() {
  mb4::Command command;
  command.ids = 1;
  command.test_acknowledge = true;
  return command;
}

}  // namespace mb4test

#endif  // TESTS_DRIVER_RTL_RTL_CALLS_HPP_
