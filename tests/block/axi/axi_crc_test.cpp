// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Serial CRC with any polynomial up to degree 16, against the division bit by bit.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "Vaxi_crc.h"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/support/model_context.hpp"

namespace {

TEST(AxiCrcBlock, EveryDegree_IsTheRemainder) {
  mb4test::Dice dice;
  mb4test::Block<Vaxi_crc> block;
  Vaxi_crc& m = block.model;
  m.load_i = m.shift_i = m.feed_i = m.bit_i = 0;
  m.poly_i = m.mask_i = m.start_i = 0;
  block.reset();
  for (int round = 0; round < 600; ++round) {
    const unsigned degree = 1 + round % 16;
    const std::uint32_t below = (1U << degree) - 1;
    const std::uint32_t lower = dice.below(0x10000) & below;
    const std::uint32_t start = dice.below(0x10000) & below;
    std::string word;
    for (unsigned bits = 1 + dice.below(70); bits > 0; --bits)
      word += dice.below(2) != 0 ? '1' : '0';
    m.poly_i = static_cast<std::uint16_t>(lower);
    m.mask_i = static_cast<std::uint16_t>(1U << (degree - 1));
    m.start_i = static_cast<std::uint16_t>(start);
    m.load_i = 1;
    block.clock();
    m.load_i = 0;
    const auto shift = [&](bool feed, bool bit) {
      for (unsigned pause = dice.below(3); pause > 0; --pause) block.clock();
      m.feed_i = feed;
      m.bit_i = bit;
      m.shift_i = 1;
      block.clock();
      m.shift_i = 0;
    };
    for (const char bit : word) shift(true, bit == '1');
    const std::uint32_t rest = mb4test::crc_of(word, 1U << degree | lower, start);
    for (unsigned bit = degree; bit-- > 0;) {
      m.eval();
      ASSERT_EQ(m.top_o, rest >> bit & 1U) << "degree " << degree << " round " << round;
      shift(false, dice.below(2) != 0);
    }
  }
}

}  // namespace
