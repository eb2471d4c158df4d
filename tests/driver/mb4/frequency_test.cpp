// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// FREQAGS, table 37 on page 30, and its encoding from a Config.

#include "mb4/frequency.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/register_image.hpp"
#include "tests/driver/mb4/encoder26.hpp"

namespace {
namespace frequency_test {

using mb4::Config;
using mb4test::encoder26;

std::uint8_t freqags(const Config& config) { return mb4::encode_registers(config)[0xE8 - 0xC0]; }

Config periodic(std::uint32_t period_clk) {
  Config config = encoder26();
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = period_clk;
  return config;
}

// 0x00..0x7B: f_CLK / 20 / (code + 1); 0x7C..0x7F: no rate; 0x80..0xFF: f_CLK / 625 / (code - 127).
TEST(Freqags, EveryCode_HasThePeriodOfTable37) {
  for (unsigned code = 0; code <= 0xFF; ++code) {
    const std::uint32_t period = mb4::ags_period_clk(static_cast<std::uint8_t>(code));
    if (code >= 0x7C && code <= 0x7F) {
      EXPECT_EQ(period, 0U) << code;
      continue;
    }
    EXPECT_EQ(period, code < 0x7C ? 20 * (code + 1) : 625 * (code - 127)) << code;
    ASSERT_TRUE(mb4::freqags_code(period).ok()) << code;
    EXPECT_EQ(*mb4::freqags_code(period), code);
    if (period >= 400) {
      ASSERT_TRUE(mb4::validate(periodic(period)).ok()) << code;
      EXPECT_EQ(freqags(periodic(period)), code);
    }
  }
}

TEST(Freqags, OtherPeriods_AreInvalid) {
  for (const std::uint32_t period : {0U, 1U, 19U, 30U, 2500U - 5U, 2490U, 80'625U, 0xFFFFFFFFU}) {
    EXPECT_EQ(mb4::freqags_code(period).info().field, mb4::ConfigField::kFramePeriodClk) << period;
  }
}

// Page 30: at 20 MHz 1 us to 4 ms. 31.25 us is in the upper half, 32 us in the lower.
TEST(FramePeriodAtLeast, TakesTheNextLongerOne) {
  EXPECT_EQ(mb4::frame_period_clk_at_least(20'000'000, 1), 20U);
  EXPECT_EQ(mb4::frame_period_clk_at_least(20'000'000, 1'000), 20U);
  EXPECT_EQ(mb4::frame_period_clk_at_least(20'000'000, 1'001), 40U);
  EXPECT_EQ(mb4::frame_period_clk_at_least(20'000'000, 31'100), 625U);
  EXPECT_EQ(mb4::frame_period_clk_at_least(20'000'000, 31'251), 640U);
  EXPECT_EQ(mb4::frame_period_clk_at_least(20'000'000, 4'000'000), 80'000U);
  EXPECT_EQ(mb4::frame_period_clk_at_least(20'000'000, 4'000'001), 0U);
  EXPECT_EQ(mb4::frame_period_clk_at_least(25'000'000, 0xFFFFFFFF), 0U);
}

TEST(FramePeriodAtMostHz, DoesNotExceedTheRate) {
  EXPECT_EQ(mb4::frame_period_clk_at_most_hz(20'000'000, 10'000), 2'000U);
  EXPECT_EQ(mb4::frame_period_clk_at_most_hz(20'000'000, 9'999), 2'020U);
  EXPECT_EQ(mb4::frame_period_clk_at_most_hz(20'000'000, 8'000), 2'500U);  // 625 * 4
  EXPECT_EQ(mb4::frame_period_clk_at_most_hz(20'000'000, 32'000), 625U);   // not 640
  EXPECT_EQ(mb4::frame_period_clk_at_most_hz(20'000'000, 0xFFFFFFFF), 20U);
  EXPECT_EQ(mb4::frame_period_clk_at_most_hz(20'000'000, 249), 0U);
}

// Table 37: AGSMIN = 0x7C, AGSINFINITE = 0x7D..0x7F.
TEST(Freqags, FrameStart_SelectsMinAndInfinite) {
  Config config = encoder26();
  config.frame_start = mb4::FrameStart::kBackToBack;
  EXPECT_EQ(freqags(config), 0x7C);
  config.frame_start = mb4::FrameStart::kOnPin;
  EXPECT_EQ(freqags(config), 0x7D);
}

// 5 + 28 + 6 = 39 periods of 10 clocks, and 0.55 of one for the timeout (I306): 395.5 clocks.
TEST(FramePeriod, JustLongEnough_IsValid) { EXPECT_TRUE(mb4::validate(periodic(400)).ok()); }

}  // namespace frequency_test
}  // namespace
