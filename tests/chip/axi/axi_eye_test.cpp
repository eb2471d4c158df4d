// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sampler by frames in the whole master, [chip] features = "frames": words of bad lines, what
// the driver reads of the eye, alarm and interrupt (docs/axi.md, docs/samplers.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "biss_axi/page.hpp"
#include "sim/core/random.hpp"
#include "sim/lines/device.hpp"
#include "tests/chip/axi/axi_spi_bench.hpp"

namespace mb4test {
namespace {

constexpr unsigned kClocks = 10;  // of a bit: 100 MHz, MA 10 MHz

std::string frames(const std::string& text) { return with_features(text, "frames"); }

std::string jitter(double percent) { return "jitter_ns = " + std::to_string(percent) + "\n"; }

TEST(AxiEye, Identity_HasTheSampler) {
  for (const unsigned channels : {1U, 4U, 16U}) {
    AxiBench bench(frames(axi_scenario(std::vector<AxiEncoder>(channels))));
    EXPECT_EQ(bench.read(axireg::kAddrFeatures),
              channels << 16U | 1U << 14U | 1U << 13U | 1U << 9U | 0x1FFU);
    bench.write(axireg::kAddrEyeLimit, ~0U);
    EXPECT_EQ(bench.read(axireg::kAddrEyeLimit), 0x1FU);
    bench.write(axireg::kAddrEye, ~0U);
    EXPECT_EQ(bench.read(axireg::kAddrEyeAlarm), 0U);
  }
}

// Lines with delays of their own and half a bit of jitter, 1, 4 and 16 channels: each word is right
// and each eye that of its line.
class AxiEyeOfLines : public testing::TestWithParam<unsigned> {};

TEST_P(AxiEyeOfLines, LinesThatJitter_AreReadAndTold) {
  const unsigned channels = GetParam();
  std::vector<AxiEncoder> encoders(channels);
  for (unsigned c = 0; c < channels; ++c) {
    encoders[c].delay_ns = 17.3 * c + 5;
    encoders[c].keys = jitter(50.0 * c / channels);
  }
  AxiBench bench(frames(axi_scenario(encoders)));
  AxiPort port{bench};
  biss_axi::Page page(port);
  bench.set_up(26, kClocks / 2);
  sim::Random random(channels);
  std::vector<unsigned> smallest(channels, 31);
  for (int round = 0; round < 60; ++round) {
    std::vector<std::uint64_t> sent;
    for (unsigned c = 0; c < channels; ++c) {
      sent.push_back(random.next() & 0x3FF'FFFFU);
      bench.simulator.slave(c + 1)->set_data(raw_word(sent.back()));
    }
    const auto beat = bench.frame();
    ASSERT_TRUE(beat);
    ASSERT_EQ(beat->user, (1U << channels) - 1U);
    for (unsigned c = 0; c < channels; ++c) {
      ASSERT_EQ(bench.read(c, axireg::kAddrSinglePointData), sent[c]);
      const auto eye = page.eye(c);
      ASSERT_TRUE(eye.ok());
      ASSERT_TRUE(eye->valid && eye->used);
      ASSERT_EQ(eye->before + eye->after + 1, eye->width);
      ASSERT_GE(eye->point, eye->before);
      ASSERT_LT(eye->point + eye->after, kClocks);
      smallest[c] = std::min<unsigned>(smallest[c], eye->smallest);
    }
  }
  for (unsigned c = 0; c < channels; ++c) {
    const double free = kClocks * (1 - 0.5 * c / channels);
    EXPECT_LE(std::abs(smallest[c] - free), 1.0) << c << " of " << channels;
  }
}

INSTANTIATE_TEST_SUITE_P(Channels, AxiEyeOfLines, testing::Values(1U, 4U, 16U),
                         testing::PrintToStringParamName());

// Without the extra the same line costs words.
TEST(AxiEye, SameLineWithoutTheSampler_LosesWords) {
  for (const bool with : {true, false}) {
    const std::string text = axi_scenario({{.delay_ns = 437.1, .keys = jitter(55)}});
    AxiBench bench(with ? frames(text) : text);
    bench.set_up(26, kClocks / 2);
    unsigned bad = 0;
    for (std::uint32_t i = 0; i < 400; ++i) {
      bench.simulator.slave(1)->set_data(raw_word(i * 12345 & 0x3FF'FFFFU));
      const auto beat = bench.frame();
      ASSERT_TRUE(beat);
      bad += beat->user == 0 ? 1 : 0;
    }
    if (with) {
      EXPECT_EQ(bad, 0U);
    } else {
      EXPECT_GT(bad, 5U);
    }
  }
}

TEST(AxiEye, NarrowEye_IsAnAlarmAndAnInterrupt) {
  AxiBench bench(frames(axi_scenario({{.delay_ns = 35}, {.delay_ns = 72, .keys = jitter(40)}})));
  AxiPort port{bench};
  biss_axi::Page page(port);
  bench.set_up(26, kClocks / 2);
  EXPECT_EQ(page.watch_eyes(32).error(), biss_axi::Error::kConfig);
  EXPECT_EQ(page.eye(16).error(), biss_axi::Error::kChannel);
  ASSERT_TRUE(page.enable_interrupt(biss_axi::kEventError).ok());
  ASSERT_TRUE(bench.frame());
  EXPECT_FALSE(bench.pin("irq"));
  ASSERT_TRUE(page.watch_eyes(9).ok());
  ASSERT_TRUE(bench.frame());
  EXPECT_TRUE(bench.pin("irq"));
  EXPECT_EQ(page.take_eye_alarms().value_or(0), 2U);
  EXPECT_EQ(page.take_eye_alarms().value_or(9), 0U);
  EXPECT_NE(page.take_events().value_or(0) & biss_axi::kEventError, 0U);
  EXPECT_FALSE(bench.pin("irq"));
  EXPECT_EQ(page.take_alarms().value_or(9), 0U) << "the delay has not moved";
}

TEST(AxiEye, UnpluggedLine_HasNoNumbers) {
  AxiBench bench(frames(axi_scenario({{.delay_ns = 35}})));
  AxiPort port{bench};
  biss_axi::Page page(port);
  bench.set_up(26, kClocks / 2);
  ASSERT_TRUE(bench.frame());
  EXPECT_TRUE(page.eye(0)->valid);
  bench.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 0\n");
  bench.simulator.advance(100 * sim::kPsPerUs);
  bench.frame();
  EXPECT_EQ(bench.read(0, axireg::kAddrEye), 1U << 30U);
  EXPECT_EQ(page.eye(0)->smallest, 0U);
  // A divider out of reach: words, and no numbers.
  AxiBench slow(frames(axi_scenario({{.delay_ns = 35}})));
  slow.set_up(26, 11);
  slow.simulator.slave(1)->set_data(raw_word(99));
  ASSERT_TRUE(slow.frame());
  EXPECT_EQ(slow.read(0, axireg::kAddrSinglePointData), 99U);
  EXPECT_EQ(slow.read(0, axireg::kAddrEye), 0U);
}

// Reads register 0x20 of the encoder, one bit in each frame.
biss_axi::AccessResult read_0x20(AxiBench& bench, biss_axi::Page<AxiPort>& page) {
  EXPECT_TRUE(page.begin_access({.address = 0x20}).ok());
  auto result = page.access_result();
  for (int i = 0; i < 100 && result->state == biss_axi::AccessState::kRunning; ++i) {
    EXPECT_TRUE(bench.frame());
    result = page.access_result();
  }
  return *result;
}

// A register access in the frames of a line that jitters, and the same after a soft reset.
TEST(AxiEye, RegisterAccess_GoesWithTheFrames) {
  AxiBench bench(frames(axi_scenario(
      {{.delay_ns = 235, .keys = jitter(20), .slave = "registers = { 0x20 = [0x5A] }\n"}})));
  AxiPort port{bench};
  biss_axi::Page page(port);
  bench.set_up(26, kClocks / 2);
  for (int turn = 0; turn < 2; ++turn) {
    const auto result = read_0x20(bench, page);
    EXPECT_EQ(result.state, biss_axi::AccessState::kDone);
    EXPECT_EQ(result.value, 0x5A);
    bench.write(axireg::kAddrSoftReset, 1);
    EXPECT_EQ(bench.read(0, axireg::kAddrEye), 1U << 30U);
    bench.write(axireg::kAddrSoftReset, 0);
    bench.simulator.advance(50 * sim::kPsPerUs);
  }
}

// Of `count` accesses those that end well on a bad line.
unsigned accesses_done(const std::string& scenario, unsigned count) {
  AxiBench bench(scenario);
  AxiPort port{bench};
  biss_axi::Page page(port);
  bench.set_up(26, kClocks / 2);
  unsigned done = 0;
  for (unsigned turn = 0; turn < count; ++turn) {
    const auto result = read_0x20(bench, page);
    if (result.state != biss_axi::AccessState::kDone) continue;
    ++done;
    EXPECT_EQ(result.value, 0x5A);
  }
  return done;
}

// The start bit and CDS of lines with nearly half a bit of jitter, or with jitter and distortion.
TEST(AxiEye, RegisterAccessOnABadLine_IsAsGoodAsWithoutTheSampler) {
  constexpr unsigned kCount = 25;
  for (const std::string& keys : {jitter(45), jitter(35) + "skew_ns = -10.0\n"}) {
    const std::string line =
        axi_scenario({{.delay_ns = 437, .keys = keys, .slave = "registers = { 0x20 = [0x5A] }\n"}});
    const unsigned without = accesses_done(with_features(line, "full"), kCount);
    const unsigned with = accesses_done(frames(line), kCount);
    EXPECT_GE(with + 2, without) << keys;
    EXPECT_GE(with, kCount * 9 / 10) << keys;
    std::printf("%s: %u of %u, without the sampler %u\n", keys.c_str(), with, kCount, without);
  }
}

TEST(AxiEye, BehindSpi_TheSame) {
  SpiBench bench(
      behind_spi({{.delay_ns = 35, .keys = jitter(50)}}, 100'000'000, 10'000'000, "frames"));
  ASSERT_TRUE(bench.device.configure({}).ok());
  for (std::uint32_t i = 1; i < 100; ++i) {
    bench.simulator.slave(1)->set_data(raw_word(i * 777));
    ASSERT_EQ(bench.device.read_single(0).value_or(0), i * 777);
    const auto eye = bench.page.eye(0);
    ASSERT_TRUE(eye.ok() && eye->valid);
    EXPECT_GE(eye->width, 4);
    EXPECT_LE(eye->width, 9);
  }
}

}  // namespace
}  // namespace mb4test
