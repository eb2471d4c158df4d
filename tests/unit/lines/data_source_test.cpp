// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/data_source.hpp"

#include <gtest/gtest.h>

namespace mb4test {

using namespace mb4::sim;

namespace {

TEST(DataSource, Ramp_CountsPositionAboveTheFlags) {
  DataSource source;
  source.kind = DataSource::Kind::kRamp;
  source.start = 5;
  source.step = 2;
  EXPECT_EQ(source.word(0, 0, 12, 2, 0b11), (5U << 2) | 3U);
  EXPECT_EQ(source.word(0, 10, 12, 2, 0b11), (25U << 2) | 3U);
}

TEST(DataSource, RampDownBelowZero_WrapsAtTheLength) {
  DataSource source;
  source.kind = DataSource::Kind::kRamp;
  source.step = -1;
  EXPECT_EQ(source.word(0, 1, 10, 0, 0), 0x3FFU);
}

TEST(DataSource, Sine_ReachesOffsetAndBothExtremes) {
  DataSource source;
  source.kind = DataSource::Kind::kSine;
  source.offset = 1000;
  source.amplitude = 100;
  source.period = 400 * kPsPerUs;
  EXPECT_EQ(source.word(0, 0, 16, 0, 0), 1000U);
  EXPECT_EQ(source.word(100 * kPsPerUs, 0, 16, 0, 0), 1100U);
  EXPECT_EQ(source.word(300 * kPsPerUs, 0, 16, 0, 0), 900U);
}

TEST(DataSource, List_RepeatsOrHoldsItsEnd) {
  DataSource source;
  source.kind = DataSource::Kind::kList;
  source.words = {1, 2, 3};
  EXPECT_EQ(source.word(0, 4, 8, 0, 0), 2U);
  source.repeat = false;
  EXPECT_EQ(source.word(0, 4, 8, 0, 0), 3U);
}

}  // namespace
}  // namespace mb4test
