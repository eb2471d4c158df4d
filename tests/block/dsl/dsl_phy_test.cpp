// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The pins: eighths at their clocks, and samples of the level before the clock edge that each is
// named after, whatever RX_START is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vdsl_phy.h"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kSlots = 72;
constexpr unsigned kSamples = 8 * kSlots;
constexpr unsigned kValid = 19;  // bits of the stream
constexpr unsigned kNumber = 9;
constexpr unsigned kTurn = 1;
constexpr unsigned kDrive = 8;
constexpr unsigned kEighths = 4;  // lowest bit

TEST(DslPhyBlock, RandomBits_LeaveAndEnterAtTheirTicks) {
  mb4test::Dice random;
  mb4test::Block<Vdsl_phy> block;
  auto& m = block.model;
  m.bit_i = 0xFF0;
  m.line_i = 1;
  m.rx_start_i = 5;
  block.clock();
  m.rst_ni = 1;
  for (unsigned start = 0; start < 16; ++start) {
    SCOPED_TRACE(testing::Message() << "RX_START " << start);
    m.rx_start_i = static_cast<std::uint8_t>(start);
    // Bits of a frame; SWITCH is the one with this number.
    const unsigned turn = random.below(20);
    constexpr unsigned kBits = 20 + kSlots + 4;
    std::vector<unsigned> sampled;
    std::vector<unsigned> numbers;
    std::vector<bool> levels;  // just before each tick
    unsigned taken = 0;
    for (unsigned bit = 0; bit < kBits; ++bit) {
      const unsigned eighths = random.below(256);
      const bool drive = random.below(2) != 0;
      for (unsigned tick = 0; tick < 8; ++tick) {
        m.line_i = static_cast<std::uint8_t>(random.below(2));
        if (tick == 0) {
          m.bit_i = static_cast<std::uint16_t>(eighths << kEighths | (drive ? kDrive : 0U) |
                                               (bit == turn ? kTurn : 0U));
          m.eval();
          ASSERT_EQ(m.slot_o, 1);
        } else {
          m.bit_i = static_cast<std::uint16_t>(random.below(1U << 12U));  // not looked at
          m.eval();
          ASSERT_EQ(m.slot_o, 0);
        }
        levels.push_back(m.line_i != 0);
        block.clock();
        ASSERT_EQ(m.line_o, eighths >> (7 - tick) & 1U) << "bit " << bit << " tick " << tick;
        ASSERT_EQ(m.drive_o, drive);
        if ((m.stream_o >> kValid & 1U) == 0) continue;
        const unsigned number = m.stream_o >> kNumber & 0x3FFU;
        ASSERT_EQ(number, taken++);
        const std::size_t at = turn * 8 + start + number;
        ASSERT_EQ(levels.size(), at + 1 + 2) << "two flops behind the sample";
        unsigned expected = 0;
        for (std::size_t i = at - std::min<std::size_t>(at, 8); i <= at; ++i) {
          expected = expected << 1U | (levels[i] ? 1U : 0U);
        }
        if (at >= 8) {
          ASSERT_EQ(m.stream_o & 0x1FFU, expected);
        }
      }
    }
    ASSERT_EQ(taken, kSamples);
  }
}

TEST(DslPhyBlock, Reset_LineIsFreeAndTheFirstEdgeTakesABit) {
  mb4test::Block<Vdsl_phy> block;
  auto& m = block.model;
  m.bit_i = kDrive;
  m.line_i = 1;
  m.rx_start_i = 0;
  block.clock();
  EXPECT_EQ(m.drive_o, 0);
  EXPECT_EQ(m.line_o, 1);
  EXPECT_EQ(m.stream_o >> kValid, 0U);
  m.rst_ni = 1;
  block.clock();
  EXPECT_EQ(m.drive_o, 1);
  EXPECT_EQ(m.line_o, 0);
}

}  // namespace
