// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/ma_pulse_check.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kClock = 50'000;

// MA at whole clocks: levels alternate from 0 on at clock 100; returns the first complaint.
std::string run(const std::vector<std::uint64_t>& widths, unsigned half_clocks) {
  MaPulseCheck check;
  std::uint64_t clock = 100;
  bool level = false;
  const std::string* complaint = check.edge(clock * kClock, level, clock, half_clocks, kClock);
  for (const std::uint64_t width : widths) {
    clock += width;
    level = !level;
    if (complaint != nullptr) break;
    complaint = check.edge(clock * kClock, level, clock, half_clocks, kClock);
  }
  return complaint != nullptr ? *complaint : "";
}

TEST(MaPulseCheck, HalfPeriodsAndLonger_AreGood) {
  EXPECT_EQ(run({3, 3, 3, 1000, 3, 3}, 3), "");
  EXPECT_EQ(run({1, 1, 1, 1}, 1), "");
}

TEST(MaPulseCheck, OneClockShort_IsNamedWithLevelAndTime) {
  EXPECT_EQ(run({3, 2}, 3),
            "short MA pulse: high for 100000 ps (2 clocks) until 5250000 ps, needed are 3 clocks "
            "and 150000 ps");
  EXPECT_NE(run({2}, 3).find("low for 100000 ps"), std::string::npos);
}

// A reset or the clock switch could cut a pulse between two clock edges.
TEST(MaPulseCheck, CutBetweenClockEdges_IsFoundByCountAndByTime) {
  MaPulseCheck check;
  EXPECT_FALSE(check.edge(100'000, false, 2, 1, kClock));
  EXPECT_TRUE(check.edge(100'010, true, 2, 1, kClock)) << "no clock edge in between";
  MaPulseCheck glitch;
  EXPECT_FALSE(glitch.edge(100'000, false, 2, 1, kClock));
  EXPECT_TRUE(glitch.edge(100'010, true, 3, 1, kClock)) << "a clock edge that came too early";
  MaPulseCheck by_hand;
  EXPECT_FALSE(by_hand.edge(100'000, false, 2, 1, 0));
  EXPECT_FALSE(by_hand.edge(100'010, true, 3, 1, 0)) << "speed of the clock is not known";
  // Clock edges are rounded to picoseconds.
  MaPulseCheck rounded;
  EXPECT_FALSE(rounded.edge(100'001, false, 2, 1, kClock));
  EXPECT_FALSE(rounded.edge(150'000, true, 3, 1, kClock));
}

// A frame takes FREQS before its first falling edge and keeps it.
TEST(MaPulseCheck, FreqsChanges_LowCountsByItsBeginningHighByItsEnd) {
  MaPulseCheck check;
  EXPECT_FALSE(check.edge(100 * kClock, false, 100, 2, kClock));
  EXPECT_FALSE(check.edge(102 * kClock, true, 102, 10, kClock)) << "low began with 2";
  EXPECT_TRUE(check.edge(111 * kClock, false, 111, 10, kClock)) << "high ends with 10";
  EXPECT_EQ(check.shortest(), 2 * kClock);
  EXPECT_EQ(check.pulses(), 2U);
}

}  // namespace
}  // namespace mb4test
