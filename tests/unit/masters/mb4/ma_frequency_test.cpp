// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/ma_frequency.hpp"

#include <gtest/gtest.h>

namespace mb4test {

using namespace mb4::sim;

namespace {

// Datasheet Table 35, f_CLK = 20 MHz: 10 MHz down to 62.5 kHz.
TEST(MaFrequency, CodesOfTable35_GiveItsFrequencies) {
  EXPECT_EQ(ma_frequency(20'000'000, 0x00), 10'000'000U);
  EXPECT_EQ(ma_frequency(20'000'000, 0x01), 5'000'000U);
  EXPECT_EQ(ma_frequency(20'000'000, 0x0F), 625'000U);
  EXPECT_EQ(ma_frequency(20'000'000, 0x10), 0U);
  EXPECT_EQ(ma_frequency(20'000'000, 0x11), 500'000U);
  EXPECT_EQ(ma_frequency(20'000'000, 0x12), 333'333U);
  EXPECT_EQ(ma_frequency(20'000'000, 0x1F), 62'500U);
  EXPECT_EQ(ma_frequency(20'000'000, 0x20), 0U);
}

TEST(MaFrequency, FrequencyBetweenCodes_HasNoCodeAndTwoNeighbours) {
  EXPECT_FALSE(freqs_code(20'000'000, 4'000'000).has_value());
  const NearestMa nearest = nearest_ma(20'000'000, 4'000'000);
  EXPECT_EQ(nearest.below, 3'333'333U);
  EXPECT_EQ(nearest.above, 5'000'000U);
}

TEST(MaFrequency, Default_IsTheHighestUpToTenMegahertz) {
  EXPECT_EQ(default_ma_frequency(20'000'000), 10'000'000U);
  EXPECT_EQ(default_ma_frequency(25'000'000), 6'250'000U);
  EXPECT_EQ(default_ma_frequency(1'000'000), 500'000U);
}

}  // namespace
}  // namespace mb4test
