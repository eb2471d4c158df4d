// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sampler of SL alone.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "Vbiss_sl_sampler.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::biss_pkg;

using mb4test::Block;

// Decision 2: sampling points after rising edge 2 up to and including the first that reads 0.
TEST(SamplerBlock, DelayOfKQuarters_CountsKPlusOneAndTakesBitsMidway) {
  for (const unsigned half : {1U, 2U, 3U, 8U}) {
    for (unsigned delay = 0; delay < 60 * half; delay += 1 + half / 3) {  // in half clocks
      Block<Vbiss_sl_sampler> sampler;
      auto& m = sampler.model;
      m.sl_i = 1;
      m.sample_i = half & 1U;
      m.sample_half_i = 0;
      m.clear_i = 0;
      m.armed_a_i = m.armed_b_i = 0;
      sampler.reset();
      m.clear_i = 1;
      sampler.clock();
      m.clear_i = 0;
      // Time 0 (in half clocks) is the rising clock edge at which MA rises for the second time. SL
      // falls `delay` plus a quarter of a half clock later; then bits follow, one a period: 1 0
      // 1 1.
      const unsigned period = 4 * half;
      const std::string bits = "1011001110001";
      const auto level = [&](int time) {
        // `time` is an edge: what the flop sees is the level just before it.
        const int since = time - 1 - static_cast<int>(delay);
        if (since < 0) return true;
        const unsigned slot = static_cast<unsigned>(since) / period;
        if (slot == 0) return false;
        return slot - 1 >= bits.size() || bits[slot - 1] == '1';
      };
      std::string seen;
      // Two clocks of pipeline: the marks for a point at time t come in the clock before t + 4.
      for (int n = -4; n < static_cast<int>(period * 20 + 70 * half); ++n) {
        const auto marks = [&](int clock_edge) {
          // Points of the clock that begins at `clock_edge` (its rising edge and its falling edge).
          const int t = 2 * clock_edge;
          const int h = static_cast<int>(half);
          const auto is_point = [&](int time) { return time >= 0 && time % h == 0; };
          const bool point_a = is_point(t) && (t / h) % 2 == 0;
          const int b = (half & 1U) != 0 ? t + 1 : t;
          const bool point_b = is_point(b) && (b / h) % 2 == 1;
          const bool level_ma = t >= 0 && (t / (2 * h)) % 2 == 0;
          m.sample_i = static_cast<std::uint8_t>(
              at::sample_t::kA(point_a) | at::sample_t::kB(point_b) | at::sample_t::kBNeg(half));
          m.sample_half_i = level_ma ? 1 : 0;
        };
        // The flags of biss_frame: armed from rising edge 2 on, for point b one clock early.
        m.armed_a_i = n >= 1 ? 1 : 0;
        m.armed_b_i = n >= 0 ? 1 : 0;
        marks(n - 2);
        m.eval();
        if (m.bit_valid_o != 0) seen += m.bit_o != 0 ? '1' : '0';
        m.sl_i = level(2 * n) ? 1 : 0;
        m.clk_i = 1;
        m.eval();
        m.sl_i = level(2 * n + 1) ? 1 : 0;
        m.clk_i = 0;
        m.eval();
      }
      const unsigned quarters = delay / half + 1;
      EXPECT_EQ(m.quarters_o, quarters) << "half " << half << " delay " << delay;
      ASSERT_GE(seen.size(), bits.size());
      EXPECT_EQ(seen.substr(0, bits.size()), bits) << "half " << half << " delay " << delay;
    }
  }
}

}  // namespace
