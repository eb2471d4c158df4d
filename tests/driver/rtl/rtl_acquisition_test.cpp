// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The driver on the Verilated chip: several slaves, automatic frames, recovery.

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::Frame;
using mb4test::Chip;
using mb4test::config26;
namespace sim = mb4::sim;

std::string slave(const std::string& keys) {
  return "[[channel.slave]]\nprotocol = \"biss-c\"\n" + keys + "\n";
}

// Two slaves on channel 1, one on channel 2 behind a line of 1.5 us.
const std::string kThree = "[[channel]]\nnumber = 1\n" +
                           slave("data_bits = 28\nsource = \"ramp\"\nstep = 3") +
                           slave("data_bits = 14\ncrc = 0x25\ndata = 0x1237") +
                           "[[channel]]\nnumber = 2\ndelay_ns = 1500\n" +
                           slave(
                               "data_bits = 24\nflag_bits = 0\ncrc = 0x190D9\n"
                               "crc_start = 0x1234\ndata = 0xABCDEF");

Config three(std::uint32_t ma_hz) {
  Config config = config26(ma_hz);
  config.channels[1].protocol = mb4::Protocol::kBissC;
  config.slaves[1] = config.slaves[0];
  config.slaves[1].data_bits = 14;
  config.slaves[1].crc_polynomial = 0x25;
  config.slaves[4].enabled = true;
  config.slaves[4].data_bits = 24;
  config.slaves[4].flags = mb4::Flags::kNone;
  config.slaves[4].crc_polynomial = 0x190D9;
  config.slaves[4].crc_start = 0x1234;
  return config;
}

class DriverFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(DriverFrames, ThreeSlavesOnTwoChannels_AllReadInEachFrame) {
  Chip chip(kThree);
  ASSERT_TRUE(chip.device.configure(three(GetParam())).ok());
  for (std::uint64_t i = 0; i < 5; ++i) {
    Frame frame;
    ASSERT_TRUE(chip.device.read_all(frame).ok());
    ASSERT_TRUE(frame.good(0x13));
    EXPECT_EQ(frame[1]->position, 3 * i);
    EXPECT_EQ(frame[2]->raw, 0x1237U);
    EXPECT_EQ(frame[5]->raw, 0xABCDEFU);
  }
}

