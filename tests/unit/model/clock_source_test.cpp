// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "clock_source.hpp"

#include <gtest/gtest.h>

namespace mb4test {

using namespace mb4::sim;

namespace {

TEST(ClockSource, WholePeriod_HasEdgesEveryHalfPeriod) {
  ClockSource clock(20'000'000);
  EXPECT_EQ(clock.next(), 25'000U);
  EXPECT_TRUE(clock.edge());
  EXPECT_EQ(clock.next(), 50'000U);
  EXPECT_FALSE(clock.edge());
}

// 3 MHz has a half period of 166666.66 ps: after one second exactly 6 million edges.
TEST(ClockSource, FractionalPeriod_DoesNotDrift) {
  ClockSource clock(3'000'000);
  for (std::uint64_t k = 1; k <= 6'000'000; ++k) {
    if (k % 100'000 == 0) {
      ASSERT_EQ(clock.next(), k * kPsPerSecond / 6'000'000);
    }
    clock.edge();
  }
}

TEST(ClockSource, NoFrequency_NeverMoves) { EXPECT_EQ(ClockSource(0).next(), kNever); }

TEST(ClockSource, SkippedAhead_EdgesAreThoseOfAnUninterruptedClock) {
  ClockSource skipped(3'000'000);
  ClockSource stepped(3'000'000);
  const Time target = 123'456'789'012;
  skipped.skip_to(target);
  while (stepped.next() < target || stepped.level() != skipped.level()) stepped.edge();
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(skipped.next(), stepped.next());
    ASSERT_EQ(skipped.edge(), stepped.edge());
  }
}

}  // namespace
}  // namespace mb4test
