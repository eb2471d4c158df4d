// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Sign, Gray code, turns, and the total position across the roll-over.

#include "mb4/position.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace {
namespace position_test {

using mb4::Error;
using mb4::PositionTracker;

TEST(Position, Sign_IsTwosComplementOfTheGivenBits) {
  EXPECT_EQ(mb4::to_signed(0x1FF, 10), 511);
  EXPECT_EQ(mb4::to_signed(0x200, 10), -512);
  EXPECT_EQ(mb4::to_signed(0x3FF, 10), -1);
  EXPECT_EQ(mb4::to_signed(0xFC00, 10), 0);  // bits above do not matter
  EXPECT_EQ(mb4::to_signed(1, 1), -1);
  EXPECT_EQ(mb4::to_signed(~std::uint64_t{0}, 64), -1);
  EXPECT_EQ(mb4::to_signed(std::uint64_t{1} << 63, 64), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(mb4::to_signed(std::uint64_t{1} << 62, 63), -(std::int64_t{1} << 62));
}

// Neighbours differ in one bit: that is what makes it a Gray code; and the way back fits.
TEST(Position, Gray_NeighboursDifferInOneBitAndRoundTrip) {
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const std::uint64_t gray = mb4::binary_to_gray(i);
    EXPECT_EQ(__builtin_popcountll(gray ^ mb4::binary_to_gray(i + 1)), 1);
    EXPECT_EQ(mb4::gray_to_binary(gray), i);
  }
  EXPECT_EQ(mb4::gray_to_binary(0xD), 9U);  // 1101 is 9 in the usual table
  for (const std::uint64_t wide : {~std::uint64_t{0}, std::uint64_t{0x8000000000000001}}) {
    EXPECT_EQ(mb4::gray_to_binary(mb4::binary_to_gray(wide)), wide);
  }
}

TEST(Position, Turns_AreAboveTheAngle) {
  const auto turns = mb4::split_turns(0xFFABC12345, 12, 20);  // bits 39:32 are not its own
  ASSERT_TRUE(turns.ok());
  EXPECT_EQ(turns->multi, 0xABCU);
  EXPECT_EQ(turns->single, 0x12345U);
  EXPECT_EQ(mb4::split_turns(0x1234, 0, 13)->multi, 0U);
  EXPECT_EQ(mb4::split_turns(0x1234, 13, 0)->multi, 0x1234U);
  EXPECT_EQ(mb4::split_turns(~std::uint64_t{0}, 1, 63)->multi, 1U);
  EXPECT_EQ(mb4::split_turns(0, 0, 0).error(), Error::kInvalidArgument);
  EXPECT_EQ(mb4::split_turns(0, 0, 64).error(), Error::kInvalidArgument);
  EXPECT_EQ(mb4::split_turns(0, 40, 25).error(), Error::kInvalidArgument);
}

// Twelve bits, 1000 up and 3000 down at different speeds: the sum of the steps is the answer.
TEST(Tracker, UpAndDownOverRollOver_CountsAllTurns) {
  for (const std::int64_t step : {1, 7, 100, 2047, -1, -7, -100, -2047}) {
    PositionTracker tracker(12);
    std::int64_t truth = 4000;
    for (int i = 0; i < 500; ++i) {
      const auto total = tracker.update(static_cast<std::uint64_t>(truth) & 0xFFF);
      ASSERT_TRUE(total.ok());
      ASSERT_EQ(*total, truth) << step << " at " << i;
      truth += step;
    }
  }
}

TEST(Tracker, HalfARange_IsAJumpAndDoesNoHarm) {
  PositionTracker tracker(12);
  ASSERT_TRUE(tracker.update(10).ok());
  EXPECT_EQ(tracker.update(10 + 2048).error(), Error::kJump);
  EXPECT_EQ(*tracker.update(11), 11);
  tracker.reset();
  EXPECT_EQ(*tracker.update(2058), 2058);
}

TEST(Tracker, MaxStep_IsTheLimitBothWays) {
  PositionTracker tracker(12, 5);
  EXPECT_EQ(*tracker.update(2), 2);
  EXPECT_EQ(tracker.update(8).error(), Error::kJump);
  EXPECT_EQ(tracker.update(4092).error(), Error::kJump);
  EXPECT_EQ(*tracker.update(4093), -3);
  EXPECT_EQ(*tracker.update(2), 2);
}

TEST(Tracker, WrongFigures_AreInvalidArguments) {
  EXPECT_EQ(PositionTracker(0).update(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(PositionTracker(65).update(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(PositionTracker(12, 2048).update(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(PositionTracker(12).update(0x1000).error(), Error::kInvalidArgument);
}

TEST(Tracker, SixtyFourBits_StopAtTheEndOfTheTotal) {
  constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();
  PositionTracker up(64);
  ASSERT_TRUE(up.update(static_cast<std::uint64_t>(kHighest) - 1).ok());
  EXPECT_EQ(*up.update(static_cast<std::uint64_t>(kHighest)), kHighest);
  EXPECT_EQ(up.update(static_cast<std::uint64_t>(kHighest) + 1).error(), Error::kJump);
  PositionTracker down(64);
  ASSERT_TRUE(down.update(std::uint64_t{1} << 63).ok());  // as the total: the lowest
  EXPECT_EQ(down.update((std::uint64_t{1} << 63) - 1).error(), Error::kJump);
}

static_assert(mb4::to_signed(0x80, 8) == -128);
static_assert(mb4::split_turns(0x35, 4, 4)->multi == 3);

}  // namespace position_test
}  // namespace