INSTANTIATE_TEST_SUITE_P(MaHz, DriverFrames, testing::Values(10'000'000U, 2'500'000U, 100'000U));

// Eight slaves with all lengths between 8 and 64 bits, one burst or several.
TEST(DriverFrame, EightSlaves_AllReadInOneFrame) {
  std::string scenario = "[[channel]]\nnumber = 1\n";
  Config config = config26(5'000'000);
  for (unsigned i = 0; i < 8; ++i) {
    const unsigned bits = 8 * (i + 1);
    scenario += slave("flag_bits = 0\ndata_bits = " + std::to_string(bits) +
                      "\ndata = " + std::to_string(0xC1 + i));
    config.slaves[i] = config.slaves[0];
    config.slaves[i].data_bits = static_cast<std::uint8_t>(bits);
    config.slaves[i].flags = mb4::Flags::kNone;
  }
  Chip chip(scenario);
  ASSERT_TRUE(chip.device.configure(config).ok());
  Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  for (unsigned i = 0; i < 8; ++i) {
    ASSERT_TRUE(frame[i + 1].ok()) << i;
    EXPECT_EQ(frame[i + 1]->raw, 0xC1U + i);
  }
}

TEST(DriverFrame, OneSlaveBad_OthersAreGood) {
  Chip chip(kThree);
  ASSERT_TRUE(chip.device.configure(three(2'500'000)).ok());
  clocked(chip.simulator.line(1))->faults().flip_next_frame({40});  // in the word of slave 2
  Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  EXPECT_TRUE(frame[1].ok());
  EXPECT_EQ(frame[2].error(), Error::kCrc);
  EXPECT_TRUE(frame[5].ok());
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  EXPECT_TRUE(frame.good(0x13));
}

// ---- Automatic frames ---------------------------------------------------------------------------

// Every byte of the word is the number of the frame: a torn one shows.
constexpr std::uint64_t kStep = 0x01010101010101;
std::string counting(std::uint64_t f_clk_hz, std::uint64_t sclk_hz, const std::string& more = "") {
  return "[chip]\nf_clk_hz = " + std::to_string(f_clk_hz) +
         "\n[host]\nsclk_hz = " + std::to_string(sclk_hz) + "\n[[channel]]\nnumber = 1\n" +
         slave("data_bits = 56\nflag_bits = 0\nsource = \"ramp\"\nstart = 0\nstep = " +
               std::to_string(kStep) + "\n" + more);
}

Config counting_config(std::uint32_t f_clk_hz, mb4::FrameStart start, std::uint32_t period = 0) {
  Config config = config26(f_clk_hz / 2, f_clk_hz);
  config.slaves[0].data_bits = 56;
  config.slaves[0].flags = mb4::Flags::kNone;
  config.frame_start = start;
  config.frame_period_clk = period;
  return config;
}

struct Ratio {
  std::uint32_t f_clk_hz;
  std::uint32_t sclk_hz;
};

class DriverAutomatic : public testing::TestWithParam<Ratio> {};

// Polled at all phases of the frame, with SCLK up to 4 f_CLK: whole words, never an old one, and no
// alarm where some polls in a row meet the end of a frame.
TEST_P(DriverAutomatic, PollAtEveryPhase_NeverTornNeverOld) {
  const Ratio ratio = GetParam();
  for (const std::uint32_t period : {0U, 160U, 200U, 320U}) {
    for (const std::uint32_t first_ns : {0U, 900U, 1'900U, 7'400U}) {
      Chip chip(counting(ratio.f_clk_hz, ratio.sclk_hz));
      ASSERT_TRUE(
          chip.device
              .configure(counting_config(
                  ratio.f_clk_hz,
                  period == 0 ? mb4::FrameStart::kBackToBack : mb4::FrameStart::kPeriodic, period))
              .ok());
      ASSERT_TRUE(chip.device.automatic().start().ok());
      chip.simulator.advance(first_ns * sim::kPsPerNs);
      std::uint64_t last = 0;
      unsigned fresh = 0;
      for (unsigned i = 0; i < 2000 && last < 200; ++i) {
        chip.simulator.advance((700 + 37 * (i % 331)) * sim::kPsPerNs);
        Frame frame;
        const mb4::Result<void> polled = chip.device.automatic().poll(frame);
        ASSERT_TRUE(polled.ok()) << to_string(polled.error()) << ", poll " << i << ", period "
                                 << period;
        if (!frame[1]) {
          ASSERT_EQ(frame[1].error(), Error::kNoData) << i;
          continue;
        }
        const std::uint64_t number = frame[1]->raw & 0xFF;
        ASSERT_EQ(frame[1]->raw, number * kStep) << "torn, poll " << i << ", period " << period;
        ASSERT_TRUE(fresh == 0 || number > last) << "old, poll " << i << ", period " << period;
        last = number;
        ++fresh;
      }
      // Frames run on while the bank is held (decision 15): at 1 MHz few polls see 200 frames pass.
      EXPECT_GE(fresh, ratio.sclk_hz > 1'000'000 ? 31U : 4U) << period;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Clocks, DriverAutomatic,
                         testing::Values(Ratio{20'000'000, 10'000'000},
                                         Ratio{12'500'000, 50'000'000},
                                         Ratio{25'000'000, 1'000'000}),
                         [](const auto& test) {
                           return "Clk" + std::to_string(test.param.f_clk_hz) + "_Sclk" +
                                  std::to_string(test.param.sclk_hz);
                         });

TEST(DriverAutomaticNext, Period_EveryFrameIsSeenOnce) {
  Chip chip(counting(20'000'000, 10'000'000));
  ASSERT_TRUE(
      chip.device.configure(counting_config(20'000'000, mb4::FrameStart::kPeriodic, 2000)).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  for (std::uint64_t i = 0; i < 50; ++i) {
    Frame frame;
    ASSERT_TRUE(chip.device.automatic().next(frame).ok());
    EXPECT_EQ(frame[1]->raw, i * kStep);
    EXPECT_FALSE(frame.status.start_error());
  }
  ASSERT_TRUE(chip.device.automatic().stop().ok());
  EXPECT_EQ(chip.device.read_frame()->raw, 50 * kStep);
}

// Page 32: FREQAGS = AGSINFINITE, a pulse at GETSENS starts a frame.
TEST(DriverAutomaticNext, Getsens_OneFrameAPulse) {
  Chip chip(counting(20'000'000, 10'000'000));
  ASSERT_TRUE(chip.device.configure(counting_config(20'000'000, mb4::FrameStart::kOnPin)).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  for (std::uint64_t i = 0; i < 3; ++i) {
    Frame frame;
    EXPECT_EQ(chip.device.automatic().next(frame).error(), Error::kNoData);
    chip.simulator.set_pin(sim::Pin::kGetsens, true);
    chip.simulator.advance(100 * sim::kPsPerNs);
    chip.simulator.set_pin(sim::Pin::kGetsens, false);
    ASSERT_TRUE(chip.device.automatic().next(frame).ok());
    EXPECT_EQ(frame[1]->raw, i * kStep);
  }
}

// Broken line, then a good one again: BREAK and AGS (table 69).
TEST(DriverAutomaticNext, LineStuckLow_LineErrorThenRecovers) {
  Chip chip(counting(20'000'000, 10'000'000));
  ASSERT_TRUE(
      chip.device.configure(counting_config(20'000'000, mb4::FrameStart::kPeriodic, 2000)).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  Frame frame;
  ASSERT_TRUE(chip.device.automatic().next(frame).ok());
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  EXPECT_EQ(chip.device.automatic().next(frame).error(), Error::kLineError);
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  ASSERT_TRUE(chip.device.automatic().next(frame).ok());
  EXPECT_TRUE(frame[1].ok());
}

TEST(DriverAutomaticNext, BadFrame_IsCrcAndTheNextIsGood) {
  Chip chip(counting(20'000'000, 10'000'000));
  ASSERT_TRUE(
      chip.device.configure(counting_config(20'000'000, mb4::FrameStart::kBackToBack)).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  unsigned bad = 0;
  for (unsigned i = 0; i < 10; ++i) {
    Frame frame;
    const mb4::Result<void> next = chip.device.automatic().next(frame);
    ASSERT_TRUE(next.ok()) << i << " " << mb4::to_string(next.error());
    if (frame[1]) {
      EXPECT_EQ(frame[1]->raw, (frame[1]->raw & 0xFF) * kStep);
    } else {
      EXPECT_EQ(frame[1].error(), Error::kCrc);
      ++bad;
    }
    // The slowest rate of reading still meets every fourth bad frame or so: mark many.
    if (i < 5) clocked(chip.simulator.line(1))->faults().flip_next_frame({9});
  }
  EXPECT_LE(bad, 5U);
}

}  // namespace
