// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/replay/replay_slave.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <ostream>
#include <sstream>

#include "tests/unit/lines/clocked/chain_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kStart = 5 * kPsPerUs;

ReplaySlaveConfig ti_frame() {
  std::ifstream in(MB4_EXAMPLES "/ti-tidm-1010.edges");
  std::ostringstream text;
  text << in.rdbuf();
  ReplaySlaveConfig config;
  config.recording = parse_recording(text.str(), "ti-tidm-1010.edges");
  config.data_bits = 15;
  return config;
}

// TI TIDM-1010, reference stimulus: CDS 0, position 0111000001000, nE = nW = 1, CRC line bits
// 101110, stop 0.
const char* const kTiBits =
    "1010"
    "0111000001000"
    "11"
    "101110"
    "0";
constexpr unsigned kTiRisings = 15 + 6 + 5;

TEST(ReplaySlave, TiFrameByTime_ShowsTheRecordedBitsAndTimeout) {
  ChainBench bench;
  bench.chain.add(std::make_unique<ReplaySlave>(ti_frame()));
  EXPECT_EQ(bench.frame(kStart, kPsPerUs, kTiRisings), kTiBits);
  EXPECT_FALSE(bench.chain.idle());
  bench.run_until(kStart + 100 * kPsPerUs);
  EXPECT_TRUE(bench.chain.idle());
  EXPECT_EQ(bench.slo.back(), std::make_pair(kStart + 38 * kPsPerUs, true));
  EXPECT_EQ(bench.frame(200 * kPsPerUs, kPsPerUs, kTiRisings), kTiBits);
  EXPECT_EQ(bench.chain.slave(0).frames(), 2U);
}

TEST(ReplaySlave, TiFrameByClock_FollowsMaAtAnyFrequency) {
  for (const Time period : {100 * kPsPerNs, 400 * kPsPerNs, 4 * kPsPerUs}) {
    ChainBench bench;
    ReplaySlaveConfig config = ti_frame();
    config.play = ReplaySlaveConfig::Play::kClock;
    bench.chain.add(std::make_unique<ReplaySlave>(config));
    EXPECT_EQ(bench.frame(kStart, period, kTiRisings), kTiBits) << period;
    bench.run_until(1000 * kPsPerUs);
    const Time last = kStart + kTiRisings * period - period / 2;
    EXPECT_EQ(bench.slo.back(), std::make_pair(last + 3 * period / 2, true));
  }
}

TEST(ReplaySlave, RemainderAfterClockEdge_IsKept) {
  ChainBench bench;
  ReplaySlaveConfig config;
  // At 1 MHz rising edge 2 comes at 1500 ns: this slave answers 120 ns later.
  config.recording = parse_recording("ma_hz 1000000\n1620 0\n9000 1\n", "x");
  config.play = ReplaySlaveConfig::Play::kClock;
  bench.chain.add(std::make_unique<ReplaySlave>(config));
  bench.frame(kStart, 500 * kPsPerNs, 4);
  EXPECT_EQ(bench.slo.front(), std::make_pair(kStart + 870 * kPsPerNs, false));
}

TEST(ReplaySlave, RemainderLongerThanHalfAPeriod_BelongsToTheEarlierClockEdge) {
  ChainBench bench;
  ReplaySlaveConfig config;
  config.recording = parse_recording("ma_hz 1000000\n2200 0\n9000 1\n", "x");  // 700 ns after #2
  config.play = ReplaySlaveConfig::Play::kClock;
  bench.chain.add(std::make_unique<ReplaySlave>(config));
  bench.frame(kStart, 500 * kPsPerNs, 6);
  EXPECT_EQ(bench.slo.front(), std::make_pair(kStart + (750 + 700) * kPsPerNs, false));
}

// A capture of two frames of 6 clocks: they are played in turn. Two clocks, as a line test makes
// them, are no reading, so the same frame comes again.
TEST(ReplaySlave, TwoFrames_ArePlayedInTurn) {
  ChainBench bench;
  ReplaySlaveConfig config;
  config.recording.ma_hz = 1'000'000;
  config.recording.frames = {{{{1'600'000, false}, {9'000'000, true}}, 6},
                             {{{1'700'000, false}, {9'000'000, true}}, 6}};
  bench.chain.add(std::make_unique<ReplaySlave>(config));
  const auto answers_after = [&](Time begin, unsigned clocks) {
    bench.slo.clear();
    bench.frame(begin, kPsPerUs, clocks);
    bench.run_until(begin + 40 * kPsPerUs);
    return bench.slo.empty() ? 0 : bench.slo.front().first - begin;
  };
  EXPECT_EQ(answers_after(100 * kPsPerUs, 6), 1'600'000U);
  EXPECT_EQ(answers_after(200 * kPsPerUs, 2), 1'700'000U);
  EXPECT_EQ(answers_after(300 * kPsPerUs, 6), 1'700'000U);
  EXPECT_EQ(answers_after(400 * kPsPerUs, 6), 1'600'000U);
}

struct BadRecording {
  const char* name;
  const char* text;
  const char* message;
};

void PrintTo(const BadRecording& bad, std::ostream* out) { *out << bad.name; }

class Recording : public testing::TestWithParam<BadRecording> {};

TEST_P(Recording, BadText_IsRefusedWithItsLine) {
  try {
    parse_recording(GetParam().text, "f");
    FAIL() << "accepted";
  } catch (const RecordingError& error) {
    EXPECT_STREQ(error.what(), GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bad, Recording,
    testing::Values(
        BadRecording{"NoFrequency", "100 0\n200 1\n", "f:2: ma_hz is missing"},
        BadRecording{"Empty", "", "f: the file is empty"},
        BadRecording{"OnlyComment", "# nothing\n", "f:1: ma_hz is missing"},
        BadRecording{"NoEdges", "ma_hz 1000\n", "f:1: no edges"},
        BadRecording{"Word", "ma_hz 1000\n\nabc 0\n",
                     "f:3: expected a time of 0 to 1e9 ns, found 'abc'"},
        BadRecording{"Level", "ma_hz 1000\n10 2\n", "f:2: expected level 0 or 1, found '2'"},
        BadRecording{"Backwards", "ma_hz 1000\n10 0\n9 1\n",
                     "f:3: time does not come after the edge before"},
        BadRecording{"NoChange", "ma_hz 1000\n10 1\n",
                     "f:2: level is 1 already (SL rests at 1 before the first edge)"},
        BadRecording{"EndsLow", "ma_hz 1000\n10 0\n", "f:2: the last edge must go to 1"},
        BadRecording{"Frequency", "ma_hz 0\n",
                     "f:1: ma_hz: expected a whole number of 1 to 100000000"}),
    [](const auto& entry) { return entry.param.name; });

}  // namespace
}  // namespace mb4test
