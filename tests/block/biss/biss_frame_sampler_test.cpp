// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sampler by frames alone (docs/samplers.md): its level is given, edges move by whole clocks.
// Eye and bits are computed anew from the samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "Vbiss_frame_sampler.h"
#include "tests/block/biss/widest_gap.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::Dice;

class FrameSamplerBlock : public testing::Test {
 protected:
  FrameSamplerBlock() {
    m.sl_i = 1;
    m.half_last_i = 4;
    m.bit_last_i = 40;
    m.run_i = m.clear_i = m.ack_i = 0;
    block.reset();
  }
  // A frame of `bits` bits from the start bit on; each edge comes up to `moves` clocks later.
  void frame(unsigned half, unsigned bits, unsigned busy, unsigned moves) {
    const unsigned period = 2 * half;
    word = "10";  // start bit, CDS
    while (word.size() < bits) word += dice.below(2) != 0 ? '1' : '0';
    const std::string line = std::string(1 + busy, '0') + word + "0";
    samples.assign(7 + dice.below(40), true);
    const std::size_t begin = samples.size();
    bool level = true;
    std::size_t last = 0;
    std::vector<std::size_t> edges;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if ((line[i] == '1') == level) continue;
      level = !level;
      last = std::max(last + 3, begin + i * period + dice.below(moves + 1));
      edges.push_back(last);
    }
    samples.resize(begin + line.size() * period + 200);
    level = true;
    for (std::size_t i = 0, next = 0; i < samples.size(); ++i) {
      if (next < edges.size() && edges[next] == i) level = !level, ++next;
      samples[i] = level;
    }
    rise = edges[1];
    m.half_last_i = static_cast<std::uint8_t>(half - 1);
    m.bit_last_i = static_cast<std::uint8_t>(2 + bits);
    got.clear();
    first_at = 0;
    m.run_i = m.clear_i = 1;
    bool ack = false;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      m.sl_i = samples[i] ? 1 : 0;
      m.ack_i = ack ? 1 : 0;
      m.eval();
      if (i > 0 && m.bit_valid_o != 0 && got.size() < bits - 2) {
        if (got.empty()) first_at = i;
        got += m.bit_o != 0 ? '1' : '0';
        last_at = i;
      }
      ack = ack || !samples[i];
      block.clock();
      m.clear_i = 0;
    }
    m.eval();
  }

  mb4test::Block<Vbiss_frame_sampler> block;
  Vbiss_frame_sampler& m = block.model;
  Dice dice;
  std::string word, got;
  std::vector<bool> samples;
  std::size_t rise = 0, first_at = 0, last_at = 0;
};

TEST_F(FrameSamplerBlock, FramesAtRandom_BitsAndEyeAreThoseOfTheSamples) {
  unsigned right = 0, waited = 0;
  for (int round = 0; round < 1500 && !HasFailure(); ++round) {
    const unsigned half = 5 + dice.below(6), bits = 9 + dice.below(dice.below(3) == 0 ? 3 : 79),
                   period = 2 * half;
    const unsigned moves = dice.below(period);
    frame(half, bits, dice.below(5) == 0 ? dice.below(900) : dice.below(4), moves);
    const std::size_t end = rise + std::size_t{bits} * period;
    const mb4test::Gap eye = mb4test::widest_gap(samples, rise, end, period);
    ASSERT_EQ(m.eye_valid_o, 1);
    EXPECT_EQ(m.eye_width_o, eye.width);
    const std::size_t point = eye.last - eye.width / 2;
    EXPECT_EQ(m.eye_point_o, point);
    std::string expected;
    for (unsigned i = 2; i < bits; ++i) expected += samples[rise + point + i * period] ? '1' : '0';
    EXPECT_EQ(got, expected) << bits << " bits of " << period << " clocks";
    // Four clocks behind the last bit, one a clock; a short word waits for its last row.
    EXPECT_EQ(first_at, end + 3);
    EXPECT_GE(last_at, first_at + bits - 3);
    EXPECT_LE(last_at, std::max(first_at + bits - 3, end + 16 + 4));
    waited += last_at > first_at + bits - 3 ? 1 : 0;
    if (moves <= half - 2) {
      EXPECT_EQ(got, word.substr(2));
      ++right;
    }
  }
  EXPECT_GT(right, 300U);
  EXPECT_GT(waited, 10U);
}

TEST_F(FrameSamplerBlock, OtherDividers_ShowNothing) {
  for (const unsigned half : {1U, 4U, 11U, 16U, 21U, 26U, 255U}) {
    frame(half, 20, 1, 0);
    EXPECT_EQ(m.usable_o, 0) << half;
    EXPECT_EQ(m.started_o, 0);
    EXPECT_EQ(m.eye_valid_o, 0);
    EXPECT_EQ(got, "");
  }
  for (unsigned half = 5; half <= 10; ++half) {
    frame(half, 20, 1, 0);
    EXPECT_EQ(m.usable_o, 1) << half;
    EXPECT_EQ(got, word.substr(2));
    EXPECT_EQ(m.eye_width_o, 2 * half) << "all edges at one place";
  }
}

// A pulse of one or two samples before the start bit is none.
TEST_F(FrameSamplerBlock, ShortPulseInTheAcknowledge_IsNoStartBit) {
  m.run_i = m.clear_i = 1;
  block.clock();
  m.clear_i = 0;
  m.ack_i = 1;
  for (const unsigned pulse : {1U, 2U, 3U}) {
    m.sl_i = 0;
    for (int i = 0; i < 30; ++i) block.clock();
    m.sl_i = 1;
    for (unsigned i = 0; i < pulse; ++i) block.clock();
    EXPECT_EQ(m.started_o, pulse == 3 ? 1 : 0);
  }
}

TEST_F(FrameSamplerBlock, AtRest_NothingMoves) {
  frame(5, 30, 0, 2);
  m.run_i = 0;
  const auto seen = [this] {
    m.eval();
    return std::vector<unsigned>{m.eye_valid_o, m.eye_width_o, m.eye_point_o,
                                 m.started_o,   m.bit_valid_o, m.bit_o};
  };
  const auto before = seen();
  for (int i = 0; i < 200; ++i) {
    m.sl_i = static_cast<std::uint8_t>(dice.below(2));
    block.clock();
    ASSERT_EQ(seen(), before);
  }
  m.sl_i = 1;
  frame(7, 40, 3, 3);
  EXPECT_EQ(got, word.substr(2));
}

}  // namespace
