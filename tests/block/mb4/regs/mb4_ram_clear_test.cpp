// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The clearing of the data memories after a reset: page 22.
#include <gtest/gtest.h>

#include <vector>

#include "Vmb4_ram_clear.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

TEST(RamClearBlock, EachReset_ClearsEveryAddressOnce) {
  mb4test::Block<Vmb4_ram_clear> block;
  auto& m = block.model;
  namespace at = mb4test::places::mb4_pkg::mem_wr_t;
  const auto busy = [&] { return at::kEn.of(m.clear_o) != 0; };
  for (const unsigned clocks : {200U, 10U, 64U, 200U}) {
    m.rst_ni = 0;
    block.clock();
    m.rst_ni = 1;
    m.eval();
    ASSERT_TRUE(busy()) << "the host reads 0 from the reset on";
    std::vector<unsigned> seen(64);
    for (unsigned i = 0; i < clocks; ++i) {
      ASSERT_EQ(busy(), i < 64) << "clock " << i;
      if (busy()) {
        ++seen.at(at::kAddr.of(m.clear_o));
        ASSERT_EQ(at::kData.of(m.clear_o), 0U);
      }
      block.clock();
    }
    if (clocks < 64) continue;
    EXPECT_EQ(seen, std::vector<unsigned>(64, 1));
  }
}

}  // namespace
