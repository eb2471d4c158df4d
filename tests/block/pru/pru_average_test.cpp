// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The average of the sample points in pru_core: the sequences of the rulings, and when it is on.
#include <vector>

#include "tests/block/pru/pru_frames.hpp"

namespace mb4test {
namespace {

constexpr unsigned kPublished = 5;  // quirks: SMA_WRAP, EXTRA_10
constexpr unsigned kUsual = 1;
constexpr std::uint32_t kAverage = 1;
constexpr std::uint32_t kCrcError = 8;

struct Signals {
  unsigned measured;
  unsigned used;
  bool after;  // the byte after RAW_DATA
  std::uint32_t flags;
};

// Frames whose transition bytes have these sample points.
template <typename Bench>
std::vector<Signals> signals_of(unsigned quirks, const std::vector<unsigned>& points) {
  constexpr unsigned kZeros[] = {5, 6, 7, 8, 1, 2, 3, 4};  // of SP 0 to 7, the table of the text
  PruFrames<Bench> frames(quirks);
  std::vector<Signals> all;
  for (const unsigned point : points) {
    frames.bench.delay = 1'000'000 - kZeros[point] * 125'000 + 60'000;
    frames.send(0x123);
    if (all.empty()) {
      frames.start(1);
    } else {
      frames.frame();
    }
    const std::uint32_t word = frames.bench.read(prureg::kAddrSignals);
    all.push_back({word >> 8U & 7U, word >> 12U & 7U, (word >> 16U & 1U) != 0, frames.flags()});
    EXPECT_EQ(all.back().measured, point);
    EXPECT_EQ(frames.position(), 0x123U);
  }
  return all;
}

template <typename Bench>
void check_sequences() {
  for (const unsigned quirks : {kUsual, kPublished}) {
    const bool wraps = quirks == kPublished;
    const auto first = signals_of<Bench>(quirks, {5, 5, 5, 5, 6});
    for (unsigned i = 0; i < 5; ++i) {
      EXPECT_EQ(first[i].used, 5U);
      EXPECT_EQ(first[i].flags, i < 4 ? 0U : kAverage);
    }
    const auto second = signals_of<Bench>(quirks, {4, 5, 4, 5, 6, 7});
    EXPECT_EQ(second[4].used, 4U);
    EXPECT_EQ(second[5].used, 5U);
    const auto third = signals_of<Bench>(quirks, {0, 7, 0, 7, 0, 7});
    for (const unsigned i : {4U, 5U}) {
      EXPECT_EQ(third[i].used, wraps ? 3U : 7U);
      EXPECT_EQ(third[i].after, !wraps || i == 5);
    }
    // As published a point that goes from 0 to 7 makes a frame bad.
    EXPECT_EQ(third[5].flags & kCrcError, wraps ? kCrcError : 0U);
  }
}

TEST(PruAverage, Sequences_UseThePointsOfTheRulings) {
  check_sequences<PruBench200>();
  check_sequences<PruBench80>();
}

// R-P12: off for four frames after a change of FREQUENCY; a write of the same value is none; never
// at 10 MHz.
template <typename Bench>
void check_changes() {
  PruFrames<Bench> frames;
  frames.bench.delay = 60'000;
  frames.send(0x5A5);
  frames.start(1);
  const auto average = [&frames] { return frames.flags() & kAverage; };
  for (unsigned i = 2; i <= 6; ++i) {
    frames.frame();
    EXPECT_EQ(average(), i < 5 ? 0U : 1U) << "frame " << i;
  }
  frames.bench.write(prureg::kAddrLengths, 1U << 16U, 4);
  frames.frame();
  frames.frame();
  EXPECT_EQ(average(), 1U) << "the same value";
  for (const unsigned mhz : {2U, 5U, 10U, 1U}) {
    frames.bench.write(prureg::kAddrLengths, mhz << 16U, 4);
    frames.frame();  // its end reads the value
    frames.set_rate(mhz);
    for (unsigned i = 1; i <= 6; ++i) {
      frames.frame();
      EXPECT_EQ(average(), i < 5 || mhz == 10 ? 0U : 1U) << mhz << " MHz, frame " << i;
      EXPECT_EQ(frames.flags() & ~kAverage, 0U);
    }
  }
}

TEST(PruAverage, ChangeOfFrequency_TurnsItOffForFourFrames) {
  check_changes<PruBench200>();
  check_changes<PruBench80>();
}

}  // namespace
}  // namespace mb4test
