// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Two slaves of one frame in steps, at every phase of a loop that ticks with the frames: each
// sampled word comes once or is counted as lost (table 69, decision 15).

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Error;
using mb4test::Chip;
namespace sim = mb4::sim;

constexpr unsigned kPhases = 25;
constexpr std::uint8_t kWith = MB4_WITH_ALL | MB4_WITH_COUNTS;

std::string scenario(bool omits) {
  const std::string slave =
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\nstep = 1\n";
  return std::string("[chip.quirks]\nAGSERR_ON_HOLDBANK = ") + (omits ? "true" : "false") +
         "\n[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n" + slave + slave +
         "start = 5000\n";
}

struct Case {
  bool omits;  // AGSERR_ON_HOLDBANK
  std::uint32_t frames_hz;
  unsigned skipped;  // of ten ticks
};

struct Loop {
  explicit Loop(const Case& test) : chip(scenario(test.omits)) {
    config = mb4test::config26(10'000'000);
    config.spi_check = mb4::SpiCheck::kCrc;
    config.slaves[1] = config.slaves[0];
    config.frame_start = mb4::FrameStart::kPeriodic;
    config.frame_period_clk =
        mb4::frame_period_clk_at_least(config.f_clk_hz, 1'000'000'000U / test.frames_hz);
    period = config.frame_period_clk * (sim::kPsPerSecond / config.f_clk_hz);
    EXPECT_TRUE(chip.device.configure(config).ok());
    EXPECT_TRUE(chip.device.automatic().start().ok());
    chip.device.automatic().count(&counts);
  }
  mb4::Result<void> read(mb4::Frame& frame) {
    EXPECT_TRUE(chip.device.automatic().plan(steps).ok());
    bool transferred = false;
    do {
      transferred = steps.run(chip.bus);
    } while (!chip.device.automatic().finish<kWith>(steps, transferred, chip.clock.now_us()));
    return steps.result(frame);
  }

  Chip chip;
  mb4::Config config;
  mb4_counts counts{};
  mb4::FrameRead steps;
  sim::Time period = 0;
};

class DriverSteps : public testing::TestWithParam<Case> {};

TEST_P(DriverSteps, EveryPhase_EachSampleComesOrIsCounted) {
  const char* all = std::getenv("MB4_ALL_FRAMES");
  const unsigned ticks = all != nullptr ? 4'000 : 60;
  std::string losing;
  for (unsigned phase = 0; phase < kPhases; ++phase) {
    Loop run(GetParam());
    sim::Time tick = run.chip.simulator.now() + 3 * run.period + run.period * phase / kPhases;
    mb4::Frame frame;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    unsigned first_tick = 0;
    std::uint32_t alarms = 0;
    unsigned skipped = 0;
    for (unsigned i = 0; i < ticks; ++i, tick += run.period) {
      if (run.chip.simulator.now() > tick) continue;  // the loop is still busy
      if (i * 7 % 10 < GetParam().skipped) {
        ++skipped;
        continue;
      }
      run.chip.simulator.run_until(tick);
      const mb4::Result<void> done = run.read(frame);
      alarms += done.ok() ? 0 : 1;
      if (!done || !frame[1]) continue;
      ASSERT_TRUE(frame[2].ok());
      EXPECT_TRUE(run.steps.one_frame());
      const std::uint64_t position = frame[1]->position;
      EXPECT_EQ(frame[2]->position, position + 5000) << "two frames, phase " << phase;
      if (run.counts.good == 1) {
        first = position;
        first_tick = i;
      }
      EXPECT_TRUE(run.counts.good == 1 || position > last) << "phase " << phase;
      last = position;
      EXPECT_EQ(run.counts.sequence, run.counts.good + run.counts.lost);
      // The ramp counts the samples. In a period that the chip has left out there is none, which
      // nobody can tell from a sample that was lost.
      if (run.counts.omits) {
        EXPECT_EQ(run.counts.sequence, i - first_tick + 1) << "phase " << phase;
      } else {
        EXPECT_EQ(run.counts.sequence, position - first + 1) << "phase " << phase;
      }
    }
    if (GetParam().frames_hz <= 32'000) {
      EXPECT_FALSE(run.counts.omits);
      EXPECT_GE(run.counts.good + skipped + 1, ticks) << "phase " << phase;
      EXPECT_LE(run.counts.lost, skipped) << "phase " << phase;
    }
    EXPECT_EQ(run.counts.faults, alarms);
    if (run.counts.good + skipped + 1 < ticks) {
      losing += " " + std::to_string(phase) + ":" + std::to_string(run.counts.good) + "/" +
                std::to_string(run.counts.lost) + "/" + std::to_string(alarms);
    }
  }
  RecordProperty("phases_that_lose", losing);
}

INSTANTIATE_TEST_SUITE_P(Loops, DriverSteps,
                         testing::Values(Case{false, 32'000, 0}, Case{true, 32'000, 0},
                                         Case{false, 32'000, 3}, Case{true, 32'000, 3},
                                         Case{false, 36'000, 0}, Case{true, 36'000, 0}),
                         [](const auto& test) {
                           return std::string(test.param.omits ? "Omits" : "Overwrites") + "_" +
                                  std::to_string(test.param.frames_hz) + "Hz_Skips" +
                                  std::to_string(test.param.skipped);
                         });

TEST(DriverStepsCall, NoFramesRun_IsWrongMode) {
  Loop run({false, 32'000, 0});
  ASSERT_TRUE(run.chip.device.automatic().stop().ok());
  EXPECT_EQ(run.chip.device.automatic().plan(run.steps).error(), Error::kWrongMode);
}

// A read that comes late is told, and so is one without an answer.
TEST(DriverStepsCall, LateAndFailedReads_AreCounted) {
  Loop run({false, 32'000, 0});
  mb4::Frame frame;
  run.chip.simulator.advance(3 * run.period);
  ASSERT_TRUE(run.read(frame).ok());
  EXPECT_EQ(run.counts.late, 0U);
  run.chip.simulator.advance(3 * run.period);
  ASSERT_TRUE(run.read(frame).ok());
  EXPECT_EQ(run.counts.late, 1U);
  EXPECT_EQ(run.counts.good, 2U);
  ASSERT_TRUE(run.chip.device.automatic().plan(run.steps).ok());
  for (bool ended = false; !ended;) {
    ended = run.chip.device.automatic().finish<kWith>(run.steps, false, run.chip.clock.now_us());
  }
  EXPECT_EQ(run.counts.faults, 1U);
  EXPECT_EQ(run.steps.result(frame).error(), Error::kTransport);
  EXPECT_EQ(run.counts.crc + run.counts.switched, 0U);
}

}  // namespace
