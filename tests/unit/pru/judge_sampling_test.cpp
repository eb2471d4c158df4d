// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the judge samples SL, which sample it takes, and its average, against the numbers of the
// published text (3.2.1, 3.2.4.2.1, 3.2.4.2.5, 3.2.4.2.6) and of the facts.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/reference/pru/average.hpp"
#include "tests/unit/pru/judge_bench.hpp"

namespace {

using namespace pru_judge;
using namespace pru_judge_test;

// P-1. Tables 4 and 6: a code is 1 and half of it, and two dividers make 8 samples a period.
TEST(PruJudgeSampling, DividerCodes_GiveEightSamplesAPeriod) {
  struct Row {
    unsigned mhz;
    unsigned div0;
    unsigned div1;
    unsigned sampling_mhz;
  };
  constexpr Row kTable4[] = {
      {1, 0x17, 0x2, 8}, {2, 0x17, 0x0, 16}, {5, 0x8, 0x0, 40}, {10, 0x3, 0x0, 80}};
  for (const Row& row : kTable4) {
    const double ratio = (1 + 0.5 * row.div0) * (1 + 0.5 * row.div1);
    EXPECT_EQ(200 / ratio, row.sampling_mhz);
    const Rate rate{200'000'000, row.mhz};
    EXPECT_EQ(rate.period_ps(), 1'000'000 / row.mhz);
    for (unsigned j = 1; j <= 8; ++j) {
      EXPECT_EQ(rate.sample_clocks(j), static_cast<unsigned>(j * ratio)) << row.mhz << " " << j;
    }
    EXPECT_EQ(rate.sample_clocks(8), rate.period_clocks());
  }
  constexpr unsigned kRatio80[][2] = {{1, 10}, {2, 5}, {5, 2}, {10, 1}};
  for (const auto& [mhz, ratio] : kRatio80) {
    const Rate rate{80'000'000, mhz};
    EXPECT_EQ(rate.period_ps(), 1'000'000 / mhz);
    for (unsigned j = 1; j <= 8; ++j) EXPECT_EQ(rate.sample_clocks(j), j * ratio);
  }
}

// R-P6: 12 and 13 clocks in turn, the first half slot short.
TEST(PruJudgeSampling, HalfSlots_AreTurnedDown) {
  const auto clocks = [](unsigned mhz) {
    std::vector<unsigned> all;
    for (unsigned j = 1; j <= 8; ++j) all.push_back(Rate{200'000'000, mhz}.sample_clocks(j));
    return all;
  };
  EXPECT_EQ(clocks(2), (std::vector<unsigned>{12, 25, 37, 50, 62, 75, 87, 100}));
  EXPECT_EQ(clocks(10), (std::vector<unsigned>{2, 5, 7, 10, 12, 15, 17, 20}));
}

// R-P8: byte m ends m periods after rising edge 2. The edge of SL at the instant comes too late.
TEST(PruJudgeSampling, Bytes_EndWithTheirPeriod) {
  const Rate rate{200'000'000, 5};
  Trace sl;
  sl.edge(10'000 * kNs, false);
  const auto at = [&](Time rising_edge_2, SamplePhase phase = {}) {
    return Samples(rate, phase, sl, rising_edge_2);
  };
  const Samples samples = at(9'000 * kNs);
  EXPECT_EQ(samples.instant(0), 8'825 * kNs);
  EXPECT_EQ(samples.instant(7), 9'000 * kNs);
  EXPECT_EQ(samples.instant(15), 9'200 * kNs);
  EXPECT_EQ(at(9'800 * kNs).byte(1), 0xFF);
  EXPECT_EQ(at(9'800 * kNs, {0, true}).byte(1), 0xFE);
  EXPECT_EQ(at(9'801 * kNs).byte(1), 0xFE);
  EXPECT_EQ(at(9'800 * kNs, {kNs, false}).byte(1), 0xFE);
  EXPECT_EQ(at(10'001 * kNs).byte(0), 0xFE);
  EXPECT_EQ(at(9'900 * kNs).byte(1), 0xF0);
}

// The text's flow chart: bit number, and whether it lies in the byte after.
struct Point {
  bool next;
  unsigned bit;
};
Point flow_chart(unsigned raw) {
  int n = 0;
  for (unsigned bit = 0; bit < 8; ++bit) n += static_cast<int>(raw >> bit & 1U);
  const int x = 7 - n;
  if (x > 4) return {false, static_cast<unsigned>(x - 4)};
  if (x == 4) return {false, 0};  // R-P11
  const int y = 4 - x;
  return {true, static_cast<unsigned>(8 - y)};
}

// P-2. All 255 bytes by the flow chart, and the facts' table by number of ones.
TEST(PruJudgeSampling, EveryTransitionByte_SelectsTheSampleOfTheFacts) {
  constexpr Point kOfOnes[] = {{false, 3}, {false, 2}, {false, 1}, {false, 0},
                               {true, 7},  {true, 6},  {true, 5},  {true, 4}};
  for (unsigned raw = 0; raw < 255; ++raw) {
    const unsigned place = place_of(static_cast<std::uint8_t>(raw), false);
    const Point due = flow_chart(raw);
    EXPECT_EQ(bit_number(place), due.bit) << raw;
    EXPECT_EQ(place >= 8, due.next) << raw;
    const Point row = kOfOnes[__builtin_popcount(raw)];
    EXPECT_EQ(due.bit, row.bit) << raw;
    EXPECT_EQ(due.next, row.next) << raw;
  }
}

// The text's example: 11110101, six ones, bit 5 of the latest byte.
TEST(PruJudgeSampling, TheExample_GivesBit5OfTheByteAfter) {
  const unsigned place = place_of(0xF5, false);
  EXPECT_EQ(bit_number(place), 5U);
  EXPECT_GE(place, 8U);
}

// R-P12a: 4 behind the first low sample; in a clean byte the same as by the ones.
TEST(PruJudgeSampling, FirstLow_IsFourBehindTheFirstLowSample) {
  EXPECT_EQ(place_of(0xF5, true), 4U + 4);
  EXPECT_EQ(place_of(0x7F, true), 4U);
  EXPECT_EQ(place_of(0xFE, true), 7U + 4);
  for (unsigned ones = 0; ones < 8; ++ones) {
    const auto clean = static_cast<std::uint8_t>(0xFF00U >> ones);
    EXPECT_EQ(place_of(clean, true), place_of(clean, false)) << ones;
  }
}

// A line that is right in the one sample only, and wrong in the seven others of each bit.
TEST(PruJudgeSampling, LineRightInOneSample_IsReadForEachByte) {
  const std::string bits = word(0xA5C, 12, "10");
  for (const std::uint32_t clock_hz : {200'000'000U, 80'000'000U}) {
    for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
      JudgeSetup setup;
      setup.clock_hz = clock_hz;
      Bench bench(setup);
      bench.start(12, 8, mhz);
      bench.frame({0, false, bits});
      ASSERT_EQ(bench.judge.mhz(), mhz);
      for (unsigned raw = 0; raw < 255; ++raw) {
        const Point point = flow_chart(raw);
        const std::string line =
            "0000"
            "1"
            "1" +
            bits;  // three zeros after the acknowledge
        // Number of the sample of the acknowledge after rising edge 2; the byte is number 3.
        const unsigned own = (point.next ? 24 : 16) + 7 - point.bit;
        std::string samples(16, '1');
        samples += binary(raw, 8);
        while (samples.size() <= own + 8 * (line.size() - 1)) {
          const auto ahead = static_cast<unsigned>(samples.size()) + 7 - own;
          const char bit = line[samples.size() < own ? 0 : ahead / 8];
          const bool right = ahead % 8 == 7;
          samples += right == (bit == '1') ? '1' : '0';
        }
        const FrameReport report = bench.frame_of_samples(3, samples);
        ASSERT_EQ(report.complaints, std::vector<std::string>()) << raw;
        EXPECT_TRUE(report.good) << raw << " " << mhz;
        EXPECT_EQ(bench.judge.position(), 0xA5CU) << raw << " " << mhz;
        EXPECT_EQ(bench.judge.byte(kRawData), raw);
        EXPECT_EQ(bench.judge.byte(kLineDelay), mhz == 10 ? 5 : 3);
        EXPECT_EQ(bench.judge.value(kProcTime, 2), 3U);
        // The average begins anew, so that each frame uses its own sample.
        bench.judge.write(kRun, 0);
        bench.judge.write(kRun, 1);
        bench.frame({0, false, bits});
      }
    }
  }
}

// Runs frames whose transition bytes have these sample points, and gives SIGNALS after each.
std::vector<std::uint32_t> signals_of(const JudgeSetup& setup,
                                      const std::vector<unsigned>& points) {
  constexpr unsigned kZeros[] = {5, 6, 7, 8, 1, 2, 3, 4};  // of SP 0 to 7, the facts' table
  Bench bench(setup);
  bench.start(12, 8, 1);
  std::vector<std::uint32_t> all;
  for (const unsigned point : points) {
    bench.delay = kUs - kZeros[point] * 125 * kNs + 60 * kNs;
    const FrameReport report = bench.frame({0, false, word(0x123, 12)});
    // As published, a point that goes from 0 to 7 makes a frame bad.
    EXPECT_EQ(report.good, !(setup.sma_wrap && all.size() == 5 && points[0] == 0));
    EXPECT_EQ(bench.judge.byte(kFlags) & kSmaFlag, all.size() >= 4 ? 1 : 0) << all.size();
    all.push_back(bench.judge.read(kSignals));
  }
  return all;
}

unsigned measured(std::uint32_t signals) { return signals >> 8 & 7U; }
unsigned used(std::uint32_t signals) { return signals >> 12 & 7U; }
bool in_byte_after(std::uint32_t signals) { return (signals >> 16 & 1U) != 0; }

// P-3. The sequences of the rulings, by the true place and as published.
TEST(PruJudgeAverage, Sequences_UseThePointsOfTheLaw) {
  JudgeSetup published;
  published.sma_wrap = true;
  for (const JudgeSetup& setup : {JudgeSetup{}, published}) {
    const bool wraps = setup.sma_wrap;
    const auto first = signals_of(setup, {5, 5, 5, 5, 6});
    for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(used(first[i]), 5U);
    EXPECT_EQ(measured(first[4]), 6U);
    EXPECT_EQ(used(first[4]), 5U);

    const std::vector<unsigned> rising = {4, 5, 4, 5, 6, 7};
    const auto second = signals_of(setup, rising);
    for (unsigned i = 0; i < 6; ++i) EXPECT_EQ(measured(second[i]), rising[i]);
    EXPECT_EQ(used(second[4]), 4U);
    EXPECT_EQ(used(second[5]), 5U);

    const auto third = signals_of(setup, {0, 7, 0, 7, 0, 7});
    EXPECT_EQ(used(third[4]), wraps ? 3U : 7U);
    EXPECT_EQ(used(third[5]), wraps ? 3U : 7U);
    EXPECT_EQ(in_byte_after(third[4]), !wraps);  // its own place is in RAW_DATA
    EXPECT_TRUE(in_byte_after(third[5]));
  }
}

// On the circle of eight a half goes to the later sample, and 4 places either way are 4 earlier.
TEST(PruJudgeAverage, Halves_GoToTheLaterSample) {
  const auto of = [](const std::vector<unsigned>& places, unsigned own) {
    Average average;
    for (const unsigned place : places) average.add(place);
    EXPECT_TRUE(average.ready());
    return average.used(own, false);
  };
  EXPECT_EQ(of({8, 8, 9, 9}, 8), 9U);  // 0.5
  EXPECT_EQ(of({8, 8, 8, 9}, 8), 8U);  // 0.25
  EXPECT_EQ(of({7, 7, 8, 8}, 8), 8U);  // -0.5
  EXPECT_EQ(of({7, 7, 7, 8}, 8), 7U);  // -0.75
  EXPECT_EQ(of({4, 4, 4, 4}, 8), 4U);  // -4
  EXPECT_EQ(of({11, 11, 11, 11}, 8), 11U);
  EXPECT_EQ(of({4, 4, 4, 4}, 11), 12U);  // 4 is 12: one later
  EXPECT_EQ(of({11, 11, 11, 11}, 4), 3U);
  EXPECT_EQ(of({4, 4, 4, 4, 11, 11, 11, 11}, 11), 11U);  // only the last four
}

// R-P12: off for four frames after a change of the rate, a write of the same value is none, never
// at 10 MHz.
TEST(PruJudgeAverage, ChangeOfTheRate_TurnsItOff) {
  Bench bench;
  bench.delay = 60 * kNs;
  bench.start(12, 8, 1);
  const auto flags = [&](unsigned frames) {
    std::string text;
    for (unsigned i = 0; i < frames; ++i) {
      EXPECT_TRUE(bench.frame({0, false, word(i, 12)}).good);
      text += (bench.judge.byte(kFlags) & kSmaFlag) != 0 ? '1' : '0';
    }
    return text;
  };
  EXPECT_EQ(flags(6), "000011");
  bench.judge.write(kFrequency & ~3U, 1U << 16, 4);
  EXPECT_EQ(flags(2), "11");
  // Read after the frame, so this frame is as it was.
  bench.judge.write(kFrequency & ~3U, 5U << 16, 4);
  EXPECT_EQ(flags(1), "1");
  EXPECT_EQ(bench.judge.mhz(), 5U);
  EXPECT_EQ(flags(6), "000011");
  bench.judge.write(kFrequency & ~3U, 10U << 16, 4);
  EXPECT_EQ(flags(7), "1000000");
  bench.judge.write(kFrequency & ~3U, 2U << 16, 4);
  EXPECT_EQ(flags(7), "0000011");
  bench.start(12, 8, 2);
  EXPECT_EQ(flags(7), "0000011");  // frame 1 is at 1 MHz, and then the rate changes
}

// R-P12: a point counts in a frame with a bad CRC, not in one without acknowledge.
TEST(PruJudgeAverage, FrameWithoutAcknowledge_HasNoPoint) {
  Bench bench;
  bench.start(12, 8, 1);
  std::string bad = word(1, 12);
  bad[0] = '1';
  for (unsigned i = 0; i < 3; ++i) EXPECT_FALSE(bench.frame({0, false, bad}).good);
  Answer silent;
  silent.acknowledges = false;
  bench.frame(silent);
  bench.frame_without_ma();
  bench.frame({0, false, word(1, 12)});
  EXPECT_EQ(bench.judge.byte(kFlags), 0);
  bench.frame({0, false, word(1, 12)});
  EXPECT_EQ(bench.judge.byte(kFlags), kSmaFlag);
  bench.frame_without_ma();
  EXPECT_EQ(bench.judge.byte(kFlags), kSmaFlag | kNoSlaveFlag);
}

}  // namespace
