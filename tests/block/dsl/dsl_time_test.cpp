// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Time: of each edge that of its clock, for the host that of a clock of its access.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vdsl_time.h"
#include "tests/support/model_context.hpp"

namespace {

class DslTimeBlock : public testing::Test {
 protected:
  DslTimeBlock() {
    m.edge_i = m.edge_next_i = m.copy_i = m.host_address_i = 0;
    block.clock();
    m.rst_ni = 1;
    m.eval();
  }
  void clock() {
    block.clock();
    ++now;
  }
  std::uint64_t host() {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < 8; ++i) {
      m.host_address_i = static_cast<CData>(i);
      clock();
      value |= std::uint64_t{m.host_data_o} << 8 * i;
    }
    return value;
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_time> block;
  Vdsl_time& m = block.model;
  std::uint64_t now = 0;  // clocks since the reset
};

TEST_F(DslTimeBlock, BeforeTheFirstCopy_TheHostReadsZero) {
  for (unsigned i = 0; i < 9; ++i) clock();
  EXPECT_EQ(host(), 0U);
}

TEST_F(DslTimeBlock, EdgesAtRandom_HaveTheTimeOfTheirClock) {
  for (unsigned i = 0; i < 8; ++i) clock();
  std::uint64_t copied = 0;
  for (unsigned turn = 0; turn < 30'000; ++turn) {
    const std::uint64_t edge = now;
    m.edge_i = 1;
    clock();
    m.edge_i = 0;
    for (unsigned rest = 17 + random.below(40); rest != 0; --rest) {
      // The host copies now and then.
      if (m.copy_i == 0 && rest > 17 && random.below(15) == 0) {
        m.copy_i = 1;
        m.eval();
        copied = now;
      }
      const bool done = m.copied_o != 0;
      clock();
      if (m.copy_i == 0 || !done) continue;
      m.copy_i = 0;
      const std::uint64_t end = now;
      ASSERT_LE(end - copied, 16U);
      // The first of its eight bytes.
      ASSERT_GE(end - 8, copied);
      ASSERT_EQ(host(), end - 8);
    }
    std::uint64_t value = 0;
    for (unsigned i = 0; i < 8; ++i) {
      value |= std::uint64_t{m.edge_data_o} << 8 * i;
      m.edge_next_i = 1;
      clock();
      m.edge_next_i = 0;
      clock();
    }
    ASSERT_EQ(value, edge);
  }
  EXPECT_GT(now, 1U << 20U);  // carries of two bytes
}

}  // namespace
