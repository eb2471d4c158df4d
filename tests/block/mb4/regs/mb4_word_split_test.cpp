// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Words that SWBANK splits: page 33, Table 49; decision 34.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_word_split.h"
#include "tests/support/model_context.hpp"

namespace {

// Words of both lines at any time, good ones, and SWBANK now and then.
TEST(WordSplitBlock, SwbankAtAnyTime_WordsItSplitsAreNotValidAndNoOthers) {
  mb4test::Dice random;
  mb4test::Block<Vmb4_word_split> block;
  auto& m = block.model;
  m.swap_i = m.word_open_i = m.word_ok_i = 0;
  block.reset();
  bool split[2] = {};
  unsigned left[2] = {};  // clocks until the word ends
  unsigned seen_split = 0, seen_whole = 0;
  for (int step = 0; step < 50'000; ++step) {
    const bool swap = random.below(10) == 0;
    unsigned open = 0, expected_split = 0, expected_ok = 0;
    for (unsigned line = 0; line < 2; ++line) {
      const unsigned bit = 1U << line;
      if (left[line] > 1) {
        open |= bit;
        if (swap) {
          expected_split |= bit;
          split[line] = true;
        }
      } else if (left[line] == 1 && !split[line]) {
        expected_ok |= bit;  // complete, also if SWBANK comes now
      }
    }
    m.swap_i = swap;
    m.word_open_i = static_cast<std::uint8_t>(open);
    m.word_ok_i = static_cast<std::uint8_t>((left[0] == 1 ? 1 : 0) | (left[1] == 1 ? 2 : 0));
    m.eval();
    ASSERT_EQ(m.split_o, expected_split) << "step " << step;
    ASSERT_EQ(m.word_ok_o, expected_ok) << "step " << step;
    block.clock();
    for (unsigned line = 0; line < 2; ++line) {
      if (left[line] == 1) ++(split[line] ? seen_split : seen_whole);
      if (left[line] > 0) {
        --left[line];
      } else if (random.below(3) == 0) {
        left[line] = 2 + random.below(12);
        split[line] = false;
      }
    }
  }
  EXPECT_GT(seen_split, 1000U);
  EXPECT_GT(seen_whole, 1000U);
}

}  // namespace
