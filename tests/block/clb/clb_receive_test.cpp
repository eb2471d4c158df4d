// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Bits to words: every length, random gaps, words that are dropped.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "Vclb_receive.h"
#include "tests/support/model_context.hpp"

namespace {

class ClbReceive : public testing::Test {
 protected:
  ClbReceive() {
    m.clear_i = 1;
    m.take_i = m.bit_i = m.last_i = 0;
    block.reset();
    m.clear_i = 0;
  }
  // One clock; the word that is pushed in the one after it, if any.
  std::optional<unsigned> bit(bool level) {
    m.take_i = 1;
    m.bit_i = level ? 1 : 0;
    block.clock();
    m.take_i = 0;
    m.bit_i = static_cast<std::uint8_t>(dice.below(2));  // counts with take only
    const std::optional<unsigned> pushed = word();
    for (unsigned gap = dice.below(4); gap > 0; --gap) {
      block.clock();
      EXPECT_FALSE(word().has_value());
    }
    if (pushed && m.push_o != 0) block.clock();
    return pushed;
  }
  std::optional<unsigned> word() {
    return m.push_o != 0 ? std::optional<unsigned>{m.word_o} : std::nullopt;
  }
  void clear(unsigned last) {
    m.clear_i = 1;
    m.last_i = static_cast<std::uint8_t>(last);
    block.clock();
    m.clear_i = 0;
  }
  mb4test::Dice dice;
  mb4test::Block<Vclb_receive> block;
  Vclb_receive& m = block.model;
};

TEST_F(ClbReceive, WordsOfEachLength_ComeRightAlignedFirstBitHighest) {
  for (unsigned length = 1; length <= 16; ++length) {
    clear(length - 1);
    for (int round = 0; round < 20; ++round) {
      unsigned sent = 0;
      for (unsigned i = 0; i < length; ++i) {
        const bool level = dice.below(2) != 0;
        sent = sent << 1U | (level ? 1U : 0U);
        const std::optional<unsigned> pushed = bit(level);
        EXPECT_EQ(pushed.has_value(), i + 1 == length) << length << ' ' << i;
        if (pushed) {
          EXPECT_EQ(*pushed, sent) << length;
        }
      }
    }
  }
}

TEST_F(ClbReceive, PartWord_IsDroppedByClear) {
  clear(11);
  for (int i = 0; i < 7; ++i) bit(true);
  clear(11);
  for (int i = 0; i < 11; ++i) EXPECT_FALSE(bit(i == 0).has_value());
  EXPECT_EQ(bit(true), 0x801U);
}

TEST_F(ClbReceive, BitsWhileClear_AreNoPartOfAWord) {
  clear(3);
  m.clear_i = 1;
  for (int i = 0; i < 6; ++i) EXPECT_FALSE(bit(true).has_value());
  m.clear_i = 0;
  EXPECT_FALSE(bit(false).has_value());
  EXPECT_FALSE(bit(true).has_value());
  EXPECT_FALSE(bit(false).has_value());
  EXPECT_EQ(bit(true), 0x5U);
}

}  // namespace
