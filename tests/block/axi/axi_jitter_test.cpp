// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sampler by frames (docs/samplers.md): each edge of SLO moves by a random time, evenly spread
// over a part of the MA period, over 121 delays up to 12 periods and all phases of the clock. Each
// frame has another delay. The words that come are compared with those that were sent, the eyes
// with what follows from the samples. MB4_AXI_JITTER_FRAMES: frames of a row.
#include <cstdio>
#include <memory>
#include <ostream>
#include <string>

#include "Vaxi_channel_frames.h"
#include "tests/block/axi/axi_frames_bench.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/environment.hpp"

namespace mb4test {
namespace {

using Line = AxiFrames<Vaxi_channel_frames>;

constexpr unsigned kBits = 26, kHalf = 5;

struct Count {
  unsigned frames = 0, bad = 0, wrong = 0;  // wrong: another position as good
};

struct Row {
  const char* name;
  unsigned percent;  // jitter of SLO, peak to peak, of T_MA
  int late_rise;     // percent of T_MA
  unsigned glitch;   // clocks of a glitch in each frame, somewhere between acknowledge and end
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

unsigned frames_of(unsigned usual) {
  return static_cast<unsigned>(number("MB4_AXI_JITTER_FRAMES", usual));
}

Count run(const Row& row, unsigned frames, bool fresh = false) {
  Dice dice;
  Count count;
  auto line = std::make_unique<Line>(kBits, kHalf);
  const std::int64_t period = line->period();
  const auto prepare = [&](Line& each) {
    each.jitter = [&dice, &row, period] {
      return period * row.percent / 100 * dice.below(4096) / 4096;
    };
    each.late_rise = period * row.late_rise / 100;
  };
  prepare(*line);
  for (unsigned i = 0; i < frames && !testing::Test::HasFatalFailure(); ++i) {
    if (fresh) {
      line = std::make_unique<Line>(kBits, kHalf);
      prepare(*line);
    }
    // The negative part of the skew goes into the delay.
    line->delay = period * dice.below(121) / 10 + dice.below(Line::kUnit) +
                  std::max<std::int64_t>(0, -line->late_rise);
    line->slave.busy = dice.below(8) == 0 ? dice.below(30) : 0;
    if (row.glitch != 0) {
      // From the acknowledge on, by the nominal times; the last bit has no end there.
      const std::uint64_t first = line->now() + 25 + static_cast<std::uint64_t>(line->delay / 1024);
      const unsigned length = (2 + line->slave.busy + kBits + 8) * 2 * kHalf;
      line->glitch(first + dice.below(length), row.glitch);
    }
    const std::uint64_t sent = dice.below(1U << kBits);
    line->frame(sent);
    ++count.frames;
    const bool good = line->good() && line->position() == sent;
    if (!good) ++count.bad;
    if (!good && line->good()) ++count.wrong;
    EXPECT_EQ(line->eye(), line->expected());
    if (testing::Test::HasFailure()) break;
  }
  return count;
}

void print(const Row& row, const Count& count) {
  std::printf(
      "%s, jitter %u %%, rising edges %d %% late: %u of %u words bad, %u of them with a CRC that "
      "fits\n",
      row.name, row.percent, row.late_rise, count.bad, count.frames, count.wrong);
}

constexpr Row kGood[] = {{"Jitter55", 55, 0, 0},
                         {"Jitter45RiseLate", 45, 10, 0},
                         {"Jitter45FallLate", 45, -10, 0},
                         {"Jitter30Glitch", 30, 0, 1},
                         {"Jitter30Glitch2", 30, 0, 2}};

class AxiFrameSampler : public testing::TestWithParam<Row> {};

TEST_P(AxiFrameSampler, UpToItsLimit_NoWordIsBad) {
  const Count count = run(GetParam(), frames_of(20'000));
  print(GetParam(), count);
  EXPECT_EQ(count.bad, 0U) << "of " << count.frames;
}

// A reset, and a word that comes at once.
TEST_P(AxiFrameSampler, FirstFrameAfterReset_IsAsGoodAsTheOthers) {
  const Count count = run(GetParam(), frames_of(20'000) / 10, true);
  EXPECT_EQ(count.bad, 0U) << "of " << count.frames;
}

INSTANTIATE_TEST_SUITE_P(Rows, AxiFrameSampler, testing::ValuesIn(kGood),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(AxiFrameSamplerBeyond, Jitter60_FewerThanOneIn10000) {
  const Row row{"Jitter60", 60, 0, 0};
  const Count count = run(row, frames_of(20'000));
  print(row, count);
  EXPECT_LT(std::uint64_t{count.bad} * 10'000, count.frames) << "of " << count.frames;
}

TEST(AxiFrameSamplerBeyond, MoreJitter_BadWordsAreCounted) {
  unsigned last = 0;
  for (const unsigned percent : {65U, 70U, 80U}) {
    const Row row{"Beyond", percent, 0, 0};
    const Count count = run(row, frames_of(20'000) / 4);
    print(row, count);
    last = count.bad;
  }
  EXPECT_GT(last, 0U) << "the test could see nothing";
}

}  // namespace
}  // namespace mb4test
