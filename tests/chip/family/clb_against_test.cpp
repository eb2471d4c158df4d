// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The same encoder on the same cable, read by the iC-MB4, biss_axi and biss_clb.
#include <string>

#include "tests/chip/family/readers.hpp"

namespace mb4test::family {
namespace {

class ClbAgainst : public testing::TestWithParam<std::pair<const char*, unsigned>> {};

TEST_P(ClbAgainst, TheIcMb4AndAxi_TheWordsAreTheSame) {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    for (unsigned metres = 0; metres <= 100; metres += 10) {
      const Line line{GetParam().first, GetParam().second, metres, mhz};
      SCOPED_TRACE(std::to_string(mhz) + " MHz, " + std::to_string(metres) + " m");
      const Words mb4 = through_mb4(line);
      const Words axi = through_axi(line);
      const Words clb = through_clb(line);
      ASSERT_EQ(axi.size(), kFrames);
      ASSERT_EQ(clb, axi);
      ASSERT_GE(mb4.size(), 3U);
      for (const auto& [frame, word] : mb4) {
        ASSERT_EQ(axi.count(frame), 1U);
        ASSERT_EQ(word, axi.at(frame)) << "frame " << frame;
      }
      // The ramp itself, without errors.
      for (const auto& [frame, word] : clb) ASSERT_EQ(word, line.word(frame));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, ClbAgainst,
                         testing::Values(std::pair{"resolute-26", 26U}, std::pair{"lika-sma1", 24U},
                                         std::pair{"wachendorff-wdgf58m", 12U}),
                         [](const auto& test) {
                           return "Bits" + std::to_string(test.param.second);
                         });

TEST(ClbAgainst, RegisterWrittenThroughOneMaster_ReadsTheSameThroughEach) {
  Mb4Way mb4;
  AxiWay axi;
  ClbWay clb;
  exchange_registers(std::array<Way*, 3>{&mb4, &axi, &clb});
}

}  // namespace
}  // namespace mb4test::family
