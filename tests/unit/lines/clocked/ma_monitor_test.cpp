// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/ma_monitor.hpp"

#include <gtest/gtest.h>

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kPeriod = 100'000;

// 10 rising edges from `start` on, low 40 %, high 60 %; the last low phase is 45 %.
void frame(MaMonitor& monitor, Time start) {
  for (Time i = 0; i < 10; ++i) {
    monitor.edge(start + i * kPeriod, false);
    monitor.edge(start + i * kPeriod + (i == 9 ? 45'000 : 40'000), true);
  }
}

TEST(MaMonitor, OneFrame_CountsEdgesAndWidths) {
  MaMonitor monitor;
  frame(monitor, 1'000'000);
  const MaFrame last = monitor.last(2'045'000);
  EXPECT_EQ(monitor.frames(), 1U);
  EXPECT_EQ(last.start, 1'000'000U);
  EXPECT_EQ(last.rising, 10U);
  EXPECT_EQ(last.falling, 10U);
  EXPECT_EQ(last.min_low, 40'000U);
  EXPECT_EQ(last.max_low, 45'000U);
  EXPECT_EQ(last.min_high, 60'000U);
  EXPECT_EQ(last.max_high, 60'000U);
  EXPECT_TRUE(last.rest_level);
  EXPECT_EQ(last.rest, 100'000U);
}

TEST(MaMonitor, RestLow_IsReportedWithItsLengthAndLevel) {
  MaMonitor monitor;
  frame(monitor, 1'000'000);
  monitor.edge(2'000'000, false);  // CDM = 1
  monitor.edge(5'000'000, true);   // MA back to 1 between the frames: no part of a frame
  frame(monitor, 6'000'000);
  const MaFrame first = monitor.last(6'945'000);
  EXPECT_EQ(first.start, 1'000'000U);
  EXPECT_FALSE(first.rest_level);
  EXPECT_EQ(first.rest, 3'000'000U);
  const MaFrame second = monitor.last(9'000'000);
  EXPECT_EQ(second.start, 6'000'000U);
  EXPECT_EQ(second.rising, 10U);
  EXPECT_EQ(monitor.frames(), 2U);
}

TEST(MaMonitor, RunningFrame_IsKnownAsRunning) {
  MaMonitor monitor;
  EXPECT_FALSE(monitor.running(0));
  frame(monitor, 1'000'000);
  EXPECT_TRUE(monitor.running(2'000'000));
  EXPECT_FALSE(monitor.running(1'945'000 + 140'000));  // falling #1 to rising #2: 140 ns
}

}  // namespace
}  // namespace mb4test
