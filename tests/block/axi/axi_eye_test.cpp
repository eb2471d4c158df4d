// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The eyes of three channels alone (regmap/axi.rdl: EYE, EYE_LIMIT, EYE_ALARM).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "Vaxi_eye.h"
#include "axi_regs.hpp"
#include "tests/block/axi/axi_bus.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = biss_axi::regs;
namespace eye_t = mb4test::places::axi_pkg::eye_t;
namespace event_t = mb4test::places::axi_pkg::event_t;

constexpr unsigned kChannels = 3, kEyeBits = mb4test::places::axi_pkg::eye_t::kAllBits,
                   kEventBits = mb4test::places::axi_pkg::event_t::kAllBits, kNone = 31;

struct Shown {
  bool valid = false;
  unsigned width = 0, last = 0, smallest = kNone;
  unsigned point() const { return last - width / 2; }
  std::uint32_t word() const {
    if (!valid) return 1U << 30U;  // used
    const unsigned before = point() - (last + 1 - width), after = last - point();
    return 1U << 31U | 1U << 30U | after << 25U | before << 21U | smallest << 16U | point() << 8U |
           width;
  }
};

// Frames at random: each has an eye or none. EYE shows that of the channel of the index; the
// smallest is that since it was read, and a limit sets the alarms of narrower ones.
TEST(AxiEyeBlock, FramesAtRandom_AreShownWithTheirSmallestAndAlarms) {
  mb4test::Dice dice;
  mb4test::Block<Vaxi_eye> block;
  Vaxi_eye& m = block.model;
  m.clear_i = m.index_i = 0;
  m.bus_i = 0;
  m.events_i = 0;
  m.eyes_i = 0;
  block.reset();
  std::array<Shown, kChannels> shown{};
  unsigned limit = 0, alarms = 0, narrow = 0, pulses = 0;
  const auto put = [&] {
    std::uint64_t eyes = 0;
    for (unsigned c = 0; c < kChannels; ++c) {
      const std::uint64_t eye = eye_t::kValid(shown[c].valid) | eye_t::kUsed(1) |
                                eye_t::kWidth(shown[c].valid ? shown[c].width : dice.below(21)) |
                                eye_t::kPoint(shown[c].valid ? shown[c].point() : dice.below(20));
      eyes |= eye << (c * kEyeBits);
    }
    m.eyes_i = eyes;
  };
  put();
  for (int round = 0; round < 60'000 && !testing::Test::HasFailure(); ++round) {
    const unsigned c = dice.below(kChannels);
    switch (dice.below(6)) {
      case 0: {  // a frame with a width
        m.events_i = event_t::kEnded(1) << (c * kEventBits);
        block.clock();
        m.events_i = 0;
        Shown& one = shown[c];
        one.valid = true;
        one.width = 1 + dice.below(20);
        one.last = one.width - 1 + dice.below(21 - one.width);
        put();
        m.eval();
        const bool below = one.width < limit;
        EXPECT_EQ(m.alarm_o, below ? 1 : 0);
        pulses += m.alarm_o;
        if (dice.below(3) == 0) {  // a read in the clock in which the numbers change
          m.index_i = static_cast<std::uint8_t>(c);
          Shown now = one;
          now.smallest = std::min(one.smallest, one.width);
          EXPECT_EQ(mb4test::read_page(block, reg::kAddrEye), now.word());
          one.smallest = one.width;
        } else {
          block.clock();
        }
        m.eval();
        EXPECT_EQ(m.alarm_o, 0);
        one.smallest = std::min(one.smallest, one.width);
        if (below) alarms |= 1U << c;
        narrow += below ? 1 : 0;
        break;
      }
      case 1:  // one without, after a good one or not
        m.events_i = event_t::kFailed(1) << (c * kEventBits);
        block.clock();
        m.events_i = 0;
        shown[c].valid = false;
        put();
        block.clock();
        break;
      case 2:
        m.index_i = static_cast<std::uint8_t>(c);
        EXPECT_EQ(mb4test::read_page(block, reg::kAddrEye), shown[c].word());
        shown[c].smallest = shown[c].valid ? shown[c].width : kNone;
        break;
      case 3:
        m.index_i = static_cast<std::uint8_t>(kChannels + dice.below(13));
        EXPECT_EQ(mb4test::read_page(block, reg::kAddrEye), 0U);
        break;
      case 4:
        if (dice.below(4) == 0) {
          limit = dice.below(32);
          mb4test::write_page(block, reg::kAddrEyeLimit, 0xFFFFFFE0U | limit);
        }
        EXPECT_EQ(mb4test::read_page(block, reg::kAddrEyeLimit), limit);
        break;
      default:
        EXPECT_EQ(mb4test::read_page(block, reg::kAddrEyeAlarm), alarms);
        if (dice.below(3) == 0) {
          const unsigned cleared = dice.below(16);
          mb4test::write_page(block, reg::kAddrEyeAlarm, cleared);
          alarms &= ~cleared;
        } else if (dice.below(50) == 0) {
          m.clear_i = 1;
          block.clock();
          m.clear_i = 0;
          alarms = 0;
          for (Shown& one : shown) one.smallest = one.valid ? one.width : kNone;
        }
    }
  }
  EXPECT_GT(narrow, 1000U);
  EXPECT_EQ(pulses, narrow);
}

}  // namespace
