// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/clocked_line.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lines/clocked/chain_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kPeriod = 100 * kPsPerNs;
constexpr Time kStart = 1000 * kPsPerNs;

// A line driven at the chip's MA pin; records the chip's SL pin.
struct LineBench {
  explicit LineBench(Time round_trip)
      : line(
            queue, config(round_trip),
            [](Time now, void* receiver, bool level) {
              static_cast<ChainBench::Edges*>(receiver)->emplace_back(now, level);
            },
            &sl) {
    line.chain().add(std::make_unique<BissCSlave>(constant_slave(8, 0xA5, 0), 1));
  }
  void run_until(Time time) {
    while (queue.next_time() <= time) queue.run_next();
  }
  void ma(Time time, bool level) {
    run_until(time);
    line.drive(time, level, false);
  }
  // SL, sampled `sample_after` each rising edge.
  std::string frame(Time start, unsigned risings, Time sample_after) {
    std::string bits;
    for (unsigned i = 0; i < risings; ++i) {
      queue.post(start + i * kPeriod + kPeriod / 2 + sample_after,
                 [&] { bits += line.sl() ? '1' : '0'; });
    }
    ma(start, false);
    for (unsigned i = 0; i < risings; ++i) {
      ma(start + i * kPeriod + kPeriod / 2, true);
      if (i + 1 < risings) ma(start + (i + 1) * kPeriod, false);
    }
    run_until(start + (risings + 20) * kPeriod);
    return bits;
  }

  static ClockedConfig config(Time round_trip) {
    ClockedConfig config;
    config.delay = round_trip;
    return config;
  }

  EventQueue queue;
  ChainBench::Edges sl;
  ClockedLine line;
};

TEST(Line, RoundTripDelay_AppearsOnceBetweenMaAndSl) {
  // Also odd picoseconds and more than one period.
  for (const Time delay : {Time{0}, Time{1}, Time{33'333}, Time{106'000}, Time{1'234'567}}) {
    LineBench bench(delay);
    bench.frame(kStart, 13, 0);
    EXPECT_EQ(bench.line.round_trip(), delay);
    ASSERT_FALSE(bench.sl.empty());
    EXPECT_EQ(bench.sl.front(), std::make_pair(kStart + 3 * kPeriod / 2 + delay, false)) << delay;
  }
}

TEST(Line, LongDelay_CarriesTheWholeFrame) {
  LineBench bench(10 * kPeriod + 7);
  EXPECT_EQ(bench.frame(kStart, 13, 10 * kPeriod + 7 + kPeriod / 2),
            "1010" + binary(0xA5, 8) + "0");
}

TEST(Line, FlippedBits_AreInvertedInOneFrameOnly) {
  LineBench bench(0);
  bench.line.faults().flip_next_frame({1, 2, 9});  // CDS, first and last data bit
  EXPECT_EQ(bench.frame(kStart, 13, kPeriod / 2),
            "1011"
            "00100100"
            "0");
  EXPECT_EQ(bench.frame(kStart + 100 * kPeriod, 13, kPeriod / 2),
            "1010"
            "10100101"
            "0");
}

// MA stops in an inverted bit, as BREAK can do it; the slave times out, and SLO stays 1.
TEST(Line, FrameCutOffInAFlippedBit_RestsHighAfterTheTimeout) {
  LineBench bench(20);
  bench.line.faults().flip_next_frame({2});
  EXPECT_EQ(bench.frame(kStart, 5, kPeriod / 2), "10100");
  bench.run_until(kStart + 1000 * kPeriod);
  EXPECT_TRUE(bench.line.sl());
  EXPECT_EQ(bench.frame(kStart + 1000 * kPeriod, 13, kPeriod / 2),
            "1010"
            "10100101"
            "0");
}

TEST(Line, BitsPlannedByFrame_AreInvertedInThatFrame) {
  LineBench bench(10'000);
  bench.line.faults().flip_frame(3, {2});
  bench.line.faults().flip_frame(2, {9});
  bench.line.faults().flip_frame(2, {1});
  unsigned told = 0;
  const FlipWatch watch{[](void* count) { ++*static_cast<unsigned*>(count); }, &told};
  bench.line.faults().flip_frame(4, {0}, watch);  // the start bit itself
  bench.line.faults().flip_frame(400, {0}, watch);
  const char* const expected[] = {"1010101001010", "1011101001000", "1010001001010",
                                  "1000101001010", "1010101001010"};
  for (unsigned frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(bench.frame(kStart + frame * 100 * kPeriod, 13, kPeriod / 2), expected[frame])
        << "frame " << frame + 1;
  }
  EXPECT_EQ(told, 1U);
}

TEST(Line, StuckLow_ThenReleased_FollowsTheSlaveAgain) {
  LineBench bench(0);
  bench.line.faults().stick(false);
  bench.line.refresh(10);
  EXPECT_FALSE(bench.line.sl());
  EXPECT_EQ(bench.frame(kStart, 13, kPeriod / 2), std::string(13, '0'));
  bench.line.faults().stick(std::nullopt);
  bench.line.refresh(kStart + 90 * kPeriod);
  EXPECT_TRUE(bench.line.sl());
  EXPECT_EQ(bench.frame(kStart + 100 * kPeriod, 13, kPeriod / 2),
            "1010"
            "10100101"
            "0");
}

TEST(Line, StuckHigh_NeverFalls) {
  LineBench bench(50);
  bench.line.faults().stick(true);
  bench.frame(kStart, 13, 0);
  EXPECT_TRUE(bench.sl.empty());
}

}  // namespace
}  // namespace mb4test
