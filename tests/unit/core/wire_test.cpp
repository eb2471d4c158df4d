// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/wire.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "tests/unit/core/arrivals.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

TEST(Wire, DelayLongerThanEdgeDistance_AllEdgesArrive) {
  EventQueue queue;
  Arrivals arrivals;
  Wire line(queue, 1000, {}, 1, 1, record, &arrivals);
  line.drive(0, 0);
  line.drive(100, 1);
  line.drive(150, 0);
  EXPECT_EQ(queue.size(), 3U);
  while (!queue.empty()) queue.run_next();
  EXPECT_EQ(arrivals, (Arrivals{{1000, 0}, {1100, 1}, {1150, 0}}));
}

TEST(Wire, ZeroDelay_ArrivesInsideTheCall) {
  EventQueue queue;
  Arrivals arrivals;
  Wire line(queue, 0, {}, 1, 0, record, &arrivals);
  line.drive(7, 1);
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(arrivals, (Arrivals{{7, 1}}));
}

// `count` edges `distance` apart through a wire with faults; what arrives.
Arrivals edges(const WireFaults& faults, std::uint64_t seed, unsigned count, Time distance,
               Time delay = 1000) {
  EventQueue queue;
  Arrivals arrivals;
  Wire wire(queue, delay, faults, seed, 1, record, &arrivals);
  for (unsigned i = 0; i < count; ++i) {
    const Time now = (i + 1) * distance;
    while (queue.next_time() <= now) queue.run_next();
    wire.drive(now, i & 1U);
  }
  const Time end = (count + 1) * distance + delay + faults.jitter;
  while (queue.next_time() <= end) queue.run_next();
  return arrivals;
}

TEST(Wire, Jitter_EveryEdgeIsZeroToJitterLateAndBothEndsAreReached) {
  constexpr Time kJitter = 500;
  constexpr Time kDistance = 10'000;
  const WireFaults faults{kJitter, 0, 0, 0};
  const Arrivals arrivals = edges(faults, 7, 20'000, kDistance);
  ASSERT_EQ(arrivals.size(), 20'000U);
  Time sum = 0;
  Time least = kNever;
  Time most = 0;
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    EXPECT_EQ(arrivals[i].second, i & 1U);
    const Time late = arrivals[i].first - (i + 1) * kDistance - 1000;
    ASSERT_LE(late, kJitter);
    least = std::min(least, late);
    most = std::max(most, late);
    sum += late;
  }
  EXPECT_EQ(least, 0U);
  EXPECT_EQ(most, kJitter);
  EXPECT_NEAR(static_cast<double>(sum) / 20'000, 250, 5);
  EXPECT_EQ(edges(faults, 7, 1000, kDistance), edges(faults, 7, 1000, kDistance));
  EXPECT_NE(edges(faults, 7, 1000, kDistance), edges(faults, 8, 1000, kDistance));
}

TEST(Wire, JitterAboveEdgeDistance_EdgesNeverOvertake) {
  const Arrivals arrivals = edges({5000, 0, 0, 0}, 3, 5000, 100, 0);
  ASSERT_EQ(arrivals.size(), 5000U);
  for (std::size_t i = 1; i < arrivals.size(); ++i) {
    EXPECT_GE(arrivals[i].first, arrivals[i - 1].first);
    EXPECT_NE(arrivals[i].second, arrivals[i - 1].second);
  }
}

TEST(Wire, Skew_DelaysFallingOrRisingEdgesOnly) {
  EXPECT_EQ(edges({0, 300, 0, 0}, 1, 4, 10'000),
            (Arrivals{{11'300, 0}, {21'000, 1}, {31'300, 0}, {41'000, 1}}));
  EXPECT_EQ(edges({0, -300, 0, 0}, 1, 4, 10'000),
            (Arrivals{{11'000, 0}, {21'300, 1}, {31'000, 0}, {41'300, 1}}));
}

TEST(Wire, Glitches_ComeAtTheirRateWithTheirWidth) {
  EventQueue queue;
  Arrivals arrivals;
  constexpr Time kWidth = 4000;
  const Wire wire(queue, 0, {0, 0, 100'000, kWidth}, 5, 1, record, &arrivals);
  while (queue.next_time() <= kPsPerSecond / 10) queue.run_next();
  ASSERT_GT(arrivals.size(), 2U);
  EXPECT_NEAR(static_cast<double>(arrivals.size()) / 2, 10'000, 300);
  for (std::size_t i = 0; i + 1 < arrivals.size(); i += 2) {
    EXPECT_EQ(arrivals[i].second, 0U);
    EXPECT_EQ(arrivals[i + 1].second, 1U);
    EXPECT_EQ(arrivals[i + 1].first - arrivals[i].first, kWidth);
  }
}

TEST(Wire, Stuck_HidesEdgesUntilItIsFree) {
  EventQueue queue;
  Arrivals arrivals;
  Wire wire(queue, 0, {}, 1, 1, record, &arrivals);
  wire.stick(10, false);
  wire.drive(20, 0);
  wire.drive(30, 1);
  wire.stick(40, std::nullopt);
  EXPECT_EQ(arrivals, (Arrivals{{10, 0}, {40, 1}}));
}

// The delay becomes shorter: edges that are on their way still arrive first.
TEST(Wire, DelayShrinks_OrderIsKept) {
  EventQueue queue;
  Arrivals arrivals;
  Wire wire(queue, 1000, {}, 1, 1, record, &arrivals);
  wire.drive(0, 0);
  wire.set_delay(0);
  wire.drive(500, 1);
  wire.set_delay(100);
  wire.drive(950, 0);
  while (!queue.empty()) queue.run_next();
  EXPECT_EQ(arrivals, (Arrivals{{1000, 0}, {1000, 1}, {1050, 0}}));
}

}  // namespace
}  // namespace mb4test
