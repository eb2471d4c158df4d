// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/delay_line.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace mb4::sim {
namespace {

using Arrivals = std::vector<std::pair<Time, unsigned>>;

void record(Time now, void* receiver, unsigned levels) {
  static_cast<Arrivals*>(receiver)->emplace_back(now, levels);
}

TEST(DelayLine, DelayLongerThanEdgeDistance_AllEdgesArrive) {
  EventQueue queue;
  Arrivals arrivals;
  DelayLine line(queue, 1000, record, &arrivals);
  line.drive(0, 0);
  line.drive(100, 1);
  line.drive(150, 0);
  EXPECT_EQ(queue.size(), 3U);
  while (!queue.empty()) queue.run_next();
  EXPECT_EQ(arrivals, (Arrivals{{1000, 0}, {1100, 1}, {1150, 0}}));
}

TEST(DelayLine, ZeroDelay_ArrivesInsideTheCall) {
  EventQueue queue;
  Arrivals arrivals;
  DelayLine line(queue, 0, record, &arrivals);
  line.drive(7, 1);
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(arrivals, (Arrivals{{7, 1}}));
}

}  // namespace
}  // namespace mb4::sim
