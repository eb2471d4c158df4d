// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The counters of three channels alone (regmap/axi.rdl: FRAME_COUNT, CRC_ERROR_COUNT, LATE_COUNT).
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "Vaxi_counters.h"
#include "axi_regs.hpp"
#include "tests/block/axi/axi_bus.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = biss_axi::regs;

TEST(AxiCountersBlock, RandomEvents_AreCountedInTheirChannel) {
  using namespace mb4test::places::axi_pkg::event_t;
  mb4test::Dice dice;
  mb4test::Block<Vaxi_counters> block;
  Vaxi_counters& m = block.model;
  m.clear_i = m.index_i = 0;
  m.bus_i = 0;
  m.events_i = 0;
  block.reset();
  std::array<std::array<std::uint32_t, 3>, 3> expected{};
  for (int clock = 0; clock < 250'000; ++clock) {
    const auto events = static_cast<std::uint32_t>(clock < 200'000 ? kEnded(1) | kCrcError(1) |
                                                                         kLate.in(1, kAllBits)(1)
                                                                   : dice.below(1U << 21));
    m.events_i = events;
    m.clear_i = dice.below(clock < 200'000 ? 1'000'000 : 500) == 1;
    for (unsigned c = 0; c < 3; ++c) {
      const unsigned mine = events >> c * kAllBits;
      if (kEnded.of(mine) != 0 || kFailed.of(mine) != 0) ++expected[c][0];
      expected[c][1] = (expected[c][1] + kCrcError.of(mine)) & 0xFFFF;
      expected[c][2] = (expected[c][2] + kLate.of(mine)) & 0xFFFF;
      if (m.clear_i != 0) expected[c] = {};
    }
    block.clock();
    if (clock % 97 != 0) continue;
    m.events_i = 0;
    m.clear_i = 0;
    for (unsigned c = 0; c < 5; ++c) {
      m.index_i = static_cast<std::uint8_t>(c);
      const std::array<std::uint32_t, 3> want =
          c < 3 ? expected[c] : std::array<std::uint32_t, 3>{};
      ASSERT_EQ(mb4test::read_page(block, reg::kAddrFrameCount), want[0]) << c;
      ASSERT_EQ(mb4test::read_page(block, reg::kAddrCrcErrorCount), want[1]) << c;
      ASSERT_EQ(mb4test::read_page(block, reg::kAddrLateCount), want[2]) << c;
      ASSERT_EQ(mb4test::read_page(block, reg::kAddrSkipCount), 0U) << "not a word of this module";
    }
  }
}

}  // namespace
