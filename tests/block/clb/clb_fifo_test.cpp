// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The FIFO against a queue: order, level, overflow, interrupt flag, what an empty FIFO shows.
#include <gtest/gtest.h>

#include <cstdint>
#include <deque>

#include "Vclb_fifo.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace fifo_t = mb4test::places::clb_pkg::fifo_t;

class ClbFifo : public testing::Test {
 protected:
  ClbFifo() {
    m.enable_i = 1;
    m.level_i = 0;
    m.push_i = m.pop_i = m.int_clear_i = m.overflow_clear_i = 0;
    m.word_i = 0;
    block.reset();
  }
  void push(unsigned word) {
    m.word_i = static_cast<std::uint16_t>(word);
    m.push_i = 1;
    clock();
    m.push_i = 0;
    clock();
  }
  unsigned pop() {
    const auto word = static_cast<unsigned>(shown());
    m.pop_i = 1;
    clock();
    m.pop_i = 0;
    clock();
    clock();
    return word;
  }
  void clock() {
    m.eval();
    lost += m.lost_o;
    block.clock();
  }
  void pulse(std::uint8_t& port) {
    port = 1;
    clock();
    port = 0;
  }
  std::uint64_t shown() const { return fifo_t::kWord.of(m.fifo_o); }
  std::uint64_t level() const { return fifo_t::kLevel.of(m.fifo_o); }
  bool raised() const { return fifo_t::kRaised.of(m.fifo_o) != 0; }
  bool overflow() const { return fifo_t::kOverflow.of(m.fifo_o) != 0; }

  unsigned lost = 0;
  mb4test::Dice dice;
  mb4test::Block<Vclb_fifo> block;
  Vclb_fifo& m = block.model;
};

TEST_F(ClbFifo, Empty_ShowsTheLastWordAgain) {
  EXPECT_EQ(level(), 0U);
  EXPECT_EQ(shown(), 0U) << "nothing has come";
  pop();
  EXPECT_EQ(level(), 0U);
  push(0x123);
  push(0x456);
  EXPECT_EQ(pop(), 0x123U);
  EXPECT_EQ(pop(), 0x456U);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(pop(), 0x456U);
  EXPECT_EQ(level(), 0U);
  push(0x789);
  EXPECT_EQ(pop(), 0x789U);
  m.enable_i = 0;
  clock();
  m.enable_i = 1;
  EXPECT_EQ(pop(), 0x789U);
}

TEST_F(ClbFifo, Word17_IsDroppedAndReported) {
  for (unsigned i = 0; i < 16; ++i) {
    push(0x100 + i);
    EXPECT_EQ(level(), i + 1);
  }
  EXPECT_FALSE(overflow());
  push(0xBAD);
  EXPECT_TRUE(overflow());
  EXPECT_EQ(lost, 1U);
  EXPECT_EQ(level(), 16U);
  for (unsigned i = 0; i < 16; ++i) EXPECT_EQ(pop(), 0x100 + i);
  EXPECT_EQ(level(), 0U);
  EXPECT_TRUE(overflow());
  pulse(m.overflow_clear_i);
  EXPECT_FALSE(overflow());
}

TEST_F(ClbFifo, Interrupt_IsKeptUntilClearedBelowTheLevel) {
  for (unsigned limit = 1; limit <= 16; ++limit) {
    m.level_i = static_cast<std::uint8_t>(limit);
    for (unsigned i = 0; i < limit; ++i) {
      EXPECT_FALSE(raised()) << limit << ' ' << i;
      push(i);
      clock();
    }
    EXPECT_TRUE(raised()) << limit;
    pulse(m.int_clear_i);
    clock();
    EXPECT_TRUE(raised()) << "the level is still there";
    pop();
    EXPECT_TRUE(raised()) << "kept";
    pulse(m.int_clear_i);
    EXPECT_FALSE(raised());
    while (level() != 0) pop();
  }
  m.level_i = 0;
  for (unsigned i = 0; i < 16; ++i) push(i);
  clock();
  EXPECT_FALSE(raised()) << "level 0 never interrupts";
}

TEST_F(ClbFifo, Disabled_HoldsItEmpty) {
  for (unsigned i = 0; i < 5; ++i) push(i);
  m.enable_i = 0;
  clock();
  EXPECT_EQ(level(), 0U);
  push(7);
  m.enable_i = 1;
  clock();
  EXPECT_EQ(level(), 0U);
  EXPECT_FALSE(overflow());
  push(0xABC);
  EXPECT_EQ(pop(), 0xABCU);
}

TEST_F(ClbFifo, RandomPushesAndPops_KeepTheOrder) {
  std::deque<unsigned> words;
  unsigned last = 0, dropped = 0;
  for (int i = 0; i < 20'000; ++i) {
    const unsigned want = dice.below(100) < (i / 2000 % 2 != 0 ? 65U : 35U) ? 1U : 0U;
    if (want != 0) {
      const unsigned word = dice.below(0x10000);
      if (words.size() < 16)
        words.push_back(word);
      else
        ++dropped;
      push(word);
    } else {
      if (!words.empty()) {
        last = words.front();
        words.pop_front();
      }
      EXPECT_EQ(pop(), last);
    }
    clock();
    ASSERT_EQ(level(), words.size());
  }
  EXPECT_EQ(lost, dropped);
  EXPECT_GT(dropped, 100U);
}

}  // namespace
