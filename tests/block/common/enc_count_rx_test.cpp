// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Events from another clock domain as steps of a Gray count.
#include <gtest/gtest.h>

#include <cstdint>

#include "Venc_count_rx.h"
#include "tests/support/model_context.hpp"

namespace {

// Steps at any time, at most two ahead of the answer: each gives one pulse, three clocks apart.
TEST(CountRxBlock, RandomSteps_OnePulseEachAndThreeClocksApart) {
  static constexpr std::uint8_t kGray[] = {0, 1, 3, 2};
  mb4test::Dice random;
  mb4test::Block<Venc_count_rx> block;
  auto& m = block.model;
  m.count_i = 0;
  block.reset();
  unsigned sent = 0, pulses = 0, clock = 0, last = 0, answered = 0;
  while (sent < 5'000 || pulses < sent) {
    ASSERT_LT(clock++, 100'000U);
    while (answered < sent && m.ack_o == kGray[(answered + 1) % 4]) ++answered;
    while (sent < 5'000 && sent - answered < 2 && random.below(3) == 0)
      m.count_i = kGray[++sent % 4];
    m.eval();
    if (m.pulse_o != 0) {
      ++pulses;
      ASSERT_LE(pulses, sent) << "clock " << clock;
      ASSERT_TRUE(pulses == 1 || clock - last >= 3) << "clock " << clock;
      last = clock;
    }
    ASSERT_LE(answered, pulses) << "clock " << clock;
    block.clock();
  }
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(m.pulse_o, 0);
    block.clock();
  }
  EXPECT_EQ(m.ack_o, m.count_i);
}

}  // namespace
