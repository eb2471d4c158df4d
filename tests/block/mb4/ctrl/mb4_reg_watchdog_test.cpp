// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The time limits of a control communication alone: page 34, Table 58; decision 24.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_reg_watchdog.h"
#include "tests/support/model_context.hpp"

namespace {

class Watchdog : public mb4test::Block<Vmb4_reg_watchdog> {
 public:
  explicit Watchdog(unsigned freqr) : limit(4096ULL * 2 * (2ULL << freqr)) {
    model.freqr_i = static_cast<std::uint8_t>(freqr);
    model.watch_i = model.clear_i = model.live_i = model.tick_i = 0;
    reset();
    model.watch_i = model.live_i = model.tick_i = 1;
  }
  void run(std::uint64_t clocks) {
    for (std::uint64_t i = 0; i < clocks; ++i) clock();
  }
  const std::uint64_t limit;  // half MA periods
};

TEST(RegWatchdogBlock, EveryFreqr_ExpiresAfter4096RegisterClocksAndStallsAnEighthLater) {
  for (unsigned freqr = 0; freqr < 8; ++freqr) {
    Watchdog watchdog(freqr);
    auto& m = watchdog.model;
    watchdog.run(watchdog.limit - 1);
    EXPECT_EQ(m.expired_o, 0) << freqr;
    watchdog.run(1);
    EXPECT_EQ(m.expired_o, 1) << freqr;
    watchdog.run(watchdog.limit / 8 - 1);
    EXPECT_EQ(m.stalled_o, 0) << freqr;
    watchdog.run(1);
    EXPECT_EQ(m.stalled_o, 1) << freqr;
    watchdog.run(1000);
    EXPECT_EQ(m.expired_o, 1) << "stays, FREQR " << freqr;
    EXPECT_EQ(m.stalled_o, 1) << "stays, FREQR " << freqr;
    m.clear_i = 1;
    watchdog.run(1);
    m.clear_i = 0;
    EXPECT_EQ(m.expired_o, 0) << freqr;
    EXPECT_EQ(m.stalled_o, 0) << freqr;
  }
}

TEST(RegWatchdogBlock, NotWatchedOrNoTick_TimeStandsStill) {
  Watchdog watchdog(0);
  auto& m = watchdog.model;
  watchdog.run(watchdog.limit - 1);
  m.tick_i = 0;
  watchdog.run(100);
  EXPECT_EQ(m.expired_o, 0);
  m.watch_i = 0;
  watchdog.run(1);
  m.watch_i = m.tick_i = 1;
  watchdog.run(watchdog.limit - 1);
  EXPECT_EQ(m.expired_o, 0) << "counts anew";
  watchdog.run(1);
  EXPECT_EQ(m.expired_o, 1);
}

// A frame that the host has not asked for is no stall.
TEST(RegWatchdogBlock, NoFrameRunsOrComes_ExpiresAndDoesNotStall) {
  Watchdog watchdog(2);
  watchdog.model.live_i = 0;
  watchdog.run(2 * watchdog.limit);
  EXPECT_EQ(watchdog.model.expired_o, 1);
  EXPECT_EQ(watchdog.model.stalled_o, 0);
  watchdog.model.live_i = 1;
  watchdog.run(watchdog.limit / 8);
  EXPECT_EQ(watchdog.model.stalled_o, 1);
}

}  // namespace
