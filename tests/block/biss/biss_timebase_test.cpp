// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The time base of the lines alone.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vbiss_timebase.h"
#include "Vbiss_timebase_wide.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::biss_pkg;

using mb4test::Block;

// Half an MA period of half clocks, as last_i and tens_i ask for it. Page 12: four equally spaced
// sampling points in each MA period, two clocks late.
template <class Model>
void expect_half(unsigned half, std::uint8_t last, std::uint8_t tens) {
  Block<Model> base;
  auto& m = base.model;
  m.last_i = last;
  m.tens_i = tens;
  m.run_i = 0;
  m.restart_i = 0;
  base.reset();
  m.restart_i = 1;
  base.clock();
  m.restart_i = 0;
  m.run_i = 1;
  std::vector<unsigned> points;  // in half clocks
  unsigned ticks = 0;
  for (unsigned i = 0; i < 8 * half + 2; ++i) {
    m.eval();
    if (m.tick_o != 0) {
      EXPECT_EQ((i + 1) % half, 0U) << i;
      EXPECT_EQ(m.half_next_o, ticks % 2) << "the first half period is high";
      ++ticks;
    }
    using namespace at::sample_t;
    if (kA.of(m.sample_o) != 0) points.push_back(2 * i);
    if (kB.of(m.sample_o) != 0) {
      points.push_back(2 * i + static_cast<unsigned>(kBNeg.of(m.sample_o)));
    }
    base.clock();
  }
  EXPECT_EQ(ticks, (8 * half + 2) / half) << half;
  // Only from the first tick on is the grid complete.
  unsigned checked = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k - 1] < 2 * half + 4) continue;
    EXPECT_EQ(points[k] - points[k - 1], half) << "half " << half << " point " << k;
    ++checked;
  }
  EXPECT_GE(checked, 10U);
}

// Page 30, Table 35. 0x10 is not permitted; the choice is f_CLK / 20 (docs/choices.md).
TEST(TimebaseBlock, EveryCodeOfFreqs_TicksAndFourEvenSamplingPoints) {
  for (unsigned code = 0; code < 32; ++code) {
    expect_half<Vbiss_timebase>(code < 0x10 ? code + 1 : 10 * (code - 15),
                                static_cast<std::uint8_t>(code % 16),
                                static_cast<std::uint8_t>(code / 16));
  }
}

// As biss_axi has it: eight bits of steps, a step is one clock.
TEST(TimebaseBlock, EveryLengthOfEightBits_TicksAndFourEvenSamplingPoints) {
  for (unsigned half = 1; half <= 256; ++half) {
    expect_half<Vbiss_timebase_wide>(half, static_cast<std::uint8_t>(half - 1), 0);
  }
}

}  // namespace
