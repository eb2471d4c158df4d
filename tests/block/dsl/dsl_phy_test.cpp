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
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kSlots = 72;
constexpr unsigned kSamples = 8 * kSlots;
namespace bits = mb4test::places::dsl_pkg::bit_t;
namespace stream = mb4test::places::dsl_pkg::stream_t;

TEST(DslPhyBlock, RandomBits_LeaveAndEnterAtTheirTicks) {
  mb4test::Dice random;
  mb4test::Block<Vdsl_phy> block;
  auto& m = block.model;
  m.bit_i = bits::kEighths(0xFF);
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
          m.bit_i = static_cast<std::uint16_t>(bits::kEighths(eighths) | bits::kDrive(drive) |
                                               bits::kTurn(bit == turn));
          m.eval();
          ASSERT_EQ(m.slot_o, 1);
        } else {
          m.bit_i =
              static_cast<std::uint16_t>(random.below(1U << bits::kAllBits));  // not looked at
          m.eval();
          ASSERT_EQ(m.slot_o, 0);
        }
        levels.push_back(m.line_i != 0);
        block.clock();
        ASSERT_EQ(m.line_o, eighths >> (7 - tick) & 1U) << "bit " << bit << " tick " << tick;
        ASSERT_EQ(m.drive_o, drive);
        if (stream::kValid.of(m.stream_o) == 0) continue;
        const auto number = static_cast<unsigned>(stream::kNumber.of(m.stream_o));
        ASSERT_EQ(number, taken++);
        const std::size_t at = turn * 8 + start + number;
        ASSERT_EQ(levels.size(), at + 1 + 2) << "two flops behind the sample";
        unsigned expected = 0;
        for (std::size_t i = at - std::min<std::size_t>(at, 8); i <= at; ++i) {
          expected = expected << 1U | (levels[i] ? 1U : 0U);
        }
        if (at >= 8) {
          ASSERT_EQ(stream::kLevels.of(m.stream_o), expected);
        }
      }
    }
    ASSERT_EQ(taken, kSamples);
  }
}

TEST(DslPhyBlock, Reset_LineIsFreeAndTheFirstEdgeTakesABit) {
  mb4test::Block<Vdsl_phy> block;
  auto& m = block.model;
  m.bit_i = bits::kDrive(1);
  m.line_i = 1;
  m.rx_start_i = 0;
  block.clock();
  EXPECT_EQ(m.drive_o, 0);
  EXPECT_EQ(m.line_o, 1);
  EXPECT_EQ(stream::kValid.of(m.stream_o), 0U);
  m.rst_ni = 1;
  block.clock();
  EXPECT_EQ(m.drive_o, 1);
  EXPECT_EQ(m.line_o, 0);
}

}  // namespace
