// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of a line, each alone: CRC, divider and time base, sampler.
#include <gtest/gtest.h>

#include <string>

#include "Venc_crc.h"
#include "Vmb4_freqs_dec.h"
#include "Vbiss_sl_sampler.h"
#include "Vbiss_timebase.h"
#include "model_context.hpp"

namespace {

template <typename Model>
class Block {
 public:
  Block() {
    if constexpr (requires { model.clk_i; }) {
      model.clk_i = 0;
      model.rst_ni = 0;
      model.eval();  // what the first call finds is no edge
    }
  }
  void reset() {
    clock();
    model.rst_ni = 1;
    clock();
  }
  void clock() {
    model.clk_i = 1;
    model.eval();
    model.clk_i = 0;
    model.eval();
  }
  mb4test::Owned<Model> owner;
  Model& model = *owner;
};

// Golden vectors of protocol facts, section 7: 28 bits of 0x2ABCDEF with nE = nW = 1.
TEST(CrcBlock, GoldenVectors_OfAllWidthsAndStarts) {
  struct Row {
    unsigned width;
    std::uint32_t polynomial;
    std::uint16_t start0, start1, start_ffff;
  };
  const Row rows[] = {{3, 0xB, 0x5, 0x4, 0x2},
                      {4, 0x13, 0x9, 0x4, 0xE},
                      {5, 0x25, 0x10, 0x06, 0x1E},
                      {6, 0x43, 0x18, 0x04, 0x31},
                      {7, 0x89, 0x21, 0x12, 0x20},
                      {8, 0x12F, 0x0C, 0xEC, 0x7E},
                      {16, 0x190D9, 0x13F8, 0x2264, 0x07A8}};
  Block<Venc_crc> crc;
  crc.model.load_i = 0;
  crc.model.shift_i = 0;
  crc.reset();
  const std::string data = "1010101011110011011110111111";
  for (const Row& row : rows) {
    for (const auto& [start, expected] : {std::pair<std::uint16_t, std::uint16_t>{0, row.start0},
                                          {1, row.start1},
                                          {0xFFFF, row.start_ffff}}) {
      crc.model.crc16_i = row.width == 16;
      crc.model.poly_i = static_cast<std::uint8_t>(row.polynomial);  // degree 16: its lower half
      crc.model.top_i = static_cast<std::uint8_t>(row.width == 16 ? 0U : 1U << (row.width - 1));
      crc.model.start_i = start;
      crc.model.load_i = 1;
      crc.clock();
      crc.model.load_i = 0;
      crc.model.shift_i = 1;
      crc.model.feed_i = 1;
      for (const char bit : data) {
        crc.model.bit_i = bit == '1' ? 1 : 0;
        crc.clock();
      }
      crc.model.feed_i = 0;
      unsigned value = 0;
      for (unsigned i = 0; i < row.width; ++i) {
        crc.model.bit_i = i & 1U;  // must not matter
        crc.model.eval();
        value = (value << 1) | crc.model.top_o;
        crc.clock();
      }
      crc.model.shift_i = 0;
      EXPECT_EQ(value, expected) << "width " << row.width << " start " << start;
    }
  }
}

// Table 35: MA period in clocks for every code; 0x10 is not permitted, the choice is f_CLK / 20.
TEST(DividerBlock, EveryCode_GivesTable35sPeriod) {
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

// Page 12: four equally spaced sampling points in each MA period, two clocks late.
TEST(DividerBlock, EveryHalfLength_TicksAndFourEvenSamplingPoints) {
  for (const unsigned half : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 15U, 16U, 20U, 30U, 150U, 160U}) {
    Block<Vbiss_timebase> base;
    auto& m = base.model;
    m.half_len_i = static_cast<std::uint8_t>(half);
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
      if (m.smp_a_o != 0) points.push_back(2 * i);
      if (m.smp_b_o != 0) points.push_back(2 * i + (m.smp_b_neg_o != 0 ? 1U : 0U));
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
}

// Decision 2: sampling points after rising edge 2 up to and including the first that reads 0.
TEST(SamplerBlock, DelayOfKQuarters_CountsKPlusOneAndTakesBitsMidway) {
  for (const unsigned half : {1U, 2U, 3U, 8U}) {
    for (unsigned delay = 0; delay < 60 * half; delay += 1 + half / 3) {  // in half clocks
      Block<Vbiss_sl_sampler> sampler;
      auto& m = sampler.model;
      m.sl_i = 1;
      m.smp_a_i = m.smp_b_i = m.smp_half_i = 0;
      m.smp_b_neg_i = half & 1U;
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
          m.smp_a_i = is_point(t) && (t / h) % 2 == 0 ? 1 : 0;
          const int b = (half & 1U) != 0 ? t + 1 : t;
          m.smp_b_i = is_point(b) && (b / h) % 2 == 1 ? 1 : 0;
          m.smp_half_i = t >= 0 && (t / (2 * h)) % 2 == 0 ? 1 : 0;
        };
        // The engine's own flags: armed from rising edge 2 on, seen one clock early by point b.
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
