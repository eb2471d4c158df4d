// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The decoder of FREQS alone: page 30, Table 35.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_freqs_dec.h"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::Block;

// Table 35: MA period in clocks for every code; 0x10 is not permitted, the choice is f_CLK / 20.
TEST(FreqsDecBlock, EveryCode_GivesTable35sPeriod) {
  Block<Vmb4_freqs_dec> decoder;
  for (unsigned code = 0; code < 32; ++code) {
    decoder.model.freqs_i = static_cast<std::uint8_t>(code);
    decoder.model.eval();
    const unsigned period = 2U * decoder.model.half_len_o;
    if (code <= 0x0F) {
      EXPECT_EQ(period, 2 * (code + 1));
    } else if (code == 0x10) {
      EXPECT_EQ(period, 20U);
    } else if (code == 0x11) {
      EXPECT_EQ(period, 40U);
    } else {
      EXPECT_EQ(period, 20 * (code - 15));
    }
  }
}

}  // namespace
