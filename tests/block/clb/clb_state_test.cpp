// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// FRAME_STATE against the Karnaugh maps of TIDM-1010 (tables 2-5 and 2-6), cell by cell.
#include <gtest/gtest.h>

#include "Vclb_state.h"
#include "tests/support/model_context.hpp"

namespace {

// Rows: state s1 s0 as a number. Columns: e1 e0 = 00, 01, 10, 11.
constexpr unsigned kTable[4][4] = {
    {0, 1, 0, 1},
    {1, 1, 2, 2},
    {2, 3, 2, 3},
    {3, 3, 3, 3},
};

class ClbState : public testing::Test {
 protected:
  ClbState() {
    m.e1_i = m.e0_i = m.clear_i = m.end_i = 0;
    block.reset();
  }
  void step(unsigned e1, unsigned e0, unsigned clear = 0, unsigned end = 0) {
    m.e1_i = static_cast<std::uint8_t>(e1);
    m.e0_i = static_cast<std::uint8_t>(e0);
    m.clear_i = static_cast<std::uint8_t>(clear);
    m.end_i = static_cast<std::uint8_t>(end);
    block.clock();
  }
  void go_to(unsigned state) {
    step(0, 0, 1);
    if (state >= 1) step(0, 1);
    if (state >= 2) step(1, 0);
    if (state >= 3) step(0, 1);
    ASSERT_EQ(m.state_o, state);
  }
  mb4test::Block<Vclb_state> block;
  Vclb_state& m = block.model;
};

TEST_F(ClbState, EachOf16Cells_IsThatOfTheTables) {
  for (unsigned state = 0; state < 4; ++state) {
    for (unsigned inputs = 0; inputs < 4; ++inputs) {
      go_to(state);
      step(inputs >> 1U, inputs & 1U);
      EXPECT_EQ(m.state_o, kTable[state][inputs]) << state << ' ' << inputs;
    }
  }
}

TEST_F(ClbState, Reset_IsIdle) { EXPECT_EQ(m.state_o, 0); }

TEST_F(ClbState, Clear_LeadsToIdleFromAnyStateWhateverElseComes) {
  for (unsigned state = 0; state < 4; ++state) {
    for (unsigned inputs = 0; inputs < 8; ++inputs) {
      go_to(state);
      step(inputs >> 1U & 1U, inputs & 1U, 1, inputs >> 2U);
      EXPECT_EQ(m.state_o, 0) << state << ' ' << inputs;
    }
  }
}

// The watchdog counts while MA runs and no start bit has come; a start bit is the stronger one.
TEST_F(ClbState, End_LeadsFrom01To11Only) {
  for (unsigned state = 0; state < 4; ++state) {
    go_to(state);
    step(0, 0, 0, 1);
    EXPECT_EQ(m.state_o, state == 1 ? 3U : state) << state;
  }
  go_to(1);
  step(1, 0, 0, 1);
  EXPECT_EQ(m.state_o, 2);
}

}  // namespace
