// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The force bits of MA on their way to the lines: page 33, Tables 50 to 53; page 27, Table 23.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_ma_force.h"
#include "tests/support/model_context.hpp"

namespace {

class Force : public mb4test::Block<Vmb4_ma_force> {
 public:
  Force() {
    set(0);
    reset();
  }
  // MAVO, MAFO, MAVS, MAFS as in 0xF5(7:4), then CHSEL.
  void set(unsigned setting) {
    model.mavo_i = (setting >> 5) & 1;
    model.mafo_i = (setting >> 4) & 1;
    model.mavs_i = (setting >> 3) & 1;
    model.mafs_i = (setting >> 2) & 1;
    model.chsel_i = setting & 3;
  }
};

TEST(MaForceBlock, EverySetting_SelectedAndOtherLinesHaveTheirBits) {
  Force force;
  for (unsigned setting = 0; setting < 64; ++setting) {
    SCOPED_TRACE(testing::Message() << "setting " << setting);
    force.set(setting);
    for (int i = 0; i < 6; ++i) force.clock();
    // Table 23: 00 is channel 1.
    const unsigned selected = (setting & 3) == 0 ? 1 : setting & 3;
    bool any = false;
    for (unsigned line = 0; line < 2; ++line) {
      const bool own = ((selected >> line) & 1) != 0;
      const bool forced = ((setting >> (own ? 2 : 4)) & 1) != 0;
      any = any || forced;
      ASSERT_EQ((force.model.force_o >> line) & 1, forced) << line;
      if (forced) {
        ASSERT_EQ((force.model.level_o >> line) & 1, (setting >> (own ? 3 : 5)) & 1) << line;
      }
    }
    ASSERT_EQ(force.model.any_o, any);
  }
}

// The host's bits may arrive in different clocks: they are taken together, and told once.
TEST(MaForceBlock, BitsArriveApart_AreTakenTogetherAndToldOnce) {
  Force force;
  force.set(0x04);  // MAFS with the level still 0
  force.clock();
  force.set(0x0C);
  unsigned told = 0;
  for (int i = 0; i < 10; ++i) {
    force.clock();
    ASSERT_TRUE(force.model.force_o == 0 || force.model.level_o == 1) << "clock " << i;
    told += force.model.change_o;
  }
  EXPECT_EQ(force.model.force_o, 1);
  EXPECT_EQ(told, 1U);
}

}  // namespace
