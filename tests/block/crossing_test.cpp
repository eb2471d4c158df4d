// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Crossings between the host and the core clock at hostile ratios, and the clock switch.
#include <gtest/gtest.h>

#include <random>

#include "Vmb4_clk_mux.h"
#include "Vmb4_posted.h"
#include "model_context.hpp"

namespace {

// A reset is an edge to Verilator.
void reset(Vmb4_clk_mux& mux) {
  for (const int level : {1, 0, 1}) {
    mux.rst_ni = static_cast<std::uint8_t>(level);
    mux.eval();
  }
}

// Two free clocks in picoseconds; host writes every `gap` host edges.
TEST(PostedBlock, HostBytesOf160nsAndAnyCoreClock_NoneIsLostOrDoubled) {
  for (const unsigned clk_ps : {40'000U, 50'000U, 60'000U, 72'300U, 79'999U}) {
    for (unsigned phase = 0; phase < clk_ps; phase += clk_ps / 13) {
      mb4test::Owned<Vmb4_posted> owner;
      Vmb4_posted& posted = *owner;
      posted.hclk_i = posted.clk_i = 0;
      posted.hrst_ni = posted.rst_ni = 0;
      posted.wr_en_i = 0;
      posted.ready_i = 1;
      posted.eval();
      for (int i = 0; i < 3; ++i) {
        posted.clk_i = 1;
        posted.hclk_i = 1;
        posted.eval();
        posted.clk_i = 0;
        posted.hclk_i = 0;
        posted.eval();
      }
      posted.hrst_ni = posted.rst_ni = 1;
      posted.eval();
      // A byte lasts eight SCLK periods of 20 ns; its write comes with the last rising edge.
      std::uint64_t host_edge = 160'000;
      std::uint64_t core_edge = phase + 1;
      std::vector<std::uint16_t> sent, received;
      std::mt19937 random(7);
      while (received.size() < 300 && host_edge < 300'000'000) {
        if (host_edge <= core_edge) {
          if (sent.size() < 300) {
            posted.wr_en_i = 1;
            posted.wr_data_i = static_cast<std::uint16_t>(random());
            sent.push_back(posted.wr_data_i);
          }
          posted.hclk_i = 1;
          posted.eval();
          posted.hclk_i = 0;
          posted.wr_en_i = 0;
          posted.eval();
          host_edge += 160'000;
        } else {
          posted.eval();
          if (posted.valid_o != 0) received.push_back(posted.data_o);
          posted.clk_i = 1;
          posted.eval();
          posted.clk_i = 0;
          posted.eval();
          core_edge += clk_ps;
        }
      }
      EXPECT_EQ(sent, received) << "clk " << clk_ps << " phase " << phase;
    }
  }
}

// Page 23, decision 32: no pulse shorter than half a period of the clock it belongs to.
TEST(ClockMuxBlock, SwitchingAtAnyPhase_NoShortPulse) {
  const std::uint64_t half0 = 25'000;
  for (const std::uint64_t half1 : {20'000ULL, 25'100ULL, 40'000ULL, 7'000ULL}) {
    mb4test::Owned<Vmb4_clk_mux> owner;
    Vmb4_clk_mux& mux = *owner;
    mux.clk0_i = mux.clk1_i = 0;
    mux.sel_i = 0;
    reset(mux);
    std::mt19937_64 random(11);
    std::uint64_t now = 0, next0 = half0, next1 = half1, next_sel = 1'000'000;
    std::uint64_t last_change = 0;
    std::uint64_t edges = 0;
    int level = 0;
    while (now < 400'000'000) {
      now = std::min({next0, next1, next_sel});
      if (now == next0) {
        mux.clk0_i = !mux.clk0_i;
        next0 += half0;
      }
      if (now == next1) {
        mux.clk1_i = !mux.clk1_i;
        next1 += half1;
      }
      if (now == next_sel) {
        mux.sel_i = !mux.sel_i;
        next_sel += 400'000 + random() % 700'000;
      }
      mux.eval();
      if (mux.clk_o != level) {
        if (level == 1 || edges > 0) {
          EXPECT_GE(now - last_change, std::min(half0, half1)) << now;
        }
        level = mux.clk_o;
        last_change = now;
        ++edges;
      }
    }
    EXPECT_GT(edges, 4000U);
  }
}

// A pin CLK that never toggled does not keep the oscillator from being chosen.
TEST(ClockMuxBlock, FirstClockNeverToggles_SecondCanBeChosen) {
  mb4test::Owned<Vmb4_clk_mux> owner;
  Vmb4_clk_mux& mux = *owner;
  mux.clk0_i = mux.clk1_i = 0;
  mux.sel_i = 1;
  reset(mux);
  unsigned rises = 0;
  for (int i = 0; i < 40; ++i) {
    const auto before = mux.clk_o;
    mux.clk1_i = !mux.clk1_i;
    mux.eval();
    if (mux.clk_o != 0 && before == 0) ++rises;
  }
  EXPECT_GE(rises, 16U);
}

}  // namespace
